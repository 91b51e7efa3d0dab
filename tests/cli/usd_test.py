"""The USD files of `sessile mesh`, as USD's own library reads them. SESSILE_USD_PYTHON names a Python that has usd-core."""
import json
import os
import subprocess
import sys

from sessile_cli import CliTest, tiny, unittest

PYTHON = os.environ.get("SESSILE_USD_PYTHON") or sys.executable
NO_USD = "" if subprocess.run([PYTHON, "-c", "from pxr import UsdGeom"], capture_output=True).returncode == 0 \
    else f"{PYTHON} has no usd-core"

# Prints what a reader of the stage finds at each of its times.
READ = """
import json, sys
from pxr import Usd, UsdGeom
stage = Usd.Stage.Open(sys.argv[1])
meshes = [p for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)]
moving = [p for p in meshes if UsdGeom.Mesh(p).GetPointsAttr().GetNumTimeSamples() > 0]
surface, = map(UsdGeom.Mesh, moving)
found = {"up": str(UsdGeom.GetStageUpAxis(stage)), "metres": UsdGeom.GetStageMetersPerUnit(stage),
         "per_second": stage.GetTimeCodesPerSecond(), "still": [p.GetName() for p in meshes if p not in moving], "frames": []}
for time in surface.GetPointsAttr().GetTimeSamples():
    points, counts = surface.GetPointsAttr().Get(time), surface.GetFaceVertexCountsAttr().Get(time)
    indices = surface.GetFaceVertexIndicesAttr().Get(time)
    valid = UsdGeom.Mesh.ValidateTopology(indices, counts, len(points))
    found["frames"].append({"time": time, "valid": bool(valid if isinstance(valid, bool) else valid[0]), "points": len(points),
                            "triangles": len(counts), "three": set(counts) <= {3},
                            "normals": len(surface.GetNormalsAttr().Get(time)),
                            "velocities": len(surface.GetVelocitiesAttr().Get(time)),
                            "low": min((p[2] for p in points), default=0.0)})
print(json.dumps(found))
"""


@unittest.skipIf(NO_USD, NO_USD)
class Usd(CliTest):
    def test_reads_every_frame(self):
        self.call("run", self.write(tiny()), "-o", "out")
        self.call("mesh", "out", "--format", "usda", "--format", "ply")
        result = subprocess.run([PYTHON, "-c", READ, "out/surface/surface.usda"], cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(result.stdout)
        self.assertEqual((found["up"], found["metres"], found["still"]), ("Z", 1, ["floor"]))
        listed = json.loads((self.folder / "out/surface/surface.json").read_text())["frames"]
        self.assertEqual(len(found["frames"]), len(listed))
        for frame, expected in zip(found["frames"], listed):
            self.assertAlmostEqual(frame["time"] / found["per_second"], expected["time"], places=6)
            self.assertEqual(frame["triangles"], expected["triangles"])
            self.assertTrue(frame["valid"] and frame["three"])
            self.assertEqual(frame["normals"], frame["points"])
            self.assertEqual(frame["velocities"], frame["points"])
        lows = [frame["low"] for frame in found["frames"]]
        self.assertLess(lows[-1], lows[0])  # the block falls


if __name__ == "__main__":
    unittest.main()
