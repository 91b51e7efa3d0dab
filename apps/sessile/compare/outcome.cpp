#include "outcome.h"

#include <algorithm>
#include <charconv>

#include "sessile/scene/input_file.h"

namespace sessile::app {
namespace {

/// The fields of a CSV line; those in quotes without them.
std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

StatsTable::StatsTable(const std::filesystem::path& file) {
  std::ifstream in = stream_of(file);
  std::string line;
  if (!std::getline(in, line)) return;
  std::vector<std::vector<double>*> by_place;
  for (const std::string& title : csv_fields(line)) by_place.push_back(&columns_[title]);
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = csv_fields(line);
    if (fields.size() != by_place.size()) break;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double value = 0;
      const std::string& text = fields[i];
      if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc{})
        by_place[i]->push_back(value);
    }
  }
}

const std::vector<double>& StatsTable::column(const std::string& title) const {
  static const std::vector<double> none;
  const auto found = columns_.find(title);
  return found == columns_.end() ? none : found->second;
}

std::optional<double> time_to_rest(const std::vector<double>& time, const std::vector<double>& energy, double share) {
  if (energy.empty() || time.size() != energy.size()) return {};
  const double limit = share * *std::max_element(energy.begin(), energy.end());
  std::size_t first = energy.size();
  while (first > 0 && energy[first - 1] <= limit) --first;
  if (first == energy.size()) return {};
  return time[first];
}

Outcome outcome_of(const StatsTable& stats) {
  Outcome outcome;
  const std::vector<double>& time = stats.column("time [s]");
  if (time.empty()) return outcome;
  outcome.known = true;
  outcome.time_to_rest = time_to_rest(time, stats.column("kinetic_energy [J]"));
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const std::vector<double>& values = stats.column(std::string(quantities[i].column));
    if (values.empty()) continue;
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    outcome.courses[i] = Course{values.back(), *least, *greatest};
  }
  return outcome;
}

}  // namespace sessile::app
