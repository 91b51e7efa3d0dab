#include "view/history.h"

namespace sessile::viewer {

void History::add(double time, std::span<const double> values) {
  if (!times_.empty() && time < times_.back()) clear();
  if (passed_++ % every_ != 0) return;
  if (times_.size() >= most_rows_) {
    thin_out();
    if (passed_ % every_ != 1) return;
  }
  times_.push_back(time);
  for (std::size_t k = 0; k < values_.size(); ++k) values_[k].push_back(values[k]);
}

void History::clear() {
  times_.clear();
  for (auto& each : values_) each.clear();
  every_ = 1;
  passed_ = 0;
}

void History::thin_out() {
  const auto halve = [](std::vector<double>& row) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < row.size(); k += 2) row[kept++] = row[k];
    row.resize(kept);
  };
  halve(times_);
  for (auto& each : values_) halve(each);
  every_ *= 2;
}

}  // namespace sessile::viewer
