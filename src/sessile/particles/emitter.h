#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sessile/core/array.h"
#include "sessile/core/bounds.h"
#include "sessile/core/space.h"
#include "sessile/neighbors/grid.h"
#include "sessile/particles/particles.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// What became of an emitter's next layer.
enum class Emission { not_due, emitted, began_to_wait, waiting };

/// How far an emitter has come.
struct LayerProgress {
  std::int64_t emitted = 0;  ///< layers
  bool waiting = false;      ///< whether the next one fell due while its place was taken
};

/// An emitter at work: the places of its layer, and which layer comes next.
class LayerSource {
 public:
  LayerSource(const Emitter& emitter, double spacing, const Space& space);

  /// Lets in the next layer when its time has come and its place is free, that is, no particle is closer than 0.9 dx
  /// to any of its places. Ids count on from `next_id`. Throws RunError, and lets nothing in, where there would be more
  /// than `most` particles.
  Emission emit(double time, Particles& particles, std::int64_t& next_id, std::size_t most = most_indices);

  const Array3& places() const { return places_; }
  std::int64_t emitted_layers() const { return progress_.emitted; }

  const LayerProgress& progress() const { return progress_; }
  void go_on_from(const LayerProgress& progress) { progress_ = progress; }

 private:
  std::optional<double> due() const;
  bool taken(const Particles& particles) const;

  Emitter emitter_;
  Space space_;
  Real clearance_;
  Array3 places_;  // in the order of grid_
  Grid grid_;
  Vec3r lower_, upper_;  // box around the places, grown by the clearance
  LayerProgress progress_;
};

}  // namespace sessile
