"""The history of a run as a pandas frame: as the file has it, number by number."""

import csv
import pathlib
import sys

import culm

folder = pathlib.Path(sys.argv[1])
frame = culm.history(folder)
with open(folder / "history.csv", encoding="utf-8") as file:
    header, *rows = list(csv.reader(file))
assert frame.index.name == header[0] and list(frame.columns) == header[1:], frame.columns
assert len(frame) == len(rows) > 10
assert frame.index.is_monotonic_increasing
for found, written in zip(frame.itertuples(), rows):
    assert list(found) == [*map(float, written[:-2]), *map(int, written[-2:])], (found, written)
assert list(frame.columns[-2:]) == ["analysis", "step"]
assert all(kind == "float64" for kind in frame.dtypes[:-2])
print(f"history: {len(frame)} rows of {', '.join(frame.columns[:2])} …")
