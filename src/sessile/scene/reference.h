#pragma once

#include <string>
#include <vector>

#include "sessile/core/fields.h"

namespace sessile {

/// What a declared field says of itself, as text.
struct ParameterReference {
  std::string key;
  std::string type;           ///< "number", "text", "[x, y, z]", "one of box, sphere", "list of ..."
  std::string unit;           ///< SI; "" for none
  std::string range;          ///< "above 0"; "" for any
  std::string default_value;  ///< as JSON, or what its absence stands for; "" for a required one
  bool required = false;
  std::string help;
};

/// A declared struct and its parameters.
struct GroupReference {
  std::string name;                  ///< of a choice ("box"), or else the place in a scene ("time")
  std::string summary;               ///< of a choice; "" otherwise
  std::vector<std::string> used_at;  ///< every place in a scene, e.g. "bodies[].shape"
  bool choice = false;               ///< whether the key "type" selects it
  std::vector<ParameterReference> parameters;
};

/// Every group that a scene can hold, the scene itself first ("").
std::vector<GroupReference> scene_reference();

/// The parameters of every pressure solver, force and shape, as a table for a terminal.
std::string models_text();

/// docs/scenes.md: the reference of scene files.
std::string scene_reference_markdown();

}  // namespace sessile
