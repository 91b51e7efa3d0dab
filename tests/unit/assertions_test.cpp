#include <gtest/gtest.h>

#include "sessile/core/lanes.h"
#include "sessile/kernels/cubic_spline.h"
#include "sessile/neighbors/neighbor_view.h"
#include "support/cloud.h"

// That a build with assertions has them: without these the unit tests in it would say no more than in the others.
namespace sessile::test {
namespace {

#ifdef NDEBUG
#define SESSILE_NEEDS_ASSERTIONS GTEST_SKIP() << "a build without assertions"
#else
#define SESSILE_NEEDS_ASSERTIONS (void)0
#endif

TEST(AssertionsDeathTest, StopAGatherBeforeTheFirstParticle) {
  SESSILE_NEEDS_ASSERTIONS;
  const Array<Real> numbers(64, Real(1));
  EXPECT_DEATH(static_cast<void>(gather(numbers.data(), IndexLanes(-1))), "none_negative");
  EXPECT_DEATH(static_cast<void>(gather_pairs(numbers.data(), IndexLanes(-1))), "none_negative");
}

TEST(AssertionsDeathTest, StopAKernelAtANegativeDistance) {
  SESSILE_NEEDS_ASSERTIONS;
  const CubicSpline W(0.2, 0.1);
  EXPECT_DEATH(static_cast<void>(W.value(Lanes(Real(-0.1)))), "none_negative");
  EXPECT_DEATH(static_cast<void>(W.value(Real(-0.1))), "none_negative");
  EXPECT_DEATH(static_cast<void>(CubicSpline(0, 0.1)), "support_radius > 0");
}

TEST(AssertionsDeathTest, StopASumOverAGroupThatIsNone) {
  SESSILE_NEEDS_ASSERTIONS;
  if constexpr (lane_count > 1) {
    Cloud cloud = lattice(3, 0.1, true);
    cloud.look_around();
    const NeighborView near(cloud.near);
    const auto one = [](const IndexLanes&) { return Lanes(Real(1)); };
    EXPECT_DEATH(static_cast<void>(near.sum(Group{1}, one)), "lane_count == 0");
    EXPECT_DEATH(static_cast<void>(near.at(0, near.count[0])), "k < count");
  }
}

}  // namespace
}  // namespace sessile::test
