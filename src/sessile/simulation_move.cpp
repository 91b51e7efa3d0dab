// The end of a step: particles move, leave, and are counted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/simulation.h"
#include "sessile/stage_watch.h"

namespace sessile {
namespace {

/// What the moves of some particles add up to. Places are -1 where there is none.
struct Moves {
  std::int64_t not_finite = 0, passages = 0, escapes = 0;
  int first_not_finite = -1, first_passage = -1, first_escape = -1;
  int passed = -1, escaped = -1;  // the solids of the latter two
  int thrown = -1;
  double throw2 = 0;                             // greatest |v' - v|^2 [m^2/s^2]
  double forces = 0, pressure = 0, kinetic = 0;  // work, and energy after the step [m^2/s^2]
};

/// Adds the moves of the particles behind those of `sum`.
void add(Moves& sum, const Moves& next) {
  const auto first = [](int& mine, int other) { mine = mine < 0 ? other : mine; };
  if (sum.first_passage < 0) sum.passed = next.passed;
  if (sum.first_escape < 0) sum.escaped = next.escaped;
  first(sum.first_not_finite, next.first_not_finite);
  first(sum.first_passage, next.first_passage);
  first(sum.first_escape, next.first_escape);
  sum.not_finite += next.not_finite;
  sum.passages += next.passages;
  sum.escapes += next.escapes;
  if (next.throw2 > sum.throw2) {
    sum.throw2 = next.throw2;
    sum.thrown = next.thrown;
  }
  sum.forces += next.forces;
  sum.pressure += next.pressure;
  sum.kinetic += next.kinetic;
}

ParticleEvent event(const Particles& particles, std::int64_t count, int place) {
  if (place < 0) return {};
  const auto k = static_cast<std::size_t>(place);
  return {count, particles.id[k], vec_cast<double>(particles.position[k]), vec_cast<double>(particles.velocity[k])};
}

template <class T>
bool finite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// A way over more periods than these in a step is looked at in its last images alone.
constexpr int most_periods = 16;

/// Whether `sees(shift)` holds for one of the images of a particle's way: itself, and from across each periodic face
/// that it crosses, once for every period, in every combination of axes. The images of one way show the same passage.
template <class Sees>
bool any_image(const std::optional<Domain>& box, const Vec3d& to, const Sees& sees) {
  if (!box) return sees(Vec3d{});
  const auto periods = [](Edge edge, double x, double start, double end) {
    return edge == Edge::periodic ? std::floor((x - start) / (end - start)) : 0.0;
  };
  const double nx = periods(box->x, to.x, box->min.x, box->max.x);
  const double ny = periods(box->y, to.y, box->min.y, box->max.y);
  const double nz = periods(box->z, to.z, box->min.z, box->max.z);
  const Vec3d size = box->max - box->min;
  const auto images = [](double n) { return static_cast<int>(std::min(std::abs(n), double{most_periods})); };
  const auto shift = [](int image, double n, double length) {
    return image == 0 ? 0.0 : std::copysign(std::abs(n) - image + 1, -n) * length;
  };
  for (int i = 0; i <= images(nx); ++i) {
    for (int j = 0; j <= images(ny); ++j) {
      for (int k = 0; k <= images(nz); ++k) {
        if (sees(Vec3d{shift(i, nx, size.x), shift(j, ny, size.y), shift(k, nz, size.z)})) return true;
      }
    }
  }
  return false;
}

}  // namespace

void Simulation::move(double dt) {
  const StageWatch watch(stage_times_, &StageTimes::integration);
  const auto step = static_cast<Real>(dt);
  // A particle without a wall sample in reach, and not faster than dx a step, cannot have met a solid whose samples lie
  // at most dx apart.
  const double far = units_.spacing * units_.spacing;
  const auto look_for_passages = [&](int i, const Vec3d& from, const Vec3d& to, Moves& all) {
    if (wall_neighbors_.count(static_cast<std::size_t>(i)) == 0 && squared_length(to - from) < far && !coarse_walls_) {
      return;
    }
    Moves own;
    const auto crosses = [&](const SolidGeometry& solid) {
      return any_image(scene_.domain, to, [&](const Vec3d& shift) { return solid.crossed(from + shift, to + shift); });
    };
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      if (!crosses(solids_[s])) continue;
      if (holds_liquid_[s]) {  // which says more than another solid on the way
        own = {};
        own.escapes = 1;
        own.first_escape = i;
        own.escaped = static_cast<int>(s);
        break;
      }
      own.passages = 1;
      own.first_passage = i;
      own.passed = static_cast<int>(s);
    }
    if (own.passages + own.escapes > 0) add(all, own);
  };
  const auto move_one = [&](int i, Moves& all) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3r predicted = particles_.velocity[k];
    const Vec3r v = predicted + step * pressure_.acceleration[k];
    const Vec3r from = particles_.position[k], to = from + step * v;
    if (!finite(to) || !std::isfinite(particles_.pressure[k])) {  // it stays where it can be seen
      if (all.not_finite++ == 0) all.first_not_finite = i;
      return;
    }
    particles_.velocity.set(k, v);
    particles_.position.set(k, to);
    const Vec3d by_forces = dt * vec_cast<double>(acceleration_[k]);
    const Vec3d by_pressure = vec_cast<double>(v) - vec_cast<double>(predicted);
    const Vec3d mean = vec_cast<double>(v) - 0.5 * (by_forces + by_pressure);  // of the velocities around the step
    const auto m = static_cast<double>(particles_.mass[k]);
    look_for_passages(i, vec_cast<double>(from), vec_cast<double>(to), all);
    if (const double throw2 = squared_length(by_forces + by_pressure); throw2 > all.throw2) {
      all.throw2 = throw2;
      all.thrown = i;
    }
    all.forces += m * dot(by_forces, mean);
    all.pressure += m * dot(by_pressure, mean);
    all.kinetic += kinetic(particles_, k);
  };
  std::vector<Moves> parts(static_cast<std::size_t>(block_count(particles_.size())));
  for_each_block(particles_.size(), [&](std::ptrdiff_t block, std::ptrdiff_t begin, std::ptrdiff_t end) {
    Moves part;
    for (auto i = begin; i < end; ++i) move_one(static_cast<int>(i), part);
    parts[static_cast<std::size_t>(block)] = part;
  });
  Moves all;
  for (const Moves& part : parts) add(all, part);
  totals_.lost += all.passages + all.escapes + all.not_finite;
  totals_.energy.forces += units_.particle_mass() * all.forces;
  totals_.energy.pressure += units_.particle_mass() * all.pressure;
  last_step_.kinetic_energy = units_.particle_mass() * all.kinetic;
  health_.step = totals_.steps + 1;
  health_.time = time_ + dt;
  health_.not_finite = event(particles_, all.not_finite, all.first_not_finite);
  health_.passage = event(particles_, all.passages, all.first_passage);
  health_.escape = event(particles_, all.escapes, all.first_escape);
  health_.passed = all.passed;
  health_.escaped = all.escaped;
  health_.thrown = event(particles_, 1, all.thrown);
  health_.throw_length = std::sqrt(all.throw2) * dt;
  if (all.not_finite > 0) refuse_places(dt);
}

void Simulation::refuse_places(double dt) const {
  const ParticleEvent& first = health_.not_finite;
  throw RunError(fmt::format(
      "{} of {} particles have no finite position or pressure after the step of {:g} s at {:g} s: the step is too long "
      "for these forces. The first of them, particle {}, stood at ({:g}, {:g}, {:g}) m",
      first.count, particles_.size(), dt, time_, first.id, first.position.x, first.position.y, first.position.z));
}

void Simulation::refuse_velocities() {
  int first = -1;
  std::int64_t count = 0;
  for (std::size_t k = particles_.size(); k-- > 0;) {
    if (finite(particles_.velocity[k])) continue;
    first = static_cast<int>(k);
    ++count;
  }
  if (first < 0) return;  // a sum of great numbers; the next step will tell
  health_.not_finite = event(particles_, count, first);
  throw RunError(
      fmt::format("{} of {} particles have no finite velocity after the divergence solve at {:g} s, first of "
                  "them particle {}",
                  count, particles_.size(), time_, particles_.id[static_cast<std::size_t>(first)]));
}

void Simulation::take_out_what_left() {
  if (!scene_.domain) return;
  const StageWatch watch(stage_times_, &StageTimes::integration);
  const Domain& box = *scene_.domain;
  const Vec3r low = vec_cast<Real>(box.min), high = vec_cast<Real>(box.max);
  const auto into_period = [](Edge edge, Real& x, Real start, Real end) {
    if (edge != Edge::periodic || (x >= start && x < end)) return;
    x -= (end - start) * std::floor((x - start) / (end - start));
    if (x < start || x >= end) x = start;  // rounding can leave it on the far face
  };
  const auto outside = [](Edge edge, Real x, Real start, Real end) {
    return edge == Edge::open && (x < start || x > end);
  };
  std::vector<std::int32_t> staying;
  double energy = 0;  // of those that leave
  const std::size_t n = particles_.size();
  staying.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    Vec3r x = particles_.position[k];
    into_period(box.x, x.x, low.x, high.x);
    into_period(box.y, x.y, low.y, high.y);
    into_period(box.z, x.z, low.z, high.z);
    particles_.position.set(k, x);
    const bool out =
        outside(box.x, x.x, low.x, high.x) || outside(box.y, x.y, low.y, high.y) || outside(box.z, x.z, low.z, high.z);
    if (out) {
      energy += kinetic(particles_, k);
    } else {
      staying.push_back(static_cast<std::int32_t>(k));
    }
  }
  if (staying.size() == n) return;
  totals_.out += static_cast<std::int64_t>(n - staying.size());
  totals_.energy.out += units_.particle_mass() * energy;
  last_step_.kinetic_energy -= units_.particle_mass() * energy;
  particles_.reorder(staying);
}

// Ids are given in a row and never again, so that the next one says how many there ever were.
void Simulation::count() const {
  const auto n = static_cast<std::int64_t>(particles_.size());
  if (n + totals_.out == next_id_) return;
  throw RunError(
      fmt::format("the particles do not add up at {:g} s: {} were there at the start and {} have been let in, {} have "
                  "left, so that {} should be there and not {}. This is a fault of the program: please report it",
                  time_, next_id_ - totals_.emitted, totals_.emitted, totals_.out, next_id_ - totals_.out, n));
}

}  // namespace sessile
