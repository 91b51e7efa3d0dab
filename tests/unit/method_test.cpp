#include "sessile/scene/method.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>

#include "sessile/core/units.h"
#include "sessile/output/check.h"
#include "unit/scene_files.h"

namespace sessile {
namespace {

using test::has;
using test::Lines;

class Methods : public test::SceneFiles {
 protected:
  /// The faults that f meets, the folder cut off.
  template <class F>
  Lines faults_in(F&& f) const {
    try {
      f();
    } catch (const SceneError& error) {
      Lines messages = error.messages;
      const std::string folder = folder_.string() + "/";
      for (auto& message : messages) {
        if (const auto at = message.find(folder); at != std::string::npos) message.erase(at, folder.size());
      }
      return messages;
    }
    return {};
  }

  Lines method_faults(const std::string& text) const {
    return faults_in([&] { read_method(write("m.json", text)); });
  }
};

TEST_F(Methods, AreReadAsScenesAre) {
  const Method method = read_method(write("m.json", R"({
    // a comment
    "title": "one", "pressure": {"type": "iisph", "error": 1e-3}, "forces": [{"type": "surface_feature", "cohesion": 3}]
  })"));
  EXPECT_EQ(method.title, "one");
  EXPECT_EQ(std::get<Iisph>(method.pressure).error, 1e-3);
  ASSERT_EQ(method.forces.size(), 1u);
  EXPECT_EQ(std::get<SurfaceFeature>(method.forces[0]).cohesion, 3);
}

TEST_F(Methods, NameTheirFaults) {
  EXPECT_EQ(method_faults("{\n\"title\": \"no solver\"\n}"), Lines{"m.json:1: pressure: missing: the pressure solver"});
  EXPECT_EQ(method_faults("{\"pressure\": {\"type\": \"iisph\"},\n\"force\": []}"),
            Lines{"m.json:2: force: unknown key (did you mean \"forces\"?)"});
  EXPECT_EQ(method_faults("{\"pressure\": {\"type\": \"iisph\"},\n\"viscosity\": 1}").size(), 1u);
  const Lines two = method_faults(
      "{\"pressure\": {\"type\": \"iisp\"},\n\"forces\": [\n{\"type\": \"surface_feature\", \"cohesion\": -1}]}");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_TRUE(has(two[0], "m.json:1: pressure.type: unknown type \"iisp\" (did you mean \"iisph\"?)")) << two[0];
  EXPECT_TRUE(has(two[1], "m.json:3: forces[0].cohesion: must be at least 0")) << two[1];
  const Lines twice = method_faults("{\"pressure\": {\"type\": \"iisph\"},\n\"pressure\": {\"type\": \"iisph\"}}");
  EXPECT_EQ(twice, Lines{"m.json:2: pressure: given twice (first on line 1)"});
  EXPECT_EQ(method_faults("{\"pressure\": ").size(), 1u);
  EXPECT_EQ(faults_in([&] { read_method(folder_ / "none.json"); }).size(), 1u);
}

constexpr const char* scene_text = R"({"spacing": 0.1, "time": {"end": 1},
"forces": [{"type": "surface_feature"}, {"type": "surface_feature"}],
"output": {"fields": ["id", "acceleration_surface_feature"]},
"bodies": [{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}}]})";

TEST_F(Methods, TakeThePlaceOfTheScenesOwn) {
  const ResolvedScene scene = read_resolved_scene(write("s.json", scene_text));
  const ResolvedMethod method = read_resolved_method(write(
      "m.json", R"({"pressure": {"type": "iisph", "max_iterations": 7}, "forces": [{"type": "surface_feature"}]})"));
  const ResolvedScene both = with_method(scene, method, check_output);
  EXPECT_EQ(both.scene.forces.size(), 1u);
  EXPECT_EQ(std::get<Iisph>(both.scene.pressure).max_iterations, 7);
  EXPECT_EQ(both.scene.bodies.size(), 1u);
  EXPECT_TRUE(has(both.places.at("forces[0].type"), "m.json:1"));
  EXPECT_FALSE(both.places.contains("forces[1].type"));
  EXPECT_TRUE(has(both.places.at("bodies"), "s.json:4"));
}

TEST_F(Methods, AreJudgedWithTheScene) {
  const ResolvedScene scene = read_resolved_scene(write("s.json", scene_text));
  const ResolvedMethod none = read_resolved_method(write("m.json", R"({"pressure": {"type": "iisph"}})"));
  EXPECT_NO_THROW(with_method(scene, none));
  const Lines faults = faults_in([&] { with_method(scene, none, check_output); });
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_TRUE(has(faults[0], "s.json:3: output.fields[1]: unknown field \"acceleration_surface_feature\""))
      << faults[0];
  const ResolvedMethod turned = read_resolved_method(
      write("t.json", "{\"pressure\": {\"type\": \"iisph\",\n\"min_iterations\": 9, \"max_iterations\": 3}}"));
  EXPECT_TRUE(has(faults_in([&] { with_method(scene, turned); }).at(0), "t.json:2: pressure.m"));
}

// What docs/comparing.md says of the presets: 119 N/m at the paper's scale, but for those without tension and csf.
TEST(Presets, HaveTheTensionThatIsSaidOfThem) {
  const Units units{0.1, 0.2, 1000};
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SESSILE_SCENES) / "methods")) {
    const Method method = read_method(entry.path());
    const std::string name = entry.path().stem().string();
    double tension = 0;
    for (const Force& force : method.forces) {
      tension += std::visit([&](const auto& model) { return model.tension(units); }, force);
    }
    EXPECT_NE(method.title, "") << name;
    EXPECT_NEAR(tension, name == "none" ? 0 : name == "csf" ? 15 : 119, 1) << name;
    ++found;
  }
  EXPECT_GE(found, 13);
}

}  // namespace
}  // namespace sessile
