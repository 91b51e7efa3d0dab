#pragma once

#include <exception>
#include <filesystem>
#include <string>

namespace sessile::app {

/// What went wrong, in a sentence for people: what() of our own errors, better words for those of the language.
std::string sentence(const std::exception& fault);

/// What can be done about it, in a sentence; empty where the fault itself says so.
std::string advice(const std::exception& fault);

/// Says both on standard error.
void tell(const std::exception& fault);

}  // namespace sessile::app
