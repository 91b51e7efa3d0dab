#include "vdb.h"

#include <fmt/format.h>
#include <omp.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <system_error>
#include <vector>

#include "sessile/core/error.h"
#include "sessile/output/file.h"

namespace sessile::app {
namespace {

/// OpenVDB numbers voxels by int32, and looks some voxels around each triangle.
void check_extent(const SurfaceMesh& mesh, double voxel) {
  constexpr double most_voxels = 2e9;
  for (const float x : mesh.points) {
    if (std::abs(static_cast<double>(x)) < most_voxels * voxel) continue;
    throw FileError(
        fmt::format("the surface reaches out to {:g} m, where OpenVDB cannot number voxels of {:g} m", x, voxel));
  }
}

openvdb::FloatGrid::Ptr level_set(const SurfaceMesh& mesh, double voxel) {
  std::vector<openvdb::Vec3s> points;
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    points.emplace_back(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]);
  }
  std::vector<openvdb::Vec3I> triangles;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    triangles.emplace_back(mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]);
  }
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  auto grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles);
  grid->setName("surface");
  grid->insertMeta("units", openvdb::StringMetadata("m"));
  grid->insertMeta("time", openvdb::DoubleMetadata(mesh.time));
  grid->insertMeta("step", openvdb::Int64Metadata(mesh.step));
  return grid;
}

}  // namespace

void write_vdb(const std::filesystem::path& file, const SurfaceMesh& mesh, double voxel) {
  check_extent(mesh, voxel);
  openvdb::initialize();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(omp_get_max_threads()));
  const auto part = part_name(file);
  std::error_code ignored;
  std::filesystem::remove(part, ignored);  // OpenVDB would write through a link
  try {
    openvdb::io::File out(part.string());
    out.write({level_set(mesh, voxel)});
    out.close();
  } catch (const openvdb::Exception& e) {
    std::filesystem::remove(part, ignored);
    throw FileError(fmt::format("cannot write {}: {}", file.string(), e.what()));
  }
  finish_part(file);
}

}  // namespace sessile::app
