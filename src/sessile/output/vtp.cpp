#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <numeric>
#include <vector>

#include "sessile/output/frames.h"
#include "sessile/output/vtk_xml.h"

namespace sessile {

std::string encode_vtp(const Snapshot& snapshot) {
  const std::size_t n = snapshot.size();
  std::vector<std::int32_t> ends(n);
  std::iota(ends.begin(), ends.end(), 1);
  std::vector<std::int32_t> indices(n);
  std::iota(indices.begin(), indices.end(), 0);

  VtkDocument document(snapshot.time, snapshot.step);
  document.text(fmt::format(
      R"(<Piece NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
<PointData>
)",
      n, n));
  for (const Column& column : snapshot.columns) document.array(column);
  document.text("</PointData>\n<Points>\n");
  document.array("Points", "m", 3, snapshot.points);
  document.text("</Points>\n<Verts>\n");
  document.array("connectivity", "", 1, indices);
  document.array("offsets", "", 1, ends);
  document.text("</Verts>\n</Piece>\n");
  return std::move(document).whole();
}

std::string encode_pvd(std::span<const TimedFile> frames) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const TimedFile& frame : frames) {
    fmt::format_to(std::back_inserter(xml), "<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                   frame.time, escaped_xml(frame.file));
  }
  return xml + "</Collection>\n</VTKFile>\n";
}

}  // namespace sessile
