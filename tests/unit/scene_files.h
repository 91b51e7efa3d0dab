#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/scene/read.h"

namespace sessile::test {

using Lines = std::vector<std::string>;

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A folder of its own for each test, gone afterwards.
class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("sessile_" + std::to_string(getpid()) + "_" + info->test_suite_name() + "_" + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// The faults of a scene text, its folder cut off the messages.
  std::vector<std::string> faults(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return faults_of(write("s.json", text), overrides);
  }

  std::vector<std::string> faults_of(const std::filesystem::path& file,
                                     const std::vector<std::string>& overrides = {}) const {
    try {
      read_scene(file, overrides);
    } catch (const SceneError& error) {
      auto messages = error.messages;
      const std::string folder = folder_.string() + "/";
      for (auto& message : messages) {
        for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
          message.erase(at, folder.size());
        }
      }
      return messages;
    }
    return {};
  }

  std::filesystem::path folder_;
};

}  // namespace sessile::test
