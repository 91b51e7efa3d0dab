#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "draw/moment.h"
#include "sessile/output/snapshot.h"
#include "sessile/scene/scene.h"

namespace sessile {
class Simulation;
}

/// What of scenes, simulations and frames is drawn: one answer for pictures and for the window.
namespace sessile::app {

/// Solids, and the box around them and around the liquid as it starts. Throws FileError or SceneError of a mesh file.
draw::Stage stage_of(const Scene& scene);

/// Fields that can colour a frame: its columns, "speed" when there is a velocity, and "height".
std::vector<std::string> shown_fields(const Snapshot& frame);

/// Fields that can colour a simulation.
std::vector<std::string> shown_fields(const Simulation& simulation);

/// A frame as it is drawn, coloured by a field; vectors by their length. Without a name: by speed where there is a
/// velocity, else by the first column, else by nothing. Throws Error with the names that are there for one that is not.
draw::Moment moment_of(const Snapshot& frame, std::string_view field, const draw::Stage& stage);

/// The simulation as it stands.
draw::Moment moment_of(const Simulation& simulation, std::string_view field, const draw::Stage& stage);

}  // namespace sessile::app
