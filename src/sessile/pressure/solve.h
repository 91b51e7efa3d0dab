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
  Array3 acceleration;        ///< pressure acceleration [m/s^2] of the solve
  Array<Real> stress;         ///< p_i/rho_i^2 of that acceleration
  Array<Real> advected;       ///< advected density over rest density
  Array<Real> diagonal;       ///< a_ii
  Array<Real> next;           ///< pressures that an iteration makes; the residual before, of conjugate directions
  Array<Real> change;         ///< density that the pressure acceleration adds over dt, over rest density
  Array3 predicted_position;  ///< x + dt v [m]
  Array<Real> mean;           ///< mean of the pressures so far, carried with the particles from step to step

  Array<Real> residual;           ///< predicted density - rest density, over rest density
  Array<Real> direction;          ///< what the pressures move along [m^2/s^2]
  Array3 direction_acceleration;  ///< acceleration of that as if it were a pressure [m/s^2]

  std::size_t bytes() const {
    const auto total = [](const auto&... arrays) { return (bytes_of(arrays) + ...); };
    return total(acceleration, stress, advected, diagonal, next, change, predicted_position, mean, residual, direction,
                 direction_acceleration);
  }
};

/// Finds the pressure p / rho0 [m^2/s^2] whose acceleration, over dt, takes the compression out of the motion with the
/// predicted velocities v*. `pressure` holds the last step's on entry and the new one on return.
PressureResult solve(const Pressure& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);
PressureResult solve(const Iisph& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);
PressureResult solve(const Pcisph& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);
/// Needs method.sound_speed; does not look at v* and dt.
PressureResult solve(const Wcsph& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);
PressureResult solve(const Dfsph& method, const StepView& view, const Array3& predicted_velocity, double dt,
                     Array<Real>& pressure, PressureScratch& scratch);

/// Whether a step ends with remove_divergence().
bool frees_velocities_of_divergence(const Pressure& method);

/// Changes the velocities so that they compress nothing, as if by the pressure p / rho0 [m^2/s^2] over dt, which
/// `pressure` holds on return (and the last step's on entry). A solver without such a part changes nothing.
PressureResult remove_divergence(const Pressure& method, const StepView& view, Array3& velocity, double dt,
                                 Array<Real>& pressure, PressureScratch& scratch);
PressureResult remove_divergence(const Dfsph& method, const StepView& view, Array3& velocity, double dt,
                                 Array<Real>& pressure, PressureScratch& scratch);

/// Speed [m/s] at which a solver lets pressure travel, which bounds the time step; 0 where it acts at once.
double sound_speed(const Pressure& method);

/// Iterations of a solve over those from which on the solver asks for shorter steps; 0 where it does not iterate.
double effort(const Pressure& method, int iterations);

/// a_ii: the derivative of particle i's density after the step by its own pressure (mended 34), and rho_adv (27).
void pressure_coefficients(const StepView& view, const Array3& predicted_velocity, double dt, PressureScratch& scratch);

/// Puts rho(x + dt v*) in the place of rho_adv, where the two differ by at most 2 %, and moves it by 2 % towards it
/// elsewhere. Neighbours are those of x(t). What (27) leaves out is of second order in the step: small and everywhere,
/// but where liquid meets a solid within one step, and there the gradients of x(t) cannot answer to a density so far
/// off.
void advect_density_to_positions(const StepView& view, const Array3& predicted_velocity, double dt,
                                 PressureScratch& scratch);

/// Density that the pressure acceleration adds to particle i over dt (left side of 29, 30), over rest density.
///   dt^2 sum_j m_j (a_i - a_j) . grad W_ij + dt^2 sum_b psi_b a_i . grad W_ib
void density_change(const StepView& view, const Array3& acceleration, double dt, Array<Real>& change);

}  // namespace sessile
