#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace sessile {

/// Cuts a text into words at white space.
class MeshWords {
 public:
  explicit MeshWords(std::string_view text) : rest_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    const auto begin = rest_.find_first_not_of(" \t\r\n\v\f");
    if (begin == std::string_view::npos) return rest_ = {};
    rest_.remove_prefix(begin);
    const auto word = rest_.substr(0, rest_.find_first_of(" \t\r\n\v\f"));
    rest_.remove_prefix(word.size());
    return word;
  }

  /// The next word as a number; false when it is none.
  bool number(double& value) {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) value = 0;  // too small; what is too large fails the next test
    return end == word.data() + word.size() && !word.empty() &&
           (error == std::errc{} || word.find("e-") != std::string_view::npos ||
            word.find("E-") != std::string_view::npos);
  }

 private:
  std::string_view rest_;
};

}  // namespace sessile
