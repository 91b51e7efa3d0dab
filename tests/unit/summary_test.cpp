#include "sessile/output/summary.h"

#include <gtest/gtest.h>
#include <json/json.h>

#include <limits>
#include <sstream>
#include <string>

#include "unit/temporary_folder.h"

namespace sessile {
namespace {

Json::Value parsed(const std::string& text) {
  Json::Value value;
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  std::istringstream in(text);
  std::string errors;
  EXPECT_TRUE(Json::parseFromStream(builder, in, &value, &errors)) << errors << text;
  return value;
}

TEST(Summary, HoldsEverythingAsJson) {
  RunFacts run;
  run.status = RunStatus::interrupted;
  run.message = "stopped by \"hand\"\nin C:\\tmp";
  run.version = "0.1.0";
  run.scene_json = "{\n  \"spacing\": 0.1,\n  \"forces\": []\n}\n";
  run.wall_time = 12.5;
  run.output_time = 0.5;
  run.measures_time = 0.25;
  run.writer_time = 3;
  run.frames = 7;
  SimulationFacts simulation;
  simulation.particles = 1728;
  simulation.wall_particles = 5329;
  simulation.time = 0.3;
  simulation.totals = {.steps = 8,
                       .iterations = 20,
                       .unconverged_solves = 1,
                       .overruled_steps = 2,
                       .emitted = 3,
                       .waits = 4,
                       .out = 5,
                       .lost = 6};
  simulation.stages = {1, 2, 3, 4, 5, 6};
  simulation.bytes = 123456;

  const Json::Value summary = parsed(summary_json(run, simulation));
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(summary["message"], run.message);
  EXPECT_EQ(summary["version"], "0.1.0");
  EXPECT_EQ(summary["particles"], 1728);
  EXPECT_EQ(summary["wall_particles"], 5329);
  EXPECT_EQ(summary["simulated_time_s"], 0.3);
  EXPECT_EQ(summary["steps"], 8);
  EXPECT_EQ(summary["frames"], 7);
  EXPECT_EQ(summary["iterations"], 20);
  EXPECT_EQ(summary["iterations_per_step"], 2.5);
  EXPECT_EQ(summary["unconverged_solves"], 1);
  EXPECT_EQ(summary["overruled_steps"], 2);
  EXPECT_EQ(summary["emitted"], 3);
  EXPECT_EQ(summary["waits"], 4);
  EXPECT_EQ(summary["out"], 5);
  EXPECT_EQ(summary["lost"], 6);
  EXPECT_EQ(summary["wall_time_s"]["total"], 12.5);
  EXPECT_EQ(summary["wall_time_s"]["neighbors"], 1);
  EXPECT_EQ(summary["wall_time_s"]["time_step"], 4);
  EXPECT_EQ(summary["wall_time_s"]["pressure"], 5);
  EXPECT_EQ(summary["wall_time_s"]["integration"], 6);
  EXPECT_EQ(summary["wall_time_s"]["output"], 0.5);
  EXPECT_EQ(summary["wall_time_s"]["measures"], 0.25);
  EXPECT_EQ(summary["wall_time_s"]["writer_thread"], 3);
  EXPECT_EQ(summary["memory_bytes"]["arrays"], 123456);
  EXPECT_GT(summary["memory_bytes"]["peak"].asUInt64(), 1'000'000u);
  EXPECT_EQ(summary["scene"]["spacing"], 0.1);
  EXPECT_TRUE(summary["scene"]["forces"].isArray());
}

TEST(Summary, IsJsonWhateverItIsGiven) {
  RunFacts run;
  run.status = RunStatus::failed;
  run.scene_json = "{\"half\": ";
  run.wall_time = std::numeric_limits<double>::quiet_NaN();
  const Json::Value summary = parsed(summary_json(run, {}));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(summary["scene"], run.scene_json);
  EXPECT_EQ(summary["iterations_per_step"], 0);
  EXPECT_TRUE(summary["wall_time_s"]["total"].isNull());
}

TEST(Summary, IsWrittenWhole) {
  test::TemporaryFolder folder;
  write_summary(folder / "summary.json", {}, {});
  EXPECT_EQ(parsed(test::read_file(folder / "summary.json"))["status"], "done");
  EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace sessile
