#include "run_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "threads.h"

namespace sessile::app {

std::string finite_and_positive(const std::string& word) { return finite_and_positive_in("s", word); }

std::string finite_and_positive_in(std::string_view unit, const std::string& word) {
  double value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || rest != word.data() + word.size()) return {};  // no number: CLI11 says so
  if (error != std::errc{} || !std::isfinite(value)) return word + " is not a finite number";
  return value > 0 ? "" : fmt::format("must be above 0 {}, found {}", unit, word);
}

void add_allow_outside(CLI::App& command, MeshPlaces& places) {
  command.add_flag_callback(
      "--allow-outside", [&places] { places = MeshPlaces::anywhere; }, "let the scene name meshes outside its folder");
}

void add_run_options(CLI::App& command, RunOptions& options, const std::string& folder_help) {
  command.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
  command.add_option("-o,--output", options.folder, folder_help)->type_name("DIR");
  command.add_option("--set", options.overrides, "put a value over the scene's, e.g. time.fixed_dt=0.002")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_allow_outside(command, options.places);
  command.add_option("--until", options.until, "end at this simulated time, in place of the scene's time.end")
      ->type_name("SECONDS")
      ->check(finite_and_positive, "");
  command.add_option("--threads", options.threads, "threads to use (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command.add_option("--progress", options.progress, "how progress is shown")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
      ->capture_default_str();
}

void apply_run_options(RunOptions& options, const std::string& folder_suffix) {
  use_threads(options.threads);
  if (options.until) options.overrides.push_back(fmt::format("time.end={:.17g}", *options.until));
  if (options.folder.empty()) {
    const std::string stem = std::filesystem::path(options.scene).stem().string();
    options.folder = (std::filesystem::path("results") / (stem + folder_suffix)).string();
  }
}

}  // namespace sessile::app
