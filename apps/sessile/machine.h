#pragma once

#include <cstddef>
#include <string>

/// What the program tells of the machine it runs on. Linux; elsewhere unknown.
namespace sessile::app {

/// Name of the processor; "unknown" where the system does not tell.
std::string processor_name();

/// Memory that programs can still get [bytes]; 0 where the system does not tell.
std::size_t available_memory();

/// Memory that this program holds now [bytes]; 0 where the system does not tell.
std::size_t resident_memory();

/// Forgets the most memory that this program has held: the next peak_memory() is of what comes after. False where the
/// system cannot.
bool forget_peak_memory();

}  // namespace sessile::app
