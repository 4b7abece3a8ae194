#!/usr/bin/env python3
"""Installs culm and builds and runs the programs of doc/guide/library.md against what was installed.

usage: run.py --build FOLDER --cmake PROGRAM
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "doc/guide/library.md"
DECK = ROOT / "inputs/turbine/nrel5mw/turbine_operation.xml"


def block(language):
    """The first block of the page in a language."""
    return re.search(rf"```{language}\n(.*?)```\n", PAGE.read_text(), re.DOTALL).group(1)


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--cmake", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="culm-consumer-") as path:
        folder = pathlib.Path(path)
        run(options.cmake, "--install", options.build, "--prefix", folder / "installed")
        source = folder / "source"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(block("cmake"))
        (source / "driver.cpp").write_text(block("cpp"))
        (source / "driver.py").write_text(block("python"))
        run(options.cmake, "-S", source, "-B", folder / "build", "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={folder / 'installed'}")
        run(options.cmake, "--build", folder / "build")
        from_cpp = run(folder / "build/driver", DECK)
        python = {**os.environ, "PYTHONPATH": str(folder / "installed/share/culm/python"),
                  "PYTHONDONTWRITEBYTECODE": "1"}
        from_python = run(sys.executable, source / "driver.py", DECK, env=python)
        print(f"C++: {from_cpp}Python: {from_python}", end="")
        without_wind = -0.016  # [m]
        if from_cpp != from_python or float(from_cpp) < without_wind + 0.1:
            sys.exit("the programs do not agree, or the wind did not push the nacelle")


if __name__ == "__main__":
    main()
