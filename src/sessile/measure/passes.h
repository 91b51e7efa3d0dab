#pragma once

#include <span>
#include <string_view>

#include "sessile/core/array.h"
#include "sessile/pressure/solve.h"

namespace sessile {

class Simulation;

/// What a pass cannot do without, as it would be if nothing were loaded or computed twice: a bound, not a count of what
/// the code does today.
struct PassWork {
  double gathered = 0;    ///< numbers gathered per neighbour; masses, which are mostly equal, left out
  double operations = 0;  ///< lane operations per neighbour, a product with a sum as one; counted by hand
  double streamed = 0;    ///< bytes read or written in order per particle, beside 4 per neighbour for its list
};

/// Memory that passes write to.
struct PassScratch {
  Array<Real> numbers;
  Array3 vectors;
  PressureScratch pressure;
};

/// One pass over all particles and their neighbours: the very function that a step calls, to be run by itself.
struct Pass {
  std::string_view name;
  PassWork work;
  void (*run)(const Simulation& simulation, PassScratch& scratch);
};

/// The passes that a step of IISPH with surface tension is made of, in the step's order.
std::span<const Pass> passes();

}  // namespace sessile
