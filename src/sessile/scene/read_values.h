#pragma once

#include <json/value.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/scene/read.h"
#include "sessile/scene/scene_text.h"
#include "sessile/scene/shapes.h"
#include "sessile/scene/spelling.h"
#include "sessile/scene/traits.h"

namespace sessile {

/// Reads JSON values into declared structs, and keeps every fault it meets. A faulty value leaves its default.
class ValueReader {
 public:
  /// Meshes are looked for from `folder`, and outside of it where `places` lets them lie.
  ValueReader(const SceneText& text, std::filesystem::path folder, MeshPlaces places = MeshPlaces::in_its_folder)
      : text_(text), folder_(std::move(folder)), places_(places) {}

  struct Found {
    std::ptrdiff_t offset = 0;  ///< of the key or value in the file; negative: of an override
    std::string path;
    std::string message;
  };

  const std::vector<Found>& faults() const { return faults_; }
  const std::map<std::string, std::ptrdiff_t>& offsets() const { return offsets_; }
  const std::set<std::string>& given() const { return given_; }

  /// Reads a value of any kind that a field can have.
  template <class T>
  void read(const Json::Value& json, const std::string& path, Range range, std::string_view unit, T& value) {
    offsets_.emplace(path, key_offset(json));
    if constexpr (std::is_same_v<T, bool>) {
      if (expect(json.isBool(), json, path, "true or false")) value = json.asBool();
    } else if constexpr (std::is_same_v<T, int>) {
      read_int(json, path, range, unit, value);
    } else if constexpr (std::is_same_v<T, double>) {
      read_number(json, path, range, unit, value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      read_text(json, path, value);
    } else if constexpr (std::is_same_v<T, Vec3d>) {
      read_vector(json, path, range, unit, value);
    } else if constexpr (Worded<T>) {
      read_word(json, path, value);
    } else if constexpr (is_optional<T>) {
      if (json.isNull()) return;  // the way of --set to take back what the file gives
      read(json, path, range, unit, value.emplace());
    } else if constexpr (is_list<T>) {
      if (!expect(json.isArray(), json, path, "a list [...]")) return;
      value.clear();
      if (too_long<typename T::value_type>(json, path)) return;
      for (Json::ArrayIndex i = 0; i < json.size(); ++i) {
        read_entry(json[i], path + "[" + std::to_string(i) + "]", range, unit, value.emplace_back());
      }
    } else if constexpr (is_choice<T>) {
      read_choice(json, path, false, value);
    } else if constexpr (Declared<T>) {
      if (expect(json.isObject(), json, path, "a group {...}")) read_group(json, path, value);
    } else {
      static_assert(never<T>, "a kind of field that scenes cannot read");
    }
    if constexpr (!Declared<T> && !is_choice<T>) given_.insert(path);
  }

 private:
  std::ptrdiff_t key_offset(const Json::Value& json) const;
  void fault(const Json::Value& json, const std::string& path, std::string message);
  bool expect(bool right, const Json::Value& json, const std::string& path, std::string_view what);
  bool read_number(const Json::Value& json, const std::string& path, Range range, std::string_view unit, double& value);
  void read_text(const Json::Value& json, const std::string& path, std::string& value);
  void read_int(const Json::Value& json, const std::string& path, Range range, std::string_view unit, int& value);
  void read_vector(const Json::Value& json, const std::string& path, Range range, std::string_view unit, Vec3d& value);
  void unknown_keys(const Json::Value& json, const std::string& path, std::vector<std::string_view> valid, bool choice);
  bool is_outside(const std::filesystem::path& file) const;
  void missing(const Json::Value& json, const std::string& path, std::string_view help, std::string_view unit);
  void resolve_file(const Json::Value& json, const std::string& path, std::string& file);
  std::string_view read_type(const Json::Value& json, const std::string& path, bool must,
                             const std::vector<std::string_view>& names);

  /// Each entry of a list of groups is judged beside others; a list of numbers is bounded by the text's own bounds.
  template <class T>
  bool too_long(const Json::Value& json, const std::string& path) {
    const bool groups = is_choice<T> || Declared<T>;
    if (!groups || json.size() <= most_groups) return false;
    fault(json, path, "has more than " + std::to_string(most_groups) + " entries");
    return true;
  }

  template <class T>
  void read_entry(const Json::Value& json, const std::string& path, Range range, std::string_view unit, T& value) {
    if constexpr (is_choice<T>) {
      offsets_.emplace(path, key_offset(json));
      read_choice(json, path, true, value);
    } else {
      read(json, path, range, unit, value);
    }
  }

  template <Worded T>
  void read_word(const Json::Value& json, const std::string& path, T& value) {
    const auto& words = Words<T>::words;
    if (!expect(json.isString(), json, path, "a word")) return;
    const std::string word = json.asString();
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (word == words[i]) {
        value = static_cast<T>(i);
        return;
      }
    }
    fault(json, path, "unknown word " + in_quotes(word) + spelling_hint(word, words, "words"));
  }

  /// Reads one of several groups. Without a "type" the one stays that the value holds, unless the scene must choose.
  template <class Choice>
  void read_choice(const Json::Value& json, const std::string& path, bool must, Choice& value) {
    if (!expect(json.isObject(), json, path, "a group {\"type\": ...}")) return;
    const auto names = alternative_names<Choice>();
    std::string_view name = read_type(json, path, must, names);
    if (name.empty()) return;
    if (name == keep) name = name_of(value);
    for_each_alternative<Choice>([&]<Named T>(std::type_identity<T>) {
      if (T::name != name) return;
      T* const held = std::get_if<T>(&value);  // what the text does not give stays, as in other groups
      read_group(json, path, held != nullptr ? *held : value.template emplace<T>(), true);
    });
  }

  template <Declared T>
  void read_group(const Json::Value& json, const std::string& path, T& group, bool choice = false) {
    unknown_keys(json, path, field_keys<T>(), choice);
    for_each_field<T>([&](const auto& f) {
      using Value = typename std::remove_cvref_t<decltype(f)>::value_type;
      const std::string below = (path.empty() ? "" : path + ".") + std::string(f.key);
      if (const Json::Value* const found = json.find(f.key.data(), f.key.data() + f.key.size())) {
        if constexpr (is_choice<Value>) {
          offsets_.emplace(below, key_offset(*found));
          read_choice(*found, below, f.presence == Presence::required, group.*f.member);
        } else {
          read(*found, below, f.range, f.unit, group.*f.member);
        }
      } else if (f.presence == Presence::required) {
        missing(json, below, f.help, f.unit);
      }
    });
    if constexpr (std::is_same_v<T, Mesh>) {
      if (json["file"].isString()) resolve_file(json["file"], path + ".file", group.file);
    }
  }

  static constexpr Json::ArrayIndex most_groups = 10000;
  static constexpr std::string_view keep = "keep";

  const SceneText& text_;
  std::filesystem::path folder_;
  MeshPlaces places_;
  std::vector<Found> faults_;
  std::map<std::string, std::ptrdiff_t> offsets_;
  std::set<std::string> given_;
};

/// `above 0 m`, `at least 0`, `from 1.5 to 4`: the values of a range; empty for any number.
std::string range_text(Range range, std::string_view unit);

}  // namespace sessile
