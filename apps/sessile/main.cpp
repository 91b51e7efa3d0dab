#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "advice.h"
#include "commands.h"
#include "folder_lock.h"
#include "say.h"
#include "sessile/core/error.h"
#include "sessile/scene/spelling.h"
#include "sessile/version.h"
#include "signals.h"
#include "start.h"

namespace {

/// What to say of a first word that is no command: CLI11 only says that a command is missing.
std::string unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || !program.get_subcommands().empty()) return {};
  const std::string_view word = argv[1];
  if (word.starts_with('-')) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  const std::vector<std::string_view> commands(names.begin(), names.end());
  return "unknown command " + sessile::in_quotes(word) + sessile::spelling_hint(word, commands, "commands");
}

int sessile_program(int argc, char** argv) {
  using namespace sessile;
  app::prepare_process();
  if (!app::start(argv)) return app::bad_input;
  CLI::App program("Liquids at the scale where surface tension and adhesion rule.", "sessile");
  program.set_version_flag("--version", "sessile " + std::string(version()));
  program.require_subcommand(1);
  program.footer(
      "`sessile COMMAND --help` says more. Exit codes: 0 done, 1 the run failed, 2 wrong usage or scene, 3 another "
      "process writes into the folder, 128 + the signal's number when interrupted: 130 by Ctrl-C, 143 by SIGTERM.");
  int exit_code = app::done;
  app::add_run(program, exit_code);
  app::add_mesh(program, exit_code);
  app::add_picture(program, exit_code);
  app::add_view(program, exit_code);
  app::add_render(program, exit_code);
  app::add_compare(program, exit_code);
  app::add_bench(program, exit_code);
  app::add_check(program, exit_code);
  app::add_info(program, exit_code);
  app::add_models(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RequiredError& e) {
    const std::string unknown = unknown_command(program, argc, argv);
    if (unknown.empty()) {
      program.exit(e);
    } else {
      app::say(stderr, fmt::format("{}\nRun with --help for more information.\n", unknown));
    }
    return app::bad_input;
  } catch (const CLI::ParseError& e) {
    return program.exit(e) == 0 ? app::done : app::bad_input;
  } catch (const SceneError& e) {
    for (const std::string& line : e.messages) app::say(stderr, fmt::format("{}\n", line));
    return app::bad_input;
  } catch (const app::FolderInUse& e) {
    app::tell(e);
    return app::folder_in_use;
  } catch (const std::exception& e) {
    app::tell(e);
    return app::run_failed;
  }
  // What the other commands print is all they are for; these have their files.
  constexpr auto with_files = std::to_array<const char*>({"run", "mesh", "picture", "view", "render", "compare"});
  const bool has_files =
      std::any_of(with_files.begin(), with_files.end(), [&](const char* name) { return program.got_subcommand(name); });
  if (!has_files && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
    app::say(stderr, "sessile: cannot write to standard output\n");
    return app::run_failed;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return sessile_program(argc, argv);
  } catch (const std::exception& e) {  // before there is a command to run
    std::fprintf(stderr, "sessile: %s\n", e.what());
    return sessile::app::run_failed;
  }
}
