#pragma once

#include <filesystem>
#include <vector>

namespace sessile::app {

/// How making a film ended.
enum class FilmEnd { done, missing, interrupted };

/// Joins pictures of one size into a film (H.264), by ffmpeg; the film is there whole or not at all. Throws Error, with
/// ffmpeg's last words, when it failed.
FilmEnd make_film(const std::vector<std::filesystem::path>& pictures, double rate, const std::filesystem::path& film);

}  // namespace sessile::app
