"""Help, version, info, models, wrong usage."""
import re

from sessile_cli import VERSION, CliTest, tiny, unittest

COMMANDS = ("run", "mesh", "picture", "view", "render", "compare", "bench", "check", "info", "models")


class Help(CliTest):
    def test_program(self):
        out, err = self.call("--help")
        self.assertEqual(err, "")
        for command in COMMANDS:
            self.assertRegex(out, rf"(?m)^  {command} +[A-Z].*\.$")
        self.assertIn("Exit codes: 0 done, 1 the run failed, 2 wrong usage or scene, 3 another", out)

    def test_every_command(self):
        options = {"run": ["SCENE", "--output DIR", "--set PATH=VALUE", "--until SECONDS", "--threads N", "--progress"],
                   "mesh": ["DIR|FRAME", "--output DIR", "--format NAME", "--set PATH=VALUE", "--frames LIST",
                            "--spacing METRES", "--again", "--threads N", "--progress"],
                   "picture": ["DIR|SCENE", "--output FILE", "--frames LIST", "--time SECONDS", "--look NAME", "--field NAME", "--range LOW,HIGH",
                               "--view AZIMUTH,ELEVATION", "--size WxH", "--video FILE", "--fps N"],
                   "view": ["SCENE|DIR", "--output DIR", "--set PATH=VALUE", "--paused", "--field NAME", "--look", "--size WxH"],
                   "render": ["DIR", "--output DIR", "--frames LIST", "--look NAME", "--camera KEY=VALUE", "--samples N",
                              "--size WxH", "--fps N", "--video FILE", "--blend FILE", "--again", "--progress"],
                   "compare": ["SCENE", "--methods LIST", "--output DIR", "--set PATH=VALUE", "--until SECONDS",
                               "--threads N", "--progress", "--search-dt", "--search-until SECONDS",
                               "--search-max SECONDS"],
                   "bench": ["--case NAME", "--runs N", "--threads N", "--particles N", "--json FILE"],
                   "check": ["SCENE", "--set PATH=VALUE", "--json"], "info": [], "models": []}
        for command in COMMANDS:
            for flag in ("--help", "-h"):
                with self.subTest(command=command, flag=flag):
                    out, err = self.call(command, flag)
                    self.assertEqual(err, "")
                    self.assertIn(f"Usage: sessile {command} ", out)
                    for option in options[command]:
                        self.assertIn(option, out)

    def test_version(self):
        out, err = self.call("--version")
        self.assertRegex(out, r"^sessile \d+\.\d+\.\d+\n$")
        self.assertEqual(err, "")
        if VERSION:
            self.assertEqual(out, f"sessile {VERSION}\n")


class WrongUsage(CliTest):
    def expect(self, arguments, first_line):
        with self.subTest(arguments=arguments):
            lines = self.refused(*arguments)
            self.assertEqual(lines, [first_line, "Run with --help for more information."])

    def test_commands(self):
        self.expect([], "A subcommand is required")
        self.expect(["--threads", "1"], "A subcommand is required")
        self.expect(["rnu", "s.json"], 'unknown command "rnu" (did you mean "run"?)')
        self.expect(["simulate"], f'unknown command "simulate" (valid commands: {", ".join(COMMANDS)})')

    def test_options(self):
        scene = self.write(tiny())
        self.expect(["run"], "a SCENE, or --resume DIR, is required")
        self.expect(["check"], "scene is required")
        self.expect(["run", scene, "--thread=1"], "The following argument was not expected: --thread=1")
        self.expect(["run", scene, "other.json"], "The following argument was not expected: other.json")
        self.expect(["info", "more"], "The following argument was not expected: more")
        self.expect(["run", scene, "--set"], "--set: 1 required PATH=VALUE missing")
        self.expect(["run", scene, "-o"], "--output: 1 required DIR missing")
        self.expect(["run", scene, "--threads", "0"], "--threads: Value 0 not in range 1 to 1024")
        self.expect(["run", scene, "--threads", "two"], "--threads: Value two not in range 1 to 1024")
        self.expect(["run", scene, "--progress", "loud"], "--progress: loud not in {auto,plain,json,none}")

    def test_until(self):
        scene = self.write(tiny())
        self.expect(["run", scene, "--until", "0"], "--until: must be above 0 s, found 0")
        self.expect(["run", scene, "--until=-1"], "--until: must be above 0 s, found -1")
        self.expect(["run", scene, "--until", "nan"], "--until: nan is not a finite number")
        self.expect(["run", scene, "--until", "inf"], "--until: inf is not a finite number")
        self.expect(["run", scene, "--until", "1e999"], "--until: 1e999 is not a finite number")
        self.expect(["run", scene, "--until", "soon"], "Could not convert: --until = soon")


class Info(CliTest):
    def test_tells_of_the_build(self):
        out, err = self.call("info")
        self.assertEqual(err, "")
        self.assertRegex(out, r"\Aversion    \d+\.\d+\.\d+\ncompiler   \S.*\nbuild      .*, (32|64)-bit numbers\n"
                              r"SIMD       \S+ \(\S+\), \d+ lanes\n"
                              r"variants   \S.*\nthreads    1\n\Z")


class Models(CliTest):
    """Written out by hand: a model that disappears from the program, or comes without its page, is noticed."""

    GROUPS = {
        "Pressure solvers (pressure)": ["iisph", "pcisph", "wcsph", "dfsph"],
        "Forces (forces[])": ["surface_feature", "akinci2013", "csf", "becker2007", "tartakovsky2005", "he2014"],
        "Shapes (shape of a body, an emitter or a solid)":
            ["box", "sphere", "cylinder", "mesh", "rectangle", "disc", "plate", "container"],
    }

    def test_lists_every_model(self):
        out, err = self.call("models")
        self.assertEqual(err, "")
        for heading, names in self.GROUPS.items():
            section = out.split(heading + "\n")[1].split("\n\n")[0]
            self.assertEqual(re.findall(r"(?m)^  (\w+): \S", section), names)

    def test_gives_units_ranges_and_defaults(self):
        out, _ = self.call("models")
        for line in (r"relaxation +number, from 0.01 to 1, default 0.5",
                     r"max_iterations +whole number, at least 1, default 200",
                     r"area_minimisation +number \[m s\^-2\], at least 0, default ",
                     r"direction +word: displacement, unit, default ",
                     r"radius +number \[m\], above 0, required",
                     r"file +text, required"):
            self.assertRegex(out, rf"(?m)^    {line}")

    def test_lists_formats_and_fields(self):
        out, _ = self.call("models")
        formats = out.split("(output.formats)\n")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"(?m)^  (\w+) +\S", formats), ["vtp", "ply"])
        fields = re.findall(r"(?m)^  (\S+) +(\S+) +\S", out.split("(output.fields)\n")[1])
        self.assertEqual(fields, [("id", "-"), ("velocity", "m/s"), ("speed", "m/s"), ("density", "kg/m^3"),
                                  ("pressure", "Pa"), ("mass", "kg"), ("normal", "-"), ("neighbors", "-"),
                                  ("wall_neighbors", "-"), ("acceleration_<force>", "m/s^2")])


if __name__ == "__main__":
    unittest.main()
