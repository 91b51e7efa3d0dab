#include <gtest/gtest.h>

#include <limits>
#include <variant>

#include "support/cloud.h"
#include "support/forces.h"
#include "support/one_of_each.h"

namespace sessile::test {
namespace {

// A pack of the last particles reads past them, where old memory stands: whatever that is, no bit may depend on it.
TEST(AnyForce, IsTheSameWhateverStandsPastTheLastParticle) {
  for (const Force& force : one_of_each(Force{})) {
    std::visit(
        [](const auto& model) {
          Cloud cloud = lattice(3, 0.1, true);
          cloud.look_around();
          const std::size_t n = cloud.particles.size();
          ASSERT_NE(n % lane_count, 0U);
          const auto with_slack = [&](Real value) {
            Array3& x = cloud.particles.position;
            for (std::size_t k = n; k % lane_count != 0; ++k) x.x.data()[k] = x.y.data()[k] = x.z.data()[k] = value;
            return acceleration(cloud, model);
          };
          const Array3 a = with_slack(0);
          for (const Real value : {Real(1e30), -std::numeric_limits<Real>::quiet_NaN()}) {
            const Array3 b = with_slack(value);
            EXPECT_EQ(a.x, b.x) << model.name << " beside " << value;
            EXPECT_EQ(a.y, b.y) << model.name << " beside " << value;
            EXPECT_EQ(a.z, b.z) << model.name << " beside " << value;
          }
        },
        force);
  }
}

}  // namespace
}  // namespace sessile::test
