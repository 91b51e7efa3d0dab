#include "sessile/output/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "sessile/core/error.h"
#include "unit/small_disk.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::read_file;
using test::SmallDisk;
using test::TemporaryFolder;

TEST(WriteWhole, PutsTheBytesThereAndNothingElse) {
  TemporaryFolder folder;
  const std::string bytes("a\0b\n", 4);
  write_whole(folder / "x.bin", bytes);
  EXPECT_EQ(read_file(folder / "x.bin"), bytes);
  write_whole(folder / "x.bin", "");
  EXPECT_EQ(read_file(folder / "x.bin"), "");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteWhole, LeavesTheOldFileWhenTheDiskIsFull) {
  TemporaryFolder folder;
  write_whole(folder / "x.bin", "old");
  std::string message;
  {
    const SmallDisk disk(1000);
    message = message_of<FileError>([&] { write_whole(folder / "x.bin", std::string(5000, 'n')); });
  }
  EXPECT_EQ(message, "cannot write " + (folder / "x.bin").string() + ": File too large");
  EXPECT_EQ(read_file(folder / "x.bin"), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteWhole, NamesAMissingFolder) {
  TemporaryFolder folder;
  const auto path = folder / "none" / "x.bin";
  EXPECT_EQ(message_of<FileError>([&] { write_whole(path, "x"); }),
            "cannot write " + path.string() + ": No such file or directory");
}

TEST(WriteWhole, DoesNotReplaceAFolder) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder / "x.bin");
  EXPECT_THROW(write_whole(folder / "x.bin", "x"), FileError);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(CreateOutputFolder, MakesAllOfThePathAndTakesOneThatExists) {
  TemporaryFolder folder;
  create_output_folder(folder / "a" / "b");
  create_output_folder(folder / "a" / "b");
  create_output_folder((folder / "c").string() + "/");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a" / "b"));
}

TEST(CreateOutputFolder, RefusesAFile) {
  TemporaryFolder folder;
  write_whole(folder / "file", "x");
  EXPECT_EQ(message_of<FileError>([&] { create_output_folder(folder / "file"); }),
            "cannot create the folder " + (folder / "file").string() + ": Not a directory");
  EXPECT_EQ(message_of<FileError>([&] { create_output_folder(folder / "file" / "out"); }),
            "cannot create the folder " + (folder / "file" / "out").string() + ": Not a directory");
}

TEST(CreateOutputFolder, RefusesAFolderThatMayNotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  TemporaryFolder folder;
  create_output_folder(folder / "a");
  std::filesystem::permissions(folder / "a", std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(message_of<FileError>([&] { create_output_folder(folder / "a"); }),
            "cannot write into the folder " + (folder / "a").string() + ": Permission denied");
}

TEST(LineFile, GrowsByLines) {
  TemporaryFolder folder;
  LineFile file(folder / "x.csv");
  file.append("a,b\n");
  file.append("1,2\n");
  EXPECT_EQ(read_file(folder / "x.csv"), "a,b\n1,2\n");  // while it is still open
}

TEST(LineFile, GoesOnWithTheStartOfAFile) {
  const TemporaryFolder folder;
  { LineFile(folder / "x.csv").append("1\n2\n3\n"); }
  {
    LineFile file(folder / "x.csv", Keep{4});
    EXPECT_EQ(file.size(), 4u);
    file.append("four\n");
    file.sync();
    EXPECT_EQ(file.size(), 9u);
  }
  EXPECT_EQ(read_file(folder / "x.csv"), "1\n2\nfour\n");
  EXPECT_THROW(LineFile(folder / "x.csv", Keep{10}), FileError);
  EXPECT_EQ(read_file(folder / "x.csv"), "1\n2\nfour\n");
  EXPECT_THROW(LineFile(folder / "y.csv", Keep{0}), FileError);
}

TEST(LineFile, TakesBackHalfALine) {
  TemporaryFolder folder;
  LineFile file(folder / "x.csv");
  file.append("first\n");
  {
    const SmallDisk disk(10);
    EXPECT_EQ(message_of<FileError>([&] { file.append("second\n"); }),
              "cannot write " + (folder / "x.csv").string() + ": File too large");
  }
  EXPECT_EQ(read_file(folder / "x.csv"), "first\n");
  file.append("third\n");
  EXPECT_EQ(read_file(folder / "x.csv"), "first\nthird\n");
}

TEST(LineFile, SaysThatTheDiskIsFull) {
  LineFile file("/dev/full");
  EXPECT_EQ(message_of<FileError>([&] { file.append("x\n"); }), "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace sessile
