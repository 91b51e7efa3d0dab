#include "sessile/output/usda.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/output/durable.h"
#include "sessile/output/surfaces.h"
#include "sessile/output/usda_text.h"
#include "sessile/scene/input_file.h"

namespace sessile {

namespace {

/// Appends what a file holds after its first line.
void copy(const std::filesystem::path& from, LineFile& to) {
  std::ifstream in = stream_of(from);
  std::string first;
  std::getline(in, first);
  std::vector<char> block(std::size_t{1} << 16);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    to.append({block.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (!in.eof()) throw FileError(fmt::format("cannot read {}: {}", from.string(), std::strerror(errno)));
}

// Stands in the names of parts that do not hold all yet that they are to hold.
constexpr std::string_view unfinished = "new.";

/// Removes parts of a file; `kept`: but those that have this in their names, if it is not empty.
void remove_parts(const std::filesystem::path& file, std::string_view kept) {
  const std::string stem = fmt::format(".{}.", file.filename().string());
  std::vector<std::filesystem::path> parts;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(stem) || !name.ends_with(".part")) continue;
    if (kept.empty() || !std::string_view(name).substr(stem.size()).starts_with(kept)) parts.push_back(entry.path());
  }
  for (const auto& part : parts) std::filesystem::remove(part, ignored);
}

}  // namespace

void remove_usda_parts(const std::filesystem::path& file) { remove_parts(file, ""); }

UsdaWriter::UsdaWriter(std::filesystem::path file, double frames_per_second)
    : file_(std::move(file)), rate_(frames_per_second) {
  remove_usda_parts(file_);
}

// Parts are newer than a file beside them: that one is of an earlier end, from which a writer went on that was killed.
// So it goes as soon as there are parts, which are there as soon as the first of them is.
UsdaWriter::UsdaWriter(std::filesystem::path file, double frames_per_second, std::size_t count, double until)
    : file_(std::move(file)), rate_(frames_per_second) {
  if (count == 0) {
    remove_usda_parts(file_);
    return;
  }
  const double last = until * rate_;
  if (take_from_parts(last) < count) {
    attributes_.clear();
    naming_ = unfinished;
    if (take_from_file(last) < count) {
      for (const Attribute& each : attributes_) std::filesystem::remove(each.file);
      throw FileError(fmt::format("cannot go on with {}: it lacks frames that had been written", file_.string()));
    }
    name_parts();
  }
  std::filesystem::remove(file_);
  code_ = last;
  any_ = leaves_parts_ = true;
}

/// Gives files that hold all that was taken from the finished one the names of parts, the first of them last.
void UsdaWriter::name_parts() {
  sync();
  remove_parts(file_, unfinished);
  naming_ = "";
  for (std::size_t k = attributes_.size(); k-- > 0;) {
    std::filesystem::rename(attributes_[k].file, part_of(k));
    attributes_[k].file = part_of(k);
  }
  sync_folder(file_.parent_path());
}

UsdaWriter::~UsdaWriter() {
  std::error_code ignored;
  std::filesystem::remove(part_name(file_), ignored);
  if (leaves_parts_) return;
  for (const Attribute& each : attributes_) std::filesystem::remove(each.file, ignored);
}

void UsdaWriter::sync() const {
  for (const Attribute& each : attributes_) each.samples->sync();
}

std::filesystem::path UsdaWriter::part_of(std::size_t attribute) const {
  return part_name(file_.parent_path() / fmt::format("{}.{}{}", file_.filename().string(), naming_, attribute));
}

/// The attribute of this name; its file begins with a line that says what it holds.
UsdaWriter::Attribute& UsdaWriter::attribute(std::string_view type_and_name, std::string_view brackets) {
  const auto found = std::find_if(attributes_.begin(), attributes_.end(),
                                  [&](const Attribute& each) { return each.name == type_and_name; });
  if (found != attributes_.end()) return *found;
  Attribute added{std::string(brackets), std::string(type_and_name), part_of(attributes_.size()), nullptr};
  added.samples = std::make_unique<LineFile>(added.file);
  added.samples->append(fmt::format("{}|{}\n", added.name, added.declaration));
  return attributes_.emplace_back(std::move(added));
}

void UsdaWriter::sample(std::string_view type_and_name, std::string_view brackets, const std::string& value) {
  attribute(type_and_name, brackets).samples->append(fmt::format("{}{}: {},\n", usda::sample_indent, code_, value));
}

/// Takes the samples up to a time code out of the finished file, back into files of their own. Returns how many frames
/// there are.
std::size_t UsdaWriter::take_from_file(double until) {
  constexpr std::string_view indent = "        ", opening = ".timeSamples = {";
  std::ifstream in = stream_of(file_);
  Attribute* current = nullptr;
  std::string brackets;
  std::size_t frames = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string_view text(line);
    if (text.starts_with(usda::sample_indent) && current == nullptr) {
      brackets = text.substr(usda::sample_indent.size());
    } else if (text.starts_with(usda::sample_indent)) {
      const auto code = usda::code_of(text);
      if (!code || *code > until) continue;
      current->samples->append(line + '\n');
      if (current->name != usda::points_name) continue;
      if (frames++ == 0) first_code_ = *code;
    } else {
      const bool opens = text.starts_with(indent) && text.ends_with(opening);
      const auto name = opens ? text.substr(indent.size(), text.size() - indent.size() - opening.size()) : "";
      current = usda::is_type_and_name(name) ? &attribute(name, std::exchange(brackets, "")) : nullptr;
    }
  }
  return frames;
}

/// The same from the files that a writer left when it was killed.
std::size_t UsdaWriter::take_from_parts(double until) {
  std::size_t frames = 0;
  for (std::size_t k = 0;; ++k) {
    const auto part = part_of(k);
    std::ifstream in = stream_of(part);
    std::string line;
    if (!std::getline(in, line) || in.eof()) return frames;
    const auto bar = line.find('|');
    const std::string name = line.substr(0, bar);
    const bool is_new = std::none_of(attributes_.begin(), attributes_.end(), [&](auto& a) { return a.name == name; });
    if (bar == std::string::npos || !usda::is_type_and_name(name) || !is_new) return frames;
    Attribute found{line.substr(bar + 1), name, part, nullptr};
    std::uint64_t keep = line.size() + 1;
    while (std::getline(in, line) && !in.eof()) {
      const auto code = usda::code_of(line);
      if (!code || *code > until) break;
      keep += line.size() + 1;
      if (found.name != usda::points_name) continue;
      if (frames++ == 0) first_code_ = *code;
    }
    found.samples = std::make_unique<LineFile>(part, Keep{keep});
    attributes_.push_back(std::move(found));
  }
}

void UsdaWriter::column(const Column& column) {
  constexpr std::string_view of_vertices = "interpolation = \"vertex\"";
  const std::string name = usda::identifier(column.name);
  const auto* const floats = std::get_if<std::vector<float>>(&column.values);
  if (floats == nullptr) {
    sample("int64[] primvars:" + name, of_vertices, usda::list_of(std::get<std::vector<std::int64_t>>(column.values)));
  } else if (column.components == 1) {
    sample("float[] primvars:" + name, of_vertices, usda::list_of(*floats));
  } else if (column.name == "velocity") {
    sample("vector3f[] velocities", "", usda::vectors_of(*floats));
  } else {
    sample("vector3f[] primvars:" + name, of_vertices, usda::vectors_of(*floats));
  }
}

void UsdaWriter::add(const SurfaceMesh& mesh) {
  code_ = mesh.time * rate_;
  if (!std::exchange(any_, true)) first_code_ = code_;
  sample("float3[] extent", "", usda::extent_of(mesh));
  sample("int[] faceVertexCounts", "", usda::counts_of(mesh));
  sample("int[] faceVertexIndices", "", usda::list_of(mesh.triangles));
  sample(usda::points_name, "", usda::vectors_of(mesh.points));
  sample("normal3f[] normals", "interpolation = \"vertex\"", usda::vectors_of(mesh.normals));
  for (const Column& each : mesh.columns) column(each);
}

void UsdaWriter::finish(const Vec3d& up, std::span<const SolidMesh> solids) {
  {
    LineFile out(part_name(file_));
    out.append(fmt::format(
        "#usda 1.0\n(\n    doc = \"A liquid's surface, by Sessile\"\n    defaultPrim = \"World\"\n    upAxis = \"{}\"\n"
        "    metersPerUnit = 1\n    timeCodesPerSecond = {}\n    framesPerSecond = {}\n    startTimeCode = {}\n"
        "    endTimeCode = {}\n)\n\ndef Xform \"World\"\n{{\n    def Mesh \"surface\"\n    {{\n{}",
        std::abs(up.y) > std::abs(up.z) ? "Y" : "Z", rate_, rate_, first_code_, code_, usda::mesh_traits));
    for (const Attribute& each : attributes_) {
      // What stands in brackets belongs to the attribute, not to its samples.
      if (!each.declaration.empty()) {
        out.append(fmt::format("        {} (\n            {}\n        )\n", each.name, each.declaration));
      }
      out.append(fmt::format("        {}.timeSamples = {{\n", each.name));
      copy(each.file, out);
      out.append("        }\n");
    }
    out.append("    }\n");
    std::set<std::string> names{"surface"};
    for (const SolidMesh& solid : solids) {
      std::string name = usda::identifier(solid.label);
      while (!names.insert(name).second) name += '_';
      out.append(usda::solid_text(name, as_surface(solid.mesh)));
    }
    out.append("}\n");
  }
  finish_part(file_);
  leaves_parts_ = false;
}

}  // namespace sessile
