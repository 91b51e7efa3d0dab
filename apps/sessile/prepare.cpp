#include "prepare.h"

#include <fmt/format.h>

#include "sessile/core/error.h"
#include "sessile/output/check.h"

namespace sessile::app {
namespace {

/// `tablet.json:12: bodies[0] "a" and bodies[1] "b" overlap`: sentences that start with a parameter get its line.
std::string located(const ResolvedScene& resolved, const std::string& file, const std::string& sentence) {
  const auto place = resolved.places.find(sentence.substr(0, sentence.find_first_of(" :")));
  return fmt::format("{}: {}", place == resolved.places.end() ? file : place->second, sentence);
}

}  // namespace

ResolvedScene read_runnable_scene(const std::string& file, const std::vector<std::string>& overrides,
                                  MeshPlaces places) {
  return read_resolved_scene(file, overrides, check_output, places);
}

Simulation set_up(const ResolvedScene& resolved, const std::string& file) {
  try {
    return Simulation(resolved.scene);
  } catch (const SceneError& e) {
    std::vector<std::string> lines;
    for (const std::string& sentence : e.messages) lines.push_back(located(resolved, file, sentence));
    throw SceneError(std::move(lines));
  } catch (const FileError& e) {  // of a mesh
    throw SceneError(located(resolved, file, e.what()));
  }
}

}  // namespace sessile::app
