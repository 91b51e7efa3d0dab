#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sessile::app {

/// A quantity drawn over simulated time, all methods in one plot.
struct Plot {
  std::string_view key;    ///< of files
  std::string_view title;  ///< for people
  std::string_view column;
  std::string_view axis;
  bool logarithmic = false;
  bool from_zero = false;  ///< whether the axis begins at zero
  bool of_steps = false;   ///< whether the line of the start, before any step, has no value
};

inline constexpr std::array<Plot, 14> plots{{
    {"kinetic_energy", "Kinetic energy", "kinetic_energy [J]", "kinetic energy [J]", true},
    {"loose", "Loose particles", "loose", "particles", false, true},
    {"wetted_area", "Wetted area", "wetted_area [m^2]", "area [m^2]", false, true},
    {"surface_area", "Area of the surface", "surface_area [m^2]", "area [m^2]", false, true},
    {"pieces", "Pieces", "pieces", "pieces", false, true},
    {"nearest_p5", "Clustering: distance to the nearest particle, 5th percentile", "nearest_p5 [dx]", "distance [dx]",
     false, true},
    {"radius_of_gyration", "Radius of gyration", "radius_of_gyration [m]", "radius [m]"},
    {"held", "Particles held by solids", "held", "particles", false, true},
    {"particles", "Particles", "particles", "particles", false, true},
    {"out", "Particles that left the domain", "out", "particles", false, true},
    {"max_speed", "Greatest speed", "max_speed [m/s]", "speed [m/s]", false, true},
    {"density_error", "Density error at the new positions, average", "density_error", "density error", true},
    {"dt", "Time step", "dt [s]", "time step [s]", false, true, true},
    {"iterations", "Iterations of the pressure solve", "iterations", "iterations", false, true, true},
}};

/// The gnuplot script that draws them as PNG and SVG from the stats.csv of the methods, whose folders lie beside its
/// own. `folder` is that of the comparison.
std::string plot_script(const std::filesystem::path& folder, const std::vector<std::string>& methods);

/// Writes plots/comparison.gp and draws. Returns "", or a sentence that says why there are no plots.
/// Throws FileError when the script cannot be written.
std::string draw_plots(const std::filesystem::path& folder, const std::vector<std::string>& methods);

}  // namespace sessile::app
