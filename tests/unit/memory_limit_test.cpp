#include "sessile/core/memory_limit.h"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.h"

namespace sessile {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// What the machine itself gives, without control groups.
MemoryLimit plain() { return memory_limit("/nowhere/cgroup", "/nowhere"); }

TEST(MemoryLimit, IsTheMachinesWithoutOthers) {
  EXPECT_GT(plain().bytes, 1e8);
  EXPECT_LT(plain().bytes, 1e15);
}

TEST(MemoryLimit, HeedsTheLeastOfTheGroupAndThoseAboveIt) {
  const test::TemporaryFolder folder;
  const fs::path groups = folder.path() / "groups", process = folder.path() / "of_process";
  write(process, "0::/users/one\n");
  write(groups / "users/one/memory.max", "max\n");
  EXPECT_EQ(memory_limit(process, groups).bytes, plain().bytes);
  write(groups / "users/memory.max", "70000000\n");
  EXPECT_EQ(memory_limit(process, groups).bytes, 7e7);
  EXPECT_NE(memory_limit(process, groups).what.find("control group"), std::string::npos);
  write(groups / "users/one/memory.max", "60000000\n");
  EXPECT_EQ(memory_limit(process, groups).bytes, 6e7);
  write(groups / "memory.max", "50000000\n");  // where a container sees its own group as the root
  EXPECT_EQ(memory_limit(process, groups).bytes, 5e7);
}

TEST(MemoryLimit, HeedsGroupsOfVersion1) {
  const test::TemporaryFolder folder;
  const fs::path groups = folder.path() / "groups", process = folder.path() / "of_process";
  write(process, "7:cpu,cpuacct:/other\n5:memory:/box\n");
  write(groups / "memory/box/memory.limit_in_bytes", "40000000\n");
  write(groups / "memory/other/memory.limit_in_bytes", "30000000\n");
  EXPECT_EQ(memory_limit(process, groups).bytes, 4e7);
}

}  // namespace
}  // namespace sessile
