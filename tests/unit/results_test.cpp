#include "sessile/results/results.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "sessile/output/frames.h"
#include "sessile/scene/describe.h"
#include "support/scenes.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::TemporaryFolder;

Snapshot sample(std::size_t n, double time = 0.1) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-5, 5);
  const auto floats = [&](std::size_t count) {
    std::vector<float> values(count);
    for (float& value : values) value = number(random);
    return values;
  };
  std::vector<std::int64_t> ids(n);
  for (std::size_t i = 0; i < n; ++i) ids[i] = static_cast<std::int64_t>(i * 7 % n);
  Snapshot snapshot{time, 42, floats(3 * n), {}};
  snapshot.columns.push_back({"id", "", 1, ids});
  snapshot.columns.push_back({"velocity", "m/s", 3, floats(3 * n)});
  snapshot.columns.push_back({"density", "kg/m^3", 1, floats(n)});
  snapshot.columns.push_back({"normal", "", 3, floats(3 * n)});
  snapshot.columns.push_back({"acceleration_gravity", "m/s^2", 3, floats(3 * n)});
  return snapshot;
}

std::string encoded(const Snapshot& snapshot, std::string_view format) {
  return find_frame_format(format)->encode(snapshot);
}

class ReadFrame : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file() const { return folder_ / (std::string("frame_000000.") + GetParam()); }
  Snapshot read(const std::string& bytes) const {
    std::ofstream(file(), std::ios::binary) << bytes;  // not synced: there are thousands
    return read_frame(file());
  }
  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, ReadFrame, testing::Values("vtp", "ply"),
                         [](const auto& each) { return std::string(each.param); });

TEST_P(ReadFrame, BringsBackEveryBit) {
  for (const std::size_t n : {0U, 1U, 5U, 70000U}) {
    const Snapshot before = sample(n), after = read(encoded(before, GetParam()));
    EXPECT_EQ(after.time, 0.1);
    EXPECT_EQ(after.step, 42);
    EXPECT_EQ(after.points, before.points);
    ASSERT_EQ(after.columns.size(), before.columns.size());
    for (std::size_t i = 0; i < before.columns.size(); ++i) {
      EXPECT_EQ(after.columns[i].name, before.columns[i].name);
      EXPECT_EQ(after.columns[i].unit, before.columns[i].unit);
      EXPECT_EQ(after.columns[i].components, before.columns[i].components);
      EXPECT_EQ(after.columns[i].values, before.columns[i].values);
    }
  }
}

TEST_P(ReadFrame, RefusesCutFiles) {
  const std::string whole = encoded(sample(200), GetParam());
  const std::size_t data = GetParam() == std::string("vtp") ? whole.find("</AppendedData>") : whole.size();
  for (std::size_t length = 0; length < data; length += 1 + length / 40) {
    EXPECT_THROW(read(whole.substr(0, length)), FileError) << length;
  }
  EXPECT_THROW(read(whole.substr(0, data - 1)), FileError);
}

/// A byte may change what is said without making it wrong: a time, a name, a number of a PLY. Nothing else may happen.
TEST_P(ReadFrame, SurvivesChangedBytes) {
  const std::string whole = encoded(sample(60), GetParam());
  std::mt19937 random(11);
  std::size_t refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string changed = whole;
    const int count = 1 + trial % 3;
    for (int k = 0; k < count; ++k) changed[random() % changed.size()] = static_cast<char>(random());
    try {
      const Snapshot snapshot = read(changed);
      for (const Column& column : snapshot.columns) {
        const auto size = std::visit([](const auto& values) { return values.size(); }, column.values);
        ASSERT_EQ(size, snapshot.size() * static_cast<std::size_t>(column.components));
      }
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find(file().string()), std::string::npos);
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST_P(ReadFrame, RefusesCountsThatLie) {
  const std::string whole = encoded(sample(9), GetParam());
  for (const std::string count : {"8", "10", "9000000000", "18446744073709551615", "99999999999999999999", "-9", ""}) {
    std::string changed = whole;
    for (const std::string before : {"NumberOfPoints=\"9\"", "element vertex 9\n"}) {
      const auto at = changed.find(before);
      if (at == std::string::npos) continue;
      std::string after = before;
      after.replace(after.find('9'), 1, count);
      changed.replace(at, before.size(), after);
    }
    EXPECT_THROW(read(changed), FileError) << count;
  }
}

TEST_P(ReadFrame, RefusesWhatIsNoFrame) {
  EXPECT_THROW(read(""), FileError);
  EXPECT_THROW(read("hello\n"), FileError);
  EXPECT_THROW(read(std::string(1 << 16, '<')), FileError);
  EXPECT_THROW(read("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"), FileError);
  EXPECT_THROW(read("<VTKFile type=\"ImageData\"></VTKFile>"), FileError);
}

TEST(ReadFrames, SaysWhatIsWrong) {
  TemporaryFolder folder;
  const auto says = [&](const std::filesystem::path& file) {
    return message_of<FileError>([&] { read_frame(file); }).substr(folder.path().string().size() + 13);
  };
  EXPECT_EQ(says(folder / "none.vtp"), "none.vtp: No such file or directory");
  write_whole(folder / "a.ply", encoded(sample(2), "ply") + "x");
  EXPECT_EQ(says(folder / "a.ply"),
            "a.ply: it holds 113 bytes of particles in place of 2 x 56: it is cut short or changed");
  write_whole(folder / "a.obj", "v 0 0 0\n");
  EXPECT_EQ(says(folder / "a.obj"), "a.obj: frames are .vtp or .ply files");
}

class OpenResults : public testing::Test {
 protected:
  void frame(std::int64_t number, double time, const std::string& format = "vtp") {
    write_whole(folder_ / frame_file_name(number, format), encoded(sample(3, time), format));
  }
  void scene() { write_whole(folder_ / "scene.json", to_json(test::block(3))); }
  std::string fault() {
    return message_of<FileError>([&] { open_results(folder_.path()); });
  }
  TemporaryFolder folder_;
};

TEST_F(OpenResults, ListsFramesByNumberWithTheirTimes) {
  scene();
  frame(2, 0.2);
  frame(0, 0);
  frame(1, 0.1);
  frame(1000000, 7);
  write_whole(folder_ / ".frame_000003.vtp.part", "half");
  write_whole(folder_ / "frame_x.vtp", "not ours");
  const Results results = open_results(folder_.path());
  ASSERT_EQ(results.frames.size(), 4u);
  EXPECT_EQ(results.scene.spacing, 0.1);
  EXPECT_EQ(results.frames[1].number, 1);
  EXPECT_EQ(results.frames[1].time, 0.1);
  EXPECT_EQ(results.frames[3].number, 1000000);
  EXPECT_EQ(results.frames[3].time, 7);
  EXPECT_EQ(read_frame(results.frames[2].file).time, 0.2);
}

TEST_F(OpenResults, TakesTimesFromTheCollection) {
  scene();
  write_whole(folder_ / "frame_000000.vtp", "not looked at");
  frame(1, 0.5);
  const std::vector<TimedFile> collection{{0.25, "frame_000000.vtp"}};
  write_whole(folder_ / "frames.pvd", encode_pvd(collection));
  const Results results = open_results(folder_.path());
  EXPECT_EQ(results.frames[0].time, 0.25);
  EXPECT_EQ(results.frames[1].time, 0.5);  // newer than the collection
}

TEST_F(OpenResults, TakesPlyWhereThereIsNoVtp) {
  scene();
  frame(0, 0, "ply");
  frame(1, 0.5, "ply");
  EXPECT_EQ(open_results(folder_.path()).frames[1].time, 0.5);
  frame(0, 0);
  EXPECT_EQ(open_results(folder_.path()).frames.size(), 1u);
}

TEST_F(OpenResults, ReadsTheSceneOfAnOlderRun) {
  frame(0, 0);
  EXPECT_NE(fault().find("holds neither scene.json nor summary.json"), std::string::npos);
  write_whole(folder_ / "summary.json", "{\"status\": \"done\", \"scene\": " + to_json(test::block(3)) + "}");
  const Results results = open_results(folder_.path());
  EXPECT_EQ(to_json(results.scene), to_json(test::block(3)));
  write_whole(folder_ / "summary.json", "{\"status\": \"done\"}");
  EXPECT_NE(fault().find("it holds no scene"), std::string::npos);
  write_whole(folder_ / "summary.json", std::string(100000, '['));
  EXPECT_NE(fault().find("it holds no scene"), std::string::npos);
}

TEST_F(OpenResults, SaysWhatIsWrong) {
  scene();
  EXPECT_NE(fault().find("holds no frames"), std::string::npos);
  frame(0, 0);
  write_whole(folder_ / "frame_000001.vtp", "half");
  EXPECT_NE(fault().find("frame_000001.vtp: it tells no time, so it is no frame"), std::string::npos);
  write_whole(folder_ / "scene.json", "{\"spacing\": -1}");
  EXPECT_NE(fault().find("scene.json:1: spacing: must be above 0 m, found -1"), std::string::npos);
  EXPECT_NE(message_of<FileError>([&] { open_results(folder_ / "none"); }).find("none: "), std::string::npos);
  EXPECT_NE(message_of<FileError>([&] { open_results(folder_ / "scene.json"); }).find("no folder"), std::string::npos);
}

TEST(FrameAt, IsTheNearest) {
  Results results;
  for (const double time : {0.0, 0.1, 0.2, 0.2}) {
    results.frames.push_back({static_cast<std::int64_t>(results.frames.size()), time, {}});
  }
  EXPECT_EQ(frame_at(results, -1).number, 0);
  EXPECT_EQ(frame_at(results, 0.04).number, 0);
  EXPECT_EQ(frame_at(results, 0.06).number, 1);
  EXPECT_EQ(frame_at(results, 9).number, 2);
  results.frames.resize(2);
  results.frames[1].time = 1;
  EXPECT_EQ(frame_at(results, 0.5).number, 0);
}

}  // namespace
}  // namespace sessile
