"""`sessile run` end to end: frames, stats.csv, summary.json, options, progress."""
import csv
import json
import math

from frames import read_ply, read_pvd, read_vtp
from sessile_cli import CliTest, tiny, unittest


class Results(CliTest):
    def setUp(self):
        super().setUp()
        self.out, self.err = self.call("run", self.write(tiny()), "-o", "out", "--progress", "none")

    def test_writes_these_files_and_no_others(self):
        frames = [f"frame_{k:06d}.{kind}" for k in range(5) for kind in ("ply", "vtp")]
        self.assertEqual(self.names(), ["checkpoints"] + frames + ["frames.pvd", "scene.json", "solids.ply", "solids.vtp", "stats.csv", "summary.json"])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["out", "s.json"])

    def test_peak_memory_is_the_runs_own(self):
        ballast = b"x" * (400 << 20)  # of the process that starts it
        self.call("run", "s.json", "-o", "out", "--progress", "none")
        self.assertLess(self.summary()["memory_bytes"]["peak"], len(ballast) // 2)

    def test_frames_hold_the_particles(self):
        for k in range(5):
            points, names, time = read_vtp(self.folder / f"out/frame_{k:06d}.vtp")
            self.assertEqual((points, names), (27, ["id", "velocity", "density", "pressure"]))
            self.assertAlmostEqual(time, 0.01 * k, places=9)
            self.assertEqual(read_ply(self.folder / f"out/frame_{k:06d}.ply"), 27)
        self.assertEqual(read_vtp(self.folder / "out/solids.vtp")[0], 121)
        self.assertEqual(read_ply(self.folder / "out/solids.ply"), 121)

    def test_collection_carries_the_times(self):
        frames = read_pvd(self.folder / "out/frames.pvd")
        self.assertEqual([name for _, name in frames], [f"frame_{k:06d}.vtp" for k in range(5)])
        for time, name in frames:
            self.assertEqual(time, read_vtp(self.folder / "out" / name)[2])

    def test_stats(self):
        with open(self.folder / "out/stats.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 9)  # the start and 8 steps
        for name in ("step", "time [s]", "dt [s]", "bound", "iterations", "predicted_density_error",
                     "predicted_density_error_max", "density_error", "density_error_max", "kinetic_energy [J]",
                     "potential_energy [J]", "momentum_x [kg m/s]", "max_speed [m/s]", "particles", "loose", "first_layer",
                     "wetted_area [m^2]", "held", "pieces", "largest_share", "nearest_p5 [dx]", "radius_of_gyration [m]", "out",
                     "lost", "waits", "floor.force_z [N]", "floor.torque_x [N m]"):
            self.assertIn(name, rows[0])
        for k, row in enumerate(rows):
            self.assertNotIn(None, row, "a line with more cells than the header")
            self.assertEqual((int(row["step"]), int(row["particles"]), int(row["lost"])), (k, 27, 0))
            self.assertAlmostEqual(float(row["time [s]"]), 0.005 * k, places=9)
            for name, cell in row.items():
                if name not in ("bound", "overruled"):
                    self.assertTrue(math.isfinite(float(cell)), f"{name}: {cell}")
        # The block falls freely for these 40 ms.
        self.assertAlmostEqual(float(rows[-1]["momentum_z [kg m/s]"]), -27 * 9.81 * 0.04, delta=0.1)
        self.assertEqual(rows[-1]["bound"], "fixed")

    def test_summary(self):
        summary = self.summary()
        self.assertEqual({k: summary[k] for k in ("status", "message", "particles", "wall_particles", "steps", "frames",
                                                  "out", "lost", "waits")},
                         {"status": "done", "message": "", "particles": 27, "wall_particles": 121, "steps": 8, "frames": 5,
                          "out": 0, "lost": 0, "waits": 0})
        self.assertAlmostEqual(summary["simulated_time_s"], 0.04, places=9)
        self.assertGreaterEqual(summary["iterations"], 8)  # one a step in free fall
        self.assertEqual(set(summary["wall_time_s"]), {"total", "neighbors", "density", "forces", "time_step", "pressure",
                                                       "integration", "output", "measures", "writer_thread"})
        self.assertGreater(summary["memory_bytes"]["peak"], summary["memory_bytes"]["arrays"])
        self.assertIn(summary["version"], self.call("--version")[0])
        # The scene of the summary makes the same run.
        self.call("run", self.write(summary["scene"], "again.json"), "-o", "again", "--progress", "none")
        for name in self.names():
            if name.startswith("frame") or name == "stats.csv":
                self.assertEqual((self.folder / "again" / name).read_bytes(), (self.folder / "out" / name).read_bytes())

    def test_says_at_the_end_what_came_out(self):
        self.assertRegex(self.out, r"\A8 steps to 0.04 s in .* iterations a step\n27 particles, 0 out, 0 lost\n"
                                   r"5 frames, stats.csv and summary.json are in out\n\Z")
        self.assertEqual(self.err, "")


class Options(CliTest):
    def run_tiny(self, *options, scene=None):
        return self.call("run", self.write(scene or tiny(), "tiny.json"), "--progress", "none", *options)

    def test_results_have_a_folder_by_default(self):
        self.run_tiny()
        self.assertIn("summary.json", self.names("results/tiny"))

    def test_folders_are_made(self):
        self.run_tiny("--output", "a/b c/d")
        self.assertIn("summary.json", self.names("a/b c/d"))

    def test_set(self):
        self.run_tiny("-o", "out", "--set", "fluid.viscosity=3", "--set", 'output.formats=["ply"]', "--set",
                      "output.fields=[\"id\",\"acceleration_gravity\"]")
        self.assertEqual(self.summary()["scene"]["fluid"]["viscosity"], 3)
        self.assertEqual([n for n in self.names() if "vtp" in n or "pvd" in n], [])
        self.assertIn(b"property float acceleration_gravity_z", (self.folder / "out/frame_000000.ply").read_bytes())

    def test_until(self):
        self.run_tiny("-o", "out", "--until", "0.02")
        summary = self.summary()
        self.assertEqual((summary["steps"], summary["frames"], summary["scene"]["time"]["end"]), (4, 3, 0.02))

    def test_threads_give_the_same_bytes(self):
        big = tiny()
        big["bodies"][0].update(shape={"type": "box", "size": [1.2, 1.2, 1.2]}, jitter=0.1,
                                placement={"position": [0, 0, 0.7]})
        for threads in (1, 2):
            self.run_tiny("-o", f"t{threads}", "--threads", threads, scene=big)
        self.assertEqual(self.names("t1"), self.names("t2"))
        for name in self.names("t1"):
            if name not in ("summary.json", "checkpoints"):  # they hold wall times
                self.assertEqual((self.folder / "t1" / name).read_bytes(), (self.folder / "t2" / name).read_bytes(), name)

    def test_rerun_leaves_no_frames_of_the_run_before(self):
        self.run_tiny("-o", "out")
        (self.folder / "out/notes.txt").write_text("mine")
        self.run_tiny("-o", "out", "--until", "0.02", "--set", 'output.formats=["vtp"]')
        self.assertEqual([n for n in self.names() if n.startswith("frame")],
                         [f"frame_{k:06d}.vtp" for k in range(3)] + ["frames.pvd"])
        self.assertEqual(len(read_pvd(self.folder / "out/frames.pvd")), 3)
        self.assertIn("notes.txt", self.names())

    def test_rerun_leaves_nothing_else_of_the_run_before(self):
        self.run_tiny("-o", "out")
        (self.folder / "out/.frame_000009.ply.part").write_text("of a killed run")
        self.run_tiny("-o", "out", "--until", "0.005", "--set", 'output.formats=["ply"]')
        self.assertEqual(self.names(), ["checkpoints", "frame_000000.ply", "frame_000001.ply", "scene.json", "solids.ply", "stats.csv",
                                        "summary.json"])

    def test_failed_rerun_leaves_no_summary_of_the_run_before(self):
        self.run_tiny("-o", "out")
        scene = self.write(tiny(output={"frame_interval": 1e-2, "formats": ["ply"]}))
        self.call("run", scene, "-o", "out", code=1, before="ulimit -f 0")
        self.assertNotIn("summary.json", self.names())
        self.assertEqual([n for n in self.names() if n.startswith(("frame", "solids", "."))], [])

    def test_emitter_and_open_domain(self):
        spout = {"label": "spout", "interval": 0.1, "count": 2, "velocity": [0, 0, -2],
                 "shape": {"type": "rectangle", "width": 0.3, "depth": 0.3}, "placement": {"position": [0, 0, 0.5]}}
        self.run_tiny("-o", "out", scene=tiny(bodies=[], solids=[], emitters=[spout], forces=[],
                                              time={"end": 0.5, "fixed_dt": 0.005}, output={"frame_interval": 0.1},
                                              domain={"min": [-1, -1, 0], "max": [1, 1, 1]}))
        summary = self.summary()
        self.assertEqual([summary[k] for k in ("emitted", "out", "particles", "lost")], [18, 18, 0, 0])
        frames = read_pvd(self.folder / "out/frames.pvd")
        self.assertEqual(read_vtp(self.folder / "out" / frames[-1][1])[0], 0)  # an empty frame is a frame


class ProgressStyles(CliTest):
    def progress(self, style, scene=None):
        return self.call("run", self.write(scene or tiny()), "-o", "out", "--progress", style)

    def test_plain(self):
        for style in ("plain", "auto"):  # standard error is no terminal here
            _, err = self.progress(style)
            self.assertRegex(err.splitlines()[-1], r"^100\.0 %  t 0\.0400 of 0\.04 s  step 8  dt 0\.005 s \(fixed\)  "
                                                   r"\d+ iterations  27 particles  [\d.]+ steps/s  0 s left$")
            self.assertNotIn("\r", err)

    def test_json(self):
        out, err = self.progress("json")
        self.assertEqual(err, "")
        lines = [json.loads(line) for line in out.splitlines()]
        self.assertEqual(set(lines[-1]), {"time", "end", "step", "dt", "bound", "iterations",
                                           "predicted_density_error", "particles",
                                          "steps_per_second", "seconds_left"})
        self.assertEqual((lines[-1]["step"], lines[-1]["particles"], lines[-1]["bound"]), (8, 27, "fixed"))

    def test_none(self):
        self.assertEqual(self.progress("none")[1], "")

    def test_warnings_come_in_the_same_style(self):
        scene = tiny(time={"end": 0.24, "fixed_dt": 0.12}, forces=[], solids=[])  # it falls
        warning = r"at 0\.12 s the step of 0\.12 s \(fixed\) exceeds the \w+ bound"
        self.assertRegex(self.progress("plain", scene)[1], rf"(?m)^warning: {warning}$")
        out, err = self.progress("json", scene)
        self.assertEqual(err, "")
        self.assertRegex([line for line in map(json.loads, out.splitlines()) if "warning" in line][0]["warning"], warning)
        out, err = self.progress("none", scene)
        self.assertEqual(err, "")
        self.assertIn("2 steps above a stability bound", out)
        self.assertEqual(self.summary()["overruled_steps"], 2)


if __name__ == "__main__":
    unittest.main()
