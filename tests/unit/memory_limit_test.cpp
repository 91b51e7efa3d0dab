#include "sessile/core/memory_limit.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "sessile/core/error.h"
#include "support/scenes.h"
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

/// The promise of the estimate: never below what the arrays take, nor so far above that a scene is refused for nothing.
TEST(MemoryLimit, TheEstimateCoversTheArraysAtEverySupport) {
  for (const double support : {1.5, 2.0, 3.0, 4.0}) {
    SCOPED_TRACE(support);
    Scene scene = test::block(14);
    scene.support = support;
    scene.domain = Domain{{-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}, Edge::periodic, Edge::periodic, Edge::periodic};
    scene.forces = {SurfaceFeature{}};
    Simulation simulation(scene);
    simulation.step();
    const auto taken = static_cast<double>(simulation.bytes());
    const double estimated = estimated_bytes(static_cast<double>(simulation.particles().size()), support);
    std::printf("support %g: %.0f bytes a particle, estimated %.0f\n", support, taken / 2744, estimated / 2744);
    EXPECT_LE(taken, estimated);
    EXPECT_GE(taken, 0.4 * estimated);
  }
}

TEST(MemoryLimit, AddressSpaceThatIsTooSmallRefusesTheScene) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  if (pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) > std::size_t{1} << 29) {
    GTEST_SKIP() << "a sanitizer takes address space of its own";
  }
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  rlimit small = before;
  small.rlim_cur = rlim_t{1} << 30;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
  Scene scene = test::block(4);
  scene.bodies[0].shape = Box{{20, 20, 20}};  // 8 million particles, some 5 GiB
  const std::string said = test::message_of<SceneError>([&] { const Simulation simulation(scene); });
  setrlimit(RLIMIT_AS, &before);
  EXPECT_NE(said.find("the limit on its address space (ulimit -v) is 1 GiB"), std::string::npos) << said;
}

}  // namespace
}  // namespace sessile
