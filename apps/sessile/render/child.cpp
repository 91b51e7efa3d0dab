#include "child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "descriptor.h"
#include "sessile/core/error.h"
#include "signals.h"

namespace sessile::app {
namespace {

constexpr int patience = 5000;  // how long the child may take to end when it is asked to [ms]

/// Holds back Ctrl-C and its like while it lives; they can be read from a descriptor instead.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction now {};
      const bool ignored = sigaction(each, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;  // SIGHUP under nohup
      if (!ignored) sigaddset(&held, each);
    }
    sigprocmask(SIG_BLOCK, &held, &before_);
    descriptor_ = signalfd(-1, &held, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~HeldSignals() {
    take();
    if (descriptor_ >= 0) ::close(descriptor_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  void take() const {
    signalfd_siginfo signal{};
    while (::read(descriptor_, &signal, sizeof signal) > 0) note_stop(static_cast<int>(signal.ssi_signo));
  }
  int descriptor() const { return descriptor_; }
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_{};
  int descriptor_ = -1;
};

/// Cuts what comes in pieces into lines.
class Lines {
 public:
  explicit Lines(const std::function<void(const std::string&)>& on_line) : on_line_(on_line) {}
  void add(std::string_view piece) {
    rest_ += piece;
    std::size_t begin = 0;
    for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n', begin)) {
      on_line_(rest_.substr(begin, end - begin));
      begin = end + 1;
    }
    rest_.erase(0, begin);
  }
  void finish() {
    if (!rest_.empty()) on_line_(rest_);
    rest_.clear();
  }

 private:
  const std::function<void(const std::string&)>& on_line_;
  std::string rest_;
};

/// Starts the program in a process group of its own: Ctrl-C then reaches this program alone, which ends the other.
int start(const std::vector<std::string>& command, int output, const sigset_t& signals, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &signals);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int why = posix_spawnp(&child, words.front().c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return why;
}

/// Reads to the end of what the child prints; false when Ctrl-C came first.
bool read_lines(int output, int signals, Lines& lines) {
  std::array<char, 4096> piece{};
  for (;;) {
    std::array<pollfd, 2> wait{{{output, POLLIN, 0}, {signals, POLLIN, 0}}};
    if (poll(wait.data(), wait.size(), -1) < 0) continue;
    if (wait[1].revents != 0) return false;
    const ssize_t count = ::read(output, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    lines.add({piece.data(), static_cast<std::size_t>(count)});
  }
}

void end(pid_t child) {
  kill(-child, SIGTERM);
  for (int waited = 0; waited < patience; waited += 20) {
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == child)
      return;
    usleep(20'000);
  }
  kill(-child, SIGKILL);
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::function<void(const std::string&)>& on_line) {
  const HeldSignals signals;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(fmt::format("cannot open a pipe: {}", std::strerror(errno)));
  const Descriptor output(ends[0]);
  Descriptor input(ends[1]);
  ChildEnd result;
  pid_t child = 0;
  if (const int why = start(command, input.number(), signals.before(), child); why != 0) {
    if (why != ENOENT && why != EACCES) {
      throw Error(fmt::format("cannot start {}: {}", command.front(), std::strerror(why)));
    }
    result.missing = true;
    return result;
  }
  input.close();
  Lines lines(on_line);
  if (!read_lines(output.number(), signals.descriptor(), lines)) {
    result.interrupted = true;
    end(child);
  }
  lines.finish();
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::filesystem::path find_program(const std::string& name) {
  const char* const list = std::getenv("PATH");
  std::string_view rest = list == nullptr ? "" : list;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    std::filesystem::path file = std::filesystem::path(rest.substr(0, end)) / name;
    std::error_code error;
    if (access(file.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(file, error)) return file;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
}

}  // namespace sessile::app
