#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "sessile/core/fields.h"
#include "sessile/core/vec.h"
#include "sessile/forces/force.h"
#include "sessile/pressure/pressure.h"
#include "sessile/scene/render_settings.h"
#include "sessile/scene/shapes.h"
#include "sessile/scene/stability_settings.h"
#include "sessile/scene/surface_settings.h"

/// A scene as plain structs: what a scene file says, after defaults, in SI units.
namespace sessile {

/// How far to simulate and how large a step may be.
struct TimeSettings {
  double end = 0;
  std::optional<double> fixed_dt;
  double dt_min = 1e-6;
  double dt_max = 8e-3;
  double growth = 1.05;
  double cfl = 0.4;
  double force_factor = 0.25;
  double viscosity_factor = 0.125;
  double capillary_factor = 0.4;

  static constexpr auto fields() {
    using T = TimeSettings;
    return std::tuple{
        required(field(&T::end, "end", "s", positive, "simulated time at which the run ends")),
        derived(field(&T::fixed_dt, "fixed_dt", "s", positive, "one time step for the whole run"),
                "adaptive, from the bounds below"),
        field(&T::dt_min, "dt_min", "s", positive, "least time step; a warning says when it overrules a bound"),
        field(&T::dt_max, "dt_max", "s", positive, "greatest time step"),
        field(&T::growth, "growth", "", between(1, 2), "most that a step may grow over the one before"),
        field(&T::cfl, "cfl", "", positive, "dt <= cfl * dx / |v|max; with a speed of sound c_s: dx / (c_s + |v|max)"),
        field(&T::force_factor, "force_factor", "", positive,
              "dt <= force_factor * sqrt(dx / |a|max), a without pressure"),
        field(&T::viscosity_factor, "viscosity_factor", "", positive, "dt <= viscosity_factor * rho0 dx^2 / mu"),
        field(&T::capillary_factor, "capillary_factor", "", positive,
              "dt <= capillary_factor * sqrt(rho0 dx^3 / (2 pi sigma))"),
    };
  }
};

/// The liquid's material.
struct Fluid {
  double rest_density = 1000;
  double viscosity = 0;

  static constexpr auto fields() {
    using T = Fluid;
    return std::tuple{
        field(&T::rest_density, "rest_density", "kg m^-3", positive, "density at rest, rho0"),
        field(&T::viscosity, "viscosity", "Pa s", non_negative, "dynamic viscosity mu (water: 0.001)"),
    };
  }
};

/// A volume of liquid present from the start, filled with a cubic lattice in its own axes.
struct Body {
  std::string label;
  BodyShape shape = Box{};
  Placement placement{};
  Vec3d velocity{};
  Vec3d spin{};
  double mass_factor = 1;
  double jitter = 0;
  int seed = 1;

  static constexpr auto fields() {
    using T = Body;
    return std::tuple{
        field(&T::label, "label", "a name for messages"),
        required(field(&T::shape, "shape", "what is filled")),
        field(&T::placement, "placement", "where it stands"),
        field(&T::velocity, "velocity", "m/s", any_number, "velocity at the start"),
        field(&T::spin, "spin", "rad/s", any_number, "angular velocity at the start, about the placement's position"),
        field(&T::mass_factor, "mass_factor", "", positive, "particle mass over rho0 dx^3"),
        field(&T::jitter, "jitter", "", between(0, 0.5),
              "random shift of each particle, at most this share of dx per axis"),
        field(&T::seed, "seed", "", non_negative, "seed of the jitter"),
    };
  }
};

/// Lets single layers of particles into the scene, along its own z axis.
struct Emitter {
  std::string label;
  LayerShape shape = Rectangle{};
  Placement placement{};
  Vec3d velocity{};
  std::vector<double> times;
  std::optional<double> interval;
  double start = 0;
  std::optional<double> end;
  std::optional<int> count;
  double mass_factor = 1;

  static constexpr auto fields() {
    using T = Emitter;
    return std::tuple{
        field(&T::label, "label", "a name for messages"),
        required(field(&T::shape, "shape", "shape of a layer, filled with a square lattice")),
        field(&T::placement, "placement", "where the layers appear"),
        field(&T::velocity, "velocity", "m/s", any_number, "velocity of the particles as they appear"),
        field(&T::times, "times", "s", non_negative, "times at which a layer appears; or give an interval"),
        derived(field(&T::interval, "interval", "s", positive, "time between layers"), "the listed times"),
        field(&T::start, "start", "s", non_negative, "time of the first layer, with an interval"),
        derived(field(&T::end, "end", "s", non_negative, "no layer falls due after this time"), "never"),
        derived(field(&T::count, "count", "", at_least(1), "number of layers in all"), "no limit"),
        field(&T::mass_factor, "mass_factor", "", positive, "particle mass over rho0 dx^3"),
    };
  }
};

/// What happens at a face of the domain.
enum class Edge { open, closed, periodic };

template <>
struct Words<Edge> {
  static constexpr std::array<std::string_view, 3> words{"open", "closed", "periodic"};
};

/// The box that the simulation looks at. Without one, space is unbounded.
struct Domain {
  Vec3d min{};
  Vec3d max{};
  Edge x = Edge::open;
  Edge y = Edge::open;
  Edge z = Edge::open;

  static constexpr auto fields() {
    using T = Domain;
    return std::tuple{
        required(field(&T::min, "min", "m", any_number, "lower corner")),
        required(field(&T::max, "max", "m", any_number, "upper corner")),
        field(&T::x, "x", "both faces across x: open (what leaves is taken out), closed (walls) or periodic"),
        field(&T::y, "y", "both faces across y"),
        field(&T::z, "z", "both faces across z"),
    };
  }
};

/// Something the liquid cannot enter, sampled on its surface with boundary particles.
struct Solid {
  std::string label;
  SolidShape shape = Box{};
  Placement placement{};
  std::optional<double> spacing;
  int layers = 1;
  double adhesion = 1;
  std::optional<double> viscosity;

  static constexpr auto fields() {
    using T = Solid;
    return std::tuple{
        field(&T::label, "label", "a name for messages and for the columns of its force"),
        required(field(&T::shape, "shape", "what it is")),
        field(&T::placement, "placement", "where it stands"),
        derived(field(&T::spacing, "spacing", "m", positive, "distance between its samples"), "the particle spacing"),
        field(&T::layers, "layers", "", between(1, 8), "layers of samples"),
        field(&T::adhesion, "adhesion", "", non_negative, "factor on the adhesion of every force"),
        derived(field(&T::viscosity, "viscosity", "Pa s", non_negative, "viscosity at this wall"), "the fluid's"),
    };
  }
};

/// Surfaces of the liquid that a run makes as it goes, with the settings that all surfaces have.
struct SurfaceOutput : SurfaceSettings {
  std::vector<std::string> formats{"ply"};
  std::optional<double> interval;
  bool stats = false;

  static constexpr auto fields() {
    using T = SurfaceOutput;
    return std::tuple_cat(
        std::tuple{
            field(&T::formats, "formats", "file formats of a surface; see `sessile models`"),
            derived(field(&T::interval, "interval", "s", positive, "simulated time between surfaces"),
                    "the frame interval"),
            field(&T::stats, "stats", "whether stats.csv has surface_area and surface_volume"),
        },
        SurfaceSettings::fields());
  }
};

/// What a run can be resumed from, written while it goes on.
struct CheckpointOutput {
  int keep = 2;
  double minutes = 10;
  std::optional<double> interval;

  static constexpr auto fields() {
    using T = CheckpointOutput;
    return std::tuple{
        field(&T::keep, "keep", "", between(0, 1000000), "how many of the newest are kept; 0 for no checkpoints"),
        field(&T::minutes, "minutes", "min", positive, "wall time between checkpoints; there is one at the end too"),
        derived(field(&T::interval, "interval", "s", positive, "simulated time between checkpoints"),
                "by wall time alone"),
    };
  }
};

/// What a run writes.
struct Output {
  double frame_interval = 0.04;
  std::optional<double> stats_interval;
  std::vector<std::string> formats{"vtp"};
  std::vector<std::string> columns{"id", "velocity", "density", "pressure"};
  std::optional<SurfaceOutput> surface;
  CheckpointOutput checkpoint{};

  static constexpr auto fields() {
    using T = Output;
    return std::tuple{
        field(&T::frame_interval, "frame_interval", "s", positive, "simulated time between frames"),
        derived(field(&T::stats_interval, "stats_interval", "s", non_negative,
                      "simulated time between lines of stats.csv; 0 for every step"),
                "a tenth of the frame interval"),
        field(&T::formats, "formats", "file formats of a frame; see `sessile models`"),
        field(&T::columns, "fields", "per-particle fields of a frame; see `sessile models`"),
        derived(field(&T::surface, "surface", "surfaces of the liquid, in the folder surface"),
                "none; `sessile mesh` makes them from frames"),
        field(&T::checkpoint, "checkpoint", "what the run can be resumed from, in the folder checkpoints"),
    };
  }
};

/// All of a scene file.
struct Scene {
  std::string title;
  double spacing = 0;
  double support = 2;
  Vec3d gravity{0, 0, -9.81};
  TimeSettings time{};
  Fluid fluid{};
  std::vector<Force> forces;
  Pressure pressure = Iisph{};
  std::vector<Body> bodies;
  std::vector<Emitter> emitters;
  std::optional<Domain> domain;
  std::vector<Solid> solids;
  StabilitySettings stability{};
  Output output{};
  std::optional<RenderSettings> render;

  static constexpr auto fields() {
    using T = Scene;
    return std::tuple{
        field(&T::title, "title", "one line for people"),
        required(field(&T::spacing, "spacing", "m", positive, "particle spacing dx")),
        field(&T::support, "support", "", between(1.5, 4), "support radius h over the spacing"),
        field(&T::gravity, "gravity", "m/s^2", any_number, "acceleration of gravity"),
        required(field(&T::time, "time", "how far and in which steps")),
        field(&T::fluid, "fluid", "the liquid's material"),
        field(&T::forces, "forces", "tension and adhesion; without one the liquid has none"),
        field(&T::pressure, "pressure", "the pressure solver"),
        field(&T::bodies, "bodies", "liquid present from the start"),
        field(&T::emitters, "emitters", "liquid let in later"),
        derived(field(&T::domain, "domain", "the box that is looked at"), "unbounded space"),
        field(&T::solids, "solids", "what the liquid cannot enter"),
        field(&T::stability, "stability", "what happens when a run goes unstable"),
        field(&T::output, "output", "what a run writes"),
        derived(field(&T::render, "render", "what `sessile render` makes of it"), "its defaults"),
    };
  }

  double support_radius() const { return support * spacing; }  ///< h [m]
};

}  // namespace sessile
