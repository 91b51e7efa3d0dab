#pragma once

#include <filesystem>
#include <string>

namespace sessile::app {

enum class GnuplotEnd { done, missing, failed };

/// Runs gnuplot, found along PATH, on a script in a folder; without a shell. What it says goes to `log`.
GnuplotEnd run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                       const std::filesystem::path& log);

}  // namespace sessile::app
