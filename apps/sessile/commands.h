#pragma once

#include <CLI/CLI.hpp>

/// The program's subcommands: each adds itself to the command line and says what its call came to.
namespace sessile::app {

/// What the program exits with; interrupted_code() of signals.h when a signal has asked for the end.
enum ExitCode { done = 0, run_failed = 1, bad_input = 2, folder_in_use = 3 };

void add_run(CLI::App& program, int& exit_code);
void add_mesh(CLI::App& program, int& exit_code);
void add_picture(CLI::App& program, int& exit_code);
void add_view(CLI::App& program, int& exit_code);
void add_render(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_bench(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_info(CLI::App& program, int& exit_code);
void add_models(CLI::App& program, int& exit_code);

}  // namespace sessile::app
