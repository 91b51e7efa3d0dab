#pragma once

#include <json/value.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sessile {

/// A key that stands twice in one group.
struct RepeatedKey {
  std::ptrdiff_t offset = 0;
  std::ptrdiff_t first = 0;  ///< offset of the first one
  std::string path;
};

/// A syntax error of a JSON text.
struct SyntaxError {
  int line = 0;
  std::string message;
};

/// A JSON text (comments allowed) with what its values do not tell: lines, the places of keys, keys given twice, and
/// numbers that are not finite. Offsets count bytes from the start of the text.
class SceneText {
 public:
  explicit SceneText(std::string text);

  /// The whole of a file. Throws SceneError when it cannot be read, is no text, or is larger than any scene.
  static SceneText from_file(const std::filesystem::path& file);

  /// The value the text stands for, or nothing; then errors() says why.
  std::optional<Json::Value> parse();

  const std::vector<SyntaxError>& errors() const { return errors_; }
  const std::vector<RepeatedKey>& repeated_keys() const { return repeated_keys_; }

  /// The number at this offset as written, when it is too large for a double or a word such as NaN.
  std::optional<std::string> not_finite(std::ptrdiff_t offset) const;
  bool all_finite() const { return not_finite_.empty(); }

  /// Line of an offset, from 1.
  int line(std::ptrdiff_t offset) const;

  /// Where the key of a value stands, or the value itself when it has none.
  std::ptrdiff_t key_offset(std::ptrdiff_t value_offset) const;

 private:
  struct Level;

  void scan();
  std::size_t skip_comment(std::size_t at) const;
  void scan_word(std::size_t begin, std::size_t end);
  static std::string path_of(const std::vector<Level>& levels);

  std::string text_;
  std::vector<std::size_t> line_starts_;
  std::map<std::ptrdiff_t, std::ptrdiff_t> key_of_value_;
  std::map<std::ptrdiff_t, std::string> not_finite_;
  std::vector<RepeatedKey> repeated_keys_;
  std::vector<SyntaxError> errors_;
};

}  // namespace sessile
