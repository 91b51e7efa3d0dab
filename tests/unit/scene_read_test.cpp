#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "sessile/scene/describe.h"
#include "sessile/scene/method.h"
#include "sessile/scene/reference.h"
#include "sessile/scene/spelling.h"
#include "sessile/scene/traits.h"
#include "sessile/scene/validate.h"
#include "unit/scene_files.h"

namespace sessile::test {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Whether two values agree in every declared field.
template <class T>
bool same(const T& a, const T& b) {
  if constexpr (is_optional<T>) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
  } else if constexpr (is_list<T>) {
    bool equal = a.size() == b.size();
    for (std::size_t i = 0; equal && i < a.size(); ++i) equal = same(a[i], b[i]);
    return equal;
  } else if constexpr (is_choice<T>) {
    return a.index() == b.index() && std::visit([&]<class U>(const U& u) { return same(u, std::get<U>(b)); }, a);
  } else if constexpr (Declared<T>) {
    bool equal = true;
    for_each_field<T>([&](const auto& f) { equal = equal && same(a.*f.member, b.*f.member); });
    return equal;
  } else {
    return a == b;
  }
}

class SceneReading : public SceneFiles {
 protected:
  Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_scene(write("s.json", text), overrides);
  }
};

constexpr const char* small = R"({"spacing": 0.1, "time": {"end": 1, "fixed_dt": 0.001},
  "bodies": [{"shape": {"type": "box", "size": [1, 2, 3]}}], "forces": [{"type": "surface_feature"}]})";

/// A scene that uses every kind of field, away from every default.
Scene rich(const std::string& mesh) {
  Scene s;
  s.title = "a \"quoted\" text with \\ and / and \xC3\xA4";
  s.spacing = 0.1 + 0.2;
  s.support = 1.0 / 0.3;
  s.gravity = {1e-300, -1.0 / 3, 9.81};
  s.time = {1.0 / 3, 1e-3, 1e-9, 1e-2, 1.5, 0.3, 0.2, 0.1, 0.7};
  s.fluid = {997.3, 1e-3};
  s.forces = {SurfaceFeature{1, 2, 3, Direction::unit}, SurfaceFeature{}};
  s.pressure = Iisph{1e-5, 3, 77, 0.4, 0.25};
  s.bodies = {Body{"a", Sphere{1}, {{1, 2, 3}, {0, 1, 1}, 30}, {1, 0, 0}, {0, 0, 2}, 0.8, 0.1, 7},
              Body{"b", Cylinder{1, 2}, {}, {}, {}, 1, 0, 2147483647}, Body{"c", Mesh{mesh, 0.5}, {}, {}, {}, 1, 0, 1}};
  s.emitters = {Emitter{"e", Disc{1}, {}, {}, {0, 0.1, 1e5}, {}, 0, {}, {}, 1},
                Emitter{"f", Rectangle{1, 2}, {}, {}, {}, 0.5, 1, 7, 3, 0.9}};
  s.domain = Domain{{-9, -9, -9}, {9, 9, 9}, Edge::closed, Edge::periodic, Edge::open};
  s.solids = {Solid{"p", Plate{1, 2}, {}, 0.2, 2, 0.5, 0.0}, Solid{"q", Container{{1, 2, 3}}, {}, {}, 1, 1, {}}};
  SurfaceOutput surface;
  surface.method = DensityField{2.5, 1.0 / 3};
  surface.cube_size = 0.1 + 0.2;
  surface.formats = {"vdb", "usda"};
  surface.interval = 0.7;
  surface.stats = true;
  s.output = {0.02, 0.0, {"ply"}, {"id", "normal"}, surface};
  return s;
}

TEST_F(SceneReading, GivesDefaultsAndValues) {
  const Scene scene = read(small);
  EXPECT_EQ(scene.spacing, 0.1);
  EXPECT_EQ(scene.support, 2);
  EXPECT_EQ(scene.time.fixed_dt, 0.001);
  EXPECT_EQ(std::get<Box>(scene.bodies.at(0).shape).size, (Vec3d{1, 2, 3}));
  EXPECT_EQ(std::get<SurfaceFeature>(scene.forces.at(0)).cohesion, SurfaceFeature{}.cohesion);
  EXPECT_FALSE(scene.domain);
}

TEST_F(SceneReading, ReadsWindowsFiles) {
  EXPECT_EQ(read("\xEF\xBB\xBF{\"spacing\": 1,\r\n\"time\": {\"end\": 1},\r\n"
                 "\"bodies\": [{\"shape\": {\"type\": \"sphere\", \"radius\": 3}}]}\r\n")
                .spacing,
            1);
}

TEST_F(SceneReading, PutsOverridesOnTop) {
  const Scene scene = read(small, {"time.fixed_dt=null", "title=two words", "forces[0].cohesion=5",
                                   "forces[1]={\"type\": \"surface_feature\", \"direction\": \"unit\"}",
                                   "bodies[0].shape.size=[4,5,6]", "output.frame_interval=0.5", "pressure.error=1e-3",
                                   "domain.min=[-9,-9,-9]", "domain.max=[9,9,9]", "domain.x=closed"});
  EXPECT_FALSE(scene.time.fixed_dt);
  EXPECT_EQ(scene.title, "two words");
  EXPECT_EQ(std::get<SurfaceFeature>(scene.forces.at(0)).cohesion, 5);
  EXPECT_EQ(std::get<SurfaceFeature>(scene.forces.at(1)).direction, Direction::unit);
  EXPECT_EQ(std::get<Box>(scene.bodies.at(0).shape).size, (Vec3d{4, 5, 6}));
  EXPECT_EQ(scene.output.frame_interval, 0.5);
  EXPECT_EQ(std::get<Iisph>(scene.pressure).error, 1e-3);
  EXPECT_EQ(scene.domain.value().x, Edge::closed);
}

TEST_F(SceneReading, ComesBackFromItsJson) {
  const auto mesh = write("m.obj", "").string();
  const Scene scene = rich(mesh);
  EXPECT_TRUE(validate(scene).empty());
  const Scene back = read(to_json(scene));
  EXPECT_TRUE(same(scene, back)) << to_json(scene) << to_json(back);
  EXPECT_EQ(to_json(scene), to_json(back));
  Scene other = scene;
  std::get<Sphere>(other.bodies[0].shape).radius = 2;
  EXPECT_FALSE(same(scene, other));
}

TEST_F(SceneReading, RemembersWhatWasGiven) {
  const auto resolved = read_resolved_scene(write("s.json", small), std::vector<std::string>{"fluid.viscosity=3"});
  std::string text = describe(resolved);
  const auto both_blank = [](char a, char b) { return a == ' ' && b == ' '; };
  text.erase(std::unique(text.begin(), text.end(), both_blank), text.end());  // widths of columns do not matter
  EXPECT_TRUE(has(text, "time.end 1 given s\n"));
  EXPECT_TRUE(has(text, "fluid.viscosity 3 given Pa s\n"));
  EXPECT_TRUE(has(text, "fluid.rest_density 1000 default kg m^-3\n"));
  EXPECT_TRUE(has(text, "domain (unbounded space) default\n"));
  EXPECT_TRUE(resolved.locate({"bodies[0].shape.size[1]", "too big", {}})
                  .ends_with("s.json:2: bodies[0].shape.size[1]: too big"));
  EXPECT_EQ(resolved.locate({"fluid.viscosity", "too big", {}}), "--set fluid.viscosity: too big");
}

TEST_F(SceneReading, ResolvesMeshesFromTheSceneFile) {
  std::filesystem::create_directory(folder_ / "meshes");
  write("meshes/cup.STL", "");
  const Scene scene = read(R"({"spacing": 0.1, "time": {"end": 1},
    "bodies": [{"shape": {"type": "mesh", "file": "./meshes/cup.STL"}}]})");
  EXPECT_EQ(std::get<Mesh>(scene.bodies[0].shape).file, (folder_ / "meshes/cup.STL").string());
}

TEST(SceneFilesOfTheProject, AreSound) {
  int scenes = 0, methods = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SESSILE_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    const bool is_method = entry.path().parent_path().filename() == "methods";
    ++(is_method ? methods : scenes);
    if (is_method) {
      EXPECT_NO_THROW(read_method(entry.path())) << entry.path();
    } else {
      EXPECT_NO_THROW(read_scene(entry.path())) << entry.path();
    }
  }
  EXPECT_GE(scenes, 7);
  EXPECT_GE(methods, 3);
}

TEST(SurfaceSettings, TakeOverridesAsScenesDo) {
  SurfaceSettings before;
  before.method = DensityField{3, 0.4};
  before.cube_size = 1;
  const auto after = with_overrides(before, std::vector<std::string>{"method.threshold=0.5", "cube_size=2"});
  EXPECT_EQ(after.cube_size, 2);
  EXPECT_EQ(std::get<DensityField>(after.method).threshold, 0.5);
  EXPECT_EQ(std::get<DensityField>(after.method).smoothing_length, 3) << "what is not overridden stays";
  EXPECT_EQ(with_overrides(before, {}).cube_size, 1);
  try {
    with_overrides(before, std::vector<std::string>{"cube_sze=1", "method.type=densty", "cube_size=0"});
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_EQ(e.messages, (std::vector<std::string>{"--set cube_sze: unknown key (did you mean \"cube_size\"?)",
                                                    "--set method.type: unknown type \"densty\" (did you mean "
                                                    "\"density\"?)",
                                                    "--set cube_size: must be above 0, found 0"}));
  }
}

TEST(SceneReference, IsUpToDate) {
  // To bring it up to date: run this program with SESSILE_WRITE_DOCS set.
  const std::filesystem::path file = SESSILE_SOURCE_DIR "/docs/scenes.md";
  if (std::getenv("SESSILE_WRITE_DOCS") != nullptr) std::ofstream(file) << scene_reference_markdown();
  EXPECT_EQ(contents(file), scene_reference_markdown());
}

TEST(SceneReference, KnowsEveryGroup) {
  const auto groups = scene_reference();
  EXPECT_EQ(groups.size(), 33U + std::variant_size_v<SurfaceMethod>);
  EXPECT_TRUE(has(models_text(), "  iisph: "));
  EXPECT_TRUE(has(models_text(), "  container: "));
  EXPECT_TRUE(has(scene_reference_markdown(), "## Type `box`"));
}

TEST(SceneInCode, IsJudgedWithoutAFile) {
  Scene scene;
  scene.spacing = 0.1;
  scene.time.end = 1;
  scene.bodies.push_back({});
  std::get<Box>(scene.bodies[0].shape).size = {1, -1, std::numeric_limits<double>::quiet_NaN()};
  const auto faults = validate(scene);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(text(faults[0]), "bodies[0].shape.size[1]: must be above 0 m, found -1");
  EXPECT_EQ(text(faults[1]), "bodies[0].shape.size[2]: nan is not a finite number");
}

TEST(Spelling, FindsTheNearest) {
  EXPECT_EQ(edit_distance("cohesoin", "cohesion"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  const std::vector<std::string_view> words{"min", "max", "x"};
  EXPECT_EQ(nearest("mni", words), "min");
  EXPECT_EQ(nearest("MAX", words), "max");
  EXPECT_EQ(nearest("q", words), "");
  EXPECT_EQ(nearest(std::string(1000, 'x'), words), "");
}

}  // namespace
}  // namespace sessile::test
