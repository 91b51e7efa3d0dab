#pragma once

#include <string>
#include <vector>

namespace sessile {

/// Something in a scene that cannot be run: which parameter, and why.
struct Fault {
  std::string path;               ///< of the parameter, e.g. "forces[0].cohesion"; "" for the scene as a whole
  std::string message;            ///< what is wrong, without the path
  std::vector<std::string> uses;  ///< other parameters the judgement rests on
};

/// `path: message`, for scenes that come from no file.
inline std::string text(const Fault& fault) {
  return fault.path.empty() ? fault.message : fault.path + ": " + fault.message;
}

}  // namespace sessile
