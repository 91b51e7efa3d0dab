#include "sessile/scene/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <typeindex>

#include "sessile/scene/read_values.h"
#include "sessile/scene/scene.h"
#include "sessile/scene/value_text.h"

namespace sessile {

namespace {

std::string joined(std::span<const std::string_view> words) {
  std::string list;
  for (const auto each : words) list += (list.empty() ? "" : ", ") + std::string(each);
  return list;
}

template <class T>
std::string type_text() {
  if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_same_v<T, int>) {
    return "whole number";
  } else if constexpr (std::is_same_v<T, double>) {
    return "number";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "text";
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    return "[x, y, z]";
  } else if constexpr (Worded<T>) {
    return "word: " + joined(Words<T>::words);
  } else if constexpr (is_optional<T>) {
    return type_text<typename T::value_type>();
  } else if constexpr (is_list<T>) {
    return "list, each a " + type_text<typename T::value_type>();
  } else if constexpr (is_choice<T>) {
    const auto names = alternative_names<T>();
    return "group of type " + joined(names);
  } else {
    static_assert(Declared<T>);
    return "group";
  }
}

template <class F, class T>
std::string default_text(const F& f, const T& value) {
  if constexpr (is_optional<T>) {
    return std::string(f.derived);
  } else if constexpr (is_choice<T>) {
    return std::visit([]<Named U>(const U&) { return std::string(U::name); }, value);
  } else if constexpr (is_list<T> && is_group<T>) {
    return "none";
  } else if constexpr (Declared<T>) {
    return "its defaults";
  } else {
    return value_text(value);
  }
}

/// Collects groups in the order in which a reader of the scene meets them, each once.
class Collector {
 public:
  template <Declared T>
  void group(const std::string& path, bool choice = false) {
    const auto [known, fresh] = index_.emplace(typeid(T), groups_.size());
    if (!fresh) {
      groups_[known->second].used_at.push_back(path);
      return;
    }
    GroupReference entry;
    entry.choice = choice;
    entry.used_at = {path};
    if constexpr (Named<T>) {
      entry.name = std::string(T::name);
      entry.summary = std::string(T::summary);
    } else {
      entry.name = path;
    }
    const T defaults{};
    for_each_field<T>([&](const auto& f) {
      using Value = typename std::remove_cvref_t<decltype(f)>::value_type;
      const bool must = f.presence == Presence::required;
      entry.parameters.push_back({std::string(f.key), type_text<Value>(), std::string(f.unit), range_text(f.range, ""),
                                  must ? "" : default_text(f, defaults.*f.member), must, std::string(f.help)});
    });
    groups_.push_back(std::move(entry));
    for_each_field<T>([&](const auto& f) {
      using Value = typename std::remove_cvref_t<decltype(f)>::value_type;
      below<Value>((path.empty() ? "" : path + ".") + std::string(f.key));
    });
  }

  std::vector<GroupReference> take() { return std::move(groups_); }

 private:
  template <class T>
  void below(const std::string& path) {
    if constexpr (is_optional<T>) {
      below<typename T::value_type>(path);
    } else if constexpr (is_list<T>) {
      below<typename T::value_type>(path + "[]");
    } else if constexpr (is_choice<T>) {
      for_each_alternative<T>([&]<Named U>(std::type_identity<U>) { group<U>(path, true); });
    } else if constexpr (Declared<T>) {
      group<T>(path);
    }
  }

  std::map<std::type_index, std::size_t> index_;
  std::vector<GroupReference> groups_;
};

/// Text that Markdown leaves as it is, in a table too.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '_' || c == '<' || c == '[' || c == ']') result += '\\';
    result += c;
  }
  return result;
}

constexpr std::string_view introduction = R"(# Scenes

<!-- Written by the program from the fields that its structs declare; the unit tests say when it is out of date. -->

A scene is a JSON file, with `//` and `/* */` comments. Lengths, times and masses are in SI units, angles in degrees; z is
up by default, because gravity points down it. What a scene does not give has the default shown here; a key that is not
listed here is an error, and so is a value out of its range. `sessile check SCENE` shows every parameter as it will run.
Each can be overridden on the command line: `--set time.end=2`, `--set forces[0].cohesion=5`,
`--set bodies[0].shape.size=[1,1,1]`; `null` takes back an optional value that the file gives.
A group that comes in several types is told by its key `"type"`: `{"type": "box", "size": [1, 1, 1]}`.
)";

}  // namespace

std::vector<GroupReference> scene_reference() {
  Collector collector;
  collector.group<Scene>("");
  return collector.take();
}

std::string models_text() {
  std::string text;
  const auto groups = scene_reference();
  const auto kind = [&](std::string_view title, auto belongs) {
    text += std::string(text.empty() ? "" : "\n") + std::string(title) + "\n";
    for (const auto& each : groups) {
      if (!each.choice || !belongs(each.used_at.front())) continue;
      text += fmt::format("  {}: {}\n", each.name, each.summary);
      for (const auto& p : each.parameters) {
        const std::string unit = p.unit.empty() ? "" : fmt::format(" [{}]", p.unit);
        const std::string range = p.range.empty() ? "" : ", " + p.range;
        const std::string preset = p.required ? "required" : "default " + p.default_value;
        text += fmt::format("    {:18} {}{}{}, {}\n    {:18} {}\n", p.key, p.type, unit, range, preset, "", p.help);
      }
    }
  };
  kind("Pressure solvers (pressure)", [](const std::string& path) { return path == "pressure"; });
  kind("Forces (forces[])", [](const std::string& path) { return path == "forces[]"; });
  kind("Shapes (shape of a body, an emitter or a solid)",
       [](const std::string& path) { return path.ends_with(".shape"); });
  kind("Surface methods (output.surface.method)",
       [](const std::string& path) { return path == "output.surface.method"; });
  return text;
}

std::string scene_reference_markdown() {
  std::string text(introduction);
  for (const auto& group : scene_reference()) {
    if (group.choice) {
      text += fmt::format("\n## Type `{}`\n\n{}. A choice for", group.name, plain(group.summary));
    } else {
      text += group.name.empty() ? "\n## The scene\n" : fmt::format("\n## `{}`\n", group.name);
    }
    if (group.choice || group.used_at.size() > 1) {
      std::string places;
      for (const auto& each : group.used_at) places += (places.empty() ? "" : ", ") + fmt::format("`{}`", each);
      text += fmt::format("{}{}.\n", group.choice ? " " : "\nThe same at ", places);
    }
    text += "\n| key | type | unit | values | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const auto& p : group.parameters) {
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", p.key, plain(p.type), plain(p.unit), plain(p.range),
                          p.required ? "**required**" : plain(p.default_value), plain(p.help));
    }
  }
  return text;
}

}  // namespace sessile
