#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/vec.h"
#include "sessile/output/file.h"
#include "sessile/scene/solid_mesh.h"
#include "sessile/surface/surface_mesh.h"

namespace sessile {

/// Removes what a writer of this file left that had not finished.
void remove_usda_parts(const std::filesystem::path& file);

/// Writes a surface over time as one USD file in text: a UsdGeomMesh /World/surface with time samples of its points,
/// faces, normals, velocities and columns, and the solids beside it. Frames wait in files of their own, one for each
/// attribute, until finish() joins them: none stays in memory.
class UsdaWriter {
 public:
  /// `frames_per_second` of simulated time: a time code is a frame. Removes what another writer of the file has left.
  UsdaWriter(std::filesystem::path file, double frames_per_second);

  /// Goes on with the first `count` frames, the last of them of time `until` [s], of a writer of the same
  /// file that has finished or was killed. The finished file goes: it is of another end than this writer's. Throws
  /// FileError when the frames are not there.
  UsdaWriter(std::filesystem::path file, double frames_per_second, std::size_t count, double until);

  /// From now on, what has not been joined stays for a writer that goes on with it.
  void leave_parts() { leaves_parts_ = true; }

  /// Waits until the disk has the samples that have been added. Throws FileError.
  void sync() const;

  /// Takes back what has not been joined.
  ~UsdaWriter();
  UsdaWriter(UsdaWriter&&) = delete;

  /// Adds a frame; they come in the order of time. Throws FileError.
  void add(const SurfaceMesh& mesh);

  /// Writes the file, whole or not at all; `up` says which axis points up: y or z. Throws FileError.
  void finish(const Vec3d& up, std::span<const SolidMesh> solids);

 private:
  /// An attribute and the file that its samples wait in.
  struct Attribute {
    std::string declaration;  ///< with what stands in brackets behind it
    std::string name;         ///< type and name
    std::filesystem::path file;
    std::unique_ptr<LineFile> samples;
  };

  std::filesystem::path part_of(std::size_t attribute) const;
  Attribute& attribute(std::string_view type_and_name, std::string_view brackets);
  std::size_t take_from_file(double until);
  std::size_t take_from_parts(double until);
  void name_parts();
  void sample(std::string_view type_and_name, std::string_view brackets, const std::string& value);
  void column(const Column& column);

  std::filesystem::path file_;
  std::string naming_;  // stands in the names of parts that are not whole yet
  double rate_;
  double code_ = 0, first_code_ = 0;  // of the last frame, of the first one
  bool any_ = false, leaves_parts_ = false;
  std::vector<Attribute> attributes_;
};

}  // namespace sessile
