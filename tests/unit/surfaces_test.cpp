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
#include "sessile/scene/mesh_files.h"
#include "unit/python.h"
#include "unit/surface_samples.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::python;
using test::python_named_by;
using test::read_file;
using test::TemporaryFolder;
using test::tetrahedron_with_columns;

TEST(SurfaceFormats, AreFoundByName) {
  for (const SurfaceFormat& format : surface_formats()) EXPECT_EQ(find_surface_format(format.name), &format);
  EXPECT_EQ(find_surface_format("stl"), nullptr);
  EXPECT_EQ(surface_file_name(12, "ply"), "surface_000012.ply");
}

TEST(SurfacePly, IsWhatTheFormatSays) {
  const SurfaceMesh mesh = tetrahedron_with_columns();
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
  SurfaceMesh mesh = tetrahedron_with_columns();
  std::get<std::vector<std::int64_t>>(mesh.columns[0].values)[2] = 3'000'000'000;
  EXPECT_EQ(message_of<Error>([&] { encode_surface_ply(mesh); }),
            "PLY holds whole numbers of 32 bits only; id reached 3000000000");
}

TEST(SurfaceObj, IsReadBack) {
  const std::string text = encode_surface_obj(tetrahedron_with_columns());
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

TEST(SurfaceVtp, OpensInVtk) {
  TemporaryFolder folder;
  std::ofstream(folder / "s.vtp", std::ios::binary) << encode_surface_vtp(tetrahedron_with_columns());
  std::ofstream(folder / "n.vtp", std::ios::binary) << encode_surface_vtp({});
  const auto said = python(python_named_by("SESSILE_VTK_PYTHON", "/usr/bin/python3"), "vtkmodules.vtkIOXML",
                           fmt::format(R"(
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
for name in ("s", "n"):
    r = vtkXMLPolyDataReader(); r.SetFileName("{}/" + name + ".vtp"); r.Update(); p = r.GetOutput(); d = p.GetPointData()
    print(p.GetNumberOfPoints(), p.GetNumberOfPolys(), d.GetNormals().GetName(), p.GetFieldData().GetArray("TimeValue").GetValue(0))
    print([(d.GetArrayName(i), d.GetArray(i).GetNumberOfComponents()) for i in range(d.GetNumberOfArrays())])
    if name == "s": print([p.GetCell(3).GetPointId(k) for k in range(3)], p.GetPoint(3), d.GetArray("id").GetValue(3))
)",
                                       folder.path().string()));
  if (!said) GTEST_SKIP() << "VTK for Python is not installed";
  const std::string arrays = "[('Normals', 3), ('id', 1), ('velocity', 3), ('density', 1), ('normal', 3)]\n";
  EXPECT_EQ(*said, "4 4 Normals 0.1\n" + arrays +
                       "[0, 3, 2] (0.0, 0.0, 0.3333333432674408) -8\n0 0 Normals 0.0\n[('Normals', 3)]\n");
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
