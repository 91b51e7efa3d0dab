#include "sessile/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include "sessile/scene/read_values.h"
#include "sessile/scene/traits.h"

namespace sessile {

namespace {

constexpr double most_frames = 1e6;
constexpr double least_progress = 1e-15;     // step over the end's time: a double tells times 2e-16 of it apart
constexpr std::size_t most_collected = 101;  // faults: a hundred are told, and that there are more
constexpr double coarsest_solid = 1.5;       // sample distance over particle spacing at which particles slip through
constexpr double finest_solid = 0.05;        // below it samples cost memory and say nothing
constexpr double farthest = 1 << 20;         // distance from the origin over spacing that float still resolves to 6 %
constexpr double least_spacing = 1e-12, greatest_spacing = 1e9;  // [m] outside, squares of lengths leave float

/// Judges each number by its declared range, for scenes that no file was read for.
class RangeCheck {
 public:
  explicit RangeCheck(std::vector<Fault>& faults) : faults_(faults) {}

  template <class T>
  void check(const std::string& path, Range range, std::string_view unit, const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      number(path, range, unit, value);
    } else if constexpr (std::is_same_v<T, int>) {
      number(path, range, unit, static_cast<double>(value));
    } else if constexpr (std::is_same_v<T, Vec3d>) {
      number(path + "[0]", range, unit, value.x);
      number(path + "[1]", range, unit, value.y);
      number(path + "[2]", range, unit, value.z);
    } else if constexpr (is_optional<T>) {
      if (value) check(path, range, unit, *value);
    } else if constexpr (is_list<T>) {
      for (std::size_t i = 0; i < value.size(); ++i) check(fmt::format("{}[{}]", path, i), range, unit, value[i]);
    } else if constexpr (is_choice<T>) {
      std::visit([&](const auto& chosen) { check(path, range, unit, chosen); }, value);
    } else if constexpr (Declared<T>) {
      for_each_field<T>([&](const auto& f) {
        check((path.empty() ? "" : path + ".") + std::string(f.key), f.range, f.unit, value.*f.member);
      });
    }
  }

 private:
  void number(const std::string& path, Range range, std::string_view unit, double value) {
    if (faults_.size() >= most_collected) return;
    if (!std::isfinite(value)) {
      faults_.push_back({path, fmt::format("{} is not a finite number", value), {}});
    } else if (!range.holds(value)) {
      faults_.push_back({path, fmt::format("must be {}, found {}", range_text(range, unit), value), {}});
    }
  }

  std::vector<Fault>& faults_;
};

bool is_control(char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }

class SceneCheck {
 public:
  SceneCheck(const Scene& scene, std::vector<Fault>& faults) : scene_(scene), faults_(faults) {}

  void all() {
    if (scene_.bodies.empty() && scene_.emitters.empty()) {
      add("", "nothing to simulate: the scene has neither bodies nor emitters", {"bodies", "emitters"});
    }
    if (scene_.spacing < least_spacing || scene_.spacing > greatest_spacing) {
      add("spacing", fmt::format("must be from {} to {} m, found {}", least_spacing, greatest_spacing, scene_.spacing));
    }
    if (std::any_of(scene_.title.begin(), scene_.title.end(), is_control)) {
      add("title", "may not hold control characters");  // a terminal would obey them
    }
    time();
    pressure();
    if (scene_.domain) domain(*scene_.domain);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) body(fmt::format("bodies[{}]", i), scene_.bodies[i]);
    for (std::size_t i = 0; i < scene_.emitters.size(); ++i)
      emitter(fmt::format("emitters[{}]", i), scene_.emitters[i]);
    for (std::size_t i = 0; i < scene_.solids.size(); ++i) solid(fmt::format("solids[{}]", i), scene_.solids[i]);
    output();
  }

 private:
  void add(std::string path, std::string message, std::vector<std::string> uses = {}) {
    if (faults_.size() >= most_collected) return;
    faults_.push_back({std::move(path), std::move(message), std::move(uses)});
  }

  void time() {
    const auto& time = scene_.time;
    const auto stands_still = [&](std::string_view key, double dt) {
      if (!(dt < least_progress * time.end)) return;
      add(fmt::format("time.{}", key),
          fmt::format("{} s is less than {} of time.end, {} s: the time could not be told from that before the step",
                      dt, least_progress, time.end),
          {"time.end"});
    };
    if (time.fixed_dt) {
      stands_still("fixed_dt", *time.fixed_dt);
    } else {
      stands_still("dt_max", time.dt_max);
    }
    if (time.dt_min > time.dt_max) {
      add("time.dt_min", fmt::format("{} s is more than time.dt_max, {} s", time.dt_min, time.dt_max), {"time.dt_max"});
    }
  }

  void pressure() {
    std::visit(
        [&](const auto& solver) {
          if constexpr (requires { solver.min_iterations; }) {
            if (solver.min_iterations > solver.max_iterations) {
              add("pressure.min_iterations",
                  fmt::format("{} is more than pressure.max_iterations, {}", solver.min_iterations,
                              solver.max_iterations),
                  {"pressure.max_iterations"});
            }
            if (solver.long_solve < solver.min_iterations) {
              add("pressure.long_solve",
                  fmt::format("{} is less than pressure.min_iterations, {}: every step would be shorter than the last",
                              solver.long_solve, solver.min_iterations),
                  {"pressure.min_iterations"});
            }
          }
        },
        scene_.pressure);
  }

  void domain(const Domain& domain) {
    const double h = scene_.support_radius();
    const auto axis = [&](std::size_t index, std::string_view name, double low, double high, Edge edge) {
      const double length = high - low;
      const std::string path = fmt::format("domain.max[{}]", index);
      const std::vector<std::string> uses{fmt::format("domain.min[{}]", index), "domain.min", "domain.max", "spacing",
                                          "support"};
      if (!(length > 0)) {
        add(path, fmt::format("{} m is not above domain.min[{}], {} m", high, index, low), uses);
      } else if (edge == Edge::periodic && length < 3 * h) {
        add(path,
            fmt::format("the domain is periodic along {}, so it must be at least 3 support radii ({:.6g} m) long; "
                        "it is {} m",
                        name, 3 * h, length),
            uses);
      } else if (edge == Edge::closed && length < scene_.spacing) {
        add(path,
            fmt::format("the domain is closed across {} and only {} m long: no particle of spacing {} m fits", name,
                        length, scene_.spacing),
            uses);
      }
    };
    axis(0, "x", domain.min.x, domain.max.x, domain.x);
    axis(1, "y", domain.min.y, domain.max.y, domain.y);
    axis(2, "z", domain.min.z, domain.max.z, domain.z);
  }

  void placement(const std::string& path, const Placement& placement, bool liquid) {
    if (squared_length(placement.axis) == 0 && placement.axis == Vec3d{}) {
      add(path + ".placement.axis", "[0, 0, 0] is no axis to turn about");
    }
    if (!liquid) return;
    const Vec3d& p = placement.position;
    const std::string where = path + ".placement.position";
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > farthest * scene_.spacing) {
      add(where,
          fmt::format("is more than {} spacings from the origin: single precision cannot tell its particles apart",
                      farthest),
          {"spacing"});
    }
    if (!scene_.domain) return;
    const auto outside = [](double value, double low, double high) { return value < low || value > high; };
    const auto& domain = *scene_.domain;
    if (outside(p.x, domain.min.x, domain.max.x) || outside(p.y, domain.min.y, domain.max.y) ||
        outside(p.z, domain.min.z, domain.max.z)) {
      add(where, "stands outside the domain", {"domain"});
    }
  }

  /// Labels become headers of a table.
  void label(const std::string& path, const std::string& label) {
    const auto bad = [](char c) { return c == ',' || c == '"' || is_control(c); };
    if (std::any_of(label.begin(), label.end(), bad)) {
      add(path + ".label", "may not hold commas, quotation marks or control characters");
    }
  }

  void body(const std::string& path, const Body& body) {
    label(path, body.label);
    // A mesh lies where its file's coordinates put it, so its position says little.
    placement(path, body.placement, !std::holds_alternative<Mesh>(body.shape));
  }

  void emitter(const std::string& path, const Emitter& emitter) {
    label(path, emitter.label);
    placement(path, emitter.placement, true);
    if (emitter.times.empty() == !emitter.interval.has_value()) {
      add(path,
          emitter.interval ? "has both times and an interval; give one of them"
                           : "needs times or an interval at which layers appear",
          {path + ".times", path + ".interval"});
    }
    for (std::size_t i = 1; i < emitter.times.size(); ++i) {
      if (emitter.times[i] > emitter.times[i - 1]) continue;
      add(fmt::format("{}.times[{}]", path, i),
          fmt::format("{} s does not come after {} s", emitter.times[i], emitter.times[i - 1]),
          {fmt::format("{}.times[{}]", path, i - 1)});
    }
    const double first = emitter.times.empty() ? emitter.start : emitter.times.front();
    if (emitter.end && *emitter.end < first) {
      add(path + ".end", fmt::format("{} s is before the first layer, due at {} s", *emitter.end, first),
          {path + ".start", path + ".times"});
    }
  }

  void solid(const std::string& path, const Solid& solid) {
    label(path, solid.label);
    placement(path, solid.placement, false);
    if (solid.label == "domain" || solid.label.starts_with("domain_")) {
      add(path + ".label", "names that start with \"domain\" are those of the domain's own walls");
    } else if (!solid.label.empty() && !labels_.insert(solid.label).second) {
      add(path + ".label", in_quotes(solid.label) + " names another solid already");
    }
    const double spacing = solid.spacing.value_or(scene_.spacing);
    if (spacing > coarsest_solid * scene_.spacing) {
      add(path + ".spacing",
          fmt::format("{} m is more than {} times the particle spacing, {} m: particles would slip "
                      "through",
                      spacing, coarsest_solid, scene_.spacing),
          {"spacing"});
    } else if (spacing < finest_solid * scene_.spacing) {
      add(path + ".spacing",
          fmt::format("{} m is less than {} times the particle spacing, {} m: needlessly many samples", spacing,
                      finest_solid, scene_.spacing),
          {"spacing"});
    }
  }

  void output() {
    const auto& output = scene_.output;
    if (scene_.time.end / output.frame_interval > most_frames) {
      add("output.frame_interval",
          fmt::format("{} s would make more than {} frames in {} s", output.frame_interval, most_frames,
                      scene_.time.end),
          {"time.end"});
    }
    if (output.surface) surface(*output.surface);
    twice("output.formats", output.formats);
    twice("output.fields", output.columns);
  }

  void surface(const SurfaceOutput& surface) {
    if (surface.interval && scene_.time.end / *surface.interval > most_frames) {
      add("output.surface.interval",
          fmt::format("{} s would make more than {} surfaces in {} s", *surface.interval, most_frames, scene_.time.end),
          {"time.end"});
    }
    twice("output.surface.formats", surface.formats);
  }

  void twice(const std::string& path, const std::vector<std::string>& words) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (!seen.insert(words[i]).second) add(fmt::format("{}[{}]", path, i), in_quotes(words[i]) + " is listed twice");
    }
  }

  const Scene& scene_;
  std::vector<Fault>& faults_;
  std::set<std::string> labels_;
};

}  // namespace

std::vector<Fault> validate(const Scene& scene) {
  std::vector<Fault> faults;
  RangeCheck(faults).check("", any_number, "", scene);
  // Numbers out of range make nonsense of what they are compared with; a reader has told of them already.
  const auto single_faults = static_cast<std::ptrdiff_t>(faults.size());
  std::vector<Fault> together;
  SceneCheck(scene, together).all();
  for (auto& fault : together) {
    const auto spoilt = [&](const Fault& single) {
      const auto is = [&](const std::string& path) { return single.path == path; };
      return is(fault.path) || std::any_of(fault.uses.begin(), fault.uses.end(), is);
    };
    if (std::none_of(faults.begin(), faults.begin() + single_faults, spoilt)) {
      faults.push_back(std::move(fault));
    }
  }
  return faults;
}

}  // namespace sessile
