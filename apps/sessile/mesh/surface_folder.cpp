#include "surface_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/output/file.h"
#include "sessile/scene/describe.h"
#include "vdb.h"

namespace sessile::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view sequence_file = "surface.usda", collection_file = "surface.pvd", index_file = "surface.json";

bool is_sequence(const SurfaceFormat& format) { return format.name == "usda"; }

std::string file_of(const SurfaceFormat& format, std::int64_t number) {
  return is_sequence(format) ? std::string(sequence_file) : surface_file_name(number, format.name);
}

bool contains(const std::vector<std::string>& files, std::string_view file) {
  return std::find(files.begin(), files.end(), file) != files.end();
}

/// JSON of several lines as one.
std::string on_one_line(std::string_view json) {
  std::string line;
  bool at_start = false;
  for (const char c : json) {
    if (c == '\n') {
      if (!line.empty() && line.back() == ',') line += ' ';
      at_start = true;
    } else if (!at_start || c != ' ') {
      at_start = false;
      line += c;
    }
  }
  return line;
}

std::vector<const SurfaceFormat*> formats_named(const std::vector<std::string>& names) {
  std::vector<const SurfaceFormat*> formats;
  // In the order of the table: programs that take the first file of a frame get the most common format.
  for (const SurfaceFormat& format : surface_formats()) {
    if (contains(names, format.name)) formats.push_back(&format);
  }
  return formats;
}

/// Removes the files that hold a frame's surface.
void remove_files(const fs::path& folder, const SurfaceEntry& entry) {
  std::error_code ignored;
  for (const std::string& file : entry.files) fs::remove(folder / file, ignored);
}

}  // namespace

void remove_surfaces(const fs::path& folder) {
  const SurfaceIndex index = read_index(folder / index_file);
  std::error_code ignored;
  for (const SurfaceEntry& each : index.frames) remove_files(folder, each);
  for (const SurfaceIndex::Solid& each : index.solids) fs::remove(folder / each.file, ignored);
  if (index.source.empty()) return;
  fs::remove(folder / collection_file, ignored);
  fs::remove(folder / index_file, ignored);
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

void write_surface(const fs::path& file, const SurfaceFormat& format, const SurfaceMesh& mesh, const SurfacePlan& plan,
                   const Vec3d& up) {
  if (format.encode != nullptr) {
    write_whole(file, format.encode(mesh));
  } else if (is_sequence(format)) {
    UsdaWriter writer(file, plan.frames_per_second);
    writer.add(mesh);
    writer.finish(up, {});
  } else {
    write_vdb(file, mesh, plan.settings.cube_size * plan.spacing / 2);  // voxels as large as the surface's own cells
  }
}

Vec3d up_of(const Scene& scene) {
  const double strength = length(scene.gravity);
  if (!(strength > 0)) return {0, 0, 1};
  // Adding 0 makes 0 of -0.
  return {-scene.gravity.x / strength + 0.0, -scene.gravity.y / strength + 0.0, -scene.gravity.z / strength + 0.0};
}

SurfaceFolder::SurfaceFolder(fs::path folder, const fs::path& source, const Scene& scene, SurfacePlan plan,
                             std::optional<std::size_t> keep)
    : folder_(std::move(folder)),
      lock_(folder_),
      plan_(std::move(plan)),
      resumable_(keep.has_value()),
      formats_(formats_named(plan_.formats)),
      solids_(solid_meshes(scene)) {
  index_.source = fs::absolute(source).lexically_normal().lexically_proximate(fs::absolute(folder_).lexically_normal());
  index_.spacing = plan_.spacing;
  index_.up = up_of(scene);
  index_.settings = on_one_line(to_json(plan_.settings));
  SurfaceIndex before = read_index(folder_ / index_file);
  if (keep != std::size_t{0} && before.same_origin(index_)) {
    index_.frames = std::move(before.frames);
    if (keep) {
      std::ranges::move(before.waiting, std::back_inserter(index_.frames));
      std::ranges::sort(index_.frames, {}, &SurfaceEntry::number);
      keep_first(*keep);
    }
  } else {
    remove_surfaces(folder_);  // not the folder itself: the lock is in it
  }
  write_solids();
  write_index();
}

/// Goes back to when there were so many surfaces.
void SurfaceFolder::keep_first(std::size_t count) {
  if (index_.frames.size() < count) {
    throw FileError(
        fmt::format("{}: holds {} of the {} surfaces that had been made; without a block output.surface, "
                    "`sessile mesh` makes them from frames",
                    folder_.string(), index_.frames.size(), count));
  }
  for (std::size_t k = count; k < index_.frames.size(); ++k) {
    std::erase(index_.frames[k].files, sequence_file);  // it holds the others too
    remove_files(folder_, index_.frames[k]);
  }
  index_.frames.resize(count);
  if (std::none_of(formats_.begin(), formats_.end(), [](const auto* format) { return is_sequence(*format); })) return;
  for (SurfaceEntry& each : index_.frames) std::erase(each.files, sequence_file);
  sequence_.emplace(folder_ / sequence_file, plan_.frames_per_second, count, index_.frames.back().time);
  for (const SurfaceEntry& each : index_.frames) sequence_frames_.push_back(each.number);
}

void SurfaceFolder::keep_only(const std::vector<ResultFrame>& frames) {
  std::erase_if(index_.frames, [&](const SurfaceEntry& each) {
    const bool there = std::any_of(frames.begin(), frames.end(), [&](const ResultFrame& frame) {
      return frame.number == each.number && frame.time == each.time;
    });
    if (!there) remove_files(folder_, each);
    return !there;
  });
}

std::vector<const SurfaceFormat*> SurfaceFolder::missing(const ResultFrame& frame) const {
  const auto found = std::find_if(index_.frames.begin(), index_.frames.end(),
                                  [&](const SurfaceEntry& each) { return each.number == frame.number; });
  const auto good = [&](const SurfaceFormat& format) {
    const std::string name = file_of(format, frame.number);
    if (found == index_.frames.end() || found->time != frame.time || !contains(found->files, name)) return false;
    std::error_code no_file, no_frame;
    const auto made = fs::last_write_time(folder_ / name, no_file);
    const auto taken = fs::last_write_time(frame.file, no_frame);
    return !no_file && !no_frame && made >= taken;
  };
  std::vector<const SurfaceFormat*> formats;
  std::copy_if(formats_.begin(), formats_.end(), std::back_inserter(formats), [&](const auto* f) { return !good(*f); });
  return formats;
}

SurfaceEntry& SurfaceFolder::entry(std::int64_t number) {
  const auto at = std::lower_bound(index_.frames.begin(), index_.frames.end(), number,
                                   [](const SurfaceEntry& each, std::int64_t n) { return each.number < n; });
  if (at != index_.frames.end() && at->number == number) return *at;
  return *index_.frames.insert(at, SurfaceEntry{number, 0, {}, 0});
}

void SurfaceFolder::write(std::int64_t number, const SurfaceMesh& mesh,
                          const std::vector<const SurfaceFormat*>& formats) {
  SurfaceEntry& each = entry(number);
  each.time = mesh.time;
  each.triangles = mesh.triangle_count();
  for (const SurfaceFormat* format : formats) {
    if (is_sequence(*format)) {
      if (!sequence_) sequence_.emplace(folder_ / sequence_file, plan_.frames_per_second);
      if (resumable_) sequence_->leave_parts();
      sequence_->add(mesh);
      sequence_frames_.push_back(number);
      continue;
    }
    const std::string name = file_of(*format, number);
    write_surface(folder_ / name, *format, mesh, plan_, index_.up);
    if (!contains(each.files, name)) each.files.push_back(name);
  }
  write_index();
}

void SurfaceFolder::finish() {
  if (!sequence_) return;
  sequence_->finish(index_.up, solids_);
  sequence_.reset();
  for (SurfaceEntry& each : index_.frames) {
    const bool in_it =
        std::find(sequence_frames_.begin(), sequence_frames_.end(), each.number) != sequence_frames_.end();
    const bool listed = contains(each.files, sequence_file);
    if (in_it && !listed) each.files.emplace_back(sequence_file);
    if (!in_it && listed) std::erase(each.files, sequence_file);
  }
  write_index();
}

void SurfaceFolder::write_solids() {
  for (const SolidMesh& solid : solids_) {
    const std::string name = fmt::format("solid_{:03}.ply", index_.solids.size());
    write_whole(folder_ / name, encode_surface_ply(as_surface(solid.mesh)));
    index_.solids.push_back({solid.label, name});
  }
}

void SurfaceFolder::write_index() const {
  SurfaceIndex whole = index_;
  const auto in_files = std::stable_partition(whole.frames.begin(), whole.frames.end(),
                                              [](const SurfaceEntry& each) { return !each.files.empty(); });
  whole.waiting.assign(in_files, whole.frames.end());
  whole.frames.erase(in_files, whole.frames.end());
  std::vector<TimedFile> collection;
  for (const SurfaceEntry& each : whole.frames) {
    const std::string name = surface_file_name(each.number, "vtp");
    if (contains(each.files, name)) collection.push_back({each.time, name});
  }
  if (!collection.empty()) write_whole(folder_ / collection_file, encode_pvd(collection));
  write_whole(folder_ / index_file, index_json(whole));
}

}  // namespace sessile::app
