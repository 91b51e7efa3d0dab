#include <fmt/format.h>

#include "commands.h"
#include "say.h"
#include "sessile/output/frames.h"
#include "sessile/output/snapshot.h"
#include "sessile/output/surfaces.h"
#include "sessile/scene/reference.h"

namespace sessile::app {

void add_models(CLI::App& program, int&) {
  CLI::App* command = program.add_subcommand(
      "models", "List solvers, forces, shapes and exporters with their parameters, units, ranges and defaults.");
  command->callback([] {
    std::string text = models_text();
    text += "\nframe formats (output.formats)\n";
    for (const FrameFormat& format : frame_formats()) text += fmt::format("  {:<6} {}\n", format.name, format.summary);
    text += "\nsurface formats (output.surface.formats)\n";
    for (const SurfaceFormat& format : surface_formats())
      text += fmt::format("  {:<6} {}\n", format.name, format.summary);
    text += "\nframe fields (output.fields)\n";
    for (const KnownColumn& column : known_columns()) {
      text += fmt::format("  {:<22} {:<10} {}\n", column.name, column.unit.empty() ? "-" : column.unit, column.help);
    }
    say(stdout, text);
  });
}

}  // namespace sessile::app
