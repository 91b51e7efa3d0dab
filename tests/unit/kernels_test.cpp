#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sessile/kernels/adhesion.h"
#include "sessile/kernels/akinci_adhesion.h"
#include "sessile/kernels/cohesion.h"
#include "sessile/kernels/cubic_spline.h"

namespace sessile::kernels_test {
namespace {

constexpr double h = 0.2, dx = 0.1;
constexpr double unit = dx * dx * dx;  // kernels are in units of 1/dx^3

Real at(double x) { return static_cast<Real>(x); }

TEST(CubicSpline, IntegratesToOne) {
  const CubicSpline W(h, dx);
  double integral = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double r = (k + 0.5) * h / n;
    integral += 4 * std::numbers::pi * r * r * static_cast<double>(W.value(at(r))) / unit * h / n;
  }
  EXPECT_NEAR(integral, 1, 1e-5);
}

TEST(CubicSpline, HasThePrintedValues) {
  const CubicSpline W(h, dx);
  const double sigma = 8 / (std::numbers::pi * h * h * h) * unit;
  for (const double q : {0.0, 0.1, 0.3, 0.5, 0.7, 0.95}) {
    const double printed = q <= 0.5 ? 6 * q * q * q - 6 * q * q + 1 : 2 * std::pow(1 - q, 3);
    EXPECT_NEAR(static_cast<double>(W.value(at(q * h))), sigma * printed, 1e-6 * sigma) << q;
  }
  EXPECT_EQ(W.value(at(1.01 * h)), 0);
  EXPECT_FLOAT_EQ(static_cast<float>(W.at_zero()), static_cast<float>(W.value(Real(0))));
}

TEST(CubicSpline, GradientIsTheDifferenceOfValues) {
  const CubicSpline W(h, dx);
  const auto exact = [](double r) {  // in double, so that the difference is not float rounding
    const double q = r / h, sigma = 8 / (std::numbers::pi * h * h * h) * unit;
    return sigma * (q <= 0.5 ? 6 * q * q * q - 6 * q * q + 1 : 2 * std::pow(1 - q, 3));
  };
  const double greatest = 8 / (std::numbers::pi * h * h * h) * unit * 1.5 / h;
  for (double q = 0.01; q < 1; q += 0.01) {
    const double r = q * h, e = 1e-5 * h;
    const double difference = (exact(r + e) - exact(r - e)) / (2 * e);
    const Vec3r gradient = W.gradient(Separation<Real>({at(r), 0, 0}));
    EXPECT_NEAR(static_cast<double>(gradient.x), difference, 1e-5 * greatest) << q;
  }
  EXPECT_EQ(W.gradient(Separation<Real>(Vec3r{})), Vec3r{});
}

TEST(CubicSpline, LaplacianIsTheSecondDifferenceOfValues) {
  const CubicSpline W(h, dx);
  const auto r_times_exact = [](double r) {  // in double: lap W = (r W)''/r
    const double q = r / h, sigma = 8 / (std::numbers::pi * h * h * h) * unit;
    return r * sigma * (q <= 0.5 ? 6 * q * q * q - 6 * q * q + 1 : 2 * std::pow(1 - q, 3));
  };
  const double greatest = 8 / (std::numbers::pi * h * h * h) * unit * 36 / (h * h);
  for (double q = 0.013; q < 1; q += 0.01) {  // no step across h/2, where the third derivative jumps
    const double r = q * h, e = 1e-4 * h;
    const double difference = (r_times_exact(r + e) - 2 * r_times_exact(r) + r_times_exact(r - e)) / (e * e * r);
    const Real laplacian = W.laplacian(Separation<Real>({at(r), 0, 0}));
    EXPECT_NEAR(static_cast<double>(laplacian), difference, 1e-5 * greatest) << q;
  }
  EXPECT_EQ(W.laplacian(Separation<Real>(Vec3r{})), W.laplacian_at_zero());
  EXPECT_NEAR(static_cast<double>(W.laplacian_at_zero()), -greatest, 1e-6 * greatest);
}

TEST(CohesionSpline, IsContinuousWhereItsPiecesMeet) {
  const CohesionSpline d(h, dx);
  const double below = static_cast<double>(d.value(at(0.4999999 * h)));
  const double above = static_cast<double>(d.value(at(0.5000001 * h)));
  EXPECT_NEAR(below, above, 1e-5 * above);
  EXPECT_NEAR(static_cast<double>(d.value(at(h))), 0, 1e-7);
}

TEST(CohesionSpline, VanishesAtItsZeroAndPeaksAtHalfTheSupport) {
  const CohesionSpline d(h, dx);
  EXPECT_LT(d.value(at(0.272 * h)), 0);
  EXPECT_GT(d.value(at(0.274 * h)), 0);
  double greatest = 0, place = 0;
  for (double q = 0.001; q < 1; q += 0.001) {
    const double value = static_cast<double>(d.value(at(q * h)));
    if (value > greatest) greatest = value, place = q;
  }
  EXPECT_NEAR(greatest / unit, 0.159 / (h * h * h), 0.001 / (h * h * h));
  EXPECT_NEAR(place, 0.5, 0.002);
  EXPECT_EQ(d.value(Real(0)), 0);
}

TEST(AdhesionSpline, VanishesAtHalfTheSupportAndAtTheSupport) {
  const AdhesionSpline y(h, dx);
  EXPECT_NEAR(static_cast<double>(y.value(at(0.5 * h))), 0, 1e-8);
  EXPECT_NEAR(static_cast<double>(y.value(at(h))), 0, 1e-8);
  EXPECT_EQ(y.value(at(0.3 * h)), 0);
  const double peak = 0.01 / std::pow(h, 5) * h * h / 16 * unit;  // (23) at 3h/4
  EXPECT_NEAR(static_cast<double>(y.value(at(0.75 * h))), peak, 1e-6 * peak);
}

TEST(AkinciAdhesionSpline, HasThePublishedValues) {
  const AkinciAdhesionSpline A(h, dx);
  EXPECT_EQ(A.value(at(0.3 * h)), 0);
  EXPECT_EQ(A.value(at(0.499999 * h)), 0);
  EXPECT_EQ(A.value(at(1.000001 * h)), 0);
  for (const double q : {0.51, 0.6, 0.75, 0.9, 0.99}) {
    const double r = q * h;
    const double printed = 0.007 / std::pow(h, 3.25) * std::pow(-4 * r * r / h + 6 * r - 2 * h, 0.25) * unit;
    EXPECT_NEAR(static_cast<double>(A.value(at(r))), printed, 1e-5 * printed) << q;
  }
  const double peak = 0.007 / std::numbers::sqrt2 / (h * h * h) * unit;  // at 3h/4, where the radicand is h/4
  EXPECT_NEAR(static_cast<double>(A.value(at(0.75 * h))), peak, 1e-6 * peak);
}

TEST(AkinciAdhesionSpline, IsANumberForEveryFloatNearTheSupport) {
  for (const double radius : {h, 1.9e-6, 0.3, 7777.7}) {
    const AkinciAdhesionSpline A(radius, radius / 2);
    const auto start = static_cast<float>(radius * 0.97);
    float r = start;
    bool all = true;
    for (int k = 0; k < 1'000'000; ++k) {
      const Real value = A.value(static_cast<Real>(r));
      all = all && value >= 0 && value < 1;
      r = std::nextafter(r, 2 * start);
    }
    EXPECT_TRUE(all) << radius;
    EXPECT_GT(static_cast<double>(r), radius);
  }
}

TEST(Lanes, CosineIsTheStandardOne) {
  for (int start = 0; start < 4000; start += lane_count) {
    alignas(64) Real x[lane_count], packed[lane_count];
    for (int k = 0; k < lane_count; ++k) x[k] = at(1.5 * std::numbers::pi * (start + k) / 4000);
    cos(Lanes::load_aligned(x)).store_aligned(packed);
    for (int k = 0; k < lane_count; ++k) EXPECT_NEAR(packed[k], std::cos(x[k]), sizeof(Real) == 4 ? 2e-7 : 1e-15);
  }
}

/// Every kernel in packs of lanes gives what it gives number by number, to the rounding of its value at q = typical.
template <class Kernel, class Value>
void expect_lanes_agree(const Kernel& kernel, const Value& value, double typical = 0.5001) {
  const double size = std::abs(static_cast<double>(value(kernel, at(typical * h))));
  for (int start = 0; start < 1000; start += lane_count) {
    alignas(64) Real r[lane_count], packed[lane_count];
    for (int k = 0; k < lane_count; ++k) r[k] = at(1.1 * h * (start + k) / 1000);
    value(kernel, Lanes::load_aligned(r)).store_aligned(packed);
    for (int k = 0; k < lane_count; ++k) {
      const Real alone = value(kernel, r[k]);
      // Near the support radius 1 - q loses digits: rounding is measured by the kernel's size, not its value.
      EXPECT_NEAR(packed[k], alone, 4e-6 * size) << r[k] / h;
    }
  }
}

TEST(Lanes, AgreeWithNumbersInEveryKernel) {
  const auto value = [](const auto& kernel, const auto& r) { return kernel.value(r); };
  const auto slope = []<class T>(const auto& kernel, const T& r) {
    return kernel.slope_over_r(Separation<T>({r, T(0), T(0)}));
  };
  expect_lanes_agree(CubicSpline(h, dx), value);
  expect_lanes_agree(CubicSpline(h, dx), slope);
  const auto laplacian = []<class T>(const auto& kernel, const T& r) {
    return kernel.laplacian(Separation<T>({r, T(0), T(0)}));
  };
  expect_lanes_agree(CubicSpline(h, dx), laplacian, 0.25);
  expect_lanes_agree(CohesionSpline(h, dx), value);
  expect_lanes_agree(AdhesionSpline(h, dx), value);
  expect_lanes_agree(AkinciAdhesionSpline(h, dx), value, 0.75);
}

TEST(Kernels, StayInFloatsRangeAtOneMicrometre) {
  const double small_dx = 1e-6, small_h = 2e-6;
  for (const double q : {0.1, 0.4, 0.6, 0.9}) {
    const Real r = at(q * small_h);
    EXPECT_NEAR(CubicSpline(small_h, small_dx).value(r), CubicSpline(h, dx).value(at(q * h)), 1e-6);
    EXPECT_NEAR(CohesionSpline(small_h, small_dx).value(r), CohesionSpline(h, dx).value(at(q * h)), 1e-6);
    EXPECT_NEAR(AdhesionSpline(small_h, small_dx).value(r), AdhesionSpline(h, dx).value(at(q * h)), 1e-9);
    EXPECT_NEAR(AkinciAdhesionSpline(small_h, small_dx).value(r), AkinciAdhesionSpline(h, dx).value(at(q * h)), 1e-9);
    EXPECT_TRUE(std::isfinite(CubicSpline(small_h, small_dx).laplacian(Separation<Real>({r, 0, 0}))));
    EXPECT_TRUE(std::isfinite(CubicSpline(small_h, small_dx).slope_over_r(Separation<Real>({r, 0, 0}))));
  }
}

}  // namespace
}  // namespace sessile::kernels_test
