"""Scenes that are refused: the exact lines, all at once, exit code 2, nothing written."""
from sessile_cli import CliTest, tiny, unittest

HEAD = '{\n"spacing": 0.1, "time": {"end": 0.04},\n'
BODY = '"bodies": [{"shape": {"type": "box", "size": [0.3, 0.3, 0.3]}}]'


class SceneFaults(CliTest):
    def expect(self, text, *lines, overrides=(), names=("check", "run")):
        """Both commands must refuse the scene with these lines, `s.json:` standing before those that start with a digit."""
        scene = self.write(text)
        wanted = [("s.json:" if line[0].isdigit() else "") + line for line in lines]
        options = [word for each in overrides for word in ("--set", each)]
        for name in names:
            self.assertEqual(self.refused(name, scene, *options), wanted)

    def around(self, text, *lines, **more):
        """The text stands in a sound scene, from line 3 on."""
        self.expect(HEAD + text + ",\n" + BODY + "}", *lines, **more)


class Files(SceneFaults):
    def test_missing(self):
        self.assertEqual(self.refused("run", "no.json"), ["no.json: cannot be read: No such file or directory"])
        self.assertEqual(self.refused("check", "."), [".: cannot be read: it is a folder"])

    def test_no_json(self):
        self.expect("", "1: Syntax error: value, object or array expected")
        self.expect('{\n"spacing": 0.1\n"time": {}}', "3: Missing ',' or '}' in object declaration")
        self.expect("[]", "1: expected a group {...}, found a list of 0")

    def test_meshes(self):
        self.around('"solids": [{"shape": {"type": "mesh",\n"file": "no.obj"}}]',
                    '4: solids[0].shape.file: cannot read "no.obj": No such file or directory')
        (self.folder / "empty.obj").write_text("v 0 0 0\n")
        lines = self.refused("run", self.write(
            HEAD + '"solids": [{"shape": {"type": "mesh", "file": "empty.obj"}}],\n' + BODY + "}"))
        self.assertEqual(len(lines), 1)
        self.assertRegex(lines[0], r"^s\.json: .*empty\.obj: holds no triangles$")
        (self.folder / "cut.stl").write_bytes(bytes(90))
        lines = self.refused("run", self.write(
            HEAD + '"solids": [{"shape": {"type": "mesh", "file": "cut.stl"}}],\n' + BODY + "}"))
        self.assertEqual(len(lines), 1)
        self.assertRegex(lines[0], r"^s\.json: .*cut\.stl")


class Values(SceneFaults):
    def test_unknown_keys(self):
        self.around('"fluid": {"viscosty": 1}', '3: fluid.viscosty: unknown key (did you mean "viscosity"?)')
        self.around('"fluid": {"qqqq": 1}', "3: fluid.qqqq: unknown key (valid keys: rest_density, viscosity)")

    def test_repeated_keys(self):
        self.around('"fluid": {"viscosity": 1,\n"viscosity": 2}', "4: fluid.viscosity: given twice (first on line 3)")

    def test_types(self):
        self.around('"support": "2",\n"gravity": [0, 1]', '3: support: expected a number, found the text "2"',
                    "4: gravity: expected three numbers [x, y, z], found a list of 2")

    def test_ranges(self):
        self.around('"fluid": {"rest_density": 0}', "3: fluid.rest_density: must be above 0 kg m^-3, found 0")
        self.around('"support": 9', "3: support: must be from 1.5 to 4, found 9")

    def test_not_finite(self):
        self.around('"support": 1e999', "3: support: 1e999 is not a finite number")
        self.around('"gravity": [0, NaN, 0]', "3: gravity[1]: NaN is not a finite number")

    def test_missing(self):
        self.expect("{\n" + BODY + "}", "1: spacing: missing: particle spacing dx [m]",
                    "1: time: missing: how far and in which steps")

    def test_words(self):
        self.around('"forces": [{"type": "surface_feture"}]',
                    '3: forces[0].type: unknown type "surface_feture" (did you mean "surface_feature"?)')

    def test_output(self):
        self.around('"output": {"formats": ["vtp", "vtk"],\n"fields": ["id", "velocty", "colour", "id"]}',
                    '3: output.formats[1]: unknown format "vtk" (did you mean "vtp"?)',
                    '4: output.fields[1]: unknown field "velocty" (did you mean "velocity"?)',
                    '4: output.fields[2]: unknown field "colour" (valid fields: id, velocity, speed, density, pressure, '
                    "mass, normal, neighbors, wall_neighbors, acceleration_gravity, acceleration_viscosity, "
                    "acceleration_pressure)",
                    '4: output.fields[3]: "id" is listed twice')

    def test_overrides(self):
        self.around('"support": 2', '--set spacng: unknown key (did you mean "spacing"?)',
                    "--set time.end: must be above 0 s, found -1", "--set title: expected path=value",
                    "--set forces[1].cohesion: forces has 0 entries, so the next index is 0",
                    '--set output.formats: output.formats[0]: unknown format "vtk" (did you mean "vtp"?)',
                    overrides=["spacng=1", "time.end=-1", "title", "forces[1].cohesion=3", 'output.formats=["vtk"]'])

    def test_all_at_once(self):
        self.expect('// a comment\n{\n"spacing": -1,\n"tme": {"end": 1},\n"fluid": {"viscosity": "x"},\n'
                    '"solids": [{"label": "a,b", "shape": {"type": "sphere", "radius": 1}}],\n'
                    '"bodies": [{"shape": {"type": "bx"}}],\n"output": {"formats": ["vtk"]}}',
                    "2: time: missing: how far and in which steps", "3: spacing: must be above 0 m, found -1",
                    '4: tme: unknown key (did you mean "time"?)',
                    '5: fluid.viscosity: expected a number [Pa s], found the text "x"',
                    "6: solids[0].label: may not hold commas, quotation marks or control characters",
                    '7: bodies[0].shape.type: unknown type "bx" (did you mean "box"?)',
                    '8: output.formats[0]: unknown format "vtk" (did you mean "vtp"?)')


class WholeScenes(SceneFaults):
    """What only the parts together show."""

    def test_empty(self):
        self.expect('{"spacing": 0.1, "time": {"end": 1}}',
                    "1: nothing to simulate: the scene has neither bodies nor emitters")

    def test_too_small_a_body(self):
        self.expect(HEAD + '"bodies": [\n{"label": "a", "shape": {"type": "box", "size": [0.01, 1, 1]}}]}',
                    's.json: body "a" (box): is too small to hold a particle of spacing 0.1 m')

    def test_overlap(self):
        ball = '{"label": "%s", "shape": {"type": "sphere", "radius": 0.2}}'
        self.expect(HEAD + '"bodies": [\n' + ball % "a" + ",\n" + ball % "b" + "]}",
                    '4: bodies[0] "a" and bodies[1] "b" overlap')

    def test_inside_a_solid(self):
        self.expect(HEAD + '"solids": [{"label": "rock", "shape": {"type": "sphere", "radius": 1}}],\n' + BODY + "}",
                    '4: bodies[0] starts inside the solid "rock" (27 of its particles)')

    def test_outside_the_domain(self):
        self.expect(HEAD + '"domain": {"min": [0, -1, -1], "max": [1, 1, 1]},\n' + BODY + "}",
                    "4: bodies[0] starts outside the domain (9 of its particles)")

    def test_emitter_inside_a_solid(self):
        self.expect(HEAD + '"solids": [{"label": "rock", "shape": {"type": "sphere", "radius": 1}}],\n"emitters": [\n'
                    '{"label": "tap", "interval": 1, "shape": {"type": "rectangle", "width": 0.2, "depth": 0.2}}]}',
                    '5: emitters[0] "tap" starts inside the solid "rock" (4 of its particles)')

    def test_several(self):
        self.expect(HEAD + '"domain": {"min": [0, -1, -1], "max": [1, 1, 1]},\n"solids": [{"label": "rock", "shape": '
                    '{"type": "sphere", "radius": 1}}],\n' + BODY + "}",
                    '5: bodies[0] starts inside the solid "rock" (27 of its particles)',
                    "5: bodies[0] starts outside the domain (9 of its particles)")

    def test_too_large(self):
        for size in ("[300, 300, 300]", "[1e5, 1e5, 1e5]"):
            lines = self.refused("run", self.write(HEAD + BODY + "}"), "--set", f"bodies[0].shape.size={size}")
            self.assertEqual(len(lines), 1)
            self.assertRegex(lines[0], r"^s\.json: .*(GiB; this machine has .* GiB|2000000000)")


if __name__ == "__main__":
    unittest.main()
