#pragma once

#include <map>
#include <string_view>

#include "sessile/scene/scene.h"

/// What `sessile bench` simulates.
namespace sessile::app::bench {

/// The texts of scenes/bench/*.json, by name.
const std::map<std::string_view, std::string_view>& scene_texts();

/// A scene of scenes/bench. With `particles` > 0 its spacing is such that it has about so many.
Scene bench_scene(std::string_view name, std::size_t particles = 0);

/// A falling block of edge^3 jittered particles at h = 2 dx, with every force, and exactly so many iterations a step
/// whatever error they leave: the same work for each particle at any size.
Scene block_scene(int edge, int iterations);

/// Edge of the cube of about so many particles.
int edge_of(std::size_t particles);

}  // namespace sessile::app::bench
