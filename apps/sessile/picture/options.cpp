#include "picture/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "run_options.h"
#include "sessile/scene/spelling.h"

namespace sessile::app {
namespace {

constexpr int greatest_size = 8192;
constexpr int greatest_rays = 16384;  // what every graphics card can do

/// The numbers of a text with separators between them; nothing when something else stands there.
template <class T>
std::optional<std::vector<T>> numbers(std::string_view text, char separator) {
  std::vector<T> values;
  while (true) {
    const std::string_view word = text.substr(0, text.find(separator));
    T value{};
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || rest != word.data() + word.size()) return {};
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) return {};
    }
    values.push_back(value);
    if (word.size() == text.size()) return values;
    text.remove_prefix(word.size() + 1);
  }
}

/// Throws what CLI11 prints for a bad value.
[[noreturn]] void refuse(const std::string& option, const std::string& reason) {
  throw CLI::ValidationError(option, reason);
}

template <class T>
std::pair<T, T> pair_of(const std::string& option, const std::string& word, char separator, const char* example) {
  const auto values = numbers<T>(word, separator);
  if (!values || values->size() != 2) refuse(option, fmt::format("expected {}, found {}", example, in_quotes(word)));
  return {values->front(), values->back()};
}

std::pair<int, int> size_of(const std::string& word) {
  const auto size = pair_of<int>("--size", word, 'x', "two whole numbers such as 1280x720");
  for (const int side : {size.first, size.second}) {
    if (side < 16 || side > greatest_size) {
      refuse("--size", fmt::format("sides must be from 16 to {} pixels, found {}", greatest_size, word));
    }
  }
  return size;
}

draw::Look look_of(const std::string& word) {
  if (word == "particles") return draw::Look::particles;
  if (word == "liquid") return draw::Look::liquid;
  if (word == "surface") return draw::Look::surface;
  constexpr std::array<std::string_view, 3> looks{"particles", "liquid", "surface"};
  refuse("--look", fmt::format("unknown look {}{}", in_quotes(word), spelling_hint(word, looks, "looks")));
}

std::vector<double> times_of(const std::string& word) {
  const auto times = numbers<double>(word, ',');
  if (!times) refuse("--time", fmt::format("expected seconds such as 1.5 or 0,0.5,2, found {}", in_quotes(word)));
  for (std::size_t k = 0; k < times->size(); ++k) {
    if ((*times)[k] < 0) refuse("--time", fmt::format("no time lies before 0 s, found {}", in_quotes(word)));
    if (k > 0 && (*times)[k] <= (*times)[k - 1]) {
      refuse("--time", fmt::format("times must ascend, found {}", in_quotes(word)));
    }
  }
  return *times;
}

/// What is drawn of the source, and in which way.
void add_what(CLI::App& command, PictureOptions& options) {
  command
      .add_option("--frame,--frames", options.frames,
                  "frames by their place, from 0, -1 the last; several stand side by side: 0,5,-1; in a video a "
                  "range: 10:50 (default: the last; in a video all)")
      ->type_name("LIST");
  command
      .add_option_function<std::string>(
          "--time", [&options](const std::string& word) { options.times = times_of(word); },
          "the state at or next to a time; several with commas between them")
      ->type_name("SECONDS");
  command
      .add_option_function<std::string>(
          "--look", [&options](const std::string& word) { options.look = look_of(word); },
          "particles (default), liquid, surface")
      ->type_name("NAME");
  command.add_option("--field", options.field, "what colours: a field of the frames, speed or height (default: speed)")
      ->type_name("NAME");
  command
      .add_option_function<std::string>(
          "--range",
          [&options](const std::string& word) {
            options.range = pair_of<float>("--range", word, ',', "two numbers such as 0,2.5");
            if (!(options.range->first < options.range->second)) {
              refuse("--range", fmt::format("must ascend, found {}", in_quotes(word)));
            }
          },
          "ends of the colours (default: those of what is shown)")
      ->type_name("LOW,HIGH");
}

void add_view(CLI::App& command, PictureOptions& options) {
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& word) { options.size = size_of(word); },
          "of the picture in pixels (default: 1280x720)")
      ->type_name("WxH");
  command
      .add_option_function<std::string>(
          "--view",
          [&options](const std::string& word) {
            options.view = pair_of<double>("--view", word, ',', "two angles in degrees such as 20,30");
            if (std::abs(options.view.second) >= 90) {
              refuse("--view", "the elevation must be above -90 and below 90 degrees, found " + in_quotes(word));
            }
          },
          "from where, in degrees (default: 20,30)")
      ->type_name("AZIMUTH,ELEVATION");
  command.add_option("--zoom", options.zoom, "2 comes twice as near")
      ->type_name("FACTOR")
      ->check(CLI::Range(1e-3, 1e3));
  command.add_flag("--orthographic", options.orthographic, "lines that are parallel stay so");
  command.add_flag("--no-legend", options.no_legend, "neither colour bar nor time");
  command.add_flag("--no-solids", options.no_solids, "leaves out solids, which may hide what they hold");
  command.add_option("--fineness", options.fineness, "rays a pixel along each axis: 1 is fast, 2 and more are smooth")
      ->type_name("N")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
}

}  // namespace

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command.add_option("source", options.source, "folder of `sessile run`, or a scene, which is run without writing")
      ->required()
      ->type_name("DIR|SCENE");
  command.add_option("-o,--output", options.picture, "the picture to write")->type_name("FILE.png");
  command.add_option("--video", options.video, "a video to write in its place, by ffmpeg")->type_name("FILE.mp4");
  command.add_option("--fps", options.frames_per_second, "pictures a second of the video")
      ->type_name("N")
      ->check(CLI::Range(1.0, 240.0))
      ->capture_default_str();
  add_what(command, options);
  add_view(command, options);
  command.add_option("--set", options.overrides, "put a value over the scene's, e.g. fluid.viscosity=5")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_allow_outside(command, options.places);
  command.add_option("--threads", options.threads, "threads to use (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command.add_option("--progress", options.progress, "how progress is shown")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
}

std::string clash(const PictureOptions& options) {
  if (options.picture.empty() && options.video.empty())
    return "name the file to write: -o FILE.png, or --video FILE.mp4";
  if (!options.picture.empty() && !options.video.empty()) return "give -o or --video, not both";
  const auto ends_in = [](const std::string& file, std::string_view ending) {
    return file.empty() || std::filesystem::path(file).extension() == ending;
  };
  if (!ends_in(options.picture, ".png")) return "pictures are PNG: name a file .png, found " + options.picture;
  if (!ends_in(options.video, ".mp4")) return "videos are MP4: name a file .mp4, found " + options.video;
  const int rays = std::max(options.size.first, options.size.second) * options.fineness;
  if (rays > greatest_rays) {
    return fmt::format("a side of the picture times --fineness must not exceed {}, found {}", greatest_rays, rays);
  }
  const std::string ending = std::filesystem::path(options.source).extension().string();
  if (ending == ".vtp" || ending == ".ply") {
    return fmt::format("{} is one frame; give its folder, and --frame N for the frame", in_quotes(options.source));
  }
  if (!options.frames.empty() && !options.times.empty()) return "give --frames or --time, not both";
  if (options.look != draw::Look::particles && (!options.field.empty() || options.range)) {
    return "--field and --range colour particles; the other looks have the liquid's own colour";
  }
  if (!options.video.empty() && options.times.size() > 1) return "a video has one --time: where it ends";
  return {};
}

}  // namespace sessile::app
