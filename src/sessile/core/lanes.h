#pragma once

#ifdef SESSILE_FOR_EVERY_PROCESSOR
#error "what touches lanes is compiled for each instruction set: src/sessile/CMakeLists.txt takes this file for shared"
#endif

#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "sessile/core/real.h"
#include "sessile/core/vec.h"

/// A thin face over xsimd. Pair laws are generic in the types of their two indices: two ints give numbers, a Group of
/// particles and IndexLanes, one neighbour for each of them, give packs, and the same lines of code compute both.
/// Internal: no installed header includes this one.
namespace sessile {

using Lanes = xsimd::batch<Real>;
using LaneIndex = xsimd::as_integer_t<Real>;
using IndexLanes = xsimd::batch<LaneIndex>;
using LaneMask = Lanes::batch_bool_type;
inline constexpr int lane_count = static_cast<int>(Lanes::size);

/// lane_count particles in a row, one a lane; `first` is a multiple of lane_count. Arrays have room for the lanes past
/// the last particle: what is computed there is never read.
struct Group {
  int first;
};

template <class I>
concept ParticleIndex = std::same_as<I, int> || std::same_as<I, Group>;
template <class J>
concept NeighborIndex = std::same_as<J, int> || std::same_as<J, IndexLanes>;

/// What a law computes with: numbers for an int, packs for lanes.
template <class I>
using LaneOf = std::conditional_t<std::same_as<I, int>, Real, Lanes>;

// --- the few functions a pair law needs, for numbers; packs find xsimd's by their argument -------------------------

inline Real select(bool condition, Real a, Real b) { return condition ? a : b; }
inline Real max(Real a, Real b) { return a > b ? a : b; }
inline Real min(Real a, Real b) { return a < b ? a : b; }
using xsimd::cos;
using xsimd::max;
using xsimd::min;
using xsimd::select;
using xsimd::sqrt;

inline bool any(bool condition) { return condition; }
using xsimd::any;

/// Whether no lane is below zero, for assertions; NaN is not.
inline bool none_negative(Real a) { return !(a < 0); }
inline bool none_negative(const Lanes& a) { return !any(a < Lanes(Real(0))); }
inline bool none_negative(const IndexLanes& j) { return !any(j < IndexLanes(0)); }

/// 1/sqrt(a) to float rounding, for a > 0. Root and division of a pack keep its divider busy for some 40 cycles, half
/// of a pass; the processor's estimate and one step of Newton's method take six. xsimd 8.1 names an instruction for it
/// that no common processor has.
inline Real inverse_sqrt(Real a) { return 1 / std::sqrt(a); }
inline Lanes inverse_sqrt(const Lanes& a) {
#if defined(SESSILE_DOUBLE)
  return Lanes(Real(1)) / sqrt(a);
#elif defined(__AVX512F__)
  const Lanes estimate = _mm512_rsqrt14_ps(a);
  return estimate * (Lanes(1.5f) - Lanes(0.5f) * a * estimate * estimate);
#elif defined(__AVX2__)
  const Lanes estimate = _mm256_rsqrt_ps(a);
  return estimate * (Lanes(1.5f) - Lanes(0.5f) * a * estimate * estimate);
#elif defined(__SSE2__)
  const Lanes estimate = _mm_rsqrt_ps(a);
  return estimate * (Lanes(1.5f) - Lanes(0.5f) * a * estimate * estimate);
#else
  return Lanes(Real(1)) / sqrt(a);
#endif
}

/// How two particles lie to each other: what every pair law starts from.
template <class T>
struct Separation {
  Vec3<T> d;    ///< x_i - x_j [m]
  T r;          ///< its length [m]
  T inverse_r;  ///< 1/r [1/m]; a large number at r = 0, so that times d it is 0 there

  explicit Separation(const Vec3<T>& displacement) : d(displacement) {
    // Next to the least number a float can hold, not a length: it stands for r^2 of coincident particles only. Four
    // times as much, as halves of the least number are slow to compute with.
    const T r2 = max(squared_length(d), T(4 * std::numeric_limits<Real>::min()));
    inverse_r = inverse_sqrt(r2);
    r = r2 * inverse_r;
  }
};

// --- sums over neighbours: start, add, add where the mask holds -----------------------------------------------------

inline void set_zero(Real& a) { a = 0; }
inline void set_zero(Lanes& a) { a = Lanes(Real(0)); }
inline void add_where(const LaneMask& mask, Lanes& sum, const Lanes& a) { sum += select(mask, a, Lanes(Real(0))); }
inline void add(Real& sum, Real a) { sum += a; }

template <class T>
void set_zero(Vec3<T>& a) {
  set_zero(a.x), set_zero(a.y), set_zero(a.z);
}
inline void add_where(const LaneMask& mask, Vec3<Lanes>& sum, const Vec3<Lanes>& a) {
  add_where(mask, sum.x, a.x), add_where(mask, sum.y, a.y), add_where(mask, sum.z, a.z);
}
inline void add(Vec3r& sum, const Vec3r& a) { sum += a; }

template <class... T>
void set_zero(std::tuple<T...>& a) {
  std::apply([](auto&... each) { (set_zero(each), ...); }, a);
}
template <class... T>
void add_where(const LaneMask& mask, std::tuple<T...>& sum, const std::tuple<T...>& a) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (add_where(mask, std::get<k>(sum), std::get<k>(a)), ...); }
  (std::index_sequence_for<T...>{});
}
template <class... T>
void add(std::tuple<T...>& sum, const std::tuple<T...>& a) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (add(std::get<k>(sum), std::get<k>(a)), ...); }
  (std::index_sequence_for<T...>{});
}

// --- loads --------------------------------------------------------------------------------------------------------

/// Lane numbers 0, 1, 2 ...
inline Lanes lane_numbers() {
  alignas(64) Real numbers[lane_count];
  for (int k = 0; k < lane_count; ++k) numbers[k] = Real(k);
  return Lanes::load_aligned(numbers);
}

/// lane_count numbers from a list of int32.
inline IndexLanes load_indices(const std::int32_t* list) {
  if constexpr (std::same_as<LaneIndex, std::int32_t>) {
    return IndexLanes::load_unaligned(list);
  } else {
    alignas(64) LaneIndex wide[lane_count];
    for (int k = 0; k < lane_count; ++k) wide[k] = list[k];
    return IndexLanes::load_aligned(wide);
  }
}

/// A full mask that the compiler does not know to be full. With it a gather goes into a register set to zero; with a
/// known one GCC 12 leaves the zero out, the gather waits for whoever wrote the register before, and so the turns of a
/// loop wait for each other.
#if defined(__AVX512F__) && !defined(SESSILE_DOUBLE)
inline __mmask16 all_lanes() {
  __mmask16 all = 0xffff;
  asm("" : "+k"(all));
  return all;
}
#elif defined(__AVX2__) && !defined(SESSILE_DOUBLE)
inline __m256i all_lanes() {
  __m256i all = _mm256_set1_epi32(-1);
  asm("" : "+x"(all));
  return all;
}
#endif

/// The numbers data[j] of the lanes' indices. xsimd 8.1 picks its element-by-element gather even where the processor
/// has one (a pass then takes twice as long), so the instruction is named here.
inline Lanes gather(const Real* data, const IndexLanes& j) {
  assert(data != nullptr && none_negative(j));
#if defined(SESSILE_DOUBLE)
  return Lanes::gather(data, j);
#elif defined(__AVX512F__)
  return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), all_lanes(), j, data, sizeof(Real));
#elif defined(__AVX2__)
  return _mm256_mask_i32gather_ps(_mm256_setzero_ps(), data, j, _mm256_castsi256_ps(all_lanes()), sizeof(Real));
#elif defined(__SSE2__)
  alignas(16) std::int32_t at[4];
  j.store_aligned(at);
  return _mm_setr_ps(data[at[0]], data[at[1]], data[at[2]], data[at[3]]);
#else
  return Lanes::gather(data, j);
#endif
}

/// Writes the entries list[j] of the lanes' indices to `to`, one after the other; `to` is aligned to a pack of them.
/// Past the caches where the processor can: whole lists are long, and nobody reads them soon. finish_streams() must
/// follow before another thread does.
inline void stream_entries(const std::int32_t* list, const IndexLanes& j, std::int32_t* to) {
#if defined(__AVX512F__) && !defined(SESSILE_DOUBLE)
  const __m512i entries =
      _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), all_lanes(), j, list, sizeof(std::int32_t));
  _mm512_stream_si512(reinterpret_cast<__m512i*>(to), entries);
#else
  alignas(64) LaneIndex at[lane_count];
  j.store_aligned(at);
  for (int k = 0; k < lane_count; ++k) to[k] = list[at[k]];
#endif
}

/// The numbers data[2j] and data[2j + 1] of the lanes' indices. Gathers of 64 bits fetch both at once, and a gather's
/// time goes by how many places it looks at.
inline std::pair<Lanes, Lanes> gather_pairs(const Real* data, const IndexLanes& j) {
  assert(data != nullptr && none_negative(j));
#if defined(__AVX512F__) && !defined(SESSILE_DOUBLE)
  const auto half = [&](__m256i at) {
    const auto all = static_cast<__mmask8>(all_lanes());
    return _mm512_castpd_ps(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), all, at, data, 2 * sizeof(Real)));
  };
  const __m512i at = j;
  const __m512 low = half(_mm512_castsi512_si256(at)), high = half(_mm512_extracti64x4_epi64(at, 1));
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odd = _mm512_or_si512(even, _mm512_set1_epi32(1));
  return {_mm512_permutex2var_ps(low, even, high), _mm512_permutex2var_ps(low, odd, high)};
#elif defined(__AVX2__) && !defined(SESSILE_DOUBLE)
  const auto half = [&](__m128i at) {
    return _mm256_castpd_ps(_mm256_mask_i32gather_pd(_mm256_setzero_pd(), reinterpret_cast<const double*>(data), at,
                                                     _mm256_castsi256_pd(all_lanes()), 2 * sizeof(Real)));
  };
  const __m256i at = j;
  const __m256 low = half(_mm256_castsi256_si128(at)), high = half(_mm256_extracti128_si256(at, 1));
  // Shuffles work in halves of a register: pairs 0 1 4 5 2 3 6 7 are put in order after them.
  const auto in_order = [](__m256 a) {
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(a), _MM_SHUFFLE(3, 1, 2, 0)));
  };
  return {in_order(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0))),
          in_order(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))};
#elif defined(__SSE2__) && !defined(SESSILE_DOUBLE)
  // Not by 2j in the lanes, which has 32 bits.
  alignas(16) std::int32_t at[4];
  j.store_aligned(at);
  const auto pair = [&](int k) { return data + 2 * std::ptrdiff_t{at[k]}; };
  const Real *const a = pair(0), *const b = pair(1), *const c = pair(2), *const d = pair(3);
  return {_mm_setr_ps(a[0], b[0], c[0], d[0]), _mm_setr_ps(a[1], b[1], c[1], d[1])};
#else
  alignas(64) LaneIndex at[lane_count];
  alignas(64) Real first[lane_count], second[lane_count];
  j.store_aligned(at);
  for (int k = 0; k < lane_count; ++k) {
    first[k] = data[2 * std::ptrdiff_t{at[k]}];
    second[k] = data[2 * std::ptrdiff_t{at[k]} + 1];
  }
  return {Lanes::load_aligned(first), Lanes::load_aligned(second)};
#endif
}

/// Writes those of the lane_count numbers from `from` on whose lane is set in the mask to `to`, in order; returns how
/// many. May write a whole pack. xsimd 8.1 has no compressing store.
inline int store_where(const LaneMask& mask, const std::int32_t* from, std::int32_t* to) {
#if defined(__AVX512F__) && !defined(SESSILE_DOUBLE)
  const __mmask16 bits = mask;
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(bits, _mm512_loadu_si512(from)));
  return __builtin_popcount(bits);
#else
  alignas(64) bool holds[lane_count];
  mask.store_aligned(holds);
  int count = 0;
  for (int k = 0; k < lane_count; ++k) {
    to[count] = from[k];
    count += holds[k];
  }
  return count;
#endif
}

/// Makes what stream_entries wrote visible to other threads.
inline void finish_streams() {
#if defined(__AVX512F__) && !defined(SESSILE_DOUBLE)
  _mm_sfence();
#endif
}

}  // namespace sessile
