#include "bench/figure.h"

#include <algorithm>
#include <map>

namespace sessile::app::bench {

double Figure::median() const {
  std::vector<double> sorted = samples;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double Figure::least() const { return *std::min_element(samples.begin(), samples.end()); }
double Figure::greatest() const { return *std::max_element(samples.begin(), samples.end()); }

std::optional<Goal> goal_for(const std::string& key) {
  static const std::map<std::string, Goal> goals{
      {"s1.ms_per_step", {18, 12}},
      {"s1_fast.wall", {14, 10}},
      {"s2_250k.ms_per_step", {90, 65}},
      {"s2_1m.ms_per_step", {380, 260}},
      {"s2_1m.bytes_per_particle", {400, 300}},
      {"neighbors.together", {60, 45}},
      {"passes.pressure_acceleration.1000000", {60, 40}},
      {"passes.pressure_divergence.1000000", {60, 40}},
      {"solver.column_iterations", {5, 3}},
      {"scaling.growth", {1.3, 1.15}},
      {"scaling.speedup_2", {1.9, 1.97}},
  };
  const auto found = goals.find(key);
  return found == goals.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace sessile::app::bench
