#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>
#include <utility>

#include "sessile/core/error.h"
#include "sessile/core/memory_limit.h"
#include "sessile/results/frame_files.h"

namespace sessile {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// zlib makes at most 1032 bytes of one; a file that promises more lies.
constexpr std::uint64_t most_inflation = 1040;
constexpr std::uint64_t word_bytes = sizeof(std::uint64_t);

constexpr std::size_t most_xml = 1 << 20;  // bytes; each may become a hundred in a tree of XML

FileError not_ours() { return FileError("it is a VTK file, but no frame that `sessile run` wrote"); }
FileError damaged() { return FileError("its data is cut short or changed"); }

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || rest != text.data() + text.size()) return {};
  return value;
}

/// Takes arrays off the appended data, in the order in which the file lists them: without gaps, so that no byte is
/// unpacked twice.
class Appended {
 public:
  /// `most`: bytes that all arrays may unpack to.
  Appended(std::string_view text, std::uint64_t most) : text_(text), left_(most) {}

  /// The next array, which must hold so many values.
  template <class T>
  std::vector<T> next(std::uint64_t offset, std::uint64_t count) {
    const std::uint64_t size = count * sizeof(T);
    if (offset != at_) throw not_ours();
    const std::uint64_t blocks = words(base64(word_bytes, false))[0];
    if (blocks > text_.size() / word_bytes) throw damaged();
    const std::vector<std::uint64_t> head = words(base64(word_bytes * (3 + blocks), true));
    std::uint64_t packed_bytes = 0;
    for (std::size_t i = 3; i < head.size(); ++i) {
      if (head[i] > text_.size()) throw damaged();
      packed_bytes += head[i];
    }
    if (size / most_inflation > packed_bytes) throw damaged();
    if (size > left_) throw FileError("it unpacks to more than there is memory for");
    left_ -= size;
    return inflated<T>(base64(packed_bytes, true), head, size);
  }

 private:
  /// The next bytes; base64 of each array's head, and of its blocks, is padded by itself.
  std::string base64(std::uint64_t bytes, bool take) {
    if (bytes > text_.size()) throw damaged();
    const std::uint64_t letters = (bytes + 2) / 3 * 4;
    if (letters > text_.size() - at_) throw damaged();
    std::string decoded = base64_bytes(text_.substr(at_, letters));
    if (take && decoded.size() != bytes) throw damaged();
    if (decoded.size() < bytes) throw damaged();
    if (take) at_ += letters;
    return decoded;
  }

  static std::vector<std::uint64_t> words(const std::string& bytes) {
    std::vector<std::uint64_t> values(bytes.size() / word_bytes);
    std::memcpy(values.data(), bytes.data(), values.size() * word_bytes);
    return values;
  }

  /// Grows block by block, so that sizes that lie are found out before memory is taken for them: what is reserved is
  /// not touched, and no more than zlib could make of what is there.
  template <class T>
  static std::vector<T> inflated(const std::string& packed, const std::vector<std::uint64_t>& head,
                                 std::uint64_t size) {
    std::vector<T> values;
    values.reserve(size / sizeof(T));
    std::uint64_t from = 0, to = 0;
    for (std::size_t block = 3; block < head.size(); ++block) {
      const bool part = block + 1 == head.size() && head[2] != 0;
      const std::uint64_t expected = part ? head[2] : head[1];
      if (expected > size - to || expected / most_inflation > head[block]) throw damaged();
      values.resize((to + expected + sizeof(T) - 1) / sizeof(T));
      uLongf made = expected;
      const auto* const source = reinterpret_cast<const Bytef*>(packed.data() + from);
      if (uncompress(reinterpret_cast<Bytef*>(values.data()) + to, &made, source, head[block]) != Z_OK ||
          made != expected) {
        throw damaged();
      }
      from += head[block];
      to += expected;
    }
    if (to != size) throw damaged();
    return values;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t left_;
};

Column read_array(const pugi::xml_node& array, std::uint64_t points, Appended& appended) {
  Column column;
  column.name = array.attribute("Name").value();
  column.unit = array.find_child_by_attribute("InformationKey", "name", "UNITS_LABEL").child_value();
  column.components = array.attribute("NumberOfComponents").as_int();
  const auto offset = number<std::uint64_t>(array.attribute("offset").value());
  const std::string_view type = array.attribute("type").value();
  const bool whole = type == "Int64";
  if (!offset || (!whole && type != "Float32")) throw not_ours();
  if (column.components != 1 && column.components != 3) throw not_ours();
  const std::uint64_t count = points * static_cast<std::uint64_t>(column.components);
  if (whole) {
    column.values = appended.next<std::int64_t>(*offset, count);
  } else {
    column.values = appended.next<float>(*offset, count);
  }
  return column;
}

/// Refuses what has more XML than frames have around their data.
void refuse_much_xml(std::string_view bytes) {
  const auto begin = bytes.find("<AppendedData");
  const std::size_t before = std::min(begin, bytes.size());
  const auto end = before < bytes.size() ? bytes.find('<', before + 1) : std::string_view::npos;
  if (before > most_xml || (end != std::string_view::npos && bytes.size() - end > most_xml)) throw not_ours();
}

/// The file, the bytes behind its base64 and what is made of the frame then stand beside the unpacked data.
std::uint64_t most_unpacked() {
  constexpr double side_by_side = 8;
  return static_cast<std::uint64_t>(memory_limit().bytes / side_by_side);
}

FrameMoment moment_of(const pugi::xml_node& fields) {
  const auto text = [&](const char* name) -> std::string_view {
    return fields.find_child_by_attribute("DataArray", "Name", name).child_value();
  };
  const auto time = number<double>(text("TimeValue"));
  const auto step = number<std::int64_t>(text("Step"));
  if (!time || !std::isfinite(*time) || !step) throw not_ours();
  return {*time, *step};
}

/// The number that stands behind `Name="..."` and the next '>'.
template <class T>
std::optional<T> number_behind(std::string_view text, std::string_view name) {
  const auto at = text.find(fmt::format("Name=\"{}\"", name));
  const auto begin = text.find('>', at);
  const auto end = text.find('<', begin);
  if (at == std::string_view::npos || end == std::string_view::npos) return {};
  return number<T>(text.substr(begin + 1, end - begin - 1));
}

}  // namespace

std::optional<FrameMoment> vtp_moment(std::string_view beginning) {
  const auto time = number_behind<double>(beginning, "TimeValue");
  const auto step = number_behind<std::int64_t>(beginning, "Step");
  return time && step && std::isfinite(*time) ? std::optional(FrameMoment{*time, *step}) : std::nullopt;
}

Snapshot parse_vtp_frame(std::string bytes, std::uint64_t most) {
  const std::size_t size = bytes.size();
  if (!bytes.starts_with("<?xml") && !bytes.starts_with("<VTKFile")) throw FileError("it is no VTK file");
  refuse_much_xml(bytes);
  pugi::xml_document document;
  const auto parsed = document.load_buffer_inplace(bytes.data(), size, pugi::parse_escapes, pugi::encoding_utf8);
  const pugi::xml_node file = document.child("VTKFile");
  if (!file) throw FileError("it is no VTK file");
  if (!parsed) throw damaged();
  const auto says = [&](const char* attribute, std::string_view value) {
    return file.attribute(attribute).value() == value;
  };
  const pugi::xml_node data = file.child("AppendedData"), piece = file.child("PolyData").child("Piece");
  if (!says("type", "PolyData") || !says("byte_order", "LittleEndian") || !says("header_type", "UInt64") ||
      !says("compressor", "vtkZLibDataCompressor") || data.attribute("encoding").value() != std::string_view("base64"))
    throw not_ours();
  if (piece.attribute("NumberOfPolys").as_ullong() > 0) throw FileError("it holds a surface, not particles");
  const auto points = number<std::uint64_t>(piece.attribute("NumberOfPoints").value());
  if (!points) throw not_ours();
  if (*points > size * most_inflation) throw damaged();

  std::string_view text = data.child_value();
  while (!text.empty() && (text.front() == '\n' || text.front() == ' ')) text.remove_prefix(1);
  if (!text.starts_with('_')) throw not_ours();
  Appended appended(text.substr(1), most > 0 ? most : most_unpacked());
  const FrameMoment moment = moment_of(file.child("PolyData").child("FieldData"));
  Snapshot snapshot{moment.time, moment.step, {}, {}};
  for (const pugi::xml_node array : piece.child("PointData").children("DataArray")) {
    snapshot.columns.push_back(read_array(array, *points, appended));
  }
  Column places = read_array(piece.child("Points").child("DataArray"), *points, appended);
  auto* const floats = std::get_if<std::vector<float>>(&places.values);
  if (floats == nullptr || places.components != 3) throw not_ours();
  snapshot.points = std::move(*floats);
  return snapshot;
}

}  // namespace sessile
