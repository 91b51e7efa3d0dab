#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sessile::app {

/// The columns of a stats.csv that are numbers, by their titles ("time [s]").
class StatsTable {
 public:
  /// Empty where there is no such file.
  explicit StatsTable(const std::filesystem::path& file);

  /// The values of a column; empty when there is none.
  const std::vector<double>& column(const std::string& title) const;

 private:
  std::map<std::string, std::vector<double>> columns_;
};

/// A quantity whose course a comparison follows.
struct Quantity {
  std::string_view key;    ///< of files
  std::string_view title;  ///< for people
  std::string_view column;
  std::string_view unit;
  bool least = false;  ///< whether its least value tells more than its greatest
};

/// Every quantity of the table of outcomes.
inline constexpr std::array<Quantity, 14> quantities{{
    {"kinetic_energy", "kinetic energy", "kinetic_energy [J]", "J"},
    {"max_speed", "greatest speed", "max_speed [m/s]", "m/s"},
    {"particles", "particles", "particles", ""},
    {"held", "held by solids", "held", ""},
    {"wetted_area", "wetted area", "wetted_area [m^2]", "m^2"},
    {"loose", "loose particles", "loose", ""},
    {"pieces", "pieces", "pieces", ""},
    {"largest_share", "share of the largest piece", "largest_share", "", true},
    {"nearest_p5", "nearest distance, 5th percentile", "nearest_p5 [dx]", "dx", true},
    {"radius_of_gyration", "radius of gyration", "radius_of_gyration [m]", "m"},
    {"out", "out of the domain", "out", ""},
    {"lost", "lost through solids", "lost", ""},
    {"surface_area", "surface area", "surface_area [m^2]", "m^2"},
    {"surface_volume", "volume in the surface", "surface_volume [m^3]", "m^3", true},
}};

/// How a quantity went.
struct Course {
  double final = 0, least = 0, greatest = 0;
};

/// What became of the liquid, by its stats.csv.
struct Outcome {
  bool known = false;                  ///< whether there were any lines
  std::optional<double> time_to_rest;  ///< after which the kinetic energy stays below 1e-4 of its peak [s]
  std::array<std::optional<Course>, quantities.size()> courses{};  ///< nothing where stats.csv has no such column
};

/// The first time from which on the energy is at most a share of its peak; nothing when the last one is above.
std::optional<double> time_to_rest(const std::vector<double>& time, const std::vector<double>& energy,
                                   double share = 1e-4);

Outcome outcome_of(const StatsTable& stats);

}  // namespace sessile::app
