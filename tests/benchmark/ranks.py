#!/usr/bin/env python3
"""Speed and memory of a large slender model on several processes: the flexible pendulum. The time of a step is that
of a long run less that of a short one; memory is the largest that a process ever had; what of it were no pages of
files, such as programs and libraries; and these with its share of the pages that processes on one machine have
together, so that the sum over all is what the machine gives. More elements than a beam may have are those of several
pendula.

usage: ranks.py CULM [--elements N] [--ranks 1 2 4] [--steps 4 24] [--repeats 2] [--copies]
"""

import argparse
import copy
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

INPUTS = pathlib.Path(__file__).resolve().parent.parent.parent / "inputs"
STEP = 5e-3  # s, of the deck
LONGEST = 100000  # elements of a beam
# prints what getrusage knows when the program has ended, and what was seen: the most memory without files, and the
# share of the pages of files
WATCH = """
import os, resource, subprocess, sys, time
program = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)
own = shared = looks = 0
def numbers(file, names):
    with open(f"/proc/{program.pid}/{file}") as lines:
        return [int(line.split()[1]) for line in lines if line.startswith(names)]
while program.poll() is None:
    try:
        own = max([own] + numbers("status", "RssAnon"))
        if looks % 10 == 0:  # it takes long, and changes little
            shared = sum(numbers("smaps_rollup", ("Pss_File", "Pss_Shmem"))) or shared
    except OSError:
        pass
    looks += 1
    time.sleep(0.02)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"used {used.ru_utime + used.ru_stime} {used.ru_maxrss} {own} {own + shared};", flush=True)
sys.exit(program.returncode)
"""


def write_pendula(count, path):
    """The deck with several beams, each with its support."""
    tree = xml.etree.ElementTree.parse(INPUTS / "beam/pendulum.xml")
    for kind, of in (("Structures", "beam"), ("Constraints", "pin")):
        group = tree.find(f"ParameterList[@name='{kind}']")
        for i in range(1, count):
            other = copy.deepcopy(group.find(f"ParameterList[@name='{of}']"))
            other.set("name", f"{of}{i}")
            for node in other.findall("Parameter[@value='beam/first']"):
                node.set("value", f"beam{i}/first")
            group.append(other)
    tree.write(path)


def command(culm, folder, elements, steps):
    beams = -(-elements // LONGEST)
    if elements % beams != 0:
        sys.exit(f"{elements} elements are not those of {beams} equal beams of at most {LONGEST}")
    deck = pathlib.Path(folder, "pendula.xml")
    deck.parent.mkdir(exist_ok=True)
    write_pendula(beams, deck)
    return [sys.executable, "-c", WATCH, culm, "run", str(deck), "--quiet", "--output", f"{folder}/results", "--set",
            f"N={elements // beams}", "--set", f"Analyses/motion/End Time={steps * STEP!r}", "--set", "Output/Every=100000"]


def run(programs):
    """Wall time [s] of programs beside each other; of each process of theirs CPU time [s], memory, memory without
    files, and memory with its share of what processes have together [MB]."""
    began = time.monotonic()
    running = [subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for words in programs]
    done = [(program.communicate(), program.returncode) for program in running]
    wall = time.monotonic() - began
    for (_, errors), code in done:
        if code != 0:
            sys.exit(errors)
    # processes of MPI may write into one line
    used = [[float(number) for number in words] for (out, _), _ in done
            for words in re.findall(r"used (\S+) (\S+) (\S+) (\S+);", out)]
    cpu, *sizes = zip(*used)
    return wall, cpu, *([size / 1024 for size in of_each] for of_each in sizes)


def run_ranks(culm, ranks, elements, steps):
    with tempfile.TemporaryDirectory() as folder:
        return run([["mpiexec", "-n", str(ranks), *command(culm, folder, elements, steps)]])


def run_copies(culm, copies, elements, steps):
    """Programs that know nothing of each other, each with its part of the elements."""
    with tempfile.TemporaryDirectory() as folder:
        return run([command(culm, f"{folder}/{i}", elements // copies, steps) for i in range(copies)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("culm")
    parser.add_argument("--elements", type=int, nargs="+", default=[100000])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--steps", type=int, nargs=2, default=[4, 24])
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--copies", action="store_true",
                        help="instead of ranks independent programs, each with its part of the elements: what the machine allows")
    options = parser.parse_args()
    culm = os.path.abspath(options.culm)
    start = run_copies if options.copies else run_ranks
    print("elements  ranks  whole run [s]  a step [s]  CPU of a step and rank [s]  memory of each rank [MB], without files, with its share")
    for elements in options.elements:
        for ranks in options.ranks:
            runs = {steps: [start(culm, ranks, elements, steps) for _ in range(options.repeats)]
                    for steps in options.steps}
            few, many = options.steps
            best = {steps: min(wall for wall, *_ in results) for steps, results in runs.items()}
            cpu = {steps: min(max(times) for _, times, *_ in results) for steps, results in runs.items()}
            memory = ", ".join(" ".join(f"{size:.0f}" for size in sizes) for sizes in runs[many][0][2:])
            print(f"{elements:8d} {ranks:6d} {best[many]:14.2f} {(best[many] - best[few]) / (many - few):11.4f} "
                  f"{(cpu[many] - cpu[few]) / (many - few):27.4f}  {memory}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
