#include <gtest/gtest.h>

#include "sessile/forces/force.h"
#include "sessile/forces/viscosity.h"
#include "sessile/pressure/pressure_force.h"
#include "support/cloud.h"

namespace sessile::forces_test {
namespace {

// 1e-6 in float, 1e-12 in double.
constexpr double antisymmetry = sizeof(Real) == 4 ? 1e-6 : 1e-12;
constexpr double rounding = sizeof(Real) == 4 ? 2e-6 : 1e-13;

Array3 tension(const test::Cloud& cloud, const SurfaceFeature& model, bool one_lane = false) {
  Array3 a;
  a.assign(cloud.particles.size(), {});
  model.add_acceleration(cloud.view(one_lane), a);
  return a;
}

Array3 viscosity(const test::Cloud& cloud, double mu, bool one_lane = false) {
  Array3 a;
  a.assign(cloud.particles.size(), {});
  add_viscosity(cloud.view(one_lane), mu, a);
  return a;
}

class BothReadings : public testing::TestWithParam<Direction> {};
INSTANTIATE_TEST_SUITE_P(SurfaceFeature, BothReadings, testing::Values(Direction::displacement, Direction::unit));

TEST_P(BothReadings, CohesionAndAreaConserveMomentum) {
  test::Cloud cloud = test::lattice(9, 0.3);
  cloud.look_around();
  EXPECT_LT(test::net_over_total(cloud, tension(cloud, {7.4, 0, 0, GetParam()})), antisymmetry);
  EXPECT_LT(test::net_over_total(cloud, tension(cloud, {0, 1, 0, GetParam()})), antisymmetry);
}

TEST_P(BothReadings, UnequalMassesConserveMomentumToo) {
  test::Cloud cloud = test::lattice(9, 0.3);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.mass[i] = i % 3 == 0 ? Real(2) : Real(0.7);
  cloud.look_around();
  EXPECT_LT(test::net_over_total(cloud, tension(cloud, {7.4, 1, 0, GetParam()})), antisymmetry);
}

TEST_P(BothReadings, CohesionConservesAngularMomentum) {
  test::Cloud cloud = test::lattice(8, 0.3);
  cloud.look_around();
  const Array3 a = tension(cloud, {7.4, 0, 0, GetParam()});
  Vec3d net;
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d moment = cross(vec_cast<double>(cloud.particles.position[i]), vec_cast<double>(a[i]));
    net += moment;
    total += length(moment);
  }
  EXPECT_LT(length(net) / total, antisymmetry);
}

TEST_P(BothReadings, AdhesionGivesTheSolidTheOppositeForceAndTorque) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  const SurfaceFeature model{0, 0, 500, GetParam()};
  const Array3 a = tension(cloud, model);
  SolidForce on_liquid;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3d f = cloud.units.particle_mass() * vec_cast<double>(a[i]);
    on_liquid.force += f;
    on_liquid.torque += cross(vec_cast<double>(cloud.particles.position[i]), f);
  }
  std::vector<SolidForce> on_solid(1);
  model.add_reaction(cloud.view(), cloud.walls, on_solid);
  const double pull = length(on_liquid.force);
  EXPECT_GT(pull, 0);
  EXPECT_LT(on_liquid.force.z, 0) << "the floor below attracts";
  EXPECT_LT(length(on_liquid.force + on_solid[0].force), antisymmetry * pull);
  EXPECT_LT(length(on_liquid.torque + on_solid[0].torque), antisymmetry * pull);
}

TEST_P(BothReadings, LanesAgreeWithOneLane) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  const SurfaceFeature model{7.4, 1, 500, GetParam()};
  EXPECT_LT(test::difference(tension(cloud, model), tension(cloud, model, true)), rounding);
}

TEST_P(BothReadings, CoincidentParticlesExertNothingOnEachOther) {
  test::Cloud cloud;
  cloud.add({0, 0, 0});
  cloud.add({0, 0, 0});
  cloud.add({0.12, 0, 0});  // so that there are normals
  cloud.look_around();
  const Array3 a = tension(cloud, {7.4, 1, 0, GetParam()});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(length(a[i])));
  EXPECT_EQ(a[0], a[1]);
}

TEST(SurfaceFeature, PairForceIsThePrintedOne) {
  // Two particles 0.15 m apart, checked by hand against (14), (18), (21) in double.
  test::Cloud cloud;
  const double r = 0.15, h = 0.2, m = 1000 * 1e-3;
  cloud.add({0, 0, 0});
  cloud.add({r, 0, 0});
  cloud.look_around();
  const double rho = 1000 * static_cast<double>(cloud.density[0]);
  const double K = 1000.0 * 1000 / (rho * rho);
  const double d = 32 / (std::numbers::pi * std::pow(h, 9)) * std::pow(h - r, 3) * std::pow(r, 3);
  const Array3 displacement = tension(cloud, {7.4, 0, 0, Direction::displacement});
  EXPECT_NEAR(displacement[0].x / (7.4 * m * K * d * r), 1, 1e-5);
  const Array3 unit = tension(cloud, {7.4, 0, 0, Direction::unit});
  EXPECT_NEAR(unit[0].x / (7.4 * m * K * d), 1, 1e-5);
  // (19), (20): n_0 = h m/rho grad W, n_1 = -n_0, so a_0 = -beta K 2 n_0.
  const double slope = 8 / (std::numbers::pi * std::pow(h, 4)) * -6 * std::pow(1 - r / h, 2);
  const double n0 = h * m / rho * slope * -1;  // gradient at 0 of a neighbour at +x points to +x
  const Array3 area = tension(cloud, {0, 3, 0, Direction::displacement});
  EXPECT_NEAR(area[0].x / (-3 * K * 2 * n0), 1, 1e-5);
}

TEST(SurfaceFeature, AdhesionForceIsThePrintedOne) {
  test::Cloud cloud;
  const double r = 0.15, h = 0.2;
  cloud.add({0, 0, r});
  cloud.add_wall({0, 0, 0});
  cloud.look_around();
  const double y = 0.01 / std::pow(h, 5) * (-std::pow(r - 0.75 * h, 2) + h * h / 16);
  const double psi = 1000 * 1.43 * 1e-3;
  EXPECT_NEAR(tension(cloud, {0, 0, 500, Direction::displacement})[0].z / (-500 * psi * y * r), 1, 1e-5);
  EXPECT_NEAR(tension(cloud, {0, 0, 500, Direction::unit})[0].z / (-500 * psi * y), 1, 1e-5);
}

TEST(SurfaceFeature, MacroscopicTensionIsTheFormula) {
  // docs/model.md: both tabled strengths give 119 N/m at dx = 0.1 m.
  EXPECT_NEAR((SurfaceFeature{7.4, 1, 500, Direction::displacement}.tension({0.1, 0.2, 1000})), 119, 0.5);
  EXPECT_NEAR((SurfaceFeature{1, 1, 60, Direction::unit}.tension({0.1, 0.2, 1000})), 119, 0.5);
}

TEST(Viscosity, ConservesMomentumAndSlowsDown) {
  test::Cloud cloud = test::lattice(9, 0.3);
  cloud.look_around();
  const Array3 a = viscosity(cloud, 20);
  EXPECT_LT(test::net_over_total(cloud, a), antisymmetry);
  double power = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    power += dot(vec_cast<double>(cloud.particles.velocity[i]), vec_cast<double>(a[i]));
  }
  EXPECT_LT(power, 0);
}

TEST(Viscosity, IsTheLaplacianOnAShearedLattice) {
  // v_x = z^2 has the Laplacian 2; docs/model.md: this form gives 0.99 of it on a cubic lattice at h = 2 dx.
  test::Cloud cloud = test::lattice(9, 0);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
    const Real z = cloud.particles.position[i].z;
    cloud.particles.velocity.set(i, {z * z, 0, 0});
  }
  cloud.look_around();
  const Array3 a = viscosity(cloud, 20);
  int checked = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3r x = cloud.particles.position[i];
    if (std::min({x.x, x.y, x.z}) < Real(0.25) || std::max({x.x, x.y, x.z}) > Real(0.55)) continue;
    EXPECT_NEAR(a[i].x / (20.0 / 1000 * 2), 0.99, 0.01);
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST(Viscosity, WallDragIsOppositeOnTheSolid) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  const Array3 both = viscosity(cloud, 0);  // only the wall's own viscosity is left
  Vec3d on_liquid;
  for (std::size_t i = 0; i < both.size(); ++i) on_liquid += cloud.units.particle_mass() * vec_cast<double>(both[i]);
  std::vector<SolidForce> on_solid(1);
  add_viscosity_reaction(cloud.view(), cloud.walls, on_solid);
  EXPECT_GT(length(on_liquid), 0);
  EXPECT_LT(length(on_liquid + on_solid[0].force), 10 * antisymmetry * length(on_liquid));
}

TEST(Viscosity, LanesAgreeWithOneLane) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  EXPECT_LT(test::difference(viscosity(cloud, 20), viscosity(cloud, 20, true)), rounding);
}

TEST(PressureForce, ConservesMomentumAndPushesWallsBack) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  Array<Real> pressure(cloud.particles.size()), stress;
  for (std::size_t i = 0; i < pressure.size(); ++i) pressure[i] = Real(1) + Real(i % 7);
  Array3 a, one_lane;
  pressure_acceleration(cloud.view(), pressure, stress, a);
  pressure_acceleration(cloud.view(true), pressure, stress, one_lane);
  EXPECT_LT(test::difference(a, one_lane), rounding);
  Vec3d on_liquid;
  double total = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    on_liquid += cloud.units.particle_mass() * vec_cast<double>(a[i]);
    total += cloud.units.particle_mass() * length(vec_cast<double>(a[i]));
  }
  std::vector<SolidForce> on_solid(1);
  add_pressure_reaction(cloud.view(), stress, cloud.walls, on_solid);
  EXPECT_GT(on_liquid.z, 0);
  EXPECT_LT(length(on_liquid + on_solid[0].force), antisymmetry * total);
}

TEST(Passes, DensityAndNormalsInLanesAgreeWithOneLane) {
  test::Cloud cloud = test::lattice(8, 0.3, true), reference = cloud;
  cloud.look_around();
  reference.look_around(true);
  EXPECT_LT(test::difference(cloud.normal, reference.normal), rounding);
  for (std::size_t i = 0; i < cloud.density.size(); ++i)
    EXPECT_NEAR(cloud.density[i], reference.density[i], 2 * rounding);
}

}  // namespace
}  // namespace sessile::forces_test
