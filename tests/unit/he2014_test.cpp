#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/forces.h"

namespace sessile::he2014_test {
namespace {

using test::acceleration;

constexpr double h = 0.2, dx = 0.1, rho0 = 1000, mass = 1;
constexpr double hand = sizeof(Real) == 4 ? 1e-5 : 1e-12;

TEST(He2014, PairForceIsThePublishedOne) {
  const double r = 0.11, W0 = 8 / (std::numbers::pi * h * h * h), q = r / h;
  const double rho = mass * W0 * (1 + 2 * std::pow(1 - q, 3)), V = mass / rho;
  const double slope = W0 / h * -6 * std::pow(1 - q, 2);
  // c = V (W(0) + W(r)) = 1 at both.
  const double gradient = V * slope;
  const double tension = 280.0 / (4 * rho) * V * 2 * gradient * gradient * -slope, air = 500 / rho * V * -slope;
  const test::Cloud cloud = test::pair_of_particles(r);
  EXPECT_NEAR(static_cast<double>(acceleration(cloud, He2014{280, 0})[0].x) / tension, 1, hand);
  EXPECT_NEAR(static_cast<double>(acceleration(cloud, He2014{0, 500})[0].x) / air, 1, hand);
}

TEST(He2014, WeighsTheGradientByTheColour) {
  // Three in a row, not all alike: c differs from end to middle.
  test::Cloud cloud;
  const double r = 0.11;
  for (const int k : {-1, 0, 1}) cloud.add({k * r, 0, 0});
  cloud.look_around();
  const double W0 = 8 / (std::numbers::pi * h * h * h), q = r / h, W1 = W0 * 2 * std::pow(1 - q, 3);
  const double slope = W0 / h * -6 * std::pow(1 - q, 2);
  const double V_end = 1 / (W0 + W1), V_middle = 1 / (W0 + 2 * W1);
  const double c_end = V_end * W0 + V_middle * W1, c_middle = V_middle * W0 + 2 * V_end * W1;
  const double gradient = V_middle * c_middle * slope / c_end;  // of the ends; that of the middle is 0
  const double pull = 280.0 / 4 * V_end / mass * V_middle * gradient * gradient * -slope;
  const Array3 a = acceleration(cloud, He2014{280, 0});
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = std::round(static_cast<double>(cloud.particles.position[i].x) / r);
    EXPECT_NEAR(static_cast<double>(a[i].x), -side * pull, hand * pull);
  }
}

TEST(He2014, VanishesInsideAndPullsABallTogether) {
  const test::Cloud cloud = test::ball(8);
  for (const He2014& model : {He2014{283.5, 0}, He2014{0, 500}}) {
    const Array3 a = acceleration(cloud, model);
    double greatest = 0, inside = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec3d x = vec_cast<double>(cloud.particles.position[i]);
      const double size = static_cast<double>(length(a[i]));
      greatest = std::max(greatest, size);
      if (length(x) < 8 * dx - 2.5 * h) inside = std::max(inside, size);
      if (length(x) > 7.5 * dx) {
        EXPECT_LT(dot(x, vec_cast<double>(a[i])), 0) << length(x) / dx;
      }
    }
    EXPECT_LT(inside, 1e-5 * greatest);
  }
}

TEST(He2014, UnequalMassesConserveMomentumToo) {
  test::Cloud cloud = test::lattice(9, 0.3);
  for (std::size_t i = 0; i < cloud.particles.size(); ++i) cloud.particles.mass[i] = i % 3 == 0 ? Real(2) : Real(0.7);
  cloud.look_around();
  EXPECT_LT(test::net_over_total(cloud, acceleration(cloud, He2014{283.5, 500})), test::antisymmetry);
}

TEST(He2014, ASolidTakesTheLiquidsPlace) {
  // Boundary particles that continue the lattice, two layers deep and on all sides but the top.
  test::Cloud cloud;
  const int n = 9;
  for (int z = -2; z < n; ++z) {
    for (int y = -2; y < n + 2; ++y) {
      for (int x = -2; x < n + 2; ++x) {
        const Vec3d place{dx * (x + 0.5), dx * (y + 0.5), dx * (z + 0.5)};
        if (z >= 0 && std::min(x, y) >= 0 && std::max(x, y) < n) {
          cloud.add(place);
        } else {
          cloud.add_wall(place);
          cloud.walls.psi[cloud.walls.psi.size() - 1] = 1;
        }
      }
    }
  }
  cloud.look_around();
  for (const He2014& model : {He2014{283.5, 0}, He2014{0, 500}}) {
    const Array3 a = acceleration(cloud, model);
    double top = 0, below = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      double& most = cloud.particles.position[i].z > Real(dx * (n - 1)) ? top : below;
      if (cloud.particles.position[i].z < Real(dx * (n - 5)) || &most == &top) {
        most = std::max(most, static_cast<double>(length(a[i])));
      }
    }
    EXPECT_LT(below, 1e-4 * top);
    EXPECT_GT(top, 0);
  }
}

/// sigma h / kappa of a flat surface of uniform liquid: the model's sums as integrals over depth, by quadrature.
///   sigma = (kappa/8) int G V (int K V dz') dz over a slab of two faces,  G = |grad c|^2,  V = rho0/rho
///   K(z) = pi int_|z|^h -W'(r) (r^2 - 3 z^2) dr: the pull along the surface less that across it, of sheets z apart
double flat_surface_tension(std::size_t cells) {
  const std::size_t n = 8 * cells;
  const double d = 1.0 / static_cast<double>(cells);  // lengths in h
  const auto slope = [](double q) {
    return 8 / std::numbers::pi * (q <= 0.5 ? 18 * q * q - 12 * q : -6 * (1 - q) * (1 - q));
  };
  const auto value = [](double q) {
    return 8 / std::numbers::pi * (q <= 0.5 ? 6 * q * q * q - 6 * q * q + 1 : 2 * std::pow(1 - q, 3));
  };
  // What a sheet of liquid at distance k d does, for W, its derivative and K: the integral over r from k d to h.
  std::vector<double> W(cells + 1), dW(cells + 1), K(cells + 1);
  double sum = 0, squares = 0, slopes = 0;
  const int fine = 200;
  for (std::size_t k = cells; k-- > 0;) {
    const double z = static_cast<double>(k) * d;
    for (int m = fine - 1; m >= 0; --m) {
      const double q = z + (m + 0.5) / fine * d, e = d / fine;
      sum += 2 * std::numbers::pi * value(q) * q * e;
      squares -= std::numbers::pi * slope(q) * q * q * e;
      slopes -= 3 * std::numbers::pi * slope(q) * e;
    }
    W[k] = sum, dW[k] = -2 * std::numbers::pi * z * value(z), K[k] = squares - slopes * z * z;
  }
  const auto over_depth = [&](const std::vector<double>& sheet, bool odd, const std::vector<double>& weight) {
    std::vector<double> all(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i - std::min(i, cells); j <= std::min(n - 1, i + cells); ++j) {
        all[i] += d * weight[j] * (j <= i ? sheet[i - j] : (odd ? -1 : 1) * sheet[j - i]);
      }
    }
    return all;
  };
  const std::vector<double> rho = over_depth(W, false, std::vector<double>(n, 1));
  std::vector<double> V(n), Vc(n);
  for (std::size_t i = 0; i < n; ++i) V[i] = 1 / rho[i];
  const std::vector<double> c = over_depth(W, false, V), pull = over_depth(K, false, V);
  for (std::size_t i = 0; i < n; ++i) Vc[i] = V[i] * c[i];
  const std::vector<double> steep = over_depth(dW, true, Vc);
  double sigma = 0;
  for (std::size_t i = 0; i < n; ++i) sigma += d / 8 * V[i] * pull[i] * std::pow(steep[i] / c[i], 2);
  return sigma;
}

TEST(He2014, TensionIsTheIntegralAtAFlatSurface) {
  EXPECT_NEAR(He2014{283.5}.tension({dx, h, rho0}) * h / 283.5, flat_surface_tension(100), 1e-4);
}

TEST(He2014, GivesTheSolidTheOppositeForceAndTorque) {
  test::Cloud cloud = test::lattice(8, 0.3, true);
  cloud.look_around();
  He2014 model{0, 500};
  test::expect_opposite_reaction(cloud, model);
}

}  // namespace
}  // namespace sessile::he2014_test
