"""Recognises the instability of a coupling that exchanges loads once per step."""

import collections

import numpy as np

WINDOWS = 10  # how far it looks back
_FEWEST = 4  # with which it judges


class Reversals:
    """Follows the loads of a port from window to window.

    Where the fluid that moves with a structure is not light against it, loads of the motion before push it
    back too far: they turn over from window to window, whatever its length, and their work grows. Vibrations
    that windows resolve take several of them from one sign to the other.
    """

    def __init__(self):
        self._loads = None
        self._products = collections.deque(maxlen=WINDOWS)  # of loads with those of the window before
        self._works = collections.deque(maxlen=WINDOWS)

    def add(self, loads, work):
        """Takes a window in; returns whether the coupling is unstable.

        @param loads  forces, any shape
        @param work   of the port in this window [J]
        """
        if self._loads is not None:
            self._products.append(np.vdot(self._loads, loads))
            self._works.append(abs(work))
        self._loads = np.array(loads)
        return len(self._works) >= _FEWEST and sum(self._products) < 0.0 and self._grows()

    def _grows(self):
        works = list(self._works)
        half = len(works) // 2
        return sum(works[-half:]) > 2.0 * sum(works[:half])
