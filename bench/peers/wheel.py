"""The pinned wheel of SPlisHSPlasH, in a virtual environment under build/, and what its binary is made of."""
import pathlib
import re
import shutil
import subprocess
import sys

# A particle weighs 0.8 rho0 dx^3 up to 2.18.1, and 1 in 2.19.0. In a trial of 1 728 particles in the box of S1 the neighbour
# search of 2.18.1 and 2.19.0 took five times as long as that of 2.16.1 (22 ms, 4.4 ms).
VERSION = "2.16.1"
HERE = pathlib.Path(__file__).resolve().parent
BUILD = HERE.parents[1] / "build/peers"


def fail(sentence):
    raise SystemExit(f"peers: {sentence}")


def install(version):
    """Makes the environment if it is not there; returns its Python. Ends the program when the wheel cannot be used."""
    folder = BUILD / f"pysplishsplash-{version}"
    python = folder / "bin/python"
    if not (folder / "installed").exists():
        print(f"Installing pysplishsplash {version} into {folder} ...", flush=True)
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
        if made.returncode != 0:
            fail(f"no virtual environment (on Debian: apt-get install python3-venv): {(made.stdout + made.stderr).strip()}")
        pip = subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary",
                              ":all:", f"pysplishsplash=={version}"], capture_output=True, text=True)
        if pip.returncode != 0:
            fail(f"the wheel does not install: {pip.stderr.strip()}")
        (folder / "installed").touch()
    tried = subprocess.run([python, HERE / "splishsplash_run.py", "--only-import"], capture_output=True, text=True)
    if tried.returncode != 0:
        fail(f"the wheel cannot be imported (exit code {tried.returncode}): {tried.stderr.strip() or 'no message'}")
    return python


def instruction_set(python):
    """How the code of one of its solvers was compiled, read from the binary."""
    if not shutil.which("objdump"):
        return "not known: objdump is missing (on Debian: apt-get install binutils)"
    binaries = list(python.parents[1].glob("lib/python*/site-packages/pysplishsplash*.so"))
    widths, vex, plain, inside = {"xmm": 0, "ymm": 0, "zmm": 0}, 0, 0, False
    with subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", str(binaries[0])], stdout=subprocess.PIPE, text=True) as dump:
        for line in dump.stdout:
            if line.endswith(">:\n"):
                inside = "TimeStepIISPH" in line
            elif inside:
                found = re.search(r"\t([a-z0-9]+) .*%([xyz]mm)", line)
                if found:
                    widths[found[2]] += 1
                    vex += found[1].startswith("v")
                    plain += not found[1].startswith("v")
    kind = "SSE" if plain > vex else "AVX-512" if widths["zmm"] else "AVX" if vex else "no SIMD"
    return f"{kind}; in its IISPH " + ", ".join(f"{count} instructions on {width}" for width, count in widths.items())
