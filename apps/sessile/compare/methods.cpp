#include "methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include "sessile/core/error.h"
#include "sessile/output/check.h"
#include "sessile/scene/spelling.h"
#include "start.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// Names and files of the methods in all folders; the first folder that has a name counts.
std::map<std::string, fs::path> known_methods(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> methods;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".json") methods.emplace(entry.path().stem().string(), entry.path());
    }
  }
  return methods;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = list.find(',', begin);
    words.push_back(list.substr(begin, end - begin));
  }
  return words;
}

/// The file as seen from where the program runs, when it lies below.
fs::path from_here(const fs::path& file) {
  std::error_code error;
  const fs::path relative = fs::relative(file, error);
  return error || relative.empty() || *relative.begin() == ".." ? file : relative;
}

bool is_path(const std::string& word) { return word.find('/') != std::string::npos || word.ends_with(".json"); }

/// Why a name cannot be that of a folder of results; "" when it can.
std::string unfit(const std::string& name) {
  const bool control = std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::iscntrl(c); });
  if (control) return "has control characters in its name";
  if (name.starts_with('.')) return "has a name that starts with a dot";
  if (name == "plots" || name.starts_with("comparison.")) return "has the name of a part of the report";
  return {};
}

std::string unknown(const std::string& word, const std::map<std::string, fs::path>& known) {
  std::vector<std::string_view> names;
  std::string list;
  for (const auto& [name, file] : known) {
    names.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  const std::string_view near = nearest(word, names);
  return fmt::format("--methods: unknown method {}{} ({})", in_quotes(word),
                     near.empty() ? "" : fmt::format(", did you mean {}?", in_quotes(near)),
                     list.empty() ? "no folder \"methods\" beside the scene or above it holds any" : "found: " + list);
}

/// Adds the faults that f throws, a note behind each; returns f's result where there are none.
template <class F>
auto collect(std::vector<std::string>& faults, const std::string& note, F&& f) -> std::optional<decltype(f())> {
  try {
    return f();
  } catch (const SceneError& e) {
    for (const std::string& message : e.messages) faults.push_back(message + note);
  }
  return {};
}

}  // namespace

std::vector<fs::path> method_folders(const fs::path& scene_file) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::path at = fs::absolute(scene_file, error).lexically_normal().parent_path();; at = at.parent_path()) {
    folders.push_back(at / "methods");
    if (at == at.parent_path()) break;
  }
  if (const fs::path place = installed_in(); !place.empty()) {
    folders.push_back(place / "share/sessile/methods");
    folders.push_back((place / "../../scenes/methods").lexically_normal());  // where it was built
  }
  return folders;
}

std::vector<Contestant> read_contestants(const std::string& list, const fs::path& scene_file,
                                         const ResolvedScene& scene) {
  const auto known = known_methods(method_folders(scene_file));
  std::vector<Contestant> contestants;
  std::vector<std::string> faults;
  for (const std::string& word : split(list)) {
    if (word.empty()) {
      faults.emplace_back("--methods: expected names between commas, such as none,paper");
      continue;
    }
    const auto found = known.find(word);
    if (!is_path(word) && found == known.end()) {
      faults.push_back(unknown(word, known));
      continue;
    }
    const fs::path file = is_path(word) ? fs::path(word) : from_here(found->second);
    const std::string name = file.stem().string();
    if (const std::string why = unfit(name); !why.empty()) {
      faults.push_back(fmt::format("--methods: {} {}", in_quotes(word), why));
      continue;
    }
    if (std::any_of(contestants.begin(), contestants.end(), [&](const auto& each) { return each.name == name; })) {
      faults.push_back(fmt::format("--methods: two methods are called {}", in_quotes(name)));
      continue;
    }
    const auto method = collect(faults, "", [&] { return read_resolved_method(file); });
    if (!method) continue;
    const std::string note = fmt::format(" (with the method {})", in_quotes(name));
    auto resolved = collect(faults, note, [&] { return with_method(scene, *method, check_output); });
    if (resolved) contestants.push_back({name, file, method->method.title, std::move(*resolved)});
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
  return contestants;
}

void refuse_overrides_of_methods(const std::vector<std::string>& overrides) {
  std::vector<std::string> faults;
  for (const std::string& each : overrides) {
    const std::string path = each.substr(0, each.find('='));
    const std::string key = path.substr(0, path.find_first_of(".["));
    if (key == "pressure" || key == "forces") {
      faults.push_back(fmt::format("--set {}: the methods decide on {}; write a method's file of your own", path, key));
    }
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

}  // namespace sessile::app
