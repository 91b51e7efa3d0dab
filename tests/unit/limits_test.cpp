#include <sys/stat.h>

#include <cstring>

#include "sessile/output/check.h"
#include "sessile/output/file.h"
#include "sessile/output/frames.h"
#include "sessile/results/frame_files.h"
#include "sessile/results/results.h"
#include "sessile/scene/input_file.h"
#include "sessile/scene/json_text.h"
#include "sessile/scene/mesh_files.h"
#include "sessile/scene/mesh_sampling.h"
#include "sessile/scene/sampling.h"
#include "sessile/scene/spelling.h"
#include "sessile/scene/validate.h"
#include "sessile/simulation.h"
#include "unit/scene_files.h"
#include "unit/temporary_folder.h"

/// The limits of docs/limits.md, and what is beyond them.
namespace sessile::test {
namespace {

class Limits : public SceneFiles {
 protected:
  /// What is wrong with reading a file by a reader.
  template <class Read>
  std::string why(Read&& read) const {
    return message_of<Error>(std::forward<Read>(read));
  }
};

std::string around_body(const std::string& lines) {
  return "{\"spacing\": 0.1, \"time\": {\"end\": 1}, " + lines +
         "\"bodies\": [{\"shape\": {\"type\": \"box\", \"size\": [0.3, 0.3, 0.3]}}]}";
}

TEST_F(Limits, NestingOfASceneIs64Levels) {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_EQ(faults(nested(64)), (Lines{"s.json:1: expected a group {...}, found a list of 1"}));
  EXPECT_EQ(faults(nested(65)), (Lines{"s.json:1: nested more than 64 levels deep"}));
  EXPECT_EQ(faults(nested(1'000'000)), (Lines{"s.json:1: nested more than 64 levels deep"}));
}

TEST_F(Limits, JsonOfOurOwnIsBounded) {
  const auto list = [](std::size_t n) {
    std::string text = "[0";
    for (std::size_t k = 1; k < n; ++k) text += ",0";
    return text + "]";
  };
  EXPECT_TRUE(parsed_json(list(99), 100));  // and the list itself
  EXPECT_FALSE(parsed_json(list(100), 100));
  EXPECT_TRUE(parsed_json(R"(["{{{{[[[[,,,,\"[[[[", "\\"])", 5));  // in texts they count for nothing
  EXPECT_TRUE(parsed_json(std::string(64, '[') + std::string(64, ']')));
  EXPECT_FALSE(parsed_json(std::string(65, '[') + std::string(65, ']')));
  EXPECT_FALSE(parsed_json("/* \" */ [0,0,0] /* \" */", 3));  // nor can a comment hide them
  for (const char* text : {"", "{", "[1", "\"", "\"\\", "{\"a\"}", "]"}) EXPECT_FALSE(parsed_json(text)) << text;
}

TEST_F(Limits, PathsOfOverridesAre64Levels) {
  const auto told = [&](const std::string& step, std::size_t levels) {
    std::string path = "title";
    for (std::size_t k = 1; k < levels; ++k) path += step;
    return faults(around_body(""), {path + "=1"});
  };
  EXPECT_FALSE(has(told(".a", 64).at(0), "nested more than"));
  EXPECT_TRUE(told(".a", 65).at(0).ends_with(".a: nested more than 64 levels deep"));
  for (const char* step : {".a", "[0]"}) {
    const Lines deep = told(step, 1'000'000);
    ASSERT_EQ(deep.size(), 1U);
    EXPECT_TRUE(has(deep[0], "...: nested more than 64 levels deep")) << deep[0];
    EXPECT_LT(deep[0].size(), 400U);
  }
}

TEST_F(Limits, ASceneHoldsTwoMillionValues) {
  std::string list = "[";
  for (int i = 0; i < 2'000'001; ++i) list += "0,";
  EXPECT_EQ(faults(list + "0]"), (Lines{"s.json:1: holds more than 2000000 values"}));
}

TEST_F(Limits, AListHoldsTenThousandGroups) {
  std::string groups = "{\"spacing\": 0.1, \"time\": {\"end\": 1}, \"bodies\": [";
  for (int i = 0; i <= 10'000; ++i) groups += i == 0 ? "{}" : ",{}";
  EXPECT_EQ(faults(groups + "]}"), (Lines{"s.json:1: bodies: has more than 10000 entries"}));
}

TEST_F(Limits, OnlyAHundredFaultsAreTold) {
  std::string keys;
  for (int i = 0; i < 5000; ++i) keys += "\"k" + std::to_string(i) + "\": 0, ";
  const Lines told = faults(around_body(keys));
  ASSERT_EQ(told.size(), 101U);
  EXPECT_EQ(told.back(), "s.json: more than 100 faults");
}

TEST_F(Limits, NoMoreFaultsAreCollectedThanAreTold) {
  Scene scene = read_resolved_text(around_body("\"emitters\": [], "), "s.json").scene;
  Emitter emitter;
  emitter.shape = Disc{0.1};
  emitter.times.assign(1'000'000, 0);
  scene.emitters = {emitter};
  EXPECT_LE(validate(scene).size(), 101U);
  scene.emitters[0].times.assign(1'000'000, -1);  // each out of its range
  EXPECT_LE(validate(scene).size(), 101U + 101U);
  scene.output.columns.assign(1'000'000, "nothing");
  scene.output.formats.assign(1'000'000, "nothing");
  EXPECT_EQ(check_output(scene).size(), 101U);
}

TEST_F(Limits, StepsThatDoNotMoveTheTime) {
  const auto told = [&](const std::vector<std::string>& overrides) { return faults(around_body(""), overrides); };
  EXPECT_EQ(told({"time.fixed_dt=1e-14"}), Lines{});
  EXPECT_EQ(told({"time.fixed_dt=1e-16"}),
            (Lines{"--set time.fixed_dt: 1e-16 s is less than 1e-15 of time.end, 1 s: the time could not be told from "
                   "that before the step"}));
  EXPECT_EQ(told({"time.dt_max=1e-300", "time.dt_min=1e-300"}).size(), 1U);
  EXPECT_EQ(told({"time.dt_max=1e-300", "time.dt_min=1e-300", "time.fixed_dt=0.1"}), Lines{});
}

TEST_F(Limits, NothingOfAFileSteersTheTerminal) {
  EXPECT_EQ(printable("a\x1b[31m\x07\r\nb\x7f"), "a?[31m???b?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J \xc3\xa4 \xc2\xb5"),
            "?2J \xc3\xa4 \xc2\xb5");
  EXPECT_EQ(printable(std::string(1000, 'x')), std::string(60, 'x') + "...");
  std::vector<std::string> names(20'000, "c\x1b[2J");
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const std::string hint = spelling_hint("nope nope nope", candidates, "fields");
  EXPECT_EQ(hint.find('\x1b'), std::string::npos);
  EXPECT_LT(hint.size(), 1000U);
  EXPECT_EQ(spelling_hint("colour", std::vector<std::string_view>{"colou\x1b"}, "fields"),
            " (did you mean \"colou?\"?)");
}

TEST_F(Limits, HugeTextsAndTitlesThatWouldSteerATerminal) {
  EXPECT_EQ(faults(around_body("\"title\": \"a\\u001b[2Jb\", ")),
            (Lines{"s.json:1: title: may not hold control characters"}));
  EXPECT_EQ(faults(around_body("\"title\": \"" + std::string(1'000'000, 'x') + "\", ")), Lines{});
  const Lines told = faults(around_body("\"" + std::string(1'000'000, 'x') + "\": 0, "));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_LT(told.front().size(), 400U);
}

TEST_F(Limits, MeshesLieInTheFolderOfTheirScene) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::filesystem::create_directories(folder_ / "scenes" / "meshes");
  write("outside.obj", obj);
  write("scenes/meshes/inside.obj", obj);
  std::filesystem::create_symlink(folder_ / "outside.obj", folder_ / "scenes" / "link.obj");
  std::filesystem::create_symlink(folder_ / "scenes" / "meshes", folder_ / "scenes" / "short");
  const auto told = [&](const std::string& mesh, const std::vector<std::string>& overrides = {}) {
    return faults_of(write("scenes/s.json", around_body("\"solids\": [{\"shape\": {\"type\": \"mesh\", \"file\": \"" +
                                                        mesh + "\"}}], ")),
                     overrides);
  };
  const auto refused = [](const std::string& mesh) {
    return Lines{"scenes/s.json:1: solids[0].shape.file: \"" + mesh +
                 "\" lies outside the scene's folder: --allow-outside lets a scene read there, or move the file beside "
                 "the scene"};
  };
  EXPECT_EQ(told("meshes/inside.obj"), Lines{});
  EXPECT_EQ(told("short/inside.obj"), Lines{});
  EXPECT_EQ(told("meshes/../meshes/inside.obj"), Lines{});
  EXPECT_EQ(told((folder_ / "scenes/meshes/inside.obj").string()), Lines{});
  EXPECT_EQ(told("../outside.obj"), refused("../outside.obj"));
  EXPECT_EQ(told("meshes/../../outside.obj"), refused("meshes/../../outside.obj"));
  EXPECT_EQ(told("../scenes2/none.obj"), refused("../scenes2/none.obj"));  // nor is told whether it is there
  EXPECT_EQ(told("link.obj"), refused("link.obj"));
  EXPECT_EQ(told("/etc/x.obj"), refused("/etc/x.obj"));
  EXPECT_EQ(told("meshes/inside.obj", {"solids[0].shape.file=../outside.obj"}), Lines{});  // the user's own word
  const auto file = write(
      "scenes/s.json", around_body("\"solids\": [{\"shape\": {\"type\": \"mesh\", \"file\": \"../outside.obj\"}}], "));
  EXPECT_NO_THROW(read_resolved_scene(file, {}, {}, MeshPlaces::anywhere));
}

TEST_F(Limits, WhatIsNoFileIsNotWaitedFor) {
  const auto pipe = folder_ / "pipe.json";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(why([&] { read_input(pipe, 100); }), "it is a pipe");
  EXPECT_EQ(read_input(pipe, 100, Input::file_or_pipe), "");  // no writer: nothing comes
  EXPECT_EQ(why([&] { read_input("/dev/zero", 100); }), "it is a device");
  EXPECT_EQ(why([&] { read_input("/dev/zero", 100, Input::file_or_pipe); }), "it is a device");
  EXPECT_EQ(why([&] { read_input(folder_, 100); }), "it is a folder");
  EXPECT_EQ(why([&] { read_input(folder_ / "none", 100); }), "No such file or directory");
  EXPECT_EQ(read_input(write("100", std::string(100, 'x')), 100).size(), 100U);
  EXPECT_EQ(why([&] { read_input(write("2m", std::string(2 << 20, 'x')), 1 << 20); }), "it is larger than 1 MiB");
  EXPECT_EQ(read_beginning(folder_ / "100", 7), "xxxxxxx");
  // Every reader goes through it.
  EXPECT_EQ(faults_of("/dev/zero"), (Lines{"/dev/zero: cannot be read: it is a device"}));
  EXPECT_EQ(why([&] { read_frame("/dev/zero"); }), "cannot read /dev/zero: it is a device");
  EXPECT_EQ(faults("").size(), 1U);
  EXPECT_EQ(faults("\xff\xfe{}").size(), 1U);
}

/// Each would take 10^12 points, and more memory than there is to find it out by trying.
TEST_F(Limits, HugeCountsAreRefusedAtOnce) {
  const std::vector<std::string> scenes{
      "bodies[0].shape.size=[1000, 1000, 1000]",
      "bodies[0].shape.size=[1e300, 1e300, 1e300]",
      "bodies[0].shape.size=[0.1, 0.1, 1e11]",
      R"(bodies[0].shape={"type": "sphere", "radius": 1e4})",
      R"(bodies[0].shape={"type": "cylinder", "radius": 1e200, "height": 1e200})",
      R"(solids[0].shape={"type": "box", "size": [1e6, 1e6, 1e6]})",
      R"(solids[0].shape={"type": "box", "size": [1e200, 1e200, 1e200]})",
      R"(solids[0].shape={"type": "container", "size": [1e-9, 1e-9, 1e11]})",
      R"(solids[0].shape={"type": "plate", "width": 1e11, "depth": 1e-9})",
      R"(solids[0].shape={"type": "sphere", "radius": 1e6})",
      R"(solids[0].shape={"type": "cylinder", "radius": 1e-200, "height": 1e11})",
      R"(solids[0].shape={"type": "cylinder", "radius": 1e300, "height": 1e-300})",
      R"(emitters[0]={"shape": {"type": "rectangle", "width": 1e5, "depth": 1e5}, "interval": 1})",
      R"(emitters[0]={"shape": {"type": "disc", "radius": 1e300}, "interval": 1})",
      R"(domain={"min": [-1e6, -1e6, -1e6], "max": [1e6, 1e6, 1e6], "x": "closed", "y": "closed", "z": "closed"})",
  };
  for (const std::string& override_ : scenes) {
    SCOPED_TRACE(override_);
    const std::vector<std::string> overrides{override_};
    const Scene scene =
        read_resolved_text(around_body("\"solids\": [], \"emitters\": [], "), "s.json", overrides).scene;
    EXPECT_TRUE(has(message_of<SceneError>([&] { Simulation{scene}; }), "a larger spacing needs fewer"));
  }
}

TEST_F(Limits, ThinBodiesHoldNothingHoweverLong) {
  Body body;
  for (const Vec3d& size : {Vec3d{1e300, 1e300, 1e-300}, Vec3d{1e9, 1e9, 0.01}}) {
    body.shape = Box{size};
    EXPECT_EQ(message_of<SceneError>([&] { fill(body, 0.1); }),
              "body (box): is too small to hold a particle of spacing 0.1 m");
  }
}

TEST_F(Limits, NeedlesOfMeshesAreCounted) {
  TriangleMesh needle = make_mesh({{0, 0, 0}, {1e11, 0, 0}, {1e11, 1e-3, 0}}, {{0, 1, 2}});
  EXPECT_GT(estimate_mesh(needle, 0.1), 0.99e12);
  EXPECT_TRUE(has(message_of<SceneError>([&] { sample_mesh(needle, 0.1, 1, "needle"); }), "points at this spacing"));
  const TriangleMesh apart = make_mesh(
      {{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}, {1e11, 0, 0}, {1e11, 1e-3, 0}, {1e11, 0, 1e-3}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(message_of<SceneError>([&] { sample_mesh(apart, 1e-5, 1, "m"); }),
            "m: is more than 1e+15 sample distances wide");
}

TEST_F(Limits, CountsInHeadersOfMeshesThatLie) {
  const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex 1e300\nproperty float x\nend_header\n";
  EXPECT_EQ(why([&] { parse_ply(head + "abcd"); }), "its numbers end too early");
  std::string stl(84, ' ');
  const std::uint32_t count = 0xffffffffU;
  std::memcpy(stl.data() + 80, &count, 4);
  EXPECT_EQ(why([&] { parse_stl(stl + std::string(50, 'x')); }), "is no STL file, or its end is missing");
  EXPECT_EQ(why([&] { check_parts(50'000'001, "faces"); }), "it has more than 50000000 faces");
}

Snapshot calm(std::size_t n) { return {0, 0, std::vector<float>(3 * n), {}}; }

TEST_F(Limits, FramesThatUnpackToMoreThanMemoryAreRefused) {
  const std::string bytes = encode_vtp(calm(200'000));
  EXPECT_EQ(parse_vtp_frame(bytes, 2'400'000).size(), 200'000U);
  EXPECT_EQ(why([&] { parse_vtp_frame(bytes, 2'399'999); }), "it unpacks to more than there is memory for");
}

TEST_F(Limits, XmlOfFramesIsBounded) {
  std::string bytes = encode_vtp(calm(3));
  const std::string not_ours = "it is a VTK file, but no frame that `sessile run` wrote";
  const auto at = bytes.find("<PolyData>");
  ASSERT_NE(at, std::string::npos);
  std::string much = bytes;
  for (int i = 0; i < 18; ++i) much.insert(at, std::string(60'000, ' '));
  EXPECT_EQ(why([&] { parse_vtp_frame(much); }), not_ours);
  // Entities are not expanded: the name of a file is then no name.
  bytes.insert(bytes.find("<VTKFile"), "<!DOCTYPE a [<!ENTITY b \"3\">]>");
  const auto count = bytes.find("NumberOfPoints=\"3\"");
  ASSERT_NE(count, std::string::npos);
  bytes.replace(count, 18, "NumberOfPoints=\"&b;\"");
  EXPECT_EQ(why([&] { parse_vtp_frame(bytes); }), not_ours);
}

TEST_F(Limits, LinksInTheOutputFolderAreNotFollowed) {
  const auto precious = write("precious", "mine");
  const auto link = [&](const std::string& name) {
    std::filesystem::create_symlink(precious, folder_ / name);
    return folder_ / name;
  };
  const auto frame = link("frame_000001.ply");
  write_whole(frame, "frame");
  EXPECT_FALSE(std::filesystem::is_symlink(frame));
  EXPECT_EQ(read_file(frame), "frame");
  link(".frame_000002.ply.part");  // a temporary name can be guessed
  write_whole(folder_ / "frame_000002.ply", "frame");
  EXPECT_EQ(read_file(folder_ / "frame_000002.ply"), "frame");
  {
    LineFile stats(link("stats.csv"));
    stats.append("a,b\n");
  }
  EXPECT_EQ(read_file(folder_ / "stats.csv"), "a,b\n");
  std::filesystem::create_hard_link(precious, folder_ / "hard.csv");
  LineFile(folder_ / "hard.csv").append("x\n");
  EXPECT_THROW(finish_part(folder_ / "none"), FileError);
  EXPECT_EQ(read_file(precious), "mine");
}

}  // namespace
}  // namespace sessile::test
