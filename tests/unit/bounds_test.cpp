#include "sessile/core/bounds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "sessile/core/views.h"
#include "sessile/neighbors/neighbor_view.h"
#include "sessile/particles/emitter.h"
#include "sessile/scene/lattice.h"
#include "sessile/scene/sampling.h"
#include "sessile/surface/march.h"
#include "support/sparse.h"

/// Indices at the bound, without the memory that as many particles would take.
namespace sessile {
namespace {

constexpr auto last = static_cast<std::int32_t>(most_indices - 1);

template <class F>
std::string said(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Bounds, BlocksCoverAllIndices) {
  std::atomic<std::int64_t> sum = 0, greatest = 0;
  for_each_block(most_indices, [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    EXPECT_EQ(begin, block * block_size);
    sum += end - begin;
    if (end == static_cast<std::ptrdiff_t>(most_indices)) greatest = end;
  });
  EXPECT_EQ(static_cast<std::size_t>(sum), most_indices);
  EXPECT_EQ(static_cast<std::size_t>(greatest), most_indices);
}

TEST(Bounds, LoopsRefuseWhatAnIntDoesNotNumber) {
  const auto nothing = [](auto) {};
  const auto zero = [](int) { return 0.0; };
  EXPECT_NE(said([&] { for_each(most_indices + 1, nothing); }), "");
  EXPECT_NE(said([&] { for_each_group(most_indices + 1, nothing); }), "");
  EXPECT_NE(said([&] { sum(std::size_t{1} << 32, zero); }), "");
}

/// The prefix sums of a radix sort of as many items as there may be: the last starts do not wrap.
TEST(Bounds, DigitsOfTheLastItemsHaveTheirPlaces) {
  std::vector<DigitCounts> chunks(4, DigitCounts{});
  const auto share = static_cast<std::int32_t>(most_indices / 8);
  for (DigitCounts& chunk : chunks) chunk.front() = chunk.back() = share;
  counts_to_starts(chunks);
  for (std::int32_t c = 0; c < 4; ++c) {
    EXPECT_EQ(chunks[static_cast<std::size_t>(c)].front(), c * share);
    EXPECT_EQ(chunks[static_cast<std::size_t>(c)].back(), (4 + c) * share);
  }
}

/// Indices on both sides of where twice, and four times, an index leaves 32 bits, and the last.
std::vector<std::int32_t> telling_indices() {
  std::vector<std::int32_t> indices{0, 1, (1 << 28) + 3, (1 << 29) + 5, (1 << 30) - 1, 1 << 30, (1 << 30) + 7, last};
  while (indices.size() < 16) indices.push_back(last - static_cast<std::int32_t>(indices.size()));
  return indices;
}

Real mark(std::int32_t j) { return static_cast<Real>(j % 9973 + 1); }

TEST(Bounds, PacksGatherAtTheLastIndex) {
  const test::Sparse<Real> pairs(2 * most_indices);
  if (!pairs) GTEST_SKIP() << "no 16 GB of address space";
  const std::vector<std::int32_t> indices = telling_indices();
  for (const std::int32_t j : indices) {
    pairs[2 * static_cast<std::size_t>(j)] = mark(j);
    pairs[2 * static_cast<std::size_t>(j) + 1] = -mark(j);
  }
  for (std::size_t first = 0; first + lane_count <= indices.size(); first += lane_count) {
    const IndexLanes at = load_indices(indices.data() + first);
    const auto [even, odd] = gather_pairs(pairs.data(), at);
    const Lanes alone = gather(pairs.data(), at);  // as if it were an array of single numbers
    for (std::size_t k = 0; k < lane_count; ++k) {
      const std::int32_t j = indices[first + k];
      EXPECT_EQ(even.get(k), mark(j)) << j;
      EXPECT_EQ(odd.get(k), -mark(j)) << j;
      EXPECT_EQ(alone.get(k), pairs[static_cast<std::size_t>(j)]) << j;
    }
  }
}

/// A sum over the neighbours of the last group of particles, whose lists name the last particles too; entries of all
/// lists together are far more than 32 bits count.
TEST(Bounds, NeighboursOfTheLastGroupAreSummed) {
  constexpr std::size_t lanes = lane_count, last_group = (most_indices - 1) / lanes;
  const test::Sparse<Real> mass(most_indices + lanes);
  const test::Sparse<NeighborGroup> groups(last_group + 1);
  const test::Sparse<std::int32_t> counts((last_group + 1) * lanes);
  if (!mass || !groups || !counts) GTEST_SKIP() << "no 40 GB of address space";
  const std::vector<std::int32_t> indices = telling_indices();
  std::vector<std::int32_t> entries(indices.size() * lanes);
  std::vector<double> expected(lanes, 0);
  for (std::size_t q = 0; q < lanes; ++q) {
    counts[last_group * lanes + q] = static_cast<std::int32_t>(q % indices.size() + 1);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const std::int32_t j = indices[(k + q) % indices.size()];
      entries[k * lanes + q] = j;
      mass[static_cast<std::size_t>(j)] = mark(j);
      if (k <= q % indices.size()) expected[q] += static_cast<double>(mark(j));
    }
  }
  groups[last_group] = {entries.data(), static_cast<std::int32_t>(indices.size())};

  NeighborView near;
  near.groups = groups.data();
  near.count = counts.data();
  const View1 m{mass.data()};
  const auto first = static_cast<int>(last_group * lanes);
  const Lanes packed = near.sum(Group{first}, [&](auto j) { return m[j]; });
  for (int q = 0; q < lane_count; ++q) {
    EXPECT_EQ(static_cast<double>(packed.get(static_cast<std::size_t>(q))), expected[static_cast<std::size_t>(q)]);
    EXPECT_EQ(static_cast<double>(near.sum(first + q, [&](int j) { return m[j]; })),
              expected[static_cast<std::size_t>(q)]);
  }
  const test::Sparse<Real> sums(most_indices + lanes);
  if (!sums) GTEST_SKIP() << "no 40 GB of address space";
  Out1{sums.data()}.set(Group{first}, packed);
  EXPECT_EQ(sums[static_cast<std::size_t>(first)], packed.get(0));
}

TEST(Bounds, CountsOfPointsAreRefusedBeyondIt) {
  EXPECT_EQ(said([] { check_count(2e9, "sea"); }), "");
  EXPECT_EQ(said([] { check_count(2e9 + 1, "sea"); }), "sea: needs more than 2000000000 points at this spacing");
  EXPECT_NE(said([] { check_count(std::numeric_limits<double>::quiet_NaN(), "sea"); }), "");
  EXPECT_NE(said([] { check_count(std::numeric_limits<double>::infinity(), "sea"); }), "");
}

TEST(Bounds, ASheetWithoutALayerHoldsNothing) {
  Body body;
  body.label = "sheet";
  body.shape = Box{{1e9, 1e9, 0.01}};  // 10^20 places a layer, and no layer
  EXPECT_EQ(said([&] { fill(body, 0.1); }), "body \"sheet\" (box): is too small to hold a particle of spacing 0.1 m");
}

TEST(Bounds, AnEmitterIsRefusedWhatCannotBeNumbered) {
  Emitter emitter;
  emitter.label = "spout";
  emitter.shape = Rectangle{0.2, 0.2};
  emitter.interval = 1;
  LayerSource source(emitter, 0.1, Space{});
  Particles particles;
  std::int64_t next_id = 0;
  EXPECT_EQ(source.emit(0, particles, next_id, 4), Emission::emitted);
  particles.position.assign(4, {0, 0, 1});  // out of the way
  EXPECT_EQ(said([&] { source.emit(1, particles, next_id, 7); }),
            "at 1 s the emitter \"spout\" would let 4 particles in to 4 others; there may be 7 in all (give it a count "
            "or an end, or the domain open faces)");
  EXPECT_EQ(particles.size(), 4u);
  EXPECT_EQ(next_id, 4);
  EXPECT_EQ(source.emit(1, particles, next_id, 8), Emission::emitted);
}

TEST(Bounds, SurfacesAreRefusedWhatCannotBeNumbered) {
  EXPECT_EQ(said([] { check_surface_size(most_indices, most_indices); }), "");
  EXPECT_NE(said([] { check_surface_size(most_indices + 1, 0); }), "");
  EXPECT_NE(said([] { check_surface_size(std::uint64_t{1} << 30, std::uint64_t{1} << 31); }), "");
}

/// Lists are masked by their length in the precision of the build: it must tell every length apart.
TEST(Bounds, ListsAreToldApartUpToTheFullestCells) {
  EXPECT_EQ(said([] { refuse_crowding(most_in_a_cell); }), "");
  EXPECT_NE(said([] { refuse_crowding(most_in_a_cell + 1); }), "");
  constexpr auto longest = static_cast<std::int32_t>(27 * most_in_a_cell);
  EXPECT_LT(static_cast<Real>(longest - 1), static_cast<Real>(longest));
  EXPECT_LT(static_cast<std::int64_t>(longest) * lane_count, std::numeric_limits<std::int32_t>::max());
}

}  // namespace
}  // namespace sessile
