#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "commands.h"
#include "draw/image.h"
#include "draw/painter.h"
#include "picture/footage.h"
#include "picture/options.h"
#include "picture/studio.h"
#include "progress.h"
#include "say.h"
#include "sessile/core/error.h"
#include "signals.h"
#include "threads.h"

namespace sessile::app {
namespace {

constexpr std::size_t most_panels = 8;

/// What was asked for cannot be: the program ends as for wrong usage.
struct BadInput : Error {
  using Error::Error;
};

/// Calls what finds out whether the input is good. Throws BadInput of anything wrong with it; SceneError as it is.
template <class F>
auto judged(F&& f) {
  try {
    return f();
  } catch (const SceneError&) {
    throw;
  } catch (const Error& e) {
    throw BadInput(e.what());
  }
}

int take_picture(Studio& studio, auto& footage, const PictureOptions& options) {
  if (footage.count() > most_panels) {
    throw BadInput(fmt::format("{} frames do not stand side by side; {} do, and --video shows them one after the other",
                               footage.count(), most_panels));
  }
  std::vector<draw::Moment> moments;
  footage.play([&](draw::Moment&& moment) { moments.push_back(std::move(moment)); });
  if (stop_asked() || moments.empty()) return interrupted_code();
  studio.set_up(footage.stage(), moments, moments.size());
  draw::write_png(options.picture, studio.draw(moments, options.range.value_or(common_range(moments))));
  return done;
}

/// What a video shows is known beforehand only of a folder; a scene's colours widen as it runs.
std::vector<draw::Moment> preview(const FolderFootage& footage) { return footage.sample(); }
std::vector<draw::Moment> preview(const SceneFootage& /*footage*/) { return {}; }

int take_video(Studio& studio, auto& footage, const PictureOptions& options) {
  std::vector<draw::Moment> seen_before = preview(footage);
  std::optional<std::pair<float, float>> range = options.range;
  if (!range && !seen_before.empty()) range = common_range(seen_before);
  studio.set_up(footage.stage(), seen_before, 1);
  seen_before.clear();
  draw::Video video(options.video, options.size.first, options.size.second, options.frames_per_second);
  CountProgress progress(
      std::is_same_v<decltype(footage), FolderFootage&> ? progress_style(options.progress) : ProgressStyle::none,
      "frames", static_cast<std::int64_t>(footage.count()));
  std::int64_t count = 0;
  footage.play([&](draw::Moment&& moment) {
    const std::pair<float, float> own = draw::own_range(moment);
    if (!range) range = own;
    if (!options.range) range = std::pair{std::min(range->first, own.first), std::max(range->second, own.second)};
    video.add(studio.draw({&moment, 1}, *range));
    progress.update(++count, fmt::format("t = {:.4g} s", moment.time));
  });
  if (count == 0) return interrupted_code();
  video.finish();
  if (stop_asked()) say(stderr, fmt::format("interrupted; the video holds {} of {} frames\n", count, footage.count()));
  return stop_asked() ? interrupted_code() : done;
}

template <class Footage>
int take(const PictureOptions& options) {
  Footage footage = judged([&] { return Footage(options); });
  Studio studio(options);  // before a long run: this machine may not be able to draw
  heed_signals();
  return options.video.empty() ? take_picture(studio, footage, options) : take_video(studio, footage, options);
}

int picture(const PictureOptions& options) {
  if (const std::string reason = clash(options); !reason.empty()) {
    say(stderr, fmt::format("sessile: {}\n", reason));
    return bad_input;
  }
  use_threads(options.threads);
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(options.source, ignored);
  try {
    return is_folder ? take<FolderFootage>(options) : take<SceneFootage>(options);
  } catch (const BadInput& e) {
    say(stderr, fmt::format("sessile: {}\n", e.what()));
    return bad_input;
  }
}

}  // namespace

void add_picture(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<PictureOptions>();
  CLI::App* command = program.add_subcommand("picture", "Draw a picture or a video of a run's results, or of a scene.");
  add_picture_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = picture(*options); });
}

}  // namespace sessile::app
