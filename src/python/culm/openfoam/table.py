"""The history of a coupled run, readable up to the last step at any time."""

import csv

import numpy as np


class Table:
    """Writes history.csv: what the deck's history watches, and what went over the interface. There is no
    file before the first row.

    @param path  of the file
    @param port  its name, for the names of columns
    """

    def __init__(self, path, port):
        self._path, self._port, self._file = path, port, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._file:
            self._file.close()

    def write(self, time, quantities, work, loads):
        """One row.

        @param quantities  of the deck, by name and unit
        @param work        of the port since the start [J]
        @param loads       forces and moments, shape (2, stations, 3)
        """
        if self._file is None:
            self._file = open(self._path, "w", newline="")
            self._writer = csv.writer(self._file, lineterminator="\n")
            forces = [f"{self._port} f{axis} [N]" for axis in "xyz"]
            self._writer.writerow(["time", *quantities, f"{self._port} work [J]", *forces])
        numbers = [time, *quantities.values(), work, *np.sum(loads[0], axis=0)]
        self._writer.writerow("" if np.isnan(x) else f"{x:.17g}" for x in numbers)
        self._file.flush()
