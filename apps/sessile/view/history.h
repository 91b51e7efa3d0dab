#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sessile::viewer {

/// A quantity that is followed over time.
struct Series {
  std::string name;
  std::string unit;  ///< SI; "" for a pure number
};

/// Values of several quantities over time, in bounded memory: when it is full, every second row is given up, and from
/// then on only every second one is taken.
class History {
 public:
  explicit History(std::vector<Series> series, std::size_t most_rows = 4096)
      : series_(std::move(series)), values_(series_.size()), most_rows_(most_rows) {}

  /// One value of each quantity. A time before the last one starts anew.
  void add(double time, std::span<const double> values);
  void clear();

  const std::vector<Series>& series() const { return series_; }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& values(std::size_t series) const { return values_[series]; }

 private:
  void thin_out();

  std::vector<Series> series_;
  std::vector<std::vector<double>> values_;  // by series
  std::vector<double> times_;
  std::size_t most_rows_;
  std::size_t every_ = 1, passed_ = 0;  // which of the rows are taken
};

}  // namespace sessile::viewer
