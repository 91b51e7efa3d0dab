#include "vdb.h"

#include <fmt/format.h>
#include <omp.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
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

/// How many threads TBB may use, this one among them: as many as can be started now. Where one of its own cannot be, it
/// throws, or ends the program.
std::size_t startable(std::size_t wanted) {
  std::promise<void> enough;
  const std::shared_future<void> wait(enough.get_future());
  std::vector<std::thread> threads;
  threads.reserve(wanted);
  try {
    while (threads.size() + 1 < wanted) threads.emplace_back([wait] { wait.wait(); });
  } catch (const std::exception&) {
    // With one alone TBB starts none.
  }
  const std::size_t all = threads.size() + 1;
  enough.set_value();
  for (std::thread& thread : threads) thread.join();
  return all < wanted ? 1 : all;
}

/// Lets TBB take so many threads from now on; the least that it was told counts. For good: where a limit is taken back
/// TBB starts threads, out of a destructor, and ends the program where it cannot.
void limit_threads(std::size_t most) {
  static std::mutex one;
  const std::lock_guard lock(one);
  static auto& limits = *new std::vector<std::unique_ptr<tbb::global_control>>;
  static std::size_t least = std::numeric_limits<std::size_t>::max();
  if (most >= least) return;
  least = most;
  limits.push_back(std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, most));
}

}  // namespace

void write_vdb(const std::filesystem::path& file, const SurfaceMesh& mesh, double voxel) {
  check_extent(mesh, voxel);
  openvdb::initialize();
  limit_threads(startable(static_cast<std::size_t>(omp_get_max_threads())));
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
  } catch (const std::system_error&) {
    std::filesystem::remove(part, ignored);
    throw;
  } catch (const std::runtime_error& e) {  // TBB's, of a thread or memory that it did not get
    std::filesystem::remove(part, ignored);
    throw Error(
        fmt::format("cannot make {}: {}; `--threads 1` takes fewer, `ulimit -u` and `ulimit -v` show the limits",
                    file.string(), e.what()));
  } catch (...) {
    std::filesystem::remove(part, ignored);
    throw;
  }
  finish_part(file);
}

}  // namespace sessile::app
