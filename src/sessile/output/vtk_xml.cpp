#include "sessile/output/vtk_xml.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <new>

namespace sessile {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

// Few bytes are won by compressing floats harder, and the simulation wants the processor.
constexpr int compression_level = Z_BEST_SPEED;
constexpr std::size_t block_bytes = std::size_t{1} << 18;

void append_base64(std::string& to, std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  to.reserve(to.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) to += k <= left ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
}

/// Appends one array as VTK stores it: base64 of the head (number of blocks, bytes of a whole block, bytes of the
/// last block when it is a part, compressed bytes of each), then base64 of the compressed blocks.
void append_array(std::string& to, std::string_view bytes) {
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes;
  std::vector<std::uint64_t> head{blocks, block_bytes, bytes.size() % block_bytes};
  std::string packed;
  for (std::size_t begin = 0; begin < bytes.size(); begin += block_bytes) {
    const std::string_view block = bytes.substr(begin, block_bytes);
    const std::size_t old_size = packed.size();
    uLongf size = compressBound(block.size());
    packed.resize(old_size + size);
    if (compress2(reinterpret_cast<Bytef*>(packed.data() + old_size), &size,
                  reinterpret_cast<const Bytef*>(block.data()), block.size(), compression_level) != Z_OK) {
      throw std::bad_alloc();  // what else can go wrong, too little room for the bytes, compressBound rules out
    }
    packed.resize(old_size + size);
    head.push_back(size);
  }
  append_base64(to, {reinterpret_cast<const char*>(head.data()), head.size() * sizeof(head[0])});
  append_base64(to, packed);
}

template <class T>
constexpr std::string_view vtk_type = "";
template <>
constexpr std::string_view vtk_type<float> = "Float32";
template <>
constexpr std::string_view vtk_type<std::int32_t> = "Int32";
template <>
constexpr std::string_view vtk_type<std::int64_t> = "Int64";

}  // namespace

std::string escaped_xml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

VtkDocument::VtkDocument(double time, std::int64_t step)
    : xml_(fmt::format(
          R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<PolyData>
<FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="Step" NumberOfTuples="1" format="ascii">{}</DataArray>
</FieldData>
)",
          time, step)) {}

void VtkDocument::array(std::string_view name, std::string_view unit, int components,
                        const std::vector<float>& values) {
  add(name, unit, components, values);
}
void VtkDocument::array(std::string_view name, std::string_view unit, int components,
                        const std::vector<std::int32_t>& values) {
  add(name, unit, components, values);
}
void VtkDocument::array(std::string_view name, std::string_view unit, int components,
                        const std::vector<std::int64_t>& values) {
  add(name, unit, components, values);
}

void VtkDocument::array(const Column& column) {
  std::visit([&](const auto& values) { add(column.name, column.unit, column.components, values); }, column.values);
}

template <class T>
void VtkDocument::add(std::string_view name, std::string_view unit, int components, const std::vector<T>& values) {
  fmt::format_to(std::back_inserter(xml_),
                 R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}")", vtk_type<T>,
                 escaped_xml(name), components, appended_.size());
  if (unit.empty()) {
    xml_ += "/>\n";
  } else {
    fmt::format_to(std::back_inserter(xml_),
                   ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n"
                   "</DataArray>\n",
                   escaped_xml(unit));
  }
  append_array(appended_, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

std::string VtkDocument::whole() && {
  xml_ += "</PolyData>\n<AppendedData encoding=\"base64\">\n_";
  xml_ += appended_;
  xml_ += "\n</AppendedData>\n</VTKFile>\n";
  return std::move(xml_);
}

}  // namespace sessile
