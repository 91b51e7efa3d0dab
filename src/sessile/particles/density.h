#pragma once

#include "sessile/core/array.h"

namespace sessile {

struct StepView;

/// Density of every particle over rest density, boundary particles included (paper, eqs. 3, 4).
///   rho_i = sum_j m_j W_ij + sum_b psi_b W_ib,  i itself included
void compute_density(const StepView& view, Array<Real>& density);

/// Normal of the colour field of every particle, dimensionless; long at the surface, near zero inside (eq. 19).
///   n_i = h sum_j (m_j / rho_j) grad W_ij
void compute_normals(const StepView& view, Array3& normal);

}  // namespace sessile
