#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sessile/core/vec.h"

namespace sessile {

/// Allocator of cache-line-aligned memory that leaves new numbers uninitialised, so that growing costs nothing.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  /// One widest pack of slack at the end: lanes may load past the last element (and mask what they find there).
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T) + 64, alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    if constexpr (sizeof...(Args) == 0 && std::is_trivially_default_constructible_v<U>) {
      ::new (static_cast<void*>(p)) U;
    } else {
      ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
    }
  }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

/// One number per particle, contiguous. resize() leaves new entries uninitialised.
template <class T>
using Array = std::vector<T, AlignedAllocator<T>>;

/// Memory in use [bytes]; what a vector holds in reserve has never been touched.
template <class T>
std::size_t bytes_of(const Array<T>& array) {
  return array.size() * sizeof(T);
}

/// One vector per particle, stored as three arrays so that lanes load or gather each component.
struct Array3 {
  Array<Real> x, y, z;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
  void reserve(std::size_t n) {
    x.reserve(n);
    y.reserve(n);
    z.reserve(n);
  }
  void assign(std::size_t n, const Vec3r& value) {
    x.assign(n, value.x);
    y.assign(n, value.y);
    z.assign(n, value.z);
  }
  void push_back(const Vec3r& v) {
    x.push_back(v.x);
    y.push_back(v.y);
    z.push_back(v.z);
  }
  Vec3r operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3r& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

inline std::size_t bytes_of(const Array3& a) { return bytes_of(a.x) + bytes_of(a.y) + bytes_of(a.z); }

}  // namespace sessile
