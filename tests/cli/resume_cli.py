"""What the tests of `sessile run --resume` share: a scene that uses all of it, and what a run leaves behind."""
import json

from frames import read_ply, read_pvd, read_vtp
from sessile_cli import CliTest, tiny
from surfaces import read_surface_ply


def lively(**changes):
    """A scene that uses all that a checkpoint holds: a jet on a plate, an open domain, surfaces, a changing step."""
    output = {"frame_interval": 0.01, "stats_interval": 0.005, "formats": ["vtp", "ply"],
              "surface": {"formats": ["ply", "usda"], "interval": 0.02, "stats": True},
              "checkpoint": {"interval": 0.004, "keep": 3}}
    output.update(changes.pop("output", {}))
    scene = {"title": "a jet", "time": {"end": 0.2}, "output": output,
             "domain": {"min": [-0.45, -0.45, -0.5], "max": [0.45, 0.45, 1.2], "x": "open", "y": "open", "z": "open"},
             "emitters": [{"shape": {"type": "rectangle", "width": 0.3, "depth": 0.3},
                           "placement": {"position": [0, 0, 1.1]}, "velocity": [0, 0, -3], "interval": 0.04}]}
    return tiny(**{**scene, **changes})


class ResumeTest(CliTest):
    def run_scene(self, scene, folder, *arguments, **how):
        return self.call("run", self.write(scene, folder + ".json"), "-o", folder, "--progress", "none", *arguments, **how)

    def resume(self, folder, *arguments, **how):
        return self.call("run", "--resume", folder, "--progress", "none", *arguments, **how)

    def checkpoints(self, folder):
        return sorted(path.name for path in (self.folder / folder / "checkpoints").glob("checkpoint_*.sessile"))

    def start_resume(self, folder, *arguments, **how):
        return self.start("run", "--resume", folder, "--progress", "none", *arguments, **how)

    def kill(self, process, at):
        """Kills a run at once when a file is there, or held by the faults."""
        self.wait_for(at, process=process)
        process.kill()
        process.wait()

    def assert_whole(self, folder):
        """Every file under its own name is whole: nothing but what begins with a dot may be torn."""
        for path in sorted((self.folder / folder).rglob("*")):
            if path.is_dir() or path.name.startswith("."):
                continue
            if path.suffix == ".vtp":
                read_vtp(path)
            elif path.suffix == ".pvd":
                for _, name in read_pvd(path):
                    self.assertTrue((path.parent / name).exists(), f"{path} names {name}")
            elif path.suffix == ".ply":
                (read_surface_ply if path.parent.name == "surface" else read_ply)(path)
            elif path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix == ".usda":
                self.assertTrue(path.read_text().endswith("}\n"), path)
            elif path.suffix == ".csv":
                self.assertTrue(path.read_text().endswith("\n"), path)
            elif path.suffix == ".sessile":
                self.call("check", path)
            else:
                self.fail(f"{path}: what is it?")
