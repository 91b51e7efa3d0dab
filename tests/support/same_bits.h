#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "sessile/output/stats.h"
#include "sessile/simulation.h"

namespace sessile::test {

/// The line of stats.csv that a simulation would get now.
inline std::string line_of(const Simulation& s) {
  return stats_line({s.time(), s.last_step(), s.totals(), measure(s), s.walls().forces, {}});
}

/// Whether every field of every particle has the same bits in both.
inline bool same_bits(const Particles& a, const Particles& b) {
  std::string first, second;
  const auto into = [](std::string& bytes) {
    return [&bytes](const auto& array) { bytes.append(reinterpret_cast<const char*>(array.data()), bytes_of(array)); };
  };
  a.for_each_field(into(first));
  b.for_each_field(into(second));
  return first == second;
}

/// Expects two simulations to stand exactly alike.
inline void expect_same(const Simulation& a, const Simulation& b, const std::string& what) {
  EXPECT_EQ(line_of(a), line_of(b)) << what;
  EXPECT_TRUE(same_bits(a.particles(), b.particles())) << what;
}

}  // namespace sessile::test
