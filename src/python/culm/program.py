"""Runs of the program: what is asked, what came out, and what it cost."""

import contextlib
import dataclasses
import os
import pathlib
import signal
import subprocess
import time

from .errors import CulmError
from .history import History
from .results import Results

EXITS = {
    0: "done",
    1: "internal error",
    2: "command line is wrong",
    3: "deck is wrong",
    4: "did not converge",
    5: "not finite",
    6: "file error",
    7: "stopped",
    8: "done, a promise is broken",
}
DONE = (0, 8)  # the results are whole
TEXT = {"encoding": "utf-8", "errors": "replace"}  # of what is said, in which names of files may be any bytes


@dataclasses.dataclass
class Run:
    """One run of a deck."""

    exit: int  # negative: ended by this signal; None: took too long
    output: str
    errors: str
    cpu: float  # user and system time [s]
    wall: float  # [s]
    folder: pathlib.Path

    @property
    def succeeded(self):
        return self.exit in DONE

    @property
    def outcome(self):
        """How it ended, in a few words."""
        if self.exit is None:
            return "took too long"
        if self.exit < 0:
            return f"killed by {signal.Signals(-self.exit).name}"
        return EXITS.get(self.exit, f"exit code {self.exit}")

    @property
    def history(self):
        """history.csv; None if the run did not come so far."""
        path = self.folder / "history.csv"
        return History(path) if path.exists() else None

    @property
    def results(self):
        """run.h5; None if the run did not come so far."""
        path = self.folder / "run.h5"
        return Results(path) if path.exists() else None

    @property
    def broken(self):
        """The promises that a run broke which came to its end, as sentences."""
        return [str(one) for one in self.results.findings() if one.is_broken] if self.exit == 8 else []


class Program:
    """The program culm."""

    def __init__(self, path):
        self.path = str(path)

    def run(self, deck, folder, settings=(), time_limit=None, pictures=False):
        """Runs a deck; any exit code is a result.

        @param settings   path=value, as --set takes them
        @param time_limit wall time [s] after which the run is killed
        """
        command = [self.path, "run", _word(deck), "--output", _word(folder)]
        if not pictures:
            settings = [*settings, "Output/Pictures=false"]
        for setting in settings:
            command += ["--set", setting]
        return self._call(command, folder, time_limit)

    def call(self, *words):
        """Another verb, with what it prints; the result of subprocess.run."""
        command = [self.path, *map(str, words)]
        return subprocess.run(
            command, capture_output=True, **TEXT, stdin=subprocess.DEVNULL, env=_environment()
        )

    def resume(self, folder, walltime, time_limit=None):
        """Goes on from the checkpoint of a run for about `walltime` seconds; what the run wrote in
        its folder is continued."""
        command = [self.path, "resume", _word(folder), "--walltime", str(walltime)]
        return self._call(command, folder, time_limit)

    def resolve(self, deck, path, settings=()):
        """Writes the deck as it is used, with all defaults, to `path`. Raises CulmError with what
        the program says of a deck that is wrong."""
        command = [self.path, "check", _word(deck), "--quiet", "--resolved", _word(path)]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, **TEXT, env=_environment())
        if done.returncode != 0:
            raise CulmError(done.stderr.strip() or EXITS.get(done.returncode, "failed"), done.returncode)

    def _call(self, command, folder, time_limit):
        pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
        files = {name: pathlib.Path(folder) / f"{name}.txt" for name in ("output", "errors")}
        start = time.monotonic()
        with open(files["output"], "w") as output, open(files["errors"], "w") as errors:
            process = subprocess.Popen(command, stdout=output, stderr=errors, env=_environment())
        exit_code, usage = _wait(process, time_limit)
        return Run(
            exit_code,
            files["output"].read_text(**TEXT),
            files["errors"].read_text(**TEXT),
            usage.ru_utime + usage.ru_stime,
            time.monotonic() - start,
            pathlib.Path(folder),
        )


def _word(path):
    """A path that is not taken for an option."""
    return f"./{path}" if str(path).startswith("-") else str(path)


def _wait(process, time_limit):
    """Exit code (None if it had to be killed) and resources of a child."""
    end = None if time_limit is None else time.monotonic() + time_limit
    pause = 0.001
    while True:
        flags = 0 if end is None else os.WNOHANG
        pid, status, usage = os.wait4(process.pid, flags)
        if pid != 0:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, usage
        if time.monotonic() > end:
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            return None, usage
        time.sleep(pause)
        pause = min(2 * pause, 0.05)


def _environment():
    """One thread, and Open MPI content with root and any machine."""
    return {
        **os.environ,
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OPENBLAS_NUM_THREADS": "1",
    }
