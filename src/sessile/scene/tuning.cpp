#include "sessile/scene/tuning.h"

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>
#include <utility>

#include "sessile/scene/describe.h"
#include "sessile/scene/traits.h"

namespace sessile {
namespace {

// Groups and single parameters, without the places in lists. A solver keeps its own pressures from step to step, so its
// type stays; forces keep nothing.
constexpr auto changeable =
    std::to_array<std::string_view>({"title", "gravity", "time", "fluid.viscosity", "forces[]", "pressure",
                                     "solids[].adhesion", "solids[].viscosity", "stability", "output", "render"});
constexpr auto fixed = std::to_array<std::string_view>({"pressure", "pressure.type"});

/// The path without the places in lists: "forces[].cohesion".
std::string pattern(std::string_view path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) text += c;
    if (c == '[') inside = true;
  }
  return text;
}

/// Copies what may change from one scene to another, wherever both have it.
class Tuner {
 public:
  template <Declared T>
  void group(const std::string& path, T& into, const T& from) {
    for_each_field<T>([&](const auto& f) {
      value((path.empty() ? "" : path + ".") + std::string(f.key), into.*f.member, from.*f.member);
    });
  }

 private:
  template <class T>
  void value(const std::string& path, T& into, const T& from) {
    if (may_change_between_steps(path)) {
      into = from;
    } else if constexpr (is_optional<T>) {  // NOLINT(bugprone-branch-clone): kinds of a parameter
      if (into && from) value(path, *into, *from);
    } else if constexpr (is_list<T>) {
      if (into.size() != from.size()) return;
      for (std::size_t i = 0; i < into.size(); ++i) value(path + "[]", into[i], from[i]);
    } else if constexpr (is_choice<T>) {
      std::visit(
          [&]<Named U>(U& chosen) {
            if (const U* same = std::get_if<U>(&from)) group(path, chosen, *same);
          },
          into);
    } else if constexpr (Declared<T>) {
      group(path, into, from);
    }
  }
};

std::vector<ResolvedParameter> listed(const Scene& scene) { return parameters({scene, {}, {}}); }

}  // namespace

bool may_change_between_steps(std::string_view path) {
  std::string place = pattern(path);
  if (place == "forces") place = "forces[]";
  if (std::find(fixed.begin(), fixed.end(), place) != fixed.end()) return false;
  return std::any_of(changeable.begin(), changeable.end(), [&](std::string_view each) {
    return place == each || (place.starts_with(each) && place[each.size()] == '.');
  });
}

Scene tuned(Scene running, const Scene& wanted) {
  Tuner().group("", running, wanted);
  return running;
}

std::vector<std::string> differing_parameters(const Scene& first, const Scene& second) {
  std::map<std::string, std::string> others;
  for (auto& each : listed(second)) others.emplace(each.path, each.value);
  std::vector<std::string> paths;
  for (const auto& each : listed(first)) {
    const auto other = others.find(each.path);
    if (other == others.end() || other->second != each.value) paths.push_back(each.path);
    if (other != others.end()) others.erase(other);
  }
  for (const auto& each : listed(second)) {
    if (others.contains(each.path)) paths.push_back(each.path);
  }
  return paths;
}

}  // namespace sessile
