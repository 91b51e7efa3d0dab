#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

#include "sessile/core/vec.h"

namespace sessile::test {

/// Random choices from a seed, the same with every standard library.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  /// Even over the logarithm: as likely between 0.1 and 1 as between 1 and 10.
  double magnitude(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double share) { return uniform(0, 1) < share; }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  int from(int low, int high) { return low + below(high - low + 1); }
  /// Even over the unit sphere.
  Vec3d direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace sessile::test
