#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "fuzz/targets.h"
#include "unit/temporary_folder.h"

namespace sessile::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Regressions : public testing::TestWithParam<Target> {};

INSTANTIATE_TEST_SUITE_P(Readers, Regressions, testing::ValuesIn(targets),
                         [](const auto& each) { return std::string(each.param.name); });

/// What fuzzers once found, and what they start from: a reader survives it in every build, with or without fuzzers.
TEST_P(Regressions, AreSurvived) {
  const fs::path fuzz = fs::path(SESSILE_SOURCE_DIR) / "tests/fuzz";
  std::size_t seeds = 0;
  for (const char* kind : {"corpus", "regressions"}) {
    for (const fs::path& file : files_below(fuzz / kind / GetParam().name)) {
      SCOPED_TRACE(file);
      EXPECT_NO_THROW(survive(GetParam().read, test::read_file(file)));
      ++seeds;
    }
  }
  EXPECT_GT(seeds, 0U) << "no seed of " << GetParam().name;
}

/// Seeds cut short and with bytes changed: a little of what fuzzers do, in every build.
TEST_P(Regressions, SeedsThatAreCutOrChangedAreSurvived) {
  constexpr std::size_t cuts = 23;
  for (const fs::path& file : files_below(fs::path(SESSILE_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name)) {
    const std::string whole = test::read_file(file);
    for (std::size_t k = 1; k < cuts; ++k) {
      const std::size_t at = whole.size() * k / cuts;
      std::string changed = whole;
      if (at < changed.size()) changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(1U << k % 8));
      SCOPED_TRACE(file.string() + " at " + std::to_string(at));
      EXPECT_NO_THROW(survive(GetParam().read, whole.substr(0, at)));
      EXPECT_NO_THROW(survive(GetParam().read, changed));
    }
  }
}

TEST(Scenes, OfTheRepositoryAreRead) {
  const fs::path scenes(SESSILE_SCENES);
  for (const fs::path& file : files_below(scenes)) {
    SCOPED_TRACE(file);
    const bool method = file.parent_path().filename() == "methods";
    EXPECT_NO_THROW((method ? read_method_json : read_scene_json)(test::read_file(file)));
  }
}

}  // namespace
}  // namespace sessile::fuzz
