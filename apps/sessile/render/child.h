#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sessile::app {

/// How a program ended that this one had started.
struct ChildEnd {
  bool missing = false;      ///< there is no such program
  bool interrupted = false;  ///< Ctrl-C; the child was ended for it
  int status = 0;            ///< exit code; 128 and the signal's number where a signal ended it
};

/// Runs a program with its arguments, found in PATH, and hands over each line that it prints. Ctrl-C ends the child and
/// returns. Throws Error when the system cannot start another program.
ChildEnd run_child(const std::vector<std::string>& command, const std::function<void(const std::string&)>& on_line);

/// Where PATH has a program; empty when it has none.
std::filesystem::path find_program(const std::string& name);

}  // namespace sessile::app
