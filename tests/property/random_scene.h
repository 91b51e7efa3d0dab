#pragma once

#include "sessile/scene/scene.h"

namespace sessile::test {

/// A small scene drawn from a seed: bodies of every shape, solids, emitters, every edge of a domain, every force and
/// solver, at any scale from 10 um to 10 m. Coefficients follow from numbers without dimension drawn over magnitudes,
/// so that steps stay near what the motion asks for. It passes validate(); whether bodies are clear of solids and of
/// each other is left to Simulation, which refuses such a scene with SceneError. Every third seed, 1, 4, 7 ..., makes
/// some 1200 to 3000 particles, three or more of the blocks that threads share out; the others mostly less than one.
Scene random_scene(unsigned seed);

}  // namespace sessile::test
