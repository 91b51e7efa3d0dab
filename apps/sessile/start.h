#pragma once

#include <filesystem>
#include <vector>

#include "isa.h"

namespace sessile::app {

/// What must be settled before the program's work begins: which instruction set it runs with and how OpenMP's threads
/// wait. Starts the program anew, at most twice and mostly once, where either is not yet as it should be. False, and
/// says why, where the environment asks for an instruction set that cannot be had.
bool start(char** argv);

/// The instruction sets that the program knows, the best first; its own among them.
std::vector<Isa> known_isas();

/// The folder that the program is installed in, above bin and lib; empty where that cannot be found out.
std::filesystem::path installed_in();

}  // namespace sessile::app
