#include "session_state.h"

#include <fmt/format.h>
#include <json/json.h>

#include <string_view>

#include "sessile/core/error.h"
#include "sessile/output/json_object.h"
#include "sessile/scene/json_text.h"

namespace sessile::app {
namespace {

std::string list_of(const std::vector<double>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

/// Calls f(key, number) for each number that is always there.
template <class State, class F>
void each_number(State& state, F&& f) {
  f("wall_time", state.wall_time);
  f("output_time", state.output_time);
  f("measures_time", state.measures_time);
  f("writer_time", state.writer_time);
  f("compressed_first", state.stability.health.first_half);
  f("compressed_second", state.stability.health.second_half);
  f("dt_limit", state.stability.dt_limit);
  f("dt_limit_until", state.stability.until);
}

template <class State, class F>
void each_count(State& state, F&& f) {
  f("compressed_steps", state.stability.health.compressed_steps);
  f("retries", state.stability.retries);
  f("went_back", state.stability.went_back);
  f("undone_steps", state.stability.undone_steps);
}

template <class State, class F>
void each_list(State& state, F&& f) {
  f("frame_times", state.frame_times);
  f("surface_times", state.surface_times);
}

template <class State, class F>
void each_option(State& state, F&& f) {
  f("stats_time", state.stats_time);
  f("frame_due", state.frame_due);
}

}  // namespace

std::string session_json(const SessionState& state) {
  JsonObject object(0);
  object.add("stats_bytes", static_cast<std::size_t>(state.stats_bytes));
  each_number(state, [&](std::string_view key, double value) { object.add(key, value); });
  each_count(state, [&](std::string_view key, std::int64_t value) { object.add(key, value); });
  object.add("last_fault", state.stability.last_fault);
  each_list(state, [&](std::string_view key, const auto& values) { object.raw(key, list_of(values)); });
  each_option(state, [&](std::string_view key, const auto& value) {
    if (value) object.add(key, *value);
  });
  return object.text() + "\n";
}

SessionState session_of(const std::string& json, std::int64_t steps) {
  constexpr std::size_t most_values = 4'000'000;  // a million times of frames and of surfaces, and room
  const auto parsed = parsed_json(json, most_values);
  if (!parsed || !parsed->isObject()) throw Error("does not say what had been written");
  const Json::Value& root = *parsed;
  SessionState state;
  try {
    state.stats_bytes = root["stats_bytes"].asUInt64();
    each_number(state, [&](const char* key, double& value) { value = root[key].asDouble(); });
    each_count(state, [&](const char* key, std::int64_t& value) { value = root[key].asInt64(); });
    state.stability.last_fault = root["last_fault"].asString();
    each_list(state, [&](const char* key, std::vector<double>& values) {
      for (const Json::Value& each : root[key]) values.push_back(each.asDouble());
    });
    each_option(state, [&](const char* key, std::optional<double>& value) {
      if (root.isMember(key)) value = root[key].asDouble();
    });
  } catch (const Json::Exception&) {
    throw Error("does not say what had been written");
  }
  if (static_cast<std::int64_t>(state.frame_times.size()) - 1 > steps) throw Error("tells of more frames than steps");
  return state;
}

}  // namespace sessile::app
