#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/scene/scene.h"

namespace sessile {

/// Places [m] of the particles that fill a body: a cubic lattice at distance `spacing` in the body's own axes, centred
/// on it, of the points inside the shape, jittered as the body says. A box of size L holds round(L/spacing) per axis.
/// Throws SceneError when the shape holds no point, FileError or SceneError when a mesh cannot be used.
std::vector<Vec3d> fill(const Body& body, double spacing);

/// Places [m] of one layer of an emitter: a square lattice in the shape's plane, centred on it.
std::vector<Vec3d> layer(const Emitter& emitter, double spacing);

/// Places [m] of a solid's boundary particles: its surface at distance solid.spacing (or `spacing`), in
/// solid.layers layers that grow into the solid.
std::vector<Vec3d> sample_surface(const Solid& solid, double spacing);

/// Roughly how many particles fill() and layer() will make: volume or area over that of one, and length over that of
/// one for what is thinner than a sample; of a mesh the larger of the volume that its triangles sum up to and a rough
/// one by the rule by which it is filled. Costs no memory but a mesh's, so that a scene too large can be refused before
/// it is tried. Throws as they do for meshes.
double estimate_fill(const Body& body, double spacing);
double estimate_layer(const Emitter& emitter, double spacing);

/// The same for sample_surface(): the most samples it can make, of a mesh about as many as it will.
double estimate_surface(const Solid& solid, double spacing);

/// The walls of a domain as solids: one container when all its faces are closed, or else a plate for each closed face,
/// facing inwards. Labels: "domain", or "domain_x_min" and so on.
std::vector<Solid> domain_walls(const Domain& domain);

/// A solid as a body of space: what is inside, and what has passed through.
class SolidGeometry {
 public:
  explicit SolidGeometry(const Solid& solid);
  ~SolidGeometry();
  SolidGeometry(SolidGeometry&&) noexcept;
  SolidGeometry& operator=(SolidGeometry&&) noexcept;

  /// Whether the point lies inside the solid's matter (for a container: outside its hollow). Never true for a plate.
  bool contains(const Vec3d& point) const;

  /// Whether the way from a to b passes the solid's surface into or through it (for a plate: crosses the rectangle).
  bool crossed(const Vec3d& a, const Vec3d& b) const;

  /// A box around the solid's surface: a particle that moves outside it cannot have crossed (mesh queries are skipped).
  Vec3d lower() const;
  Vec3d upper() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sessile
