#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "draw/image.h"
#include "sessile/core/error.h"

extern char** environ;  // NOLINT: POSIX's name

namespace sessile::draw {
namespace {

/// Ends of a connection. A socket in place of a pipe: writing to one whose reader has gone can be told not to raise a
/// signal.
struct Connection {
  int ours = -1, theirs = -1;

  Connection() {
    int ends[2] = {-1, -1};  // NOLINT: what socketpair fills
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw Error(fmt::format("cannot start ffmpeg: {}", std::strerror(errno)));
    }
    ours = ends[0];
    theirs = ends[1];
  }
};

/// Starts ffmpeg on the other end of a connection, with its words going into a file. Returns its process, or throws.
int start(const std::vector<std::string>& arguments, int input, const std::string& words) {
  posix_spawn_file_actions_t files{};
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, words.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW,
                                   0600);
  posix_spawnattr_t attributes{};
  posix_spawnattr_init(&attributes);
  // A group of its own: Ctrl-C is for this program, which then ends the video in order.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<char*> words_of;
  for (const std::string& argument : arguments) words_of.push_back(const_cast<char*>(argument.c_str()));  // NOLINT
  words_of.push_back(nullptr);
  pid_t process = -1;
  const int error = posix_spawnp(&process, words_of.front(), &files, &attributes, words_of.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (error == ENOENT) {
    throw Error("cannot make a video: the program ffmpeg is not there; on Debian, apt-get install ffmpeg brings it");
  }
  if (error != 0) throw Error(fmt::format("cannot start ffmpeg: {}", std::strerror(error)));
  return process;
}

/// The last line that is not empty.
std::string last_line(const std::string& file) {
  std::ifstream in(file);
  std::string line, last = "it gave no reason";
  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// Waits for a process and says whether it ended well.
bool ended_well(int process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A hidden file beside `file`.
std::filesystem::path beside(const std::filesystem::path& file, const char* ending) {
  return file.parent_path() / fmt::format(".{}.{}.{}", file.filename().string(), getpid(), ending);
}

}  // namespace

Video::Video(const std::filesystem::path& file, int width, int height, double frames_per_second)
    : file_(file), part_(beside(file, "part")), width_(width), height_(height), words_(beside(file, "log").string()) {
  std::error_code none;
  for (const auto& old : {part_, std::filesystem::path(words_)}) std::filesystem::remove(old, none);  // a link, maybe
  {
    const std::ofstream made(part_);
    if (!made) throw FileError(fmt::format("{}: cannot write: {}", file.string(), std::strerror(errno)));
  }
  const std::string size = fmt::format("{}x{}", width, height);
  const std::string rate = fmt::format("{}", frames_per_second);
  try {
    const Connection connection;
    pipe_ = connection.ours;
    const std::vector<std::string> arguments{"ffmpeg",
                                             "-loglevel",
                                             "error",
                                             "-y",
                                             "-f",
                                             "rawvideo",
                                             "-pixel_format",
                                             "rgb24",
                                             "-video_size",
                                             size,
                                             "-framerate",
                                             rate,
                                             "-i",
                                             "pipe:0",
                                             "-an",
                                             "-vf",
                                             "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                             "-c:v",
                                             "libx264",
                                             "-pix_fmt",
                                             "yuv420p",
                                             "-crf",
                                             "18",
                                             "-movflags",
                                             "+faststart",
                                             "-f",
                                             "mp4",
                                             part_.string()};
    try {
      process_ = start(arguments, connection.theirs, words_);
    } catch (...) {
      close(connection.theirs);
      throw;
    }
    close(connection.theirs);
  } catch (...) {
    if (pipe_ >= 0) close(pipe_);
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    std::filesystem::remove(words_, ignored);
    throw;
  }
}

Video::~Video() {
  if (pipe_ >= 0) close(pipe_);
  if (process_ > 0) {
    kill(process_, SIGTERM);
    ended_well(process_);
  }
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  std::filesystem::remove(words_, ignored);
}

void Video::add(const Image& image) {
  if (image.width != width_ || image.height != height_) throw Error("a video's pictures must be of one size");
  std::size_t sent = 0;
  while (sent < image.rgb.size()) {
    const ssize_t n = send(pipe_, image.rgb.data() + sent, image.rgb.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      ended_well(process_);
      process_ = -1;
      throw Error(fmt::format("ffmpeg has failed: {}", last_line(words_)));
    }
    sent += static_cast<std::size_t>(n);
  }
}

void Video::finish() {
  close(pipe_);
  pipe_ = -1;
  const bool well = ended_well(process_);
  process_ = -1;
  if (!well) throw Error(fmt::format("ffmpeg has failed: {}", last_line(words_)));
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw FileError(fmt::format("{}: cannot write: {}", file_.string(), error.message()));
}

}  // namespace sessile::draw
