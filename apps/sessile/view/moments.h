#pragma once

#include <string>
#include <vector>

#include "draw/moment.h"
#include "sessile/output/snapshot.h"
#include "sessile/simulation.h"

namespace sessile::viewer {

/// What there is to see of the simulation, coloured by a field. Without a field of that name, by nothing.
draw::Moment moment_of(const Simulation& simulation, const std::string& field);

/// The same of a frame; "speed" is also found from a velocity, and every vector gives its length.
draw::Moment moment_of(const Snapshot& snapshot, const std::string& field);

/// What a surface is made of: the points, with the field that colours.
Snapshot coloured_points(const draw::Moment& moment);

/// Where a scene is looked at: its solids, and the points at the start. Throws FileError or SceneError of a mesh file.
draw::Stage stage_of(const Scene& scene, const std::vector<float>& points);

/// Fields that can colour a frame.
std::vector<std::string> fields_of(const Snapshot& snapshot);

/// Fields that can colour a simulation that has these accelerations.
std::vector<std::string> fields_of(const std::vector<std::string>& accelerations);

}  // namespace sessile::viewer
