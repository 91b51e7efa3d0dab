#include "sessile/scene/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sessile/scene/traits.h"
#include "sessile/scene/value_text.h"

namespace sessile {

namespace {

/// Walks over a scene and lists its values.
class Lister {
 public:
  explicit Lister(const std::set<std::string>& given) : given_(given) {}

  template <Declared T>
  void group(const std::string& path, const T& group) {
    for_each_field<T>(
        [&](const auto& f) { value((path.empty() ? "" : path + ".") + std::string(f.key), f, group.*f.member); });
  }

  std::vector<ResolvedParameter> take() { return std::move(list_); }

 private:
  void add(const std::string& path, std::string value, std::string_view unit) {
    list_.push_back({path, std::move(value), std::string(unit), given_.contains(path)});
  }

  template <class F, class T>
  void value(const std::string& path, const F& f, const T& value_) {
    if constexpr (is_optional<T>) {
      if (value_) {
        value(path, f, *value_);
      } else {
        add(path, fmt::format("({})", f.derived), "");
      }
    } else if constexpr (is_choice<T>) {
      std::visit(
          [&]<Named U>(const U& chosen) {
            list_.push_back({path + ".type", std::string(U::name), "", given_.contains(path + ".type")});
            group(path, chosen);
          },
          value_);
    } else if constexpr (Declared<T>) {
      group(path, value_);
    } else if constexpr (is_list<T> && is_group<T>) {
      if (value_.empty()) add(path, "(none)", "");
      for (std::size_t i = 0; i < value_.size(); ++i) value(fmt::format("{}[{}]", path, i), f, value_[i]);
    } else {
      add(path, value_text(value_), f.unit);
    }
  }

  const std::set<std::string>& given_;
  std::vector<ResolvedParameter> list_;
};

/// Writes groups as indented JSON.
class JsonWriter {
 public:
  template <Declared T>
  void group(const T& group, int indent, std::string_view type = "") {
    text_ += "{";
    bool first = true;
    const auto key = [&](std::string_view name) {
      text_ += fmt::format("{}\n{:{}}\"{}\": ", first ? "" : ",", "", indent + 2, name);
      first = false;
    };
    if (!type.empty()) {
      key("type");
      text_ += fmt::format("\"{}\"", type);
    }
    for_each_field<T>([&](const auto& f) {
      const auto& member = group.*f.member;
      if constexpr (is_optional<std::remove_cvref_t<decltype(member)>>) {
        if (!member) return;
      }
      key(f.key);
      value(member, indent + 2);
    });
    text_ += fmt::format("\n{:{}}}}", "", indent);
  }

  std::string take() { return std::move(text_); }

 private:
  template <class T>
  void value(const T& value_, int indent) {
    if constexpr (!is_group<T>) {
      text_ += value_text(value_);
    } else if constexpr (is_optional<T>) {
      value(*value_, indent);
    } else if constexpr (is_choice<T>) {
      std::visit([&]<Named U>(const U& chosen) { group(chosen, indent, U::name); }, value_);
    } else if constexpr (is_list<T>) {
      text_ += "[";
      for (std::size_t i = 0; i < value_.size(); ++i) {
        text_ += i == 0 ? "" : ", ";
        value(value_[i], indent);
      }
      text_ += "]";
    } else {
      group(value_, indent);
    }
  }

  std::string text_;
};

}  // namespace

std::vector<ResolvedParameter> parameters(const ResolvedScene& resolved) {
  Lister lister(resolved.given);
  lister.group("", resolved.scene);
  return lister.take();
}

std::string describe(const ResolvedScene& resolved) {
  const auto list = parameters(resolved);
  // One long path or text must not push everything else off the screen.
  std::size_t path_width = 0, value_width = 0;
  for (const auto& each : list) {
    path_width = std::max(path_width, std::min<std::size_t>(each.path.size(), 40));
    value_width = std::max(value_width, std::min<std::size_t>(each.value.size(), 32));
  }
  std::string text;
  for (const auto& each : list) {
    text += fmt::format("{:{}}  {:{}}  {:7}  {}", each.path, path_width, each.value, value_width,
                        each.given ? "given" : "default", each.unit);
    while (text.ends_with(' ')) text.pop_back();
    text += '\n';
  }
  return text;
}

std::string to_json(const Scene& scene) {
  JsonWriter writer;
  writer.group(scene, 0);
  return writer.take() + "\n";
}

std::string to_json(const SurfaceSettings& settings) {
  JsonWriter writer;
  writer.group(settings, 0);
  return writer.take() + "\n";
}

std::string to_json(const RenderSettings& settings) {
  JsonWriter writer;
  writer.group(settings, 0);
  return writer.take() + "\n";
}

}  // namespace sessile
