"""run.h5, also of a run that goes on."""

import fcntl
import io
import pathlib
import time

import h5py

from .errors import CulmError

TRIALS = 100
PAUSE = 0.02  # s


class RunFile:
    """@param path  of a run.h5"""

    def __init__(self, path):
        self.path = path
        self._copy = None

    def open(self):
        """The file of h5py, to read. While a run writes, the file is that of one moment, the same each time. Raises
        CulmError where there was no such moment, and where it is none of HDF5."""
        if self._copy is None and _is_held(self.path.with_name("run.lock")):
            self._copy = self._steady()
        try:
            return h5py.File(self.path if self._copy is None else io.BytesIO(self._copy), "r")
        except OSError as error:
            raise self.damaged(error) from error

    def damaged(self, error):
        """What to tell of what h5py raised."""
        hint = ""
        if pathlib.Path(f"{self.path}.journal").exists():
            hint = "; run.h5.journal holds the rest of it, 'culm resume' puts that in its place"
        return CulmError(f"cannot read '{self.path}', which is damaged or incomplete: {' '.join(str(error).split())}{hint}", 6)

    def _steady(self):
        """Commits change places all over the file, each in microseconds: what is the same twice lies between two."""
        for _ in range(TRIALS):
            found = self.path.read_bytes()
            if self.path.read_bytes() == found:
                return found
            time.sleep(PAUSE)
        raise CulmError(f"'{self.path}' changes faster than it can be read: the run goes on; try again", 6)


def _is_held(lock):
    """Whether a run owns the folder; one that was killed leaves the file, and nobody holds it."""
    try:
        with open(lock, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except OSError:  # held, or on a file system without locks
        return True
    return False
