#include "sessile/output/writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sessile/core/error.h"
#include "unit/small_disk.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::read_file;
using test::SmallDisk;
using test::TemporaryFolder;

Snapshot frame(double time, std::size_t n = 3) {
  Snapshot snapshot{time, static_cast<std::int64_t>(time * 100), std::vector<float>(3 * n), {}};
  for (std::size_t i = 0; i < 3 * n; ++i) snapshot.points[i] = static_cast<float>(i * i % 7919) / 3;
  return snapshot;
}

const std::vector<std::string> vtp{"vtp"};
const std::vector<std::string> both{"vtp", "ply"};

TEST(FrameWriter, WritesEveryFrameInOrder) {
  TemporaryFolder folder;
  FrameWriter writer(folder.path(), both);
  writer.write_solids(frame(0));
  std::vector<TimedFile> frames;
  for (std::int64_t i = 0; i < 12; ++i) {
    frames.push_back({static_cast<double>(i) * 0.25, frame_file_name(i, "vtp")});
    writer.push(frame(frames.back().time));
  }
  writer.close();
  EXPECT_EQ(writer.frames_written(), 12);
  EXPECT_EQ(folder.entries(), 2 * 12 + 2 + 1u);
  EXPECT_EQ(read_file(folder / "frames.pvd"), encode_pvd(frames));
  for (const TimedFile& each : frames) EXPECT_EQ(read_file(folder / each.file), encode_vtp(frame(each.time)));
  EXPECT_EQ(read_file(folder / "frame_000005.ply"), encode_ply(frame(5 * 0.25)));
  EXPECT_EQ(read_file(folder / "solids.ply"), encode_ply(frame(0)));
}

TEST(FrameWriter, WritesNoCollectionWithoutVtp) {
  TemporaryFolder folder;
  FrameWriter writer(folder.path(), std::vector<std::string>{"ply"});
  writer.push(frame(0));
  writer.close();
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(FrameWriter, FinishesWhenItIsDestroyed) {
  TemporaryFolder folder;
  {
    FrameWriter writer(folder.path(), vtp);
    for (int i = 0; i < 3; ++i) writer.push(frame(i));
  }
  EXPECT_EQ(folder.entries(), 3 + 1u);
}

TEST(FrameWriter, RefusesUnknownFormats) {
  EXPECT_EQ(message_of<Error>([] { FrameWriter(".", std::vector<std::string>{"vtk"}); }), "unknown format \"vtk\"");
}

TEST(FrameWriter, ThrowsAtCloseWhatWentWrong) {
  TemporaryFolder folder;
  FrameWriter writer(folder / "none", vtp);
  writer.push(frame(0));
  EXPECT_EQ(message_of<FileError>([&] { writer.close(); }),
            "cannot write " + (folder / "none" / "frame_000000.vtp").string() + ": No such file or directory");
  writer.close();  // it has been said
  EXPECT_THROW(writer.push(frame(1)), FileError);
}

TEST(FrameWriter, ThrowsAtTheNextPushWhatWentWrong) {
  TemporaryFolder folder;
  FrameWriter writer(folder / "none", vtp);
  EXPECT_THROW(
      {
        for (int i = 0; i < 100; ++i) writer.push(frame(i));
      },
      FileError);
  EXPECT_THROW(writer.push(frame(0)), FileError);
  writer.close();
  EXPECT_EQ(writer.frames_written(), 0);
}

TEST(FrameWriter, DropsAnErrorNobodyAskedFor) {
  TemporaryFolder folder;
  FrameWriter writer(folder / "none", vtp);
  writer.push(frame(0));
}

TEST(FrameWriter, RefusesFramesAfterClose) {
  TemporaryFolder folder;
  FrameWriter writer(folder.path(), vtp);
  writer.close();
  EXPECT_THROW(writer.push(frame(0)), Error);
}

TEST(FrameWriter, KeepsEarlierFramesWhenTheDiskIsFull) {
  TemporaryFolder folder;
  FrameWriter writer(folder.path(), both);
  const SmallDisk disk(5000);
  writer.push(frame(0));
  writer.push(frame(1));
  writer.push(frame(2, 20000));
  EXPECT_EQ(message_of<FileError>([&] { writer.close(); }),
            "cannot write " + (folder / "frame_000002.vtp").string() + ": File too large");
  EXPECT_EQ(writer.frames_written(), 2);
  EXPECT_EQ(folder.entries(), 2 * 2 + 1u);  // no temporary is left
  EXPECT_EQ(read_file(folder / "frame_000001.vtp"), encode_vtp(frame(1)));
  EXPECT_EQ(read_file(folder / "frames.pvd"),
            encode_pvd(std::vector<TimedFile>{{0, "frame_000000.vtp"}, {1, "frame_000001.vtp"}}));
}

// Pushing is far faster than writing, so that without waiting most frames would still be in memory.
TEST(FrameWriter, WaitsWhileTheQueueIsFull) {
  TemporaryFolder folder;
  FrameWriter writer(folder.path(), vtp);
  constexpr auto in_memory = static_cast<std::int64_t>(FrameWriter::queue_length) + 1;  // and the one at hand
  for (std::int64_t pushed = 1; pushed <= 30; ++pushed) {
    writer.push(frame(static_cast<double>(pushed), 20000));
    EXPECT_GE(writer.frames_written(), pushed - in_memory);
  }
  writer.close();
  EXPECT_EQ(writer.frames_written(), 30);
}

}  // namespace
}  // namespace sessile
