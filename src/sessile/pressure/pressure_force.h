#pragma once

#include <span>

#include "sessile/core/array.h"
#include "sessile/walls/walls.h"

namespace sessile {

struct StepView;

/// Acceleration [m/s^2] that a pressure field p / rho0 [m^2/s^2] gives every particle (paper, eq. 5); walls mirror the
/// particle's own pressure.
///   a_i = - sum_j m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W_ij - sum_b psi_b (p_i/rho_i^2) grad W_ib
/// `stress` is scratch for p_i/rho_i^2.
void pressure_acceleration(const StepView& view, const Array<Real>& pressure, Array<Real>& stress,
                           Array3& acceleration);

/// Adds to each solid the opposite of what its boundary particles' pressure does to the liquid. `stress` as above.
void add_pressure_reaction(const StepView& view, const Array<Real>& stress, const Walls& walls,
                           std::span<SolidForce> forces);

}  // namespace sessile
