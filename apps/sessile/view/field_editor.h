#pragma once

#include <map>
#include <set>
#include <string>

#include "sessile/scene/scene.h"
#include "sessile/scene/surface_settings.h"

namespace sessile::viewer {

/// What stands beside parameters.
struct FieldNotes {
  std::map<std::string, std::string> faults;  ///< by path; what is wrong with a value
  std::set<std::string> pending;              ///< paths of values that wait for a reset
  bool read_only = false;                     ///< whether nothing can be changed
  bool marks_resets = false;                  ///< whether parameters that need a reset are marked
};

/// Shows every declared parameter as a table of ImGui with a field to edit it. Returns whether one was changed.
bool edit_fields(Scene& scene, const FieldNotes& notes);
bool edit_fields(SurfaceSettings& settings, const FieldNotes& notes);

}  // namespace sessile::viewer
