#!/usr/bin/env python3
"""A process that no launcher started does without MPI, which takes longer to start than a small model to solve, until
a solver asks for it. Open MPI prints its settings when it starts, if it is told to.

usage: alone.py --culm PROGRAM
"""

import argparse
import os
import subprocess
import sys
import tempfile

from driver import BASE


def starts_mpi(culm, solver):
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "deck.xml")
        with open(deck, "w") as file:
            file.write(BASE)
        words = [culm, "run", deck, "--quiet", "--output", f"{folder}/out", "--set", f"Solver/Linear Solver={solver}"]
        done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "OMPI_MCA_mpi_show_mca_params": "all"})
    if done.returncode != 0:
        sys.exit(f"{solver}: exit code {done.returncode}\n{done.stderr}")
    return "mca_base_param_files" in done.stdout + done.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--culm", required=True)
    culm = parser.parse_args().culm
    for solver, wanted in (("Automatic", False), ("Block LU", False), ("KLU2", False), ("MUMPS", True)):
        if starts_mpi(culm, solver) != wanted:
            sys.exit(f"{solver}: MPI was {'not ' if wanted else ''}started")


if __name__ == "__main__":
    main()
