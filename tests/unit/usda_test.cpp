#include "sessile/output/usda.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "sessile/core/error.h"
#include "sessile/scene/mesh_files.h"
#include "unit/python.h"
#include "unit/small_disk.h"
#include "unit/surface_samples.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::python;
using test::python_named_by;
using test::read_file;
using test::TemporaryFolder;
using test::tetrahedron_with_columns;

std::string usda_of(const std::filesystem::path& file, int frames) {
  UsdaWriter writer(file, 25);
  for (int k = 0; k < frames; ++k) {
    SurfaceMesh mesh = k == 1 ? SurfaceMesh{} : tetrahedron_with_columns(0.04 * k);
    mesh.time = 0.04 * k;
    writer.add(mesh);
  }
  const SolidMesh solid{"my 1st", make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  writer.finish({0, 1, 0}, std::vector<SolidMesh>{solid, solid});
  return read_file(file);
}

TEST(SurfaceUsda, HoldsEveryFrame) {
  TemporaryFolder folder;
  const std::string text = usda_of(folder / "surface.usda", 3);
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  for (const char* part :
       {"upAxis = \"Y\"", "metersPerUnit = 1\n", "timeCodesPerSecond = 25\n", "endTimeCode = 2\n",
        "def Mesh \"surface\"", "def Mesh \"my_1st\"", "def Mesh \"my_1st_\"", "subdivisionScheme = \"none\"",
        "        point3f[] points.timeSamples = {\n            0: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, "
        "0.33333334)],\n"
        "            1: [],\n            2: [(0",
        "int64[] primvars:id.timeSamples = {\n            0: [5, 6, 7, -8],\n",
        "        float[] primvars:density (\n            interpolation = \"vertex\"\n        )\n"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(SurfaceUsda, OpensInUsd) {
  TemporaryFolder folder;
  usda_of(folder / "surface.usda", 3);
  const auto said = python(python_named_by("SESSILE_USD_PYTHON", "python3"), "pxr",
                           fmt::format(R"(
from pxr import Usd, UsdGeom
stage = Usd.Stage.Open("{}")
mesh = UsdGeom.Mesh.Get(stage, "/World/surface")
print(UsdGeom.GetStageUpAxis(stage), UsdGeom.GetStageMetersPerUnit(stage), stage.GetEndTimeCode())
for t in mesh.GetPointsAttr().GetTimeSamples():
    points, counts = mesh.GetPointsAttr().Get(t), mesh.GetFaceVertexCountsAttr().Get(t)
    good, why = UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(t), counts, len(points))
    print(t, len(points), len(counts), good, len(mesh.GetVelocitiesAttr().Get(t)))
print(sorted(p.GetPrimvarName() for p in UsdGeom.PrimvarsAPI(mesh).GetPrimvarsWithAuthoredValues()))
print([p.GetName() for p in stage.Traverse()])
)",
                                       (folder / "surface.usda").string()));
  if (!said) GTEST_SKIP() << "usd-core is not installed";
  EXPECT_EQ(*said,
            "Y 1.0 2.0\n0.0 4 4 True 4\n1.0 0 0 True 4\n2.0 4 4 True 4\n['density', 'id', 'normal']\n"
            "['World', 'surface', 'my_1st', 'my_1st_']\n");
}

TEST(SurfaceUsda, LeavesNothingBehindWhenItFails) {
  TemporaryFolder folder;
  {
    UsdaWriter writer(folder / "surface.usda", 25);
    writer.add(tetrahedron_with_columns());
    EXPECT_GT(folder.entries(), 0u);
  }
  EXPECT_EQ(folder.entries(), 0u);
  const test::SmallDisk disk(100);
  EXPECT_THROW(usda_of(folder / "surface.usda", 9), FileError);
  EXPECT_EQ(folder.entries(), 0u);
}

/// The text that four frames make when a writer stopped after `stopped` of them, and one goes on after `kept`.
std::string resumed_usda(const std::filesystem::path& file, int stopped, int kept, bool killed) {
  const auto add = [](UsdaWriter& writer, int from, int to) {
    for (int k = from; k < to; ++k) {
      SurfaceMesh mesh = k == 1 ? SurfaceMesh{} : tetrahedron_with_columns(0.04 * k);
      mesh.time = 0.1 + 0.04 * k;
      writer.add(mesh);
    }
  };
  if (stopped > 0) {
    UsdaWriter writer(file, 30);
    if (killed) writer.leave_parts();
    add(writer, 0, stopped);
    if (!killed) writer.finish({0, 0, 1}, {});
  }
  UsdaWriter writer(file, 30, static_cast<std::size_t>(kept), 0.1 + 0.04 * (kept - 1));
  add(writer, kept, 4);
  writer.finish({0, 0, 1}, {});
  return read_file(file);
}

TEST(SurfaceUsda, GoesOnWhereAWriterWasStopped) {
  TemporaryFolder folder;
  const std::string whole = resumed_usda(folder / "whole.usda", 0, 0, false);
  for (const bool killed : {false, true}) {
    for (const int stopped : {2, 4}) {
      EXPECT_EQ(resumed_usda(folder / "surface.usda", stopped, 2, killed), whole) << killed << stopped;
      EXPECT_EQ(folder.entries(), 2u);
      std::filesystem::remove(folder / "surface.usda");
    }
  }
  EXPECT_THROW(resumed_usda(folder / "surface.usda", 2, 3, false), FileError);
  EXPECT_THROW(resumed_usda(folder / "none.usda", 0, 2, false), FileError);
}

/// Adds frames of one size of tetrahedra, so that others can be told from them.
void add_frames(UsdaWriter& writer, int from, int to, double size) {
  for (int k = from; k < to; ++k) {
    SurfaceMesh mesh = tetrahedron_with_columns(size);
    mesh.time = 0.04 * k;
    writer.add(mesh);
  }
}

// A finished file, a writer that goes on with it from an earlier frame and is killed, one that goes on with that.
TEST(SurfaceUsda, GoesOnWithItsPartsAndNotWithAnEarlierEnd) {
  TemporaryFolder folder;
  const auto whole = folder / "whole.usda", file = folder / "surface.usda";
  {
    UsdaWriter writer(whole, 25);
    add_frames(writer, 0, 2, 1);
    add_frames(writer, 2, 6, 2);
    writer.finish({0, 0, 1}, {});
  }
  {
    UsdaWriter first(file, 25);
    add_frames(first, 0, 4, 1);
    first.finish({0, 0, 1}, {});
  }
  {
    UsdaWriter second(file, 25, 2, 0.04);
    add_frames(second, 2, 5, 2);
  }
  EXPECT_FALSE(std::filesystem::exists(file)) << "it is of another past than the parts";
  UsdaWriter third(file, 25, 4, 0.12);
  add_frames(third, 4, 6, 2);
  third.finish({0, 0, 1}, {});
  EXPECT_EQ(read_file(file), read_file(whole));
}

/// What a writer says that goes on with two frames in these parts and adds a third.
std::string gone_on_with(const std::filesystem::path& file, const std::vector<std::string>& parts) {
  remove_usda_parts(file);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::ofstream(file.parent_path() / fmt::format(".{}.{}.part", file.filename().string(), k)) << parts[k];
  }
  try {
    UsdaWriter writer(file, 25, 2, 0.04);
    add_frames(writer, 2, 3, 1);
    writer.finish({0, 0, 1}, {});
  } catch (const FileError& error) {
    return error.what();
  }
  return "went on";
}

TEST(SurfaceUsda, TakesNoPartThatItCannotHaveWritten) {
  TemporaryFolder folder;
  const auto file = folder / "surface.usda";
  const std::string points = "point3f[] points|\n", first = "            0: [(0, 0, 0)],\n";
  const std::string second = "            1: [(1, 0, 0)],\n";
  EXPECT_EQ(gone_on_with(file, {points + first + second}), "went on");
  EXPECT_NO_THROW(UsdaWriter(file, 25, 3, 0.08)) << "what was gone on with can be gone on with again";
  std::filesystem::remove(file);
  const std::vector<std::vector<std::string>> others{{points + first, points + first},
                                                     {points + first + "            1: [(1, 0, 0)],.timeSamples = {\n"},
                                                     {points + first + "            1: [(1, 0,\n"},
                                                     {points + first + "            -inf: [(1, 0, 0)],\n"},
                                                     {points + first + "            1: 0,\n"},
                                                     {"point3f[] points (\n" + first + second},
                                                     {"float[] a.timeSamples = {|\n", points + first + second},
                                                     {"|\n", points + first + second}};
  for (const auto& parts : others) {
    EXPECT_NE(gone_on_with(file, parts).find("it lacks frames"), std::string::npos) << parts.front() << parts.back();
  }
}

TEST(SurfaceUsda, LeavesWhatItCannotGoOnWith) {
  TemporaryFolder folder;
  const auto file = folder / "surface.usda";
  {
    UsdaWriter first(file, 25);
    first.leave_parts();
    add_frames(first, 0, 3, 1);
  }
  const std::size_t parts = folder.entries();
  EXPECT_THROW(UsdaWriter(file, 25, 4, 0.12), FileError);
  EXPECT_EQ(folder.entries(), parts);
  EXPECT_NO_THROW(UsdaWriter(file, 25, 3, 0.08));
  EXPECT_EQ(folder.entries(), parts) << "nothing was finished, so that another may go on";
  UsdaWriter anew(file, 25);
  EXPECT_EQ(folder.entries(), 0u) << "those of another past";
}

}  // namespace
}  // namespace sessile
