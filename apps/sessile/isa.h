#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

/// Instruction sets that the program is built for, and the choice among them (docs/decisions/instruction-sets.md).
namespace sessile::app {

/// The best first, the baseline last; cmake/InstructionSets.cmake lists the same.
inline constexpr std::array<std::string_view, 3> isa_names = {"x86-64-v4", "x86-64-v3", "x86-64"};

struct Isa {
  std::string name;
  bool there = false;  ///< the program for it is installed
  bool runs = false;   ///< this processor and its operating system have it
};

/// Whether this processor, under its operating system, runs code for the instruction set; true for names that the
/// program does not know, such as "native".
bool processor_runs(std::string_view isa);

struct IsaChoice {
  std::string isa;    ///< empty where there is a fault
  std::string fault;  ///< a sentence for the user
};

/// Of `isas`, which has the best first, the one that `wish` names, or without a wish the first that is there and runs.
IsaChoice choose_isa(const std::vector<Isa>& isas, std::string_view wish);

}  // namespace sessile::app
