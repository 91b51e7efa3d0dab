#pragma once

namespace sessile::app {

/// Loops run on so many threads from now on; 0: on as many as OpenMP chose. Where the system does not give so many, a
/// warning says so and they run on those there are, with the same results: OpenMP itself would end the program.
void use_threads(int wanted);

}  // namespace sessile::app
