"""What `sessile render` starts Blender with: blender -b --factory-startup -P render.py -- JOB.json"""
import json
import pathlib
import sys
import traceback

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

from sessile import film  # noqa: E402


def main():
    job = json.loads(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).read_text(encoding="utf-8"))
    try:
        film.make_film(job)
    except (OSError, ValueError) as fault:
        film.say(f"fault {fault}")
        return 1
    except Exception as fault:  # pylint: disable=broad-except
        traceback.print_exc()
        film.say(f"fault {fault!r}")
        return 1
    return 0


sys.exit(main())
