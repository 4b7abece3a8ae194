#!/usr/bin/env python3
"""Runs the commands of a tutorial as they stand, and looks for the output that it shows.

usage: tutorial.py --culm PROGRAM PAGE.md

Blocks fenced as `sh` are commands, run one block after the other in an empty folder in which
`inputs` and `src` are those of the repository and `culm` is the program. Each line of a block fenced as `output`
must be printed by the block of commands before it: words alike, numbers to three digits, and … stands
for any word.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
from culm_runs import MPI_ENVIRONMENT  # noqa: E402

DIGITS = 1e-3
TIME_LIMIT = 600  # s


def blocks(page):
    """Kind, line and text of all fenced blocks."""
    pattern = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    return [(m[1], page.count("\n", 0, m.start()) + 1, m[2]) for m in pattern.finditer(page)]


def same_word(shown, printed):
    if shown in ("…", printed):
        return True
    try:
        a, b = float(shown), float(printed)
    except ValueError:
        return False
    return abs(a - b) <= DIGITS * max(abs(a), abs(b))


def same_line(shown, printed):
    a, b = re.split(r"[\s,]+", shown.strip()), re.split(r"[\s,]+", printed.strip())
    return len(a) == len(b) and all(map(same_word, a, b))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True, type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    arguments = parser.parse_args()
    found = blocks(arguments.page.read_text())
    failures = 0
    commands = 0
    with tempfile.TemporaryDirectory(prefix="culm") as name:
        folder = pathlib.Path(name)
        for part in ("inputs", "src"):
            (folder / part).symlink_to(ROOT / part)
        (folder / "bin").mkdir()
        (folder / "bin/python3").symlink_to(sys.executable)
        (folder / "bin/culm").symlink_to(arguments.culm.resolve())
        environment = {
            **os.environ,
            **MPI_ENVIRONMENT,
            "PATH": f"{folder / 'bin'}:{os.environ['PATH']}",
            "PYTHONPATH": str(arguments.culm.resolve().parents[1] / "share/culm/python"),
            "MPLBACKEND": "Agg",
        }
        printed = []
        for kind, line, text in found:
            if kind == "sh":
                run = subprocess.run(
                    ["bash", "-euo", "pipefail", "-c", text],
                    cwd=folder,
                    env=environment,
                    capture_output=True,
                    text=True,
                    timeout=TIME_LIMIT,
                )
                print(f"{text}{run.stdout}{run.stderr}")
                printed = run.stdout.splitlines()
                commands += 1
                if run.returncode != 0:
                    print(f"line {line}: exit code {run.returncode}")
                    failures += 1
            elif kind == "output":
                for shown in text.splitlines():
                    if not any(same_line(shown, one) for one in printed):
                        print(f"line {line}: not printed: {shown}")
                        failures += 1
    if commands == 0:
        print("there are no commands on the page")
    print(f"{commands} blocks of commands, {failures} failures")
    sys.exit(1 if failures or commands == 0 else 0)


if __name__ == "__main__":
    main()
