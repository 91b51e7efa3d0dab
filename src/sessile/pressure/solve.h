#pragma once

#include "sessile/core/array.h"
#include "sessile/pressure/pressure.h"

namespace sessile {

struct StepView;

/// What a pressure solve reports.
struct PressureResult {
  int iterations = 0;
  bool converged = false;
  double error = 0;      ///< average compression over rest density that the solver predicts, all particles counted
  double error_max = 0;  ///< the greatest one
};

/// Memory that a solve works in, and its result.
struct PressureScratch {
  Array3 acceleration;   ///< pressure acceleration [m/s^2] of the solve
  Array<Real> stress;    ///< p_i/rho_i^2 of that acceleration
  Array<Real> advected;  ///< advected density over rest density
  Array<Real> diagonal;  ///< a_ii
  Array<Real> next;      ///< pressures that an iteration makes
};

/// Finds the pressure p / rho0 [m^2/s^2] whose acceleration, over dt, takes the compression out of the motion with the
/// predicted velocities v*. `pressure` holds the last step's on entry and the new one on return.
PressureResult solve(const Iisph& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);

/// The same for whichever solver the scene names.
PressureResult solve(const Pressure& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);

/// a_ii: the derivative of particle i's density after the step by its own pressure (mended 34), and rho_adv (27).
void iisph_coefficients(const StepView& view, const Array3& predicted_velocity, double dt, PressureScratch& scratch);

/// Density that the pressure acceleration takes from particle i over dt (left side of 29, 30), over rest density.
///   dt^2 sum_j m_j (a_i - a_j) . grad W_ij + dt^2 sum_b psi_b a_i . grad W_ib
void iisph_density_change(const StepView& view, const Array3& acceleration, double dt, Array<Real>& change);

}  // namespace sessile
