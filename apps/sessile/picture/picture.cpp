#include <fmt/format.h>

#include <memory>

#include <chrono>
#include "commands.h"
#include "draw/gl.h"
#include "draw/headless.h"
#include "draw/image.h"
#include "draw/ink.h"
#include "draw/legend.h"
#include "draw/painter.h"
#include "sessile/results/results.h"
#include "sessile/surface/reconstruct.h"
#include "shown.h"

namespace sessile::app {
namespace {
struct PictureOptions {
  std::string source, output, look = "particles";
  int width = 1280, height = 720, fineness = 2;
  int repeat = 1;
  double zoom = 1, azimuth = 30, elevation = 25;
  std::optional<double> time;
};

int picture(const PictureOptions& o) {
  const Results results = open_results(o.source);
  const draw::Stage stage = stage_of(results.scene);
  const Snapshot frame = read_frame(o.time ? frame_at(results, *o.time).file : results.frames.back().file);
  draw::Moment moment = moment_of(frame, "", stage);
  draw::HeadlessContext context;
  draw::Painter painter(stage);
  painter.show(moment);
  draw::Camera camera;
  camera.up = stage.up;
  camera.azimuth = o.azimuth;
  camera.elevation = o.elevation;
  camera.fit(stage.low, stage.high, double(o.width) / o.height, draw::legend_share());
  camera.zoom(o.zoom);
  draw::Appearance appearance;
  appearance.look = o.look == "liquid"    ? draw::Look::liquid
                    : o.look == "surface" ? draw::Look::surface
                                          : draw::Look::particles;
  if (appearance.look == draw::Look::surface) {
    moment.surface = reconstruct(frame, stage.spacing, {});
    painter.show(moment);
  }
  appearance.fineness = o.fineness;
  draw::gl::Target target(o.width, o.height, {GL_RGBA8});
  for (int k = 0; k < o.repeat; ++k) {
    auto t0 = std::chrono::steady_clock::now();
    painter.paint(camera, appearance, o.width, o.height, target.framebuffer());
    glFinish();
    fmt::print("{:.1f} ms\n", 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
  }
  draw::Ink ink(o.width, o.height);
  ink.draw(target.framebuffer(),
           [&] { draw::draw_legend(moment, appearance, own_range(moment), float(o.width), float(o.height)); });
  draw::write_png(o.output, draw::read_pixels(o.width, o.height, target.framebuffer()));
  return done;
}
}  // namespace

void add_picture(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<PictureOptions>();
  CLI::App* command = program.add_subcommand("picture", "Draw a scene or the results of a run.");
  command->add_option("source", options->source)->required();
  command->add_option("-o,--output", options->output)->required();
  command->add_option("--look", options->look);
  command->add_option("--time", options->time);
  command->add_option("--fineness", options->fineness);
  command->add_option("--repeat", options->repeat);
  command->add_option("--zoom", options->zoom);
  command->add_option("--azimuth", options->azimuth);
  command->add_option("--elevation", options->elevation);
  command->add_option("--width", options->width);
  command->add_option("--height", options->height);
  command->callback([options, &exit_code] { exit_code = picture(*options); });
}
}  // namespace sessile::app
