#pragma once

namespace sessile {

/// Number type of every per-particle quantity: float, or double in the `double` preset (reference tests).
/// Time and global sums are double in every build.
#ifdef SESSILE_DOUBLE
using Real = double;
#else
using Real = float;
#endif

}  // namespace sessile
