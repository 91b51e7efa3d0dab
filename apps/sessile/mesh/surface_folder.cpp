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

/// What surface.json says of where the surfaces of a folder come from.
SurfaceIndex origin_of(const fs::path& folder, const fs::path& source, const Scene& scene, const SurfacePlan& plan) {
  SurfaceIndex index;
  index.source = fs::absolute(source).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal());
  index.spacing = plan.spacing;
  index.up = up_of(scene);
  index.settings = on_one_line(to_json(plan.settings));
  return index;
}

/// All frames of surface.json, those too that only the file of all frames is to hold.
std::vector<SurfaceEntry> all_frames(SurfaceIndex index) {
  std::vector<SurfaceEntry> frames = std::move(index.frames);
  std::ranges::move(index.waiting, std::back_inserter(frames));
  std::ranges::sort(frames, {}, &SurfaceEntry::number);
  return frames;
}

/// The frames of a folder, if the first of them are of these times and all there.
std::vector<SurfaceEntry> frames_with(const fs::path& folder, const SurfaceIndex& origin,
                                      const std::vector<double>& times) {
  const SurfaceIndex index = read_index(folder / index_file);
  std::vector<SurfaceEntry> frames = all_frames(index);
  const auto there = [&](const SurfaceEntry& each) {
    return std::ranges::all_of(each.files,
                               [&](const auto& file) { return file == sequence_file || fs::exists(folder / file); });
  };
  bool good = (times.empty() || index.same_origin(origin)) && frames.size() >= times.size();
  for (std::size_t k = 0; good && k < times.size(); ++k) good = frames[k].time == times[k] && there(frames[k]);
  if (good) return frames;
  throw FileError(
      fmt::format("{}: the {} surfaces that the run had made are not there any more, or others are: put them back, or "
                  "go on without surfaces, with `--set output.surface.formats=[]`, and make them of the frames with "
                  "`sessile mesh`",
                  folder.string(), times.size()));
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
  remove_usda_parts(folder / sequence_file);
  if (index.source.empty()) return;
  fs::remove(folder / sequence_file, ignored);  // not listed while a run goes on with it
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

void require_surfaces(const fs::path& folder, const fs::path& source, const Scene& scene, const SurfacePlan& plan,
                      const std::vector<double>& times) {
  frames_with(folder, origin_of(folder, source, scene, plan), times);
}

SurfaceFolder::SurfaceFolder(fs::path folder, const fs::path& source, const Scene& scene, SurfacePlan plan,
                             const std::optional<std::vector<double>>& kept)
    : folder_(std::move(folder)),
      lock_(folder_),
      plan_(std::move(plan)),
      resumable_(kept.has_value()),
      formats_(formats_named(plan_.formats)),
      solids_(solid_meshes(scene)),
      index_(origin_of(folder_, source, scene, plan_)) {
  if (kept && !kept->empty()) {
    index_.frames = frames_with(folder_, index_, *kept);
    keep_first(kept->size());
  } else if (SurfaceIndex before = read_index(folder_ / index_file); !kept && before.same_origin(index_)) {
    index_.frames = std::move(before.frames);
  } else {
    remove_surfaces(folder_);  // not the folder itself: the lock is in it
  }
  write_solids();
  write_index();
}

/// Goes back to when there were so many surfaces.
void SurfaceFolder::keep_first(std::size_t count) {
  if (std::ranges::any_of(formats_, [](const auto* format) { return is_sequence(*format); })) {
    sequence_.emplace(folder_ / sequence_file, plan_.frames_per_second, count, index_.frames[count - 1].time);
  }
  for (SurfaceEntry& each : index_.frames) std::erase(each.files, sequence_file);
  for (std::size_t k = count; k < index_.frames.size(); ++k) remove_files(folder_, index_.frames[k]);
  index_.frames.resize(count);
  if (!sequence_) return;
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
