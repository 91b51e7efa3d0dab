#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sessile::app {

/// The places that a selection names out of `count`, in order and each once: "3,5,-1" a list, "10:20", ":", "::5"
/// slices as Python has them, and lists of those. Negative ones count from the end.
/// Throws Error with a sentence for a text that is none, or a place of a list that is not there.
std::vector<std::size_t> selected(const std::string& text, std::size_t count);

}  // namespace sessile::app
