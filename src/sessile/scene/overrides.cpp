#include "sessile/scene/overrides.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <utility>

#include "sessile/scene/scene_text.h"

namespace sessile {

namespace {

constexpr int deepest_path = 64;  // levels, as in a file: what walks over values calls itself once a level
constexpr std::string_view too_deep = "nested more than 64 levels deep";

/// Gives a value and all below it one offset.
void mark_all(Json::Value& value, std::ptrdiff_t mark) {
  value.setOffsetStart(mark);
  value.setOffsetLimit(mark);
  if (!value.isArray() && !value.isObject()) return;
  for (auto& each : value) mark_all(each, mark);
}

/// Takes `[12]` off the front of the path.
bool take_index(std::string_view& rest, Json::ArrayIndex& index) {
  const auto end = rest.find(']');
  if (end == std::string_view::npos) return false;
  const auto [last, error] = std::from_chars(rest.data() + 1, rest.data() + end, index);
  if (error != std::errc{} || last != rest.data() + end) return false;
  rest.remove_prefix(end + 1);
  return true;
}

/// The value at a path, made where it is missing. Returns a null pointer and says why when there is no way to it.
Json::Value* make_way(Json::Value& root, std::string_view path, std::ptrdiff_t mark, std::string& why) {
  Json::Value* node = &root;
  std::string_view rest = path;
  const auto done = [&] { return std::string(path.substr(0, path.size() - rest.size())); };
  for (int level = 0; !rest.empty(); ++level) {
    if (level == deepest_path) return why = too_deep, nullptr;
    const std::string here = done();
    if (rest.front() == '[') {
      Json::ArrayIndex index = 0;
      if (!take_index(rest, index)) return why = "expected an index such as [0] after " + here, nullptr;
      if (node->isNull()) {
        *node = Json::Value(Json::arrayValue);
        mark_all(*node, mark);
      }
      if (!node->isArray()) return why = here + " is no list", nullptr;
      if (index > node->size()) {
        return why = fmt::format("{} has {} entries, so the next index is {}", here, node->size(), node->size()),
               nullptr;
      }
      node = &(*node)[index];
    } else {
      if (rest.front() == '.' && !here.empty()) rest.remove_prefix(1);
      const std::string key(rest.substr(0, rest.find_first_of(".[")));
      if (key.empty()) return why = "expected a path such as forces[0].cohesion", nullptr;
      rest.remove_prefix(key.size());
      if (node->isNull()) {
        *node = Json::Value(Json::objectValue);
        mark_all(*node, mark);
      }
      if (!node->isObject()) return why = (here.empty() ? "the scene" : here) + " is no group", nullptr;
      node = &(*node)[key];
    }
  }
  return node;
}

}  // namespace

Override split_override(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos) return {std::string(text), std::nullopt};
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Fault apply_override(const Override& override_, std::ptrdiff_t mark, Json::Value& root) {
  if (override_.path.empty() || !override_.value) return {override_.path, "expected path=value", {}};
  SceneText text(*override_.value);
  auto value = text.parse();
  if (!text.all_finite()) return {override_.path, *override_.value + " is not finite", {}};
  if (!value) value = Json::Value(*override_.value);
  mark_all(*value, mark);

  Json::Value trial = root;  // a way that ends nowhere leaves nothing behind
  std::string why;
  Json::Value* const node = make_way(trial, override_.path, mark, why);
  if (node == nullptr) return {why == too_deep ? "" : override_.path, why, {}};  // hundreds of levels are not repeated
  *node = std::move(*value);
  root = std::move(trial);
  return {};
}

}  // namespace sessile
