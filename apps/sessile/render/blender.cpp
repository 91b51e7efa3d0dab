#include "blender.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <deque>
#include <string>
#include <string_view>

#include "child.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "start.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// The script, where it is installed or where it was built.
fs::path find_script() {
  const fs::path place = installed_in();
  for (const char* folder : {"share/sessile/blender", "../../tools/blender"}) {
    fs::path script = (place / folder / "render.py").lexically_normal();
    std::error_code error;
    if (fs::exists(script, error)) return script;
  }
  throw Error(
      fmt::format("cannot find render.py in {}; install Sessile anew", (place / "share/sessile/blender").string()));
}

/// Listens to what Blender and its script print.
class Listener {
 public:
  Listener(const fs::path& log, std::size_t frames, ProgressStyle style)
      : log_(log), progress_(style, "frames", static_cast<std::int64_t>(frames)) {}

  void hear(const std::string& line) {
    constexpr std::string_view mark = "sessile: ";
    if (!line.starts_with(mark)) {
      keep(line);
      return;
    }
    const std::string said = line.substr(mark.size());
    if (said.starts_with("fault ")) {
      fault_ = said.substr(6);
    } else if (said.starts_with("done ")) {
      progress_.update(++done_, picture_of({}, std::atoll(said.c_str() + 5)).string());
    }
    log_.append(line + "\n");
  }

  const std::string& fault() const { return fault_; }
  std::string last_lines() const {
    std::string text;
    for (const std::string& line : last_) text += "\n  " + line;
    return text;
  }

 private:
  void keep(const std::string& line) {
    constexpr std::size_t most = 6;
    log_.append(line + "\n");
    if (line.empty()) return;
    last_.push_back(line);
    if (last_.size() > most) last_.pop_front();
  }

  LineFile log_;
  CountProgress progress_;
  std::int64_t done_ = 0;
  std::string fault_;
  std::deque<std::string> last_;
};

fs::path find_blender() {
  fs::path blender = find_program("blender");
  if (blender.empty()) {
    throw Error(
        "rendering takes Blender, and there is no program `blender`; on Debian: apt install blender python3-numpy");
  }
  return blender;
}

std::vector<std::string> command_for(const fs::path& job_file, int threads) {
  const fs::path blender = find_blender();
  // Debian's Blender takes its Python's libraries from beside the first python3 in PATH, which an environment of the
  // user's may have put there.
  const std::string path = fmt::format("PATH={}:/usr/bin:/bin", blender.parent_path().string());
  std::vector<std::string> command{"env", path, blender.string(), "--background", "--factory-startup"};
  if (threads > 0) {
    command.emplace_back("--threads");
    command.push_back(std::to_string(threads));
  }
  for (const std::string& each : {std::string("--python-exit-code"), std::string("1"), std::string("--python"),
                                  find_script().string(), std::string("--"), job_file.string()}) {
    command.push_back(each);
  }
  return command;
}

}  // namespace

bool run_blender(const RenderJob& job, const BlenderOptions& options) {
  const fs::path job_file = fs::absolute(job.output) / "job.json", log = job.output / "blender.log";
  const std::vector<std::string> command = command_for(job_file, options.threads);
  write_whole(job_file, job_json(job));
  Listener listener(log, job.frames.size(), options.progress);
  const ChildEnd end = run_child(command, [&](const std::string& line) { listener.hear(line); });
  if (end.interrupted) return false;
  if (!listener.fault().empty()) throw Error(fmt::format("Blender: {} (log: {})", listener.fault(), log.string()));
  if (end.status != 0) {
    throw Error(fmt::format("Blender failed with exit code {}; {} ends with:{}", end.status, log.string(),
                            listener.last_lines()));
  }
  return true;
}

}  // namespace sessile::app
