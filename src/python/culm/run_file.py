"""run.h5, also of a run that goes on."""

import io
import time

import h5py

from .errors import CulmError

TRIALS = 50
PAUSE = 0.02  # s


class RunFile:
    """@param path  of a run.h5"""

    def __init__(self, path):
        self.path = path
        self._copy = None

    def open(self):
        """The file of h5py, to read. While a run writes, the file is that of one moment, the same each time. Raises
        CulmError where there was no such moment, and what h5py raises."""
        if self._copy is None and self.path.with_name("run.lock").exists():
            self._copy = self._steady()
        return h5py.File(self.path if self._copy is None else io.BytesIO(self._copy), "r")

    def _steady(self):
        """Commits change places all over the file, each in microseconds: what is the same twice lies between two."""
        before = self.path.read_bytes()
        for _ in range(TRIALS):
            again = self.path.read_bytes()
            if again == before:
                return again
            before = again
            time.sleep(PAUSE)
        raise CulmError(f"'{self.path}' changes faster than it can be read: the run goes on; try again", 6)
