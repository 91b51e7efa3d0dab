#pragma once

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sessile {

/// Base of everything Sessile throws; what() is a sentence meant for the user.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A scene that cannot be run. Holds every fault found, one line each: `file:line: key: what (hint)`.
struct SceneError : Error {
  explicit SceneError(std::vector<std::string> faults) : Error(join(faults)), messages(std::move(faults)) {}
  explicit SceneError(const std::string& fault) : SceneError(std::vector<std::string>{fault}) {}

  std::vector<std::string> messages;

 private:
  static std::string join(const std::vector<std::string>& lines) {
    std::string text;
    for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
  }
};

/// A file or folder that cannot be read or written; names the path and the system's reason.
struct FileError : Error {
  using Error::Error;
  FileError(const std::string& sentence, std::error_code why) : Error(sentence), reason(why) {}

  std::error_code reason{};  ///< of the system, where it gave one while something was written
};

/// A simulation that went wrong while running (a position that is not finite, memory exhausted).
struct RunError : Error {
  using Error::Error;
};

}  // namespace sessile
