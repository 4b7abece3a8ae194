"""Runs decks with culm and reads their history; for the regression and the verification tests."""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.history import History  # noqa: E402

INPUTS = ROOT / "inputs"
TIME_LIMIT = 600  # s; against runs that hang, also on a machine that is busy with others

# Open MPI: start as root (containers), more ranks than cores, and do not pin them; the rest saves time.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_pml": "ob1",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "HWLOC_COMPONENTS": "-pci,-linuxio,-x86",
    "OPENBLAS_NUM_THREADS": "1",
}


class RunFailed(Exception):
    """culm ended with another exit code than 0; the text is what it said."""


class Table:
    """Columns of a table that an analysis wrote, such as 'frequency [Hz]'; rows from 1. An empty cell
    is nan."""

    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        self.names = rows[0]
        self.rows = rows[1:]

    def column(self, name):
        if name not in self.names:
            raise KeyError(f"no column '{name}' among: {', '.join(self.names)}")
        i = self.names.index(name)
        return [row[i] if name == "remark" else float(row[i] or math.nan) for row in self.rows]

    def at(self, row, name):
        return self.column(name)[row - 1]


class Run:
    """Exit code, what was printed, the history if one was written, and the tables by their paths
    below analyses/, such as 'modes/modes', the text of MatrixMarket files by their names."""

    def drift(self, what):
        """A number of the certificate, such as 'energy balance'; the run must not be quiet."""
        line = next(line for line in self.output.splitlines() if line.strip().startswith(what))
        return float(line.split(what)[1].split()[0])

    def books(self):
        """The energies and works of the certificate [J] by name, 'work of loads, air' for a share of an account; of
        energies what they gained. The run must not be quiet."""
        books, row = {}, None
        for line in self.output.splitlines():
            energy = re.fullmatch(r"  (\S.*?) +(\S+) J  -> +(\S+) J", line)
            amount = re.fullmatch(r"  (  )?(\S.*?) +(\S+) J", line)
            if energy:
                books[energy[1]] = float(energy[3]) - float(energy[2])
            elif amount and amount[1]:
                books[f"{row}, {amount[2]}"] = float(amount[3])
            elif amount:
                row = amount[2]
                books[row] = float(amount[3])
        return books

    def _steps(self, pattern):
        """A number of the closing words, such as '500 steps accepted, 0 cut back; …'."""
        return int(re.search(pattern, self.output).group(1))

    def cut_back(self):
        return self._steps(r"steps accepted, (\d+) cut back")

    def iterations(self):
        return self._steps(r"cut back; (\d+) iterations")

    def most_iterations(self):
        return self._steps(r"per step, at most (\d+)")

    def __init__(self, process, folder):
        self.exit = process.returncode
        self.errors = process.stderr
        self.output = process.stdout
        history = pathlib.Path(folder) / "history.csv"
        self.history = History(history) if history.exists() else None
        self.matrices = {
            path.stem: path.read_text()
            for path in sorted(pathlib.Path(folder).glob("analyses/*/*.mtx"))
        }
        self.tables = {
            f"{path.parent.name}/{path.stem}": Table(path)
            for path in sorted(pathlib.Path(folder).glob("analyses/*/*.csv"))
        }


class Culm:
    """The program, to be run in folders that vanish afterwards."""

    def __init__(self, program, mpiexec="mpiexec", keeps=False):
        """@param keeps  whether a deck of inputs/ that is run once more with the same overrides gives the same result"""
        self.program = str(program)
        self.mpiexec = mpiexec
        self.kept = {} if keeps else None

    def run(self, deck, settings=(), ranks=1, quiet=True):
        """Runs a deck of inputs/ (or a path) with overrides; any exit code is a result."""
        if self.kept is None or pathlib.Path(deck).is_absolute() or any(tempfile.gettempdir() in one for one in settings):
            return self._run(deck, settings, ranks, quiet)
        key = (str(deck), *settings, ranks, quiet)
        if key not in self.kept:
            self.kept[key] = self._run(deck, settings, ranks, quiet)
        return self.kept[key]

    def _run(self, deck, settings, ranks, quiet):
        command = [self.mpiexec, "-n", str(ranks)] if ranks > 1 else []
        command += [self.program, "run", str(INPUTS / deck), *(["--quiet"] if quiet else [])]
        for setting in [*settings, "Output/Pictures=false"]:
            command += ["--set", setting]
        with tempfile.TemporaryDirectory(prefix="culm") as folder:
            process = subprocess.run(
                [*command, "--output", folder],
                capture_output=True,
                text=True,
                timeout=TIME_LIMIT,
                env={**os.environ, **MPI_ENVIRONMENT},
            )
            return Run(process, folder)

    def succeed(self, deck, settings=(), ranks=1):
        """As run, but the run must succeed."""
        run = self.run(deck, settings, ranks)
        if run.exit != 0:
            raise RunFailed(f"{deck} {list(settings)}: exit code {run.exit}\n{run.errors}")
        return run

    def check(self, deck):
        """What culm check prints."""
        return subprocess.run(
            [self.program, "check", str(INPUTS / deck)],
            capture_output=True,
            text=True,
            check=True,
            timeout=TIME_LIMIT,
            env={**os.environ, **MPI_ENVIRONMENT},
        ).stdout

    def history(self, deck, settings=(), ranks=1):
        return self.succeed(deck, settings, ranks).history

    def table(self, name, deck, settings=(), ranks=1):
        return self.succeed(deck, settings, ranks).tables[name]
