#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sessile::app::bench {

/// What a machine with such ceilings needs at least for a pass.
struct Bound {
  double value = 0;  ///< in the figure's unit
  std::string by;    ///< which ceiling it is: gathers, arithmetic or memory
};

/// What is aimed at, on 2 cores with AVX-512.
struct Goal {
  double goal = 0, moonshot = 0;
};

/// Something measured, with every sample of it.
struct Figure {
  std::string key;   ///< the same in every version, such as "s1.ms_per_step"
  std::string what;  ///< for people
  std::string unit;
  std::vector<double> samples;
  std::optional<double> neighbors{};  ///< per particle, of a pass
  std::optional<Bound> bound{};

  double median() const;
  double least() const;
  double greatest() const;
};

/// The goal for a figure, where there is one.
std::optional<Goal> goal_for(const std::string& key);

}  // namespace sessile::app::bench
