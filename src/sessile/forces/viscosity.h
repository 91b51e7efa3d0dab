#pragma once

#include <span>

#include "sessile/core/array.h"
#include "sessile/walls/walls.h"

namespace sessile {

struct StepView;

/// Adds the laminar viscous acceleration [m/s^2] of every particle (paper, eq. 6; Morris et al. 1997).
///   a_i = (2/rho_i) [ mu sum_j (m_j/rho_j) v_ij (x_ij . grad W_ij)/(r^2 + 0.01 h^2)
///                     + mu_wall sum_b (psi_b/rho0) (v_i - v_b) (x_ib . grad W_ib)/(r^2 + 0.01 h^2) ]
/// Antisymmetric in m a: conserves momentum. `viscosity` is mu [Pa s]; mu_wall belongs to each boundary particle.
void add_viscosity(const StepView& view, double viscosity, Array3& acceleration);

/// Adds to each solid the opposite of what its boundary particles' viscosity does to the liquid.
void add_viscosity_reaction(const StepView& view, const Walls& walls, std::span<SolidForce> forces);

}  // namespace sessile
