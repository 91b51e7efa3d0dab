#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "mesh/selection.h"
#include "mesh/surface_index.h"
#include "mesh/vdb.h"
#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "sessile/output/surfaces.h"
#include "sessile/scene/solid_mesh.h"
#include "unit/temporary_folder.h"

namespace sessile::app {
namespace {

using test::message_of;
using Places = std::vector<std::size_t>;

TEST(Selection, IsAsInPython) {
  EXPECT_EQ(selected(":", 4), (Places{0, 1, 2, 3}));
  EXPECT_EQ(selected("1:3", 4), (Places{1, 2}));
  EXPECT_EQ(selected("-2:", 4), (Places{2, 3}));
  EXPECT_EQ(selected(":-3", 4), (Places{0}));
  EXPECT_EQ(selected("::2", 5), (Places{0, 2, 4}));
  EXPECT_EQ(selected("1::3", 5), (Places{1, 4}));
  EXPECT_EQ(selected("7:9", 4), Places{});
  EXPECT_EQ(selected("3:1", 4), Places{});
  EXPECT_EQ(selected("-99:99", 2), (Places{0, 1}));
  EXPECT_EQ(selected("::9223372036854775807", 3), (Places{0}));
  EXPECT_EQ(selected("3,0,-1,0", 4), (Places{0, 3}));
  EXPECT_EQ(selected("0,2:", 4), (Places{0, 2, 3}));
}

TEST(Selection, SaysWhatIsWrong) {
  EXPECT_EQ(message_of<Error>([] { selected("4", 4); }), "there is no frame 4: there are 4");
  EXPECT_EQ(message_of<Error>([] { selected("-5", 4); }), "there is no frame -5: there are 4");
  EXPECT_EQ(message_of<Error>([] { selected("2:x", 4); }),
            "expected frames such as 10:20, ::5 or 0,3,-1, found \"2:x\"");
  EXPECT_THROW(selected("", 4), Error);
  EXPECT_THROW(selected("1,", 4), Error);
  EXPECT_THROW(selected("::0", 4), Error);
  EXPECT_THROW(selected("::-1", 4), Error);
  EXPECT_THROW(selected("1:2:3:4", 4), Error);
  EXPECT_THROW(selected("99999999999999999999", 4), Error);
}

TEST(SurfaceIndexes, AreReadBack) {
  test::TemporaryFolder folder;
  SurfaceIndex index;
  index.source = "..";
  index.spacing = 0.1 + 0.2;
  index.settings = R"({"cube_size": 0.75})";
  index.frames = {{0, 0, {"surface_000000.ply"}, 12}, {7, 1.0 / 3, {"surface_000007.ply", "surface.usda"}, 5}};
  index.solids = {{"a \"b\"", "solid_000.ply"}};
  write_whole(folder / "surface.json", index_json(index));
  const SurfaceIndex back = read_index(folder / "surface.json");
  EXPECT_TRUE(back.same_origin(index));
  ASSERT_EQ(back.frames.size(), 2u);
  EXPECT_EQ(back.frames[1].time, 1.0 / 3);
  EXPECT_EQ(back.frames[1].files, index.frames[1].files);
  EXPECT_EQ(back.frames[1].triangles, 5u);
  EXPECT_EQ(back.solids.at(0).label, "a \"b\"");
}

TEST(SurfaceIndexes, OfOthersAreEmpty) {
  test::TemporaryFolder folder;
  for (const char* text : {"", "[]", "{\"version\": 2}", "{\"version\": 1, \"frames\": [3]}", "{\"version\": \"x\"}"}) {
    write_whole(folder / "surface.json", text);
    EXPECT_TRUE(read_index(folder / "surface.json").frames.empty()) << text;
  }
  // Files elsewhere are never ours to remove.
  write_whole(folder / "surface.json",
              R"({"version": 1, "frames": [{"number": 0, "time": 0, "triangles": 1,
                  "files": ["surface/../../x.ply", "/etc/passwd", "notes.txt", "surface_000000.ply"]}]})");
  const SurfaceIndex index = read_index(folder / "surface.json");
  ASSERT_EQ(index.frames.size(), 1u);
  EXPECT_EQ(index.frames[0].files, std::vector<std::string>{"surface_000000.ply"});
}

TEST(SurfaceVdb, IsALevelSetOfTheMesh) {
  test::TemporaryFolder folder;
  Scene scene;
  scene.solids.emplace_back().shape = Sphere{0.5};
  scene.solids[0].placement.position = {1, 2, 3};
  const SurfaceMesh ball = as_surface(solid_meshes(scene).at(0).mesh);
  write_vdb(folder / "ball.vdb", ball, 0.05);
  EXPECT_EQ(folder.entries(), 1u);
  openvdb::io::File file((folder / "ball.vdb").string());
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_EQ(grid->metaValue<std::string>("units"), "m");
  const auto at = [&](double x, double y, double z) {
    const auto place = grid->transform().worldToIndexNodeCentered({x, y, z});
    return grid->getConstAccessor().getValue(place);
  };
  EXPECT_NEAR(at(1.5, 2, 3), 0, 0.01);
  EXPECT_NEAR(at(1.6, 2, 3), 0.1, 0.01);
  EXPECT_NEAR(at(1, 2, 3.4), -0.1, 0.01);
  EXPECT_LT(at(1, 2, 3), 0);
  EXPECT_GT(at(0, 0, 0), 0);
}

TEST(SurfaceVdb, OfNoLiquidIsAnEmptyGrid) {
  test::TemporaryFolder folder;
  write_vdb(folder / "none.vdb", {}, 0.05);
  openvdb::io::File file((folder / "none.vdb").string());
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->activeVoxelCount(), 0u);
  EXPECT_THROW(write_vdb(folder.path() / "none" / "x.vdb", {}, 0.05), FileError);
}

}  // namespace
}  // namespace sessile::app
