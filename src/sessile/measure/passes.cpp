#include "sessile/measure/passes.h"

#include <array>

#include "sessile/forces/surface_feature.h"
#include "sessile/forces/viscosity.h"
#include "sessile/neighbors/step_view.h"
#include "sessile/particles/density.h"
#include "sessile/pressure/pressure_force.h"
#include "sessile/simulation.h"

namespace sessile {
namespace {

constexpr double dt = 1e-3;  // [s]; no pass takes longer for another

/// Forces add to what is there: the sums of many runs stay finite.
Array3& accelerations(const StepView& view, PassScratch& scratch) {
  if (scratch.vectors.size() != view.n) scratch.vectors.assign(view.n, {});
  return scratch.vectors;
}

void density(const Simulation& s, PassScratch& scratch) { compute_density(s.view(), scratch.numbers); }

void normals(const Simulation& s, PassScratch& scratch) { compute_normals(s.view(), scratch.pressure.acceleration); }

void viscosity(const Simulation& s, PassScratch& scratch) {
  const StepView view = s.view();
  add_viscosity(view, s.scene().fluid.viscosity, accelerations(view, scratch));
}

void surface_feature(const Simulation& s, PassScratch& scratch) {
  const StepView view = s.view();
  SurfaceFeature{}.add_acceleration(view, accelerations(view, scratch));
}

void coefficients(const Simulation& s, PassScratch& scratch) {
  pressure_coefficients(s.view(), s.particles().velocity, dt, scratch.pressure);
}

// Densities serve as pressures: those of a liquid that has not moved are zero.
void acceleration(const Simulation& s, PassScratch& scratch) {
  pressure_acceleration(s.view(), s.density(), scratch.pressure.stress, scratch.pressure.acceleration);
}

void divergence(const Simulation& s, PassScratch& scratch) {
  density_change(s.view(), s.particles().velocity, dt, scratch.numbers);
}

/// Bytes of so many numbers per particle, and of where its list lies and how long it is.
constexpr double numbers(int count) { return count * static_cast<double>(sizeof(Real)) + 12; }

// Numbers streamed: those read of each particle, once, and those written; a sum that is added to is both.
constexpr std::array all{
    Pass{"density", {3, 27, numbers(3 + 1)}, density},                             // x; rho
    Pass{"normals", {4, 33, numbers(4 + 3)}, normals},                             // x, rho; n
    Pass{"viscosity", {7, 40, numbers(7 + 6)}, viscosity},                         // x, v, rho; a
    Pass{"surface feature", {7, 44, numbers(7 + 6)}, surface_feature},             // x, n, rho; a
    Pass{"pressure coefficients", {6, 45, numbers(7 + 2)}, coefficients},          // x, v, rho; rho_adv, a_ii
    Pass{"pressure acceleration", {4, 32, numbers(3 + 2 + 2 + 3)}, acceleration},  // x, p, rho, stress; a
    Pass{"pressure divergence", {6, 32, numbers(6 + 1)}, divergence},              // x, a; change
};

}  // namespace

std::span<const Pass> passes() { return all; }

}  // namespace sessile
