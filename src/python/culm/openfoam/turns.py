"""Whose turn it is, by a lock file: where it stands the flow program works, where not, culm does."""

import os
import time

import numpy as np

from ..errors import CulmError
from .dictionary import read_dictionary
from .rotation import euler_angles

LEFT = 9  # exit code: the other program ended, or does not answer
STOPPED = 7  # exit code
_PAUSE = 0.005  # between looks at the lock [s]


class Turns:
    """Gives and takes turns with a flow program.

    @param case      of the flow program
    @param patience  how long it may work on a step [s]
    @param stop      an event: somebody wants both programs to end
    """

    def __init__(self, case, patience, stop):
        self._case = case
        self._patience, self._stop = patience, stop
        self._lock = case.comms / "OpenFOAM.lock"
        self.waited = 0.0  # for the flow program [s]

    def begin(self):
        """Takes away what an earlier run left, and gives the first turn to a flow program that is yet to be
        started: it would else seem to have had it."""
        self._case.comms.mkdir(parents=True, exist_ok=True)
        for path in (self._case.positions, self._case.forces):
            path.unlink(missing_ok=True)
        self._give()

    def wait(self, flow):
        """Returns whether it is culm's turn; if not, the flow program has ended well. Raises CulmError if
        it failed or lost its way."""
        start = time.monotonic()
        try:
            while self._lock.exists():
                if not flow.is_running():
                    return not self._lock.exists()  # it may have given the turn before
                if self._stop.is_set():
                    raise CulmError("stopped by a signal", STOPPED)
                if time.monotonic() - start > self._patience:
                    raise CulmError(f"{flow.name} has not answered for {self._patience:g} s", LEFT)
                time.sleep(_PAUSE)
            return True
        finally:
            self.waited += time.monotonic() - start

    def take_loads(self):
        """Forces and moments about the present places of stations, shape (stations, 3) [N, N m]; zero
        in a first turn that comes without them."""
        stations = len(self._case.locations)
        path = self._case.forces
        if not path.exists():
            return np.zeros((2, stations, 3))
        found = read_dictionary(path)
        loads = []
        for name in ("forces", "moments"):
            try:
                loads.append(np.array(found[name], dtype=float).reshape(-1, 3))
            except (KeyError, ValueError):
                raise CulmError(f"'{path}' has no {name} of stations", LEFT) from None
            if len(loads[-1]) != stations:
                raise CulmError(f"'{path}' has {name} of {len(loads[-1])} stations, of {stations} 'locations'",
                                LEFT)
        path.unlink()  # what is read once is not read again
        return np.array(loads)

    def give_motion(self, position, rotation):
        """Positions (stations, 3) [m] and rotations (stations, 3, 3) at the end of the flow program's step."""
        lists = {"points": position - self._case.centre, "angles": euler_angles(rotation)}
        text = ""
        for name, rows in lists.items():
            lines = ("({:.17g} {:.17g} {:.17g})\n".format(*row) for row in rows)
            text += f"{name}\n{len(rows)}\n(\n{''.join(lines)});\n"
        _write(self._case.positions, text + "degrees false;\n")
        self._give()

    def _give(self):
        _write(self._lock, "status=openfoam\n")


def _write(path, text):
    """A file that is whole when it appears."""
    new = path.with_name(path.name + ".new")
    new.write_text(text)
    os.replace(new, path)
