#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/array.h"
#include "sessile/core/space.h"
#include "sessile/core/units.h"
#include "sessile/neighbors/grid.h"
#include "sessile/neighbors/neighbors.h"
#include "sessile/particles/emitter.h"
#include "sessile/particles/particles.h"
#include "sessile/pressure/solve.h"
#include "sessile/scene/sampling.h"
#include "sessile/scene/scene.h"
#include "sessile/simulation_state.h"
#include "sessile/step_health.h"
#include "sessile/walls/walls.h"

namespace sessile {

struct StepView;

/// A liquid in motion: the state of a run and the paper's step.
///
/// After construction and after every step, neighbours, densities and normals belong to the current positions, so that
/// whoever measures or writes reads them as they are.
class Simulation {
 public:
  /// Fills bodies, samples solids, and looks for what cannot be run.
  /// Throws SceneError (overlaps, fluid inside a solid, nothing to simulate, not enough memory), FileError (meshes).
  explicit Simulation(Scene scene);

  /// Goes on from a state() with the scene it was taken from, bit for bit on the same instruction set.
  /// Throws as above, and SceneError when the state cannot be one of this scene.
  Simulation(Scene scene, SimulationState state);

  /// One step of Algorithm 1. Throws RunError when a particle's position is no longer finite, or when their count is
  /// not what started and was let in less what left. Nothing but go_back_to() goes on from there.
  void step();

  /// Goes on with other values of the parameters that may change between two steps (scene/tuning.h); without a change,
  /// as if it had not been called. A speed of sound that was found at the start stays unless one is given.
  /// Throws SceneError, and changes nothing, when the scene is faulty or differs in another parameter.
  void retune(Scene scene);

  /// All that the scene does not tell, copied between two steps.
  SimulationState state() const;

  /// Goes on from a state() of its own, as if it had just been made of it. Throws SceneError when it is not one.
  void go_back_to(const SimulationState& state);

  const Scene& scene() const { return scene_; }
  double time() const { return time_; }  ///< [s]
  bool finished() const;                 ///< whether time() has reached the scene's end
  const Particles& particles() const { return particles_; }
  const Walls& walls() const { return walls_; }
  const NeighborList& fluid_neighbors() const { return fluid_neighbors_; }  ///< fluid around each fluid particle
  const NeighborList& wall_neighbors() const { return wall_neighbors_; }    ///< wall samples around each fluid particle
  const Array<Real>& density() const { return density_; }                   ///< rho / rho0
  const Array3& normal() const { return normal_; }                          ///< n_i of (19), dimensionless
  const Units& units() const { return units_; }
  const Space& space() const { return space_; }  ///< displacements, across periodic faces too

  const StepReport& last_step() const { return last_step_; }
  const StepHealth& health() const { return health_; }  ///< of the last step, of one that threw too
  const Totals& totals() const { return totals_; }
  const StageTimes& stage_times() const { return stage_times_; }
  std::size_t bytes() const;  ///< memory of particles, walls, neighbours and scratch

  /// Names of the accelerations that acceleration() can give: "gravity", "viscosity", "pressure", and each force's.
  std::vector<std::string> acceleration_names() const;

  /// One force's acceleration [m/s^2] of every particle at the current positions and velocities.
  Array3 acceleration(std::string_view name) const;

  /// What pair laws read of this moment. StepView is internal: this is for parts of the library that run passes alone.
  StepView view() const;

 private:
  void set_up_surroundings(std::optional<double> liquid);
  void take_over(SimulationState state);
  void fill_bodies();
  void look_around();
  void find_normals();
  void free_velocities_of_divergence(double dt);
  void settle_sound_speed(Array3 liquid);
  double tension() const;
  void accelerate();
  double next_time_step();
  void predict_velocities(double dt);
  void solve_pressure(double dt);
  void move(double dt);
  [[noreturn]] void refuse_places(double dt) const;
  void refuse_velocities();
  void take_out_what_left();
  void let_in_new_layers();
  void count() const;

  Scene scene_;
  Units units_;
  Space space_;
  GridShape grid_shape_;
  double time_ = 0;
  Particles particles_;
  std::int64_t next_id_ = 0;
  std::vector<LayerSource> sources_;
  Walls walls_;
  std::vector<SolidGeometry> solids_;  // one per solid of walls_
  std::vector<char> holds_liquid_;     // of each of them, whether the liquid is to stay on its one side
  bool coarse_walls_ = false;          // whether some solid's samples lie further apart than dx
  Grid grid_, wall_grid_;
  NeighborList fluid_neighbors_, wall_neighbors_;
  bool equal_masses_ = false;
  Array<Real> density_;
  Array3 normal_, acceleration_;
  Array<Real> position_pairs_;  // x and y of each position in a row: what every pass gathers
  mutable Array<Real> pairs_;   // the same of the field that the pass at hand gathers besides
  PressureScratch pressure_;
  StepReport last_step_;
  StepHealth health_;
  Totals totals_;
  StageTimes stage_times_;
};

}  // namespace sessile
