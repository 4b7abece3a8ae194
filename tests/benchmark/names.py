#!/usr/bin/env python3
"""Decks with many names, as importers write them: what a start with thousands of structures, joints and loads takes.
Each is run once and short, so that what is not the start hardly counts.

usage: names.py CULM [CULM ...] [--sizes 1000 4000 16000] [--problems chain frame forces]
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

from dynamics import parameters, rigid_chain, write_list

SECTION = write_list("tube", parameters(Type="Circle", Radius=0.02, Young_Modulus=2.1e11, Poisson_Ratio=0.3, Density=7850))
# prints what getrusage knows of a program that has ended
WATCH = """
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
sys.exit(done.returncode)
"""


def entry(name, *lists, **values):
    return write_list(name, parameters(**values), *lists)


def point(place):
    return f"{{{', '.join(map(str, place))}}}"


def beam(name, begin, end, up, elements):
    return entry(name, entry("Curve", Type="Line", From=point(begin), To=point(end), Up=point(up), Elements=elements),
                 Type="Beam", Section="tube")


def static_deck(structures, supports, joints, loads, watched):
    return entry("culm", entry("Sections", SECTION), entry("Structures", *structures),
                 entry("Node Sets", entry("feet", Nodes=f"{{{', '.join(supports)}}}")),
                 entry("Constraints", entry("ground", Type="Rigid Support", Node="feet"), *joints),
                 entry("Loads", *loads), entry("Analyses", entry("load", Type="Static", Steps=1)),
                 entry("Output", entry("History", entry("end", Type="Displacement", Node=watched))))


def frame(size):
    """A cube of about so many members of 1 m, each a beam, rigidly joined where they meet."""
    edge = max(2, round((size / 3) ** (1 / 3)) + 1)
    corners = [(x, y, z) for x in range(edge) for y in range(edge) for z in range(edge)]
    members, ends = [], {}
    for corner in corners:
        for axis, up in ((0, (0, 1, 0)), (1, (0, 0, 1)), (2, (1, 0, 0))):
            other = tuple(x + (i == axis) for i, x in enumerate(corner))
            if max(other) == edge:
                continue
            name = f"member {len(members)}"
            members.append(beam(name, corner, other, up, 2))
            ends.setdefault(corner, []).append(f"{name}/first")
            ends.setdefault(other, []).append(f"{name}/last")
    joints = [entry(f"joint of {end.split('/')[0]}, {end.split('/')[1]}", Type="Rigid Connection", Node=end, Master=first)
              for first, *others in ends.values() for end in others]
    feet = [ends[corner][0] for corner in corners if corner[2] == 0]
    top = ends[corners[-1]][0]
    loads = [entry("push", Type="Force", Node=top, Force="{100, 0, 0}"), entry("weight", Type="Gravity")]
    return static_deck(members, feet, joints, loads, top), []


def forces(size):
    """A beam with as many elements, and a force with a name on each node."""
    loads = [entry(f"force {i}", Type="Force", Node=f"beam/{i}", Force="{0, 0, 1e-3}") for i in range(1, size + 1)]
    return static_deck([beam("beam", (0, 0, 0), (10, 0, 0), (0, 0, 1), size)], ["beam/first"], [], loads, "beam/last"), []


def chain(size):
    """Bodies and ball joints."""
    return rigid_chain(size), ["Analyses/motion/End Time=0.004", "Output/Every=1000"]


PROBLEMS = {"chain": chain, "frame": frame, "forces": forces}


def run(culm, problem, size, folder):
    """Processor time [s], largest memory [MB], size of run.h5 [MB]."""
    deck, settings = PROBLEMS[problem](size)
    path = pathlib.Path(folder, "deck.xml")
    path.write_text(deck)
    words = [culm, "run", str(path), "--quiet", "--output", f"{folder}/results"]
    for setting in settings:
        words += ["--set", setting]
    done = subprocess.run([sys.executable, "-c", WATCH, *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{problem} {size}: {done.stderr}")
    return *map(float, done.stdout.split()), pathlib.Path(folder, "results/run.h5").stat().st_size / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("culm", nargs="+")
    parser.add_argument("--sizes", type=int, nargs="+", default=[1000, 4000, 16000])
    parser.add_argument("--problems", nargs="+", choices=PROBLEMS, default=list(PROBLEMS))
    options = parser.parse_args()
    print("problem   size  " + "  ".join("CPU [s]  memory [MB]  run.h5 [MB]" for _ in options.culm))
    for problem in options.problems:
        for size in options.sizes:
            cells = []
            for culm in options.culm:
                with tempfile.TemporaryDirectory(prefix="culm") as folder:
                    seconds, memory, states = run(os.path.abspath(culm), problem, size, folder)
                cells.append(f"{seconds:7.2f}  {memory:11.0f}  {states:11.1f}")
            print(f"{problem:7} {size:6d}  " + "  ".join(cells), flush=True)


if __name__ == "__main__":
    main()
