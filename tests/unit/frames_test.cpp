#include "sessile/output/frames.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <regex>
#include <sstream>

#include "sessile/core/error.h"
#include "sessile/output/check.h"
#include "unit/python.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::message_of;
using test::TemporaryFolder;

Snapshot sample_snapshot(std::size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(-5, 5);
  const auto floats = [&](std::size_t count) {
    std::vector<float> values(count);
    for (float& value : values) value = number(random);
    return values;
  };
  std::vector<std::int64_t> ids(n);
  for (std::size_t i = 0; i < n; ++i) ids[i] = static_cast<std::int64_t>(3 * (n - i));
  Snapshot snapshot{0.1, 42, floats(3 * n), {}};
  snapshot.columns.push_back({"id", "", 1, ids});
  snapshot.columns.push_back({"velocity", "m/s", 3, floats(3 * n)});
  snapshot.columns.push_back({"density", "kg/m^3", 1, floats(n)});
  snapshot.columns.push_back({"acceleration_gravity", "m/s^2", 3, floats(3 * n)});
  return snapshot;
}

template <class T>
std::vector<T> numbers_in(std::string_view bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

/// The bytes of base64 text up to its padding, or of `limit` bytes.
std::string base64_decoded(std::string_view text, std::size_t limit = std::numeric_limits<std::size_t>::max()) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t i = 0; i + 4 <= text.size() && bytes.size() < limit; i += 4) {
    std::uint32_t group = 0;
    int letters = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t digit = digits.find(text[i + k]);
      group = group << 6 | static_cast<std::uint32_t>(digit == std::string::npos ? 0 : digit);
      letters += digit != std::string::npos;
    }
    for (int k = 0; k < letters - 1; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 255);
    if (letters < 4) break;
  }
  return bytes;
}

/// A .vtp file read back by its specification.
class Vtp {
 public:
  explicit Vtp(std::string text) : text_(std::move(text)) {
    const std::size_t marker = text_.find("<AppendedData encoding=\"base64\">\n_");
    appended_ = std::string_view(text_).substr(text_.find('_', marker) + 1);
  }

  std::string attribute(const std::string& element, const std::string& name) const {
    std::smatch match;
    const std::regex pattern("<" + element + "[^>]* " + name + "=\"([^\"]*)\"");
    return std::regex_search(text_, match, pattern) ? match[1].str() : "";
  }
  std::string array_attribute(const std::string& array, const std::string& name) const {
    std::smatch match;
    std::regex_search(text_, match, std::regex("<DataArray[^>]* Name=\"" + array + "\"[^>]*>"));
    const std::string tag = match[0].str();
    std::regex_search(tag, match, std::regex(name + "=\"([^\"]*)\""));
    return match[1].str();
  }

  std::string array_bytes(const std::string& name) const {
    const std::string_view at = appended_.substr(std::stoul(array_attribute(name, "offset")));
    const std::size_t blocks = numbers_in<std::uint64_t>(base64_decoded(at, 8))[0];
    const std::size_t head_bytes = 8 * (3 + blocks);
    const auto head = numbers_in<std::uint64_t>(base64_decoded(at, head_bytes));
    const std::string packed = base64_decoded(at.substr((head_bytes + 2) / 3 * 4));
    std::string bytes;
    std::size_t begin = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      uLongf size = block + 1 == blocks && head[2] != 0 ? head[2] : head[1];
      std::string part(size, '\0');
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(part.data()), &size,
                           reinterpret_cast<const Bytef*>(packed.data() + begin), head[3 + block]),
                Z_OK);
      EXPECT_EQ(size, part.size());
      bytes += part;
      begin += head[3 + block];
    }
    return bytes;
  }
  template <class T>
  std::vector<T> array(const std::string& name) const {
    return numbers_in<T>(array_bytes(name));
  }

 private:
  std::string text_;
  std::string_view appended_;
};

void expect_read_back(const Snapshot& snapshot) {
  const Vtp vtp(encode_vtp(snapshot));
  const std::string n = std::to_string(snapshot.size());
  EXPECT_EQ(vtp.attribute("Piece", "NumberOfPoints"), n);
  EXPECT_EQ(vtp.attribute("Piece", "NumberOfVerts"), n);
  EXPECT_EQ(vtp.array<float>("Points"), snapshot.points);
  for (const Column& column : snapshot.columns) {
    EXPECT_EQ(vtp.array_attribute(column.name, "NumberOfComponents"), std::to_string(column.components));
    if (const auto* floats = std::get_if<std::vector<float>>(&column.values)) {
      EXPECT_EQ(vtp.array_attribute(column.name, "type"), "Float32");
      EXPECT_EQ(vtp.array<float>(column.name), *floats);
    } else {
      EXPECT_EQ(vtp.array_attribute(column.name, "type"), "Int64");
      EXPECT_EQ(vtp.array<std::int64_t>(column.name), std::get<std::vector<std::int64_t>>(column.values));
    }
  }
  const auto ends = vtp.array<std::int32_t>("offsets");
  ASSERT_EQ(ends.size(), snapshot.size());
  if (!ends.empty()) {
    EXPECT_EQ(ends.back(), static_cast<std::int32_t>(snapshot.size()));
  }
}

TEST(Vtp, IsReadBack) { expect_read_back(sample_snapshot(7)); }
TEST(Vtp, IsReadBackWithoutParticles) { expect_read_back(sample_snapshot(0)); }
TEST(Vtp, IsReadBackInManyBlocks) { expect_read_back(sample_snapshot(70000)); }
TEST(Vtp, IsReadBackWhenTheLastBlockIsWhole) { expect_read_back(sample_snapshot((1 << 18) / 4)); }

TEST(Vtp, CarriesTimeStepAndUnits) {
  const std::string text = encode_vtp(sample_snapshot(2));
  EXPECT_NE(text.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.1<"), std::string::npos);
  EXPECT_NE(text.find("Name=\"Step\" NumberOfTuples=\"1\" format=\"ascii\">42<"), std::string::npos);
  EXPECT_NE(text.find("location=\"vtkDataArray\">kg/m^3<"), std::string::npos);
}

TEST(Pvd, ListsFilesWithTheirTimes) {
  const std::vector<TimedFile> frames{{0, "frame_000000.vtp"}, {0.04, "frame_000001.vtp"}};
  EXPECT_EQ(encode_pvd(frames),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "<Collection>\n"
            "<DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"frame_000000.vtp\"/>\n"
            "<DataSet timestep=\"0.04\" group=\"\" part=\"0\" file=\"frame_000001.vtp\"/>\n"
            "</Collection>\n</VTKFile>\n");
}

TEST(Ply, IsReadBack) {
  const std::size_t n = 5;
  const Snapshot snapshot = sample_snapshot(n);
  const std::string bytes = encode_ply(snapshot);
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment Sessile, time 0.1 s, step 42\nelement vertex 5\n"
      "property float x\nproperty float y\nproperty float z\nproperty int id\n"
      "property float vx\nproperty float vy\nproperty float vz\nproperty float density\n"
      "property float acceleration_gravity_x\nproperty float acceleration_gravity_y\n"
      "property float acceleration_gravity_z\nend_header\n";
  ASSERT_EQ(bytes.substr(0, head.size()), head);
  const std::string_view body = std::string_view(bytes).substr(head.size());
  const std::size_t width = 11;
  ASSERT_EQ(body.size(), n * width * 4);
  const auto floats = numbers_in<float>(body);
  const auto ints = numbers_in<std::int32_t>(body);
  const auto& ids = std::get<std::vector<std::int64_t>>(snapshot.columns[0].values);
  const auto& velocity = std::get<std::vector<float>>(snapshot.columns[1].values);
  const auto& density = std::get<std::vector<float>>(snapshot.columns[2].values);
  const auto& gravity = std::get<std::vector<float>>(snapshot.columns[3].values);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(floats[i * width + c], snapshot.points[3 * i + c]);
      EXPECT_EQ(floats[i * width + 4 + c], velocity[3 * i + c]);
      EXPECT_EQ(floats[i * width + 8 + c], gravity[3 * i + c]);
    }
    EXPECT_EQ(ints[i * width + 3], ids[i]);
    EXPECT_EQ(floats[i * width + 7], density[i]);
  }
}

TEST(Ply, RefusesNumbersThatDoNotFit) {
  Snapshot snapshot{0, 0, {0, 0, 0}, {}};
  snapshot.columns.push_back({"id", "", 1, std::vector<std::int64_t>{3'000'000'000}});
  EXPECT_EQ(message_of<Error>([&] { encode_ply(snapshot); }),
            "PLY holds whole numbers of 32 bits only; id reached 3000000000");
}

TEST(FrameFormats, AreFoundByName) {
  for (const FrameFormat& format : frame_formats()) EXPECT_EQ(find_frame_format(format.name), &format);
  EXPECT_EQ(find_frame_format("vtk"), nullptr);
  EXPECT_EQ(frame_file_name(12, "vtp"), "frame_000012.vtp");
  EXPECT_EQ(solids_file_name("ply"), "solids.ply");
}

TEST(CheckOutput, TakesTheDefaultsAndEveryForce) {
  Scene scene;
  EXPECT_TRUE(check_output(scene).empty());
  scene.forces.assign(2, SurfaceFeature{});
  scene.output.columns = {"acceleration_gravity",         "acceleration_viscosity",         "acceleration_pressure",
                          "acceleration_surface_feature", "acceleration_surface_feature_2", "wall_neighbors"};
  scene.output.formats = {"ply", "vtp"};
  EXPECT_TRUE(check_output(scene).empty());
  scene.forces.clear();
  EXPECT_EQ(check_output(scene).size(), 2u);
}

TEST(CheckOutput, NamesEveryFault) {
  Scene scene;
  scene.output.formats = {"vtp", "vtk", "alembic"};
  scene.output.columns = {"id", "velocty", "acceleration_gravty", "colour"};
  std::vector<std::string> lines;
  for (const Fault& fault : check_output(scene)) lines.push_back(text(fault));
  EXPECT_EQ(lines,
            (std::vector<std::string>{
                "output.formats[1]: unknown format \"vtk\" (did you mean \"vtp\"?)",
                "output.formats[2]: unknown format \"alembic\" (valid formats: vtp, ply)",
                "output.fields[1]: unknown field \"velocty\" (did you mean \"velocity\"?)",
                "output.fields[2]: unknown field \"acceleration_gravty\" (did you mean \"acceleration_gravity\"?)",
                "output.fields[3]: unknown field \"colour\" (valid fields: id, velocity, speed, density, pressure, "
                "mass, normal, neighbors, wall_neighbors, acceleration_gravity, acceleration_viscosity, "
                "acceleration_pressure)",
            }));
}

/// Two frames and their collection, opened by VTK itself; skipped on machines without its Python module.
TEST(Vtp, OpensInVtk) {
  const std::string python = test::python_named_by("SESSILE_VTK_PYTHON", "/usr/bin/python3");
  if (std::system((python + " -c 'import vtkmodules.vtkIOXML' >/dev/null 2>&1").c_str()) != 0) {
    GTEST_SKIP() << "VTK for Python is not installed";
  }
  TemporaryFolder folder;
  std::ostringstream expected;
  const auto print = [&](const std::string& name, int components, const auto& values) {
    expected << name << ' ' << components;
    for (const auto value : values) expected << ' ' << fmt::format("{}", value);
    expected << '\n';
  };
  std::vector<TimedFile> frames;
  for (const std::size_t n : {std::size_t{5}, std::size_t{0}}) {
    Snapshot snapshot = sample_snapshot(n);
    snapshot.time = static_cast<double>(frames.size()) * 0.04;
    frames.push_back({snapshot.time, frame_file_name(static_cast<std::int64_t>(frames.size()), "vtp")});
    std::ofstream(folder / frames.back().file, std::ios::binary) << encode_vtp(snapshot);
    expected << "frame " << fmt::format("{}", snapshot.time) << ' ' << n << '\n';
    print("Points", 3, snapshot.points);
    for (const Column& column : snapshot.columns) {
      std::visit([&](const auto& values) { print(column.name, column.components, values); }, column.values);
    }
  }
  std::ofstream(folder / "frames.pvd") << encode_pvd(frames);
  std::ofstream(folder / "expected.txt") << expected.str();
  const auto script = std::filesystem::path(SESSILE_TEST_DATA).parent_path() / "cli" / "check_vtk.py";
  const std::string command = fmt::format("{} '{}' '{}' --values '{}'", python, script.string(),
                                          (folder / "frames.pvd").string(), (folder / "expected.txt").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

}  // namespace
}  // namespace sessile
