#pragma once

#include "sessile/pressure/jacobi.h"

namespace sessile {

/// Solves the linear problem (29), (30), whose advected density and diagonal a_ii `scratch` holds, by conjugate
/// directions that keep p >= 0, until the compression left is small enough. With s = p/rho^2 and the masses as weights,
/// <x, y> = sum_i m_i x_i y_i, what pressure takes from the densities is symmetric and positive, walls included:
///   <s, A s> = dt^2 sum_i m_i |a_i|^2
/// so the pressures looked for are those of the least f(s) = <s, A s>/2 - <s, rho_adv - rho0>, s >= 0: of the least
/// kinetic energy. Each turn
///   z_i   = r_i / |a_ii|,  0 where p_i = 0 and r_i < 0          r = rho_adv - A s - rho0
///   d     = max(0, p + l (z + beta d)) - p,                     beta = -<z, A d>/<d, A d>
///   p    += t d,  a += t a(d),  t = <d, r>/<d, A d>             as far as p stays >= 0
/// costs what a Jacobi turn costs, as <d, A d> needs the acceleration of d alone. l is the length that was best in the
/// turn before; where no p_i meets 0 its value does not matter, and the turns are those of the preconditioned method of
/// Hestenes and Stiefel (1952), with beta by Polak and Ribiere (1969). The start is `pressure` times its best factor,
/// <p, rho_adv - rho0>/<p, A p>. It ends, not converged, where a direction pushes nothing but by rounding. Internal.
PressureResult improve_by_conjugate_directions(const IterationLimits& limits, const StepView& s, double dt,
                                               Array<Real>& pressure, PressureScratch& scratch);

}  // namespace sessile
