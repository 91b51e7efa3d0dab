#include "advice.h"

#include <fmt/format.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "say.h"
#include "sessile/core/error.h"
#include "sessile/output/summary.h"

namespace sessile::app {
namespace {

bool is_memory(const std::exception& fault) {
  if (const auto* const system = dynamic_cast<const std::system_error*>(&fault)) {
    return system->code() == std::errc::not_enough_memory;
  }
  if (const auto* const file = dynamic_cast<const FileError*>(&fault)) {
    return file->reason == std::errc::not_enough_memory;
  }
  return dynamic_cast<const std::bad_alloc*>(&fault) != nullptr ||
         dynamic_cast<const std::length_error*>(&fault) != nullptr;
}

/// What helps when files cannot be written.
std::string_view advice_on_files(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return "make room on that disk; what had been written is whole";
    case EFBIG:
      return "a limit on the size of files stands in the way (`ulimit -f` shows it); what had been written is whole";
    case EACCES:
    case EPERM:
    case EROFS:
      return "give yourself the right to write there, or choose another folder with -o";
    case ENOENT:
    case ENOTDIR:
    case ESTALE:
      return "the folder has to stay where it is, with all that is in it, while a run writes into it";
    case EMFILE:
    case ENFILE:
      return "too few files may be open at once: `ulimit -n 256` is enough for any run";
    case EIO:
      return "the disk or its connection is at fault: look after it before you go on";
    default:
      return "";
  }
}

}  // namespace

std::string sentence(const std::exception& fault) {
  if (is_memory(fault)) {
    return fmt::format("out of memory: the program has held {:.1f} MiB, and the system gives it no more",
                       static_cast<double>(peak_memory()) / (1 << 20));
  }
  // A thread that could not be started; errors of files that the standard library throws name the file themselves.
  const auto* const system = dynamic_cast<const std::system_error*>(&fault);
  const bool is_file = dynamic_cast<const std::filesystem::filesystem_error*>(&fault) != nullptr;
  if (system != nullptr && !is_file) return fmt::format("cannot start a thread: {}", system->code().message());
  return fault.what();
}

std::string advice(const std::exception& fault) {
  if (is_memory(fault)) {
    return "`sessile check SCENE` says what a scene takes; a larger spacing takes less, and `ulimit -v` shows a limit";
  }
  if (const auto* const file = dynamic_cast<const FileError*>(&fault)) {
    return std::string(advice_on_files(file->reason.value()));
  }
  if (const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&fault)) {
    return std::string(advice_on_files(file->code().value()));
  }
  if (dynamic_cast<const std::system_error*>(&fault) != nullptr) {
    return "`--threads 1` takes fewer, `ulimit -u` and `ulimit -v` show the limits";
  }
  return "";
}

void tell(const std::exception& fault) {
  const std::string help = advice(fault);
  say(stderr, fmt::format("sessile: {}{}{}\n", sentence(fault), help.empty() ? "" : "; ", help));
}

}  // namespace sessile::app
