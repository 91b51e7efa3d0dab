#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "folder_lock.h"
#include "sessile/output/frames.h"
#include "sessile/output/surfaces.h"
#include "sessile/output/usda.h"
#include "sessile/results/results.h"
#include "sessile/scene/solid_mesh.h"
#include "sessile/scene/surface_settings.h"
#include "surface_index.h"

namespace sessile::app {

/// Of the folder of surfaces in a folder of results.
inline constexpr std::string_view surface_folder_name = "surface";

/// Removes the surfaces of an earlier run, those that surface.json lists, and the folder when nothing else is in it.
void remove_surfaces(const std::filesystem::path& folder);

/// How surfaces are made, and in which formats they are written.
struct SurfacePlan {
  SurfaceSettings settings{};
  std::vector<std::string> formats{"ply"};
  double spacing = 0;             ///< of the particles [m]
  double frames_per_second = 25;  ///< of simulated time, for formats that count in frames
};

/// Writes a surface into a file of one of the formats, whole or not at all. Throws FileError.
void write_surface(const std::filesystem::path& file, const SurfaceFormat& format, const SurfaceMesh& mesh,
                   const SurfacePlan& plan, const Vec3d& up);

/// The direction against gravity; up the z axis without any.
Vec3d up_of(const Scene& scene);

/// Throws FileError, with what can be done, unless a run can go on with the surfaces of these times that it has made
/// [s].
void require_surfaces(const std::filesystem::path& folder, const std::filesystem::path& source, const Scene& scene,
                      const SurfacePlan& plan, const std::vector<double>& times);

/// A folder of surfaces: a file per frame and format, the solids, and surface.json, which tells what is there. Each
/// file is whole, and surface.json lists whole ones only.
class SurfaceFolder {
 public:
  /// Makes the folder and writes the solids. Of what lies there already, surfaces of the same particles and settings
  /// stay listed, of a run that goes on those of the times `kept` alone [s]; others are removed. `source` is the folder
  /// of the particles. Throws FileError, and changes nothing, when surfaces of those times are not there; FolderInUse
  /// while another process writes surfaces there.
  SurfaceFolder(std::filesystem::path folder, const std::filesystem::path& source, const Scene& scene, SurfacePlan plan,
                const std::optional<std::vector<double>>& kept);

  /// Frees the list of frames that are no longer among the source's.
  void keep_only(const std::vector<ResultFrame>& frames);

  /// Formats that a frame still needs: those whose file is not there, or older than the frame's.
  std::vector<const SurfaceFormat*> missing(const ResultFrame& frame) const;

  /// Writes a frame's surface in these formats. Throws FileError, and Error for what a format cannot hold.
  void write(std::int64_t number, const SurfaceMesh& mesh, const std::vector<const SurfaceFormat*>& formats);
  void write(std::int64_t number, const SurfaceMesh& mesh) { write(number, mesh, formats_); }

  /// Waits until the disk has what a run needs that goes on from here. Throws FileError.
  void sync() const {
    if (sequence_) sequence_->sync();
  }

  /// Writes what only the last frame completes: the file that holds them all. Throws FileError.
  void finish();

  const SurfacePlan& plan() const { return plan_; }
  const std::filesystem::path& folder() const { return folder_; }
  const FolderLock& lock() const { return lock_; }

 private:
  void keep_first(std::size_t count);
  void write_solids();
  void write_index() const;
  SurfaceEntry& entry(std::int64_t number);

  std::filesystem::path folder_;
  FolderLock lock_;
  SurfacePlan plan_;
  bool resumable_;  // whether a run writes here, that may go on one day
  std::vector<const SurfaceFormat*> formats_;
  std::vector<SolidMesh> solids_;
  SurfaceIndex index_;
  std::optional<UsdaWriter> sequence_;         // open while frames are added to it
  std::vector<std::int64_t> sequence_frames_;  // that it holds
};

}  // namespace sessile::app
