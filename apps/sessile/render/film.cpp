#include "film.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "child.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

/// ffmpeg's list of pictures; a quote inside quotes is written '\''.
std::string list_text(const std::vector<fs::path>& pictures, double rate) {
  std::string text = "ffconcat version 1.0\n";
  for (const fs::path& picture : pictures) {
    std::string name = fs::absolute(picture).string();
    for (std::size_t at = name.find('\''); at != std::string::npos; at = name.find('\'', at + 4)) {
      name.replace(at, 1, "'\\''");
    }
    text += fmt::format("file '{}'\nduration {}\n", name, 1 / rate);
  }
  return text;
}

}  // namespace

FilmEnd make_film(const std::vector<fs::path>& pictures, double rate, const fs::path& film) {
  const fs::path folder = fs::absolute(film).parent_path();
  create_output_folder(folder);
  const fs::path list = folder / fmt::format(".{}.list", film.filename().string());
  // Under the temporary name ffmpeg could not tell the format by its ending.
  const fs::path part = folder / fmt::format(".part.{}", film.filename().string());
  write_whole(list, list_text(pictures, rate));
  std::error_code error;
  fs::remove(part, error);  // ffmpeg would write through a link that stands there
  std::string last;
  const ChildEnd end = run_child({"ffmpeg",
                                  "-hide_banner",
                                  "-loglevel",
                                  "error",
                                  "-y",
                                  "-f",
                                  "concat",
                                  "-safe",
                                  "0",
                                  "-i",
                                  list.string(),
                                  "-r",
                                  fmt::format("{}", rate),
                                  "-vf",
                                  "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                  "-c:v",
                                  "libx264",
                                  "-crf",
                                  "18",
                                  "-pix_fmt",
                                  "yuv420p",
                                  "-movflags",
                                  "+faststart",
                                  part.string()},
                                 [&](const std::string& line) { last = line; });
  fs::remove(list, error);
  if (!end.missing && !end.interrupted && end.status == 0) {
    fs::rename(part, film);
    return FilmEnd::done;
  }
  fs::remove(part, error);
  if (end.missing) return FilmEnd::missing;
  if (end.interrupted) return FilmEnd::interrupted;
  throw Error(fmt::format("ffmpeg could not make {}: {}", film.string(), last));
}

}  // namespace sessile::app
