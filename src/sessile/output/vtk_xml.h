#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sessile/output/snapshot.h"

namespace sessile {

/// Text as it may stand in XML.
std::string escaped_xml(std::string_view text);

/// A VTK PolyData file in XML: the text in front and, behind it, the arrays that it points into, compressed by zlib in
/// blocks and base64 encoded.
class VtkDocument {
 public:
  /// Begins the file: its head, with the time [s] and the step as field data.
  VtkDocument(double time, std::int64_t step);

  void text(std::string_view lines) { xml_ += lines; }

  void array(std::string_view name, std::string_view unit, int components, const std::vector<float>& values);
  void array(std::string_view name, std::string_view unit, int components, const std::vector<std::int32_t>& values);
  void array(std::string_view name, std::string_view unit, int components, const std::vector<std::int64_t>& values);
  void array(const Column& column);

  /// All of the file, after its last array.
  std::string whole() &&;

 private:
  template <class T>
  void add(std::string_view name, std::string_view unit, int components, const std::vector<T>& values);

  std::string xml_;
  std::string appended_;
};

}  // namespace sessile
