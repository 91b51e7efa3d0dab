#include "sessile/output/surfaces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

#include "sessile/core/error.h"
#include "sessile/output/check.h"
#include "sessile/output/usda.h"
#include "sessile/scene/mesh_files.h"
#include "unit/small_disk.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::read_file;
using test::TemporaryFolder;

/// A tetrahedron that carries columns of every kind.
SurfaceMesh tetrahedron(double time = 0.1) {
  SurfaceMesh mesh;
  mesh.time = time;
  mesh.step = 42;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.0F / 3};
  mesh.normals = {-1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  mesh.columns.push_back({"id", "", 1, std::vector<std::int64_t>{5, 6, 7, -8}});
  mesh.columns.push_back({"velocity", "m/s", 3, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0.1F}});
  mesh.columns.push_back({"density", "kg/m^3", 1, std::vector<float>{1000, 1001, 999.5F, 1e-20F}});
  mesh.columns.push_back({"normal", "", 3, std::vector<float>(12, 0.5F)});
  return mesh;
}

TEST(SurfaceFormats, AreFoundByName) {
  for (const SurfaceFormat& format : surface_formats()) EXPECT_EQ(find_surface_format(format.name), &format);
  EXPECT_EQ(find_surface_format("stl"), nullptr);
  EXPECT_EQ(surface_file_name(12, "ply"), "surface_000012.ply");
}

TEST(SurfacePly, IsWhatTheFormatSays) {
  const SurfaceMesh mesh = tetrahedron();
  const std::string bytes = encode_surface_ply(mesh);
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment Sessile surface, time 0.1 s, step 42\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property int id\nproperty float vx\nproperty float vy\nproperty float vz\nproperty float density\n"
      "property float normal_x\nproperty float normal_y\nproperty float normal_z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  ASSERT_EQ(bytes.substr(0, head.size()), head);
  const std::size_t width = 14;
  ASSERT_EQ(bytes.size(), head.size() + 4 * width * 4 + 4 * 13);
  std::vector<float> row(width);
  std::memcpy(row.data(), bytes.data() + head.size() + 3 * width * 4, width * 4);
  EXPECT_EQ(row[2], 1.0F / 3);
  EXPECT_EQ(row[5], 1);
  EXPECT_EQ(row[9], 0.1F);
  EXPECT_EQ(row[10], 1e-20F);
  // The reader of meshes takes it too.
  const TriangleSoup soup = parse_ply(bytes);
  ASSERT_EQ(soup.triangles.size(), 4u);
  EXPECT_EQ(soup.triangles[3], (std::array<std::uint32_t, 3>{0, 3, 2}));
  EXPECT_EQ(soup.corners[3].z, static_cast<double>(1.0F / 3));
}

TEST(SurfacePly, RefusesNumbersThatDoNotFit) {
  SurfaceMesh mesh = tetrahedron();
  std::get<std::vector<std::int64_t>>(mesh.columns[0].values)[2] = 3'000'000'000;
  EXPECT_EQ(message_of<Error>([&] { encode_surface_ply(mesh); }),
            "PLY holds whole numbers of 32 bits only; id reached 3000000000");
}

TEST(SurfaceObj, IsReadBack) {
  const std::string text = encode_surface_obj(tetrahedron());
  EXPECT_NE(text.find("\nv 0 0 0.33333334\n"), std::string::npos);
  EXPECT_NE(text.find("\nvn 1 0 0\n"), std::string::npos);
  EXPECT_NE(text.find("\nf 1//1 4//4 3//3\n"), std::string::npos);
  const TriangleSoup soup = parse_obj(text);
  EXPECT_EQ(soup.corners.size(), 4u);
  EXPECT_EQ(soup.triangles.size(), 4u);
  EXPECT_EQ(static_cast<float>(soup.corners[3].z), 1.0F / 3);
}

TEST(SurfaceFiles, OfNoLiquidHoldNothing) {
  const SurfaceMesh nothing;
  const TriangleSoup soup = parse_ply(encode_surface_ply(nothing));
  EXPECT_TRUE(soup.corners.empty());
  EXPECT_TRUE(soup.triangles.empty());
  EXPECT_EQ(encode_surface_obj(nothing), "# Sessile surface, time 0 s, step 0\n");
  EXPECT_NE(encode_surface_vtp(nothing).find("NumberOfPolys=\"0\""), std::string::npos);
}

TEST(SurfaceFiles, OfSolidsHaveNoNormals) {
  const auto mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const std::string ply = encode_surface_ply(as_surface(mesh));
  EXPECT_EQ(ply.find("nx"), std::string::npos);
  EXPECT_EQ(parse_ply(ply).triangles.size(), 1u);
  EXPECT_NE(encode_surface_obj(as_surface(mesh)).find("\nf "), std::string::npos);
  EXPECT_EQ(encode_surface_obj(as_surface(mesh)).find("//"), std::string::npos);
}

/// What Python says of a script, which must end well; nothing where a module is missing.
std::optional<std::string> python(const std::string& interpreter, const std::string& module,
                                  const std::string& script) {
  if (std::system(fmt::format("{} -c 'import {}' >/dev/null 2>&1", interpreter, module).c_str()) != 0) return {};
  TemporaryFolder folder;
  std::ofstream(folder / "script.py") << script;
  const std::string command =
      fmt::format("{} {} > {}", interpreter, (folder / "script.py").string(), (folder / "out.txt").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << script;
  return read_file(folder / "out.txt");
}

TEST(SurfaceVtp, OpensInVtk) {
  TemporaryFolder folder;
  std::ofstream(folder / "s.vtp", std::ios::binary) << encode_surface_vtp(tetrahedron());
  std::ofstream(folder / "n.vtp", std::ios::binary) << encode_surface_vtp({});
  const auto said = python("/usr/bin/python3", "vtkmodules.vtkIOXML",
                           fmt::format(R"(
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
for name in ("s", "n"):
    r = vtkXMLPolyDataReader(); r.SetFileName("{}/" + name + ".vtp"); r.Update(); p = r.GetOutput(); d = p.GetPointData()
    print(p.GetNumberOfPoints(), p.GetNumberOfPolys(), d.GetNormals().GetName(), p.GetFieldData().GetArray("TimeValue").GetValue(0))
    print([(d.GetArrayName(i), d.GetArray(i).GetNumberOfComponents()) for i in range(d.GetNumberOfArrays())])
    if name == "s": print([p.GetCell(3).GetPointId(k) for k in range(3)], p.GetPoint(3), d.GetArray("id").GetValue(3))
)",
                                       folder.path().string()));
  if (!said) GTEST_SKIP() << "python3-vtk9 is not installed";
  const std::string arrays = "[('Normals', 3), ('id', 1), ('velocity', 3), ('density', 1), ('normal', 3)]\n";
  EXPECT_EQ(*said, "4 4 Normals 0.1\n" + arrays +
                       "[0, 3, 2] (0.0, 0.0, 0.3333333432674408) -8\n0 0 Normals 0.0\n[('Normals', 3)]\n");
}

std::string usda_of(const std::filesystem::path& file, int frames) {
  UsdaWriter writer(file, 25);
  for (int k = 0; k < frames; ++k) {
    SurfaceMesh mesh = k == 1 ? SurfaceMesh{} : tetrahedron(0.04 * k);
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
  const auto said = python("python3", "pxr",
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
    writer.add(tetrahedron());
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
      SurfaceMesh mesh = k == 1 ? SurfaceMesh{} : tetrahedron(0.04 * k);
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
    SurfaceMesh mesh = tetrahedron(size);
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

TEST(CheckOutput, NamesUnknownFormatsOfSurfaces) {
  Scene scene;
  scene.output.surface.emplace().formats = {"ply", "usd"};
  const auto faults = check_output(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(text(faults[0]), "output.surface.formats[1]: unknown format \"usd\" (did you mean \"usda\"?)");
}

}  // namespace
}  // namespace sessile
