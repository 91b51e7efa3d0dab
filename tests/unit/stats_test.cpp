#include "sessile/output/stats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sessile/core/error.h"
#include "unit/small_disk.h"
#include "unit/temporary_folder.h"

namespace sessile {
namespace {

using test::read_file;
using test::SmallDisk;
using test::TemporaryFolder;

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line.substr(0, line.find('\n')));
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

/// Column name -> text, by the place in the header.
std::map<std::string, std::string> by_name(const std::string& header, const std::string& line) {
  const auto names = fields_of(header), values = fields_of(line);
  EXPECT_EQ(names.size(), values.size());
  std::map<std::string, std::string> row;
  for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) row[names[k]] = values[k];
  EXPECT_EQ(row.size(), names.size()) << "two columns of the same name";
  return row;
}

StatsRow sample_row(std::span<const SolidForce> solids = {}) {
  StatsRow row;
  row.time = 0.1;
  row.last_step = {.dt = 1.0 / 3,
                   .bound = "cfl",
                   .overruled = "",
                   .iterations = 7,
                   .converged = true,
                   .predicted_error = 9e-5,
                   .predicted_error_max = 0.25};
  row.totals.steps = 12;
  row.totals.emitted = 1024;
  row.totals.waits = 3;
  row.totals.unconverged_solves = 2;
  row.measured.particles = 1728;
  row.measured.motion = {.kinetic_energy = 1.5, .potential_energy = -2.5, .momentum = {1, 2, 3}, .max_speed = 4};
  row.measured.compression = {1e-4, 0.5};
  row.measured.structure.pieces = 5;
  row.measured.out = 6;
  row.measured.lost = 8;
  row.solids = solids;
  return row;
}

TEST(Stats, PutsNumbersUnderTheirNames) {
  const std::vector<SolidForce> solids{{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}, {10, 11, 12.5}}};
  const std::string header = stats_header(std::vector<std::string>{"tablet", "rod"});
  const auto row = by_name(header, stats_line(sample_row(solids)));
  EXPECT_EQ(header.substr(0, 21), "step,time [s],dt [s],");
  EXPECT_EQ(row.at("step"), "12");
  EXPECT_EQ(row.at("time [s]"), "0.1");
  EXPECT_EQ(row.at("bound"), "cfl");
  EXPECT_EQ(row.at("iterations"), "7");
  EXPECT_EQ(row.at("predicted_density_error"), "9e-05");
  EXPECT_EQ(row.at("predicted_density_error_max"), "0.25");
  EXPECT_EQ(row.at("density_error"), "0.0001");
  EXPECT_EQ(row.at("density_error_max"), "0.5");
  EXPECT_EQ(row.at("kinetic_energy [J]"), "1.5");
  EXPECT_EQ(row.at("potential_energy [J]"), "-2.5");
  EXPECT_EQ(row.at("momentum_z [kg m/s]"), "3");
  EXPECT_EQ(row.at("max_speed [m/s]"), "4");
  EXPECT_EQ(row.at("particles"), "1728");
  EXPECT_EQ(row.at("pieces"), "5");
  EXPECT_EQ(row.at("out"), "6");
  EXPECT_EQ(row.at("lost"), "8");
  EXPECT_EQ(row.at("emitted"), "1024");
  EXPECT_EQ(row.at("waits"), "3");
  EXPECT_EQ(row.at("unconverged_solves"), "2");
  EXPECT_EQ(row.at("tablet.force_x [N]"), "1");
  EXPECT_EQ(row.at("rod.force_z [N]"), "9");
  EXPECT_EQ(row.at("rod.torque_z [N m]"), "12.5");
}

TEST(Stats, KeepsEveryDigitInEveryLocale) {
  const std::string old = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // a decimal comma, where it is installed
  const auto row = by_name(stats_header({}), stats_line(sample_row()));
  std::setlocale(LC_ALL, old.c_str());
  EXPECT_EQ(std::strtod(row.at("dt [s]").c_str(), nullptr), 1.0 / 3);
}

TEST(Stats, TellsSolidsApart) {
  const std::string header = stats_header(std::vector<std::string>{"", "rod", "rod", "a, \"b\"\n"});
  EXPECT_NE(header.find(",solid0.force_x [N],"), std::string::npos);
  EXPECT_NE(header.find(",rod.force_x [N],"), std::string::npos);
  EXPECT_NE(header.find(",solid2.force_x [N],"), std::string::npos);
  EXPECT_NE(header.find(",\"a, \"\"b\"\" .force_x [N]\","), std::string::npos);
  EXPECT_EQ(std::count(header.begin(), header.end(), '\n'), 1);
}

TEST(StatsWriter, WritesLinesAtOnceAndWhole) {
  TemporaryFolder folder;
  StatsWriter stats(folder / "stats.csv", {});
  stats.write(sample_row());
  const std::string before = stats_header({}) + stats_line(sample_row());
  EXPECT_EQ(read_file(folder / "stats.csv"), before);
  {
    const SmallDisk disk(before.size() + 5);
    EXPECT_THROW(stats.write(sample_row()), FileError);
  }
  EXPECT_EQ(read_file(folder / "stats.csv"), before);
}

TEST(StatsWriter, SaysThatTheDiskIsFull) { EXPECT_THROW(StatsWriter("/dev/full", {}), FileError); }

}  // namespace
}  // namespace sessile
