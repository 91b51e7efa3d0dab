#include "sessile/checkpoint/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "sessile/core/error.h"
#include "sessile/core/hash.h"
#include "sessile/core/memory_limit.h"
#include "sessile/scene/describe.h"
#include "sessile/scene/read.h"
#include "support/one_of_each.h"
#include "support/same_bits.h"
#include "support/scenes.h"

namespace sessile {
namespace {

template <class V>
std::string name(const V& chosen) {
  return std::visit([](const auto& model) { return std::string(model.name); }, chosen);
}

/// A drop that falls on to a plate, beside an emitter, in a domain that is periodic along x and open above: all that a
/// state can hold.
Scene busy() {
  Scene scene = test::block(5, 2e-3, 1);
  scene.time.fixed_dt.reset();
  scene.gravity = {0, 0, -9.81};
  scene.bodies[0].placement.position = {0, 0, 0.35};
  scene.bodies[0].velocity = {0.5, 0, -2};
  scene.domain = Domain{{-0.8, -2, -1}, {0.8, 2, 1.5}, Edge::periodic, Edge::open, Edge::open};
  Solid plate;
  plate.shape = Plate{1.6, 2};
  plate.label = "plate";
  scene.solids = {plate};
  Emitter jet;
  jet.shape = Rectangle{0.3, 0.3};
  jet.placement.position = {0, 0, 1.1};
  jet.velocity = {0, 0, 8};
  jet.interval = 0.013;
  scene.emitters = {jet};
  return scene;
}

void take(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.step();
}

/// Through a file's bytes and the scene's JSON, as a run that is resumed.
Simulation resumed(const Simulation& simulation) {
  const Checkpoint read =
      decode_checkpoint(encode_checkpoint({"1", "x", to_json(simulation.scene()), "{}", simulation.state()}), "c");
  return {read_resolved_text(read.scene_json, "c").scene, read.state};
}

TEST(Checkpoint, GoesOnBitForBitWithEverySolver) {
  for (const Pressure& solver : test::one_of_each(Pressure{})) {
    Scene scene = busy();
    scene.pressure = solver;
    scene.forces = {SurfaceFeature{}};
    Simulation whole(scene);
    take(whole, 60);
    Simulation second = resumed(whole);
    test::expect_same(whole, second, name(solver) + " when read");
    take(whole, 60);
    take(second, 60);
    EXPECT_GT(whole.totals().out, 0) << "or the domain would not be tested";
    EXPECT_GT(whole.totals().emitted, 9) << "or the emitter would not be tested";
    test::expect_same(whole, second, name(solver) + " 60 steps later");
  }
}

TEST(Checkpoint, GoesOnBitForBitWithEveryForce) {
  for (const Force& force : test::one_of_each(Force{})) {
    Scene scene = busy();
    scene.forces = {force};
    Simulation whole(scene);
    take(whole, 30);
    Simulation second = resumed(whole);
    take(whole, 30);
    take(second, 30);
    test::expect_same(whole, second, name(force));
  }
}

// The first step reads what the constructor leaves, so that a state from before any step must do too.
TEST(Checkpoint, GoesOnFromTheStart) {
  Simulation whole(busy());
  Simulation second = resumed(whole);
  take(whole, 3);
  take(second, 3);
  test::expect_same(whole, second, "from the start");
}

TEST(Checkpoint, HoldsNoParticlesToo) {
  Scene scene = busy();
  scene.bodies.clear();
  scene.emitters[0].start = 0.5;
  Simulation empty(scene);
  take(empty, 2);
  Simulation second = resumed(empty);
  EXPECT_EQ(second.particles().size(), 0U);
  EXPECT_EQ(second.time(), empty.time());
}

struct CheckpointFile : testing::Test {
  static std::string bytes() {
    Simulation simulation(busy());
    take(simulation, 5);
    return encode_checkpoint({"0.1.0", "x86-64", to_json(simulation.scene()), R"({"frames": 3})", simulation.state()});
  }
  static std::string fault(const std::string& bytes, std::uint64_t most = 0) {
    try {
      decode_checkpoint(bytes, "file", most);
    } catch (const FileError& e) {
      return e.what();
    }
    return "none";
  }
};

TEST_F(CheckpointFile, SaysWhatIsWrong) {
  const std::string good = bytes();
  ASSERT_EQ(fault(good), "none");
  EXPECT_EQ(fault(""), "file: is no checkpoint of Sessile");
  EXPECT_EQ(fault("{\"spacing\": 1}, and more than 32 bytes of it"), "file: is no checkpoint of Sessile");
  EXPECT_EQ(fault(good.substr(0, 20)), "file: this checkpoint is cut short");
  std::string newer = good;
  newer[8] = 2;
  EXPECT_EQ(fault(newer),
            "file: this checkpoint is of format 2, and this program reads up to format 1: a newer Sessile goes on from "
            "it");
  EXPECT_NE(fault(good, 1000).find("more than there is memory for"), std::string::npos) << fault(good, 1000);
}

/// The bytes of a checkpoint with another length of its content in the header, and a right checksum.
std::string telling_of(std::uint64_t raw_bytes, std::string bytes) {
  constexpr std::size_t header = 8, length = 16, sum = 24, content = 32;
  std::memcpy(bytes.data() + length, &raw_bytes, 8);
  std::memset(bytes.data() + sum, 0, 8);
  const std::uint64_t checksum =
      hash(bytes.data() + content, bytes.size() - content, hash(bytes.data() + header, content - header));
  std::memcpy(bytes.data() + sum, &checksum, 8);
  return bytes;
}

TEST_F(CheckpointFile, TakesNoMemoryForWhatItsHeaderClaims) {
  const std::string good = bytes();
  std::uint64_t length = 0;
  std::memcpy(&length, good.data() + 16, 8);
  ASSERT_EQ(fault(telling_of(length, good)), "none");
  constexpr std::uint64_t tebi = std::uint64_t{1} << 40;
  EXPECT_EQ(fault(telling_of(1024 * tebi, good), 2048 * tebi), "file: this checkpoint holds less than it tells of");
  EXPECT_EQ(fault(telling_of(length - 1, good)), "file: this checkpoint holds more than it tells of");
  EXPECT_EQ(fault(telling_of(length, good + "x")), "file: this checkpoint holds more than it should");
  const auto quarter = static_cast<std::uint64_t>(memory_limit().bytes / 4);
  EXPECT_NE(fault(telling_of(quarter + 1, good)).find("more than there is memory for"), std::string::npos);
  EXPECT_EQ(fault(telling_of(quarter, good)), "file: this checkpoint holds less than it tells of");
}

TEST_F(CheckpointFile, FindsEveryDamage) {
  const std::string good = bytes();
  for (std::size_t length = 32; length < good.size(); length += 97) {
    EXPECT_NE(fault(good.substr(0, length)).find("damaged or cut short"), std::string::npos) << length;
  }
  for (std::size_t place = 12; place < good.size(); place += 31) {
    std::string flipped = good;
    flipped[place] = static_cast<char>(flipped[place] ^ 1);
    EXPECT_NE(fault(flipped).find("damaged or cut short"), std::string::npos) << place;
  }
}

TEST_F(CheckpointFile, IsToldFromOtherFiles) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto file = folder / "is_checkpoint";
  std::ofstream(file, std::ios::binary) << bytes();
  EXPECT_TRUE(is_checkpoint(file));
  EXPECT_EQ(read_checkpoint(file).session, R"({"frames": 3})");
  std::ofstream(file, std::ios::binary) << "SESSILE";
  EXPECT_FALSE(is_checkpoint(file));
  EXPECT_FALSE(is_checkpoint(folder));
  EXPECT_THROW(read_checkpoint(folder), FileError);
  std::filesystem::remove(file);
}

std::string refusal(const Scene& scene, const SimulationState& state) {
  try {
    const Simulation simulation(scene, state);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "none";
}

TEST(SimulationState, IsRefusedByAnotherScene) {
  const Scene scene = busy();
  const SimulationState state = Simulation(scene).state();
  ASSERT_EQ(refusal(scene, state), "none");
  Scene other = scene;
  other.solids[0].shape = Plate{1.6, 2.2};
  EXPECT_NE(refusal(other, state).find("the solids are not those of the state"), std::string::npos);
  other = scene;
  other.emitters.clear();
  EXPECT_NE(refusal(other, state).find("1 emitters, the scene 0"), std::string::npos) << refusal(other, state);
  SimulationState torn = state;
  torn.particles.pressure.pop_back();
  EXPECT_NE(refusal(scene, torn).find("different lengths"), std::string::npos);
  torn = state;
  torn.particles.velocity.y[3] = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_NE(refusal(scene, torn).find("not finite"), std::string::npos);
  for (const std::int64_t id : {std::int64_t{-5}, state.particles.id[3], state.next_id, std::int64_t{1} << 62}) {
    torn = state;
    torn.particles.id[4] = id;
    EXPECT_NE(refusal(scene, torn).find("do not have a number each"), std::string::npos) << id;
  }
  for (const Real mass : {Real(0), Real(-1)}) {
    torn = state;
    torn.particles.mass[2] = mass;
    EXPECT_NE(refusal(scene, torn).find("without a mass"), std::string::npos);
  }
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (std::int64_t Totals::*const count : {&Totals::steps, &Totals::out, &Totals::emitted, &Totals::iterations}) {
    for (const std::int64_t value : {std::int64_t{-1000}, most}) {
      torn = state;
      torn.totals.*count = value;
      EXPECT_NE(refusal(scene, torn).find("counts below zero, or further"), std::string::npos) << value;
    }
  }
  torn = state;
  torn.next_id = most;
  torn.totals.out = most - static_cast<std::int64_t>(state.particles.size());
  EXPECT_NE(refusal(scene, torn).find("counts below zero, or further"), std::string::npos);
  torn = state;
  torn.last_step.dt = -1;
  EXPECT_NE(refusal(scene, torn).find("no length"), std::string::npos);
  torn = state;
  torn.time = -1;
  EXPECT_NE(refusal(scene, torn).find("no time"), std::string::npos);
}

}  // namespace
}  // namespace sessile
