"""The short form of tools/soak.py: memory, counts, files and the rest state over two thousand steps."""
import os
import pathlib
import subprocess
import sys

from sessile_cli import CliTest, PROGRAM, unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Soak(CliTest):
    def soak(self, *arguments):
        command = [sys.executable, "-B", SOURCE / "tools" / "soak.py", "--sessile", PROGRAM, "-o", "soak", *arguments]
        done = subprocess.run(list(map(str, command)), cwd=self.folder, env=self.environment(), capture_output=True, text=True,
                              timeout=280)
        return done.returncode, done.stdout + done.stderr

    def test_two_thousand_steps_pass(self):
        code, said = self.soak("--steps", "2000", "--sample", "0.05")
        self.assertEqual(code, 0, said)
        self.assertNotIn("FAIL", said)

    def test_a_spill_that_writes_no_good_frames_fails(self):
        # The judge must be able to fail: a program whose frames are cut short at the end of the run.
        fake = self.folder / "sessile"
        fake.write_text(f'#!/bin/sh\n"{PROGRAM}" "$@" || exit\n[ "$1" = run ] || exit 0\n'
                        'for frame in "$4"/frame_*1.ply; do truncate -s -4 "$frame"; done\n')
        os.chmod(fake, 0o755)
        code, said = self.soak("--steps", "400", "--sample", "0.05", "--only", "spill", "--sessile", fake)
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r"files that cannot be read or disagree.*[1-9]\d* +0 +FAIL")


if __name__ == "__main__":
    unittest.main()
