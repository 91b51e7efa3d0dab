#include "isa.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sessile/version.h"

namespace sessile::app {
namespace {

/// The three instruction sets, best first, as letters: t there, r runs, capital where it is so.
std::vector<Isa> isas(const std::string& v4, const std::string& v3, const std::string& baseline) {
  const auto make = [](std::string_view name, const std::string& state) {
    return Isa{std::string(name), state[0] == 'T', state[1] == 'R'};
  };
  return {make(isa_names[0], v4), make(isa_names[1], v3), make(isa_names[2], baseline)};
}

TEST(IsaChoice, TakesTheBestThatIsThereAndRuns) {
  EXPECT_EQ(choose_isa(isas("TR", "TR", "TR"), "").isa, "x86-64-v4");
  EXPECT_EQ(choose_isa(isas("Tr", "TR", "TR"), "").isa, "x86-64-v3");
  EXPECT_EQ(choose_isa(isas("tR", "TR", "TR"), "").isa, "x86-64-v3");
  EXPECT_EQ(choose_isa(isas("Tr", "tR", "TR"), "").isa, "x86-64");
  EXPECT_EQ(choose_isa(isas("tr", "tr", "TR"), "").isa, "x86-64");
  EXPECT_EQ(choose_isa(isas("TR", "TR", "TR"), "").fault, "");
}

TEST(IsaChoice, FollowsAWish) {
  for (const std::string_view name : isa_names) {
    const IsaChoice choice = choose_isa(isas("TR", "TR", "TR"), name);
    EXPECT_EQ(choice.isa, name);
    EXPECT_EQ(choice.fault, "");
  }
}

TEST(IsaChoice, RefusesWhatCannotBeHad) {
  const auto fault = [](const std::vector<Isa>& from, std::string_view wish) {
    const IsaChoice choice = choose_isa(from, wish);
    EXPECT_EQ(choice.isa, "");
    return choice.fault;
  };
  EXPECT_EQ(fault(isas("TR", "TR", "TR"), "avx2"),
            "SESSILE_ISA: unknown instruction set \"avx2\" (valid instruction sets: x86-64-v4, x86-64-v3, x86-64)");
  EXPECT_EQ(
      fault(isas("TR", "TR", "TR"), "x86-64-V3"),
      "SESSILE_ISA: unknown instruction set \"x86-64-V3\" (valid instruction sets: x86-64-v4, x86-64-v3, x86-64)");
  EXPECT_EQ(fault(isas("Tr", "TR", "TR"), "x86-64-v4"),
            "SESSILE_ISA: this processor does not run x86-64-v4 (valid instruction sets: x86-64-v3, x86-64)");
  EXPECT_EQ(fault(isas("TR", "tR", "TR"), "x86-64-v3"),
            "SESSILE_ISA: x86-64-v3 is not installed (valid instruction sets: x86-64-v4, x86-64)");
  EXPECT_EQ(fault(isas("tr", "Tr", "tr"), ""),
            "this processor does not have the instruction set that sessile is built for: x86-64-v3");
}

TEST(IsaChoice, KnowsWhatTheProcessorRuns) {
  // These tests themselves are compiled for the library's instruction set.
  EXPECT_TRUE(processor_runs(build_info().isa));
  EXPECT_TRUE(processor_runs("x86-64"));
  EXPECT_TRUE(processor_runs("x86-64-v3") || !processor_runs("x86-64-v4"));
}

}  // namespace
}  // namespace sessile::app
