#include "unit/scene_files.h"

namespace sessile::test {
namespace {

class SceneErrors : public SceneFiles {
 protected:
  /// Faults of a sound scene to which lines are added, the first of them on line 4.
  std::vector<std::string> with(const std::string& lines, const std::vector<std::string>& overrides = {}) const {
    return faults(
        "{\n\"spacing\": 0.1, \"time\": {\"end\": 1},\n"
        "\"bodies\": [{\"shape\": {\"type\": \"box\", \"size\": [1, 1, 1]}}],\n" +
            lines + "\"title\": \"t\"}\n",
        overrides);
  }
};

TEST_F(SceneErrors, NoneInASoundScene) { EXPECT_EQ(with(""), Lines{}); }

TEST_F(SceneErrors, Files) {
  EXPECT_EQ(faults_of(folder_ / "no.json"), (Lines{"no.json: cannot be read: No such file or directory"}));
  std::filesystem::create_directory(folder_ / "d.json");
  EXPECT_EQ(faults_of(folder_ / "d.json"), (Lines{"d.json: cannot be read: it is a folder"}));
  EXPECT_EQ(faults(std::string("{\0}", 3)), (Lines{"s.json: cannot be read: it is no text file"}));
  EXPECT_EQ(faults(std::string((std::size_t{16} << 20) + 1, ' ')),
            (Lines{"s.json: cannot be read: it is larger than 16 MiB"}));
}

TEST_F(SceneErrors, Syntax) {
  EXPECT_EQ(faults("{\n  \"spacing\": 0.1\n  \"time\": {}\n}"),
            (Lines{"s.json:3: Missing ',' or '}' in object declaration"}));
  EXPECT_EQ(faults(""), (Lines{"s.json:1: Syntax error: value, object or array expected"}));
  EXPECT_EQ(faults("{}\n}"), (Lines{"s.json:2: Extra non-whitespace after JSON value"}));
  EXPECT_EQ(faults("\n" + std::string(100000, '[')), (Lines{"s.json:2: nested more than 64 levels deep"}));
  EXPECT_EQ(faults("[]"), (Lines{"s.json:1: expected a group {...}, found a list of 0"}));
}

TEST_F(SceneErrors, UnknownKeys) {
  EXPECT_EQ(with("\"forces\": [{\"type\": \"surface_feature\",\n \"cohesoin\": 3}],\n"),
            (Lines{"s.json:5: forces[0].cohesoin: unknown key (did you mean \"cohesion\"?)"}));
  EXPECT_EQ(with("\"Gravity\": [0, 0, 0],\n"), (Lines{"s.json:4: Gravity: unknown key (did you mean \"gravity\"?)"}));
  EXPECT_EQ(with("\"fluid\":\n {\"qqqq\":\n 3},\n"),
            (Lines{"s.json:5: fluid.qqqq: unknown key (valid keys: rest_density, viscosity)"}));
  EXPECT_TRUE(with("\"a\\u0007\":\n 3,\n").at(0).starts_with("s.json:4: a?: unknown key"));
}

TEST_F(SceneErrors, RepeatedKeys) {
  EXPECT_EQ(with("\"fluid\": {\"viscosity\": 1,\n\n\"viscosity\": 2},\n"),
            (Lines{"s.json:6: fluid.viscosity: given twice (first on line 4)"}));
  EXPECT_EQ(with("\"solids\": [\n{\"shape\": {\"type\": \"plate\", \"width\": 1, \"depth\": 1, \"width\": 1}}],\n"),
            (Lines{"s.json:5: solids[0].shape.width: given twice (first on line 5)"}));
}

TEST_F(SceneErrors, Types) {
  EXPECT_EQ(with("\"support\": \"2\",\n\"fluid\": 3,\n\"gravity\": [0, 1],\n\"forces\": {},\n\"emitters\": [1],\n"),
            (Lines{"s.json:4: support: expected a number, found the text \"2\"",
                   "s.json:5: fluid: expected a group {...}, found the number 3",
                   "s.json:6: gravity: expected three numbers [x, y, z], found a list of 2",
                   "s.json:7: forces: expected a list [...], found a group {...}",
                   "s.json:8: emitters[0]: expected a group {...}, found the number 1"}));
  EXPECT_EQ(with("\"fluid\": {\"viscosity\": true}, \"pressure\": {\"min_iterations\": 1.5},\n"
                 "\"output\": {\"formats\": [null, 2]},\n"),
            (Lines{"s.json:4: fluid.viscosity: expected a number [Pa s], found true",
                   "s.json:4: pressure.min_iterations: expected a whole number, found 1.5",
                   "s.json:5: output.formats[0]: expected a text, found null",
                   "s.json:5: output.formats[1]: expected a text, found the number 2"}));
  EXPECT_EQ(with("\"output\": {\"formats\": [\"v\\u0000tp\"]},\n"),
            (Lines{"s.json:4: output.formats[0]: holds a NUL character"}));
}

TEST_F(SceneErrors, Ranges) {
  EXPECT_EQ(with("\"support\": 9,\n\"fluid\": {\"rest_density\": 0, \"viscosity\": -1},\n"),
            (Lines{"s.json:4: support: must be from 1.5 to 4, found 9",
                   "s.json:5: fluid.rest_density: must be above 0 kg m^-3, found 0",
                   "s.json:5: fluid.viscosity: must be at least 0 Pa s, found -1"}));
  EXPECT_EQ(with("\"pressure\": {\"max_iterations\": 3e9},\n"),
            (Lines{"s.json:4: pressure.max_iterations: must be at most 2147483647, found 3000000000"}));
  EXPECT_EQ(with("\"pressure\": {\"max_iterations\": 99999999999999999999},\n"),
            (Lines{"s.json:4: pressure.max_iterations: must be at most 2147483647, found 1e+20"}));
}

TEST_F(SceneErrors, NotFinite) {
  EXPECT_EQ(with("\"gravity\": [0, NaN,\n -Infinity],\n\"support\": 1e999,\n"),
            (Lines{"s.json:4: gravity[1]: NaN is not a finite number",
                   "s.json:5: gravity[2]: -Infinity is not a finite number",
                   "s.json:6: support: 1e999 is not a finite number"}));
}

TEST_F(SceneErrors, Missing) {
  EXPECT_EQ(faults("{\n\"bodies\": [\n{},\n{\"shape\": {\"type\": \"sphere\"}},\n{\"shape\": {}}],\n\"time\": {}}"),
            (Lines{"s.json:1: spacing: missing: particle spacing dx [m]",
                   "s.json:3: bodies[0].shape: missing: what is filled",
                   "s.json:4: bodies[1].shape.radius: missing: radius [m]",
                   "s.json:5: bodies[2].shape.type: missing: one of box, sphere, cylinder, mesh",
                   "s.json:6: time.end: missing: simulated time at which the run ends [s]"}));
}

TEST_F(SceneErrors, Words) {
  EXPECT_EQ(with("\"forces\": [{\"type\": \"surface_feture\"},\n"
                 "{\"type\": \"surface_feature\", \"direction\": \"unti\"}],\n"
                 "\"pressure\": {\"type\": 3},\n"),
            (Lines{"s.json:4: forces[0].type: unknown type \"surface_feture\" (did you mean \"surface_feature\"?)",
                   "s.json:5: forces[1].direction: unknown word \"unti\" (did you mean \"unit\"?)",
                   "s.json:6: pressure.type: expected a word, found the number 3"}));
  EXPECT_EQ(with("\"solids\": [{\"shape\": {\"type\": \"torus\"}}],\n"),
            (Lines{"s.json:4: solids[0].shape.type: unknown type \"torus\" (valid types: box, plate, sphere, "
                   "cylinder, container, mesh)"}));
}

TEST_F(SceneErrors, Meshes) {
  EXPECT_EQ(with("\"solids\": [{\"shape\": {\"type\": \"mesh\",\n\"file\": \"no.obj\"}},\n"
                 "{\"shape\": {\"type\": \"mesh\", \"file\": \"cup.fbx\"}}],\n"),
            (Lines{"s.json:5: solids[0].shape.file: cannot read \"no.obj\": No such file or directory",
                   "s.json:6: solids[1].shape.file: expected the name of an .obj, .stl or .ply file, found "
                   "\"cup.fbx\""}));
}

TEST_F(SceneErrors, Overrides) {
  EXPECT_EQ(
      with("", {"spacng=1", "time.end=-1", "forces[1].cohesion=3", "title", "a..b=1", "time[0]=1", "spacing.x=1",
                "gravity=[0,0,1e999]", "fluid={\"viscosity\": -1}"}),
      (Lines{"--set spacng: unknown key (did you mean \"spacing\"?)", "--set time.end: must be above 0 s, found -1",
             "--set forces[1].cohesion: forces has 0 entries, so the next index is 0",
             "--set title: expected path=value", "--set a..b: expected a path such as forces[0].cohesion",
             "--set time[0]: time is no list", "--set spacing.x: spacing is no group",
             "--set gravity: [0,0,1e999] is not finite",
             "--set fluid: fluid.viscosity: must be at least 0 Pa s, found -1"}));
}

TEST_F(SceneErrors, Together) {
  EXPECT_EQ(faults("{\"spacing\": 0.1, \"time\": {\"end\": 1, \"dt_min\": 1}}"),
            (Lines{"s.json:1: nothing to simulate: the scene has neither bodies nor emitters",
                   "s.json:1: time.dt_min: 1 s is more than time.dt_max, 0.008 s"}));
  EXPECT_EQ(
      with("\"domain\": {\"min\": [0, 0, 0],\n\"max\": [0, 0.5, 0.05],\n\"y\": \"periodic\", \"z\": \"closed\"},\n"),
      (Lines{"s.json:5: domain.max[0]: 0 m is not above domain.min[0], 0 m",
             "s.json:5: domain.max[1]: the domain is periodic along y, so it must be at least 3 support "
             "radii (0.6 m) long; it is 0.5 m",
             "s.json:5: domain.max[2]: the domain is closed across z and only 0.05 m long: no particle of "
             "spacing 0.1 m fits"}));
  EXPECT_EQ(with("\"emitters\": [{\"shape\": {\"type\": \"disc\", \"radius\": 1}},\n"
                 "{\"shape\": {\"type\": \"disc\", \"radius\": 1}, \"interval\": 1, \"times\": [2, 2]},\n"
                 "{\"shape\": {\"type\": \"disc\", \"radius\": 1}, \"interval\": 1, \"start\": 2, \"end\": 1}],\n"),
            (Lines{"s.json:4: emitters[0]: needs times or an interval at which layers appear",
                   "s.json:5: emitters[1]: has both times and an interval; give one of them",
                   "s.json:5: emitters[1].times[1]: 2 s does not come after 2 s",
                   "s.json:6: emitters[2].end: 1 s is before the first layer, due at 2 s"}));
  EXPECT_EQ(
      with("\"solids\": [\n{\"shape\": {\"type\": \"sphere\", \"radius\": 1}, \"spacing\": 0.2, \"label\": \"a\"},\n"
           "{\"shape\": {\"type\": \"sphere\", \"radius\": 1}, \"label\": \"a\", \"spacing\": 0.001,\n"
           "\"placement\": {\"axis\": [0, 0, 0]}},\n"
           "{\"shape\": {\"type\": \"sphere\", \"radius\": 1}, \"label\": \"domain\"},\n"
           "{\"shape\": {\"type\": \"sphere\", \"radius\": 1}, \"label\": \"a,b\"}],\n"),
      (Lines{"s.json:5: solids[0].spacing: 0.2 m is more than 1.5 times the particle spacing, 0.1 m: "
             "particles would slip through",
             "s.json:6: solids[1].label: \"a\" names another solid already",
             "s.json:6: solids[1].spacing: 0.001 m is less than 0.05 times the particle spacing, 0.1 m: "
             "needlessly many samples",
             "s.json:7: solids[1].placement.axis: [0, 0, 0] is no axis to turn about",
             "s.json:8: solids[2].label: names that start with \"domain\" are those of the domain's own walls",
             "s.json:9: solids[3].label: may not hold commas, quotation marks or control characters"}));
  EXPECT_EQ(with("\"output\": {\"frame_interval\": 1e-9, \"formats\": [\"ply\", \"ply\"]},\n"
                 "\"pressure\": {\"min_iterations\": 5, \"max_iterations\": 4},\n"
                 "\"domain\": {\"min\": [1, 1, 1], \"max\": [2, 2, 2]},\n"),
            (Lines{"s.json:3: bodies[0].placement.position: stands outside the domain",
                   "s.json:4: output.frame_interval: 1e-09 s would make more than 1000000 frames in 1 s",
                   "s.json:4: output.formats[1]: \"ply\" is listed twice",
                   "s.json:5: pressure.min_iterations: 5 is more than pressure.max_iterations, 4"}));
}

TEST_F(SceneErrors, AllAtOnceInTheOrderOfTheFile) {
  EXPECT_EQ(
      faults("// a comment\n{\n\"spacing\": -1, // another\n\"tme\": {\"end\": 1},\n/* and\n one */ \"fluid\": {\n"
             "\"viscosity\": 1, \"viscosity\": \"x\"},\n\"bodies\": [{\"shape\": {\"type\": \"bx\"}}]}",
             {"title=3"}),
      (Lines{"s.json:2: time: missing: how far and in which steps", "s.json:3: spacing: must be above 0 m, found -1",
             "s.json:4: tme: unknown key (did you mean \"time\"?)",
             "s.json:7: fluid.viscosity: given twice (first on line 7)",
             "s.json:7: fluid.viscosity: expected a number [Pa s], found the text \"x\"",
             "s.json:8: bodies[0].shape.type: unknown type \"bx\" (did you mean \"box\"?)",
             "--set title: expected a text, found the number 3"}));
}

}  // namespace
}  // namespace sessile::test
