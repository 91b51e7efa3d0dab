#include "sessile/particles/emitter.h"

#include <fmt/format.h>

#include <algorithm>

#include "sessile/core/error.h"
#include "sessile/core/parallel.h"
#include "sessile/scene/sampling.h"

namespace sessile {

LayerSource::LayerSource(const Emitter& emitter, double spacing, const Space& space)
    : emitter_(emitter), space_(space), clearance_(static_cast<Real>(0.9 * spacing)) {
  Array3 unsorted;
  for (const Vec3d& place : layer(emitter, spacing)) unsorted.push_back(vec_cast<Real>(place));
  grid_.build(unsorted, GridShape::make(spacing, {}, vec_cast<double>(space.period)));
  for (const std::int32_t k : grid_.order()) places_.push_back(unsorted[static_cast<std::size_t>(k)]);
  const auto ends = [&](const Array<Real>& a, Real& low, Real& high) {
    const auto [least, most] = std::minmax_element(a.begin(), a.end());
    low = *least - clearance_;
    high = *most + clearance_;
  };
  ends(places_.x, lower_.x, upper_.x);
  ends(places_.y, lower_.y, upper_.y);
  ends(places_.z, lower_.z, upper_.z);
}

std::optional<double> LayerSource::due() const {
  const std::int64_t next = progress_.emitted;
  if (emitter_.count && next >= *emitter_.count) return {};
  double time = 0;
  if (emitter_.interval) {
    time = emitter_.start + static_cast<double>(next) * *emitter_.interval;
  } else {
    if (next >= static_cast<std::int64_t>(emitter_.times.size())) return {};
    time = emitter_.times[static_cast<std::size_t>(next)];
  }
  if (emitter_.end && time > *emitter_.end) return {};
  return time;
}

bool LayerSource::taken(const Particles& particles) const {
  const auto close = [&](int i) {
    const Vec3r x = particles.position[static_cast<std::size_t>(i)];
    // Most particles are far away; across a periodic face the box says nothing.
    if (!space_.periodic &&
        (x.x < lower_.x || x.x > upper_.x || x.y < lower_.y || x.y > upper_.y || x.z < lower_.z || x.z > upper_.z)) {
      return false;
    }
    Grid::Cursor cursor;
    std::array<PlaceRange, 18> ranges;
    const int found = grid_.around(grid_.shape().cell_of(x), cursor, ranges);
    for (int k = 0; k < found; ++k) {
      const PlaceRange range = ranges[static_cast<std::size_t>(k)];
      for (auto place = range.begin; place < range.end; ++place) {
        const Vec3r d = space_.displacement(x, places_[static_cast<std::size_t>(place)]);
        if (squared_length(d) < clearance_ * clearance_) return true;
      }
    }
    return false;
  };
  return maximum(particles.size(), [&](int i) { return close(i) ? 1.0 : 0.0; }) > 0;
}

Emission LayerSource::emit(double time, Particles& particles, std::int64_t& next_id, std::size_t most) {
  const std::optional<double> when = due();
  if (!when || time < *when) return Emission::not_due;
  if (taken(particles)) return std::exchange(progress_.waiting, true) ? Emission::waiting : Emission::began_to_wait;
  if (places_.size() > most || particles.size() > most - places_.size()) {
    throw RunError(fmt::format(
        "at {:g} s {} would let {} particles in to {} others; there may be {} in all (give it a count or an "
        "end, or the domain open faces)",
        time, emitter_.label.empty() ? "an emitter" : "the emitter \"" + emitter_.label + "\"", places_.size(),
        particles.size(), most));
  }
  const Vec3r velocity = vec_cast<Real>(emitter_.velocity);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    particles.add(places_[k], velocity, static_cast<Real>(emitter_.mass_factor), next_id++);
  }
  ++progress_.emitted;
  progress_.waiting = false;
  return Emission::emitted;
}

}  // namespace sessile
