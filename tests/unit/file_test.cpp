#include "sessile/output/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
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

/// A device that takes everything in, as /dev/null is; false where the user may not make one.
bool make_device(const std::filesystem::path& path) { return mknod(path.c_str(), S_IFCHR | 0666, makedev(1, 3)) == 0; }

TEST(WriteWhole, WritesADeviceAsItIs) {
  TemporaryFolder folder;
  if (!make_device(folder / "x.bin")) GTEST_SKIP() << "only root makes devices";
  write_whole(folder / "x.bin", "x");
  EXPECT_TRUE(std::filesystem::is_character_file(folder / "x.bin"));
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_EQ(message_of<FileError>([&] { write_whole("/dev/full", "x"); }),
            "cannot write /dev/full: No space left on device");
  EXPECT_EQ(message_of<FileError>([&] { write_whole("/dev/sessile-test", "x"); }),
            "cannot write /dev/sessile-test: No such file or directory");
  write_whole(part_name(folder / "x.bin"), "x");
  EXPECT_THROW(finish_part(folder / "x.bin"), FileError);
  EXPECT_TRUE(std::filesystem::is_character_file(folder / "x.bin"));
  EXPECT_EQ(folder.entries(), 1u);
}

/// Whoever planted it may not have a device written.
TEST(WriteWhole, ReplacesALinkToADevice) {
  TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "x.bin");
  write_whole(folder / "x.bin", "x");
  EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / "x.bin")));
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

TEST(LineFile, SaysThatItHasBeenRemoved) {
  TemporaryFolder folder;
  const auto path = folder / "x.csv";
  LineFile file(path);
  file.append("1\n");
  std::filesystem::remove(path);
  const std::string message = path.string() + " has been removed while it was written";
  EXPECT_EQ(message_of<FileError>([&] { file.append("2\n"); }), message);
  EXPECT_EQ(message_of<FileError>([&] { file.sync(); }), message);
  EXPECT_EQ(file.size(), 2u);
}

TEST(LineFile, SaysThatTheDiskIsFull) {
  LineFile file("/dev/full");
  EXPECT_EQ(message_of<FileError>([&] { file.append("x\n"); }), "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace sessile
