#pragma once

#include <cstddef>

/// What this machine can do at all, through the lanes that the passes use: no pass can be faster than these allow.
/// Each call measures once, for at least `seconds`, on `threads` threads, and gives the rate of all of them together.
namespace sessile::ceiling {

/// Bytes per ns read in order from `bytes` of memory, a share of it for each thread.
double read_bandwidth(std::size_t bytes, int threads, double seconds);

/// Bytes per ns of a = b + s c, two read and one written, over `bytes` in the three arrays together.
double triad_bandwidth(std::size_t bytes, int threads, double seconds);

/// Numbers per ns gathered as a pass does: the three of each of the 32 nearest of a lattice's points around each point,
/// x and y at once; `points` of them, a power of two, per thread.
double gather_rate(std::size_t points, int threads, double seconds);

/// Products with sums per ns, a lane each.
double multiply_add_rate(int threads, double seconds);

}  // namespace sessile::ceiling
