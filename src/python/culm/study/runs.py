"""The runs of a study: one folder per settings, kept, so that a study that was stopped goes on."""

import contextlib
import dataclasses
import fcntl
import functools
import hashlib
import json
import os
import pathlib
import shutil
import statistics

from ..at_once import at_once
from ..errors import CulmError
from ..history import History
from ..program import DONE
from ..resolved_deck import find_files, find_states
from ..results import Results


@dataclasses.dataclass
class Record:
    """What is kept of a run."""

    settings: list
    exit: int | None
    outcome: str
    reason: str  # of a failure, in the words of the program
    times: list  # CPU [s] of runs that nothing disturbed
    broken: list  # promises, as sentences, of a run that came to its end
    folder: object

    @property
    def succeeded(self):
        return self.exit in DONE

    @property
    def cpu(self):
        """Median [s]; None if it was not timed."""
        return statistics.median(self.times) if self.times else None

    def history(self):
        return History(self.folder / "history.csv")

    def scalars(self):
        return Results(self.folder / "run.h5").scalars()


class StudyRuns:
    """Makes runs, or finds them in the folder of the study."""

    def __init__(self, program, deck, resolved, folder, time_limit=None, say=print, needs_history=True):
        """@param resolved  ResolvedDeck: runs of another deck, of other files that it reads or of another
        program are not taken for its own"""
        self.program = program
        self.deck = deck
        read = [pathlib.Path(program.path), *(path for _, path in resolved.files(deck)), *resolved.states()]
        self.identity = "\n".join([resolved.text, *map(_digest, read)])
        self.folder = folder / "runs"
        self.time_limit = time_limit
        self.say = say
        self.needs_history = needs_history
        self.folder.mkdir(parents=True, exist_ok=True)
        try:
            self.claims = open(self.folder / "claims.lock", "ab")  # closing it would give up all claims
        except OSError:  # what is there can be read, all the same
            self.claims = None

    def find(self, settings):
        """The record of a run that came to its end earlier, or None."""
        folder = self.folder / self._key(settings)
        try:
            kept = json.loads((folder / "record.json").read_text())
        except (OSError, ValueError):
            return None
        return Record(**kept, folder=folder)

    def time(self, settings, repeats, label):
        """A run with so many times; alone on the machine as far as the study is concerned."""
        record = self.find(settings)
        if record is None:
            record = self._run(settings, label, timed=True)
        while record.succeeded and len(record.times) < repeats:
            record.times.append(self._repeat(settings))
            _keep(record)
        return record

    def get(self, wanted, jobs):
        """Runs without times, so many at once.

        @param wanted  pairs of settings and label
        """
        return list(self.each(wanted, jobs))

    def each(self, wanted, jobs):
        """The same, one after the other as they come."""
        yield from at_once(lambda one: self.find(one[0]) or self._run(*one, timed=False), wanted, jobs)

    def _run(self, settings, label, timed):
        """A run that nobody else makes meanwhile, such as the same sweep that was started once more."""
        with self._claimed(settings, label):
            return self.find(settings) or self._run_alone(settings, label, timed)

    @contextlib.contextmanager
    def _claimed(self, settings, label):
        """The lock of a byte of its own; the system frees it where a process dies."""
        if self.claims is None:
            yield
            return
        place = int(self._key(settings)[:15], 16)
        try:
            fcntl.lockf(self.claims, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, place)
        except (BlockingIOError, PermissionError):
            self.say(f"another process makes {label}: waiting for it")
            fcntl.lockf(self.claims, fcntl.LOCK_EX, 1, place)
        except OSError:  # there are file systems without locks
            pass
        try:
            yield
        finally:
            with contextlib.suppress(OSError):
                fcntl.lockf(self.claims, fcntl.LOCK_UN, 1, place)

    def _run_alone(self, settings, label, timed):
        folder = self.folder / self._key(settings)
        part = folder.with_suffix(".part")
        for old in (folder, part):
            shutil.rmtree(old, ignore_errors=True)
        run = self._call(settings, part)
        times = [run.cpu] if timed and run.succeeded else []
        record = Record(list(settings), run.exit, run.outcome, _reason(run), times, run.broken, part)
        if self.needs_history and run.succeeded and not (part / "history.csv").exists():
            raise CulmError("the deck has no analysis that writes a history", 3)
        _keep(record)
        os.replace(part, folder)
        record.folder = folder
        reason = "" if run.succeeded else f": {record.reason}"
        reason += "".join(f"; BROKEN: {sentence}" for sentence in record.broken)
        self.say(f"{run.cpu:9.2f} s  {label}{reason}")
        return record

    def _repeat(self, settings):
        folder = self.folder / f"{self._key(settings)}.again"
        run = self._call(settings, folder)
        shutil.rmtree(folder)
        if not run.succeeded:
            raise CulmError(f"a run that succeeded failed when it was repeated: {_reason(run)}", 1)
        return run.cpu

    def _call(self, settings, folder):
        return self.program.run(self.deck, folder, settings, self.time_limit)

    def _key(self, settings):
        """Of settings, and of what stands in the files that they name, from where the program runs."""
        named = {path: value for path, _, value in (setting.partition("=") for setting in settings)}
        read = [*(path for _, path in find_files(named, [pathlib.Path()])), *find_states(named)]
        text = "\n".join([self.identity, *sorted(settings), *map(_digest, read)])
        return hashlib.sha256(text.encode()).hexdigest()[:16]


def _digest(path):
    found = path.stat()
    return _digest_of(path, found.st_mtime_ns, found.st_size)


@functools.lru_cache(maxsize=None)
def _digest_of(path, time, size):
    """Of a file as it was then; it is read once."""
    del time, size
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _keep(record):
    """Complete or not at all, so that a kill leaves nothing wrong behind."""
    kept = {key: value for key, value in vars(record).items() if key != "folder"}
    part = record.folder / "record.json.part"
    part.write_text(json.dumps(kept, indent=1))
    os.replace(part, record.folder / "record.json")


def _reason(run):
    if run.succeeded:
        return ""
    if run.exit is None or run.exit < 0:
        return run.outcome
    lines = [line.strip() for line in run.errors.splitlines()]
    lines = [line for line in lines if line and not line.startswith("warning:")]
    cause = [line for line in lines if line.startswith("Likely cause:")]
    return " ".join([*lines[:1], *cause[:1]]) or run.outcome
