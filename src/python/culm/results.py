"""The result file of a run, run.h5."""

import dataclasses
import pathlib
import re
import urllib.parse
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from .run_file import RunFile
from .state_tables import read_field


@dataclasses.dataclass
class Effect:
    """A line of the table of effects; None where a count makes no sense."""

    name: str
    items: int | None
    unknowns: int | None
    entries: int | None  # additions to the matrix per iteration
    calls: int
    seconds: float


@dataclasses.dataclass
class Finding:
    """What the user of a run must know."""

    is_broken: bool  # a promise does not hold; otherwise a warning
    kind: str
    text: str
    analysis: str
    time: float  # [s], or level

    def __str__(self):
        where = f"{self.analysis}, at {self.time:.6g}" if self.analysis else f"at {self.time:.6g}"
        return f"{self.kind} ({where}): {self.text}"


@dataclasses.dataclass
class Step:
    """An accepted step."""

    time: float  # [s], or level
    iterations: int
    residual: float  # of the forces, relative
    held: bool  # above the tolerance, because rounding lets it fall no further
    analysis: int | None = None  # its number in the deck, from 0; None in files of earlier versions
    step: int | None = None  # in the analysis, from 1


@dataclasses.dataclass
class Mesh:
    """A structure in its reference."""

    position: numpy.ndarray  # (nodes, 3) [m]
    cells: list  # tuples of nodes
    is_surface: bool
    directors: numpy.ndarray | None = None  # (nodes, 3, 3), by columns; None of shells, which have one


@dataclasses.dataclass
class Table:
    """What an analysis found; None in a row where there is no number."""

    analysis: str
    name: str
    columns: list
    rows: list
    remarks: list  # one for each row, or none

    @property
    def title(self):
        return f"{self.analysis}: {self.name}"


class Results:
    """What stands in the file; parts that a killed run did not write are empty."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self._run = RunFile(self.path)

    def title(self):
        with self._run.open() as file:
            return _text(file["deck"].attrs["title"])

    def version(self):
        with self._run.open() as file:
            return _text(file["deck"].attrs["version"])

    def deck(self):
        """The deck as it was used, XML."""
        with self._run.open() as file:
            return _text(file["deck/xml"][()])

    def report(self):
        """The text of the report."""
        with self._run.open() as file:
            return _text(file["report/text"][()]) if "report/text" in file else ""

    def scalars(self):
        """The numbers of the report by name."""
        with self._run.open() as file:
            if "report/scalars" not in file:
                return {}
            return {name: float(data[()]) for name, data in file["report/scalars"].items()}

    def effects(self):
        """What the run contained and what it cost."""
        with self._run.open() as file:
            if "report/effects" not in file:
                return []
            data = file["report/effects"]
            return [
                Effect(_text(name), *map(_count, row[:3]), int(row[3]), float(row[4]))
                for name, row in zip(data.attrs["remarks"], _rows(data))
            ]

    def findings(self):
        """Broken promises and warnings in the order in which they were found."""
        with self._run.open() as file:
            return [
                Finding(
                    _text(one.attrs["grade"]) == "broken",
                    *(_text(one.attrs[name]) for name in ("kind", "text", "analysis")),
                    float(one.attrs["time"]),
                )
                for one in file.get("report/findings", {}).values()
            ]

    def history(self):
        """Rows of time, quantities, number of the analysis and step; None where a quantity does not exist."""
        with self._run.open() as file:
            return _rows(file["history/values"])

    def states(self):
        """Numbers of the recorded states."""
        with self._run.open() as file:
            return sorted(int(step.attrs["index"]) for step in file["steps"].values())

    def steps(self):
        """The accepted steps."""
        with self._run.open() as file:
            if "report/steps" not in file:
                return []
            return [
                Step(time, int(iterations), residual, held != 0.0, *map(int, place))
                for time, iterations, residual, held, *place in file["report/steps"][()]
            ]

    def meshes(self):
        """Structures by name."""
        with self._run.open() as file:
            return {_text(g.attrs["name"]): _mesh(g) for g in file["mesh"].values()}

    def last_state(self):
        """Time of the last recorded state, and positions by structure."""
        with self._run.open() as file:
            last = file["steps"][max(file["steps"])]
            return float(last.attrs["time"]), {
                _text(group.attrs["name"]): read_field(last, group, "position") for group in file["mesh"].values()
            }

    def cell_fields(self):
        """Of the last recorded state: by structure whether it is a surface, and of each field of its cells the columns
        and the values (cells, columns)."""
        fields = {}
        with self._run.open() as file:
            last = file["steps"][max(file["steps"])]
            for group in file["mesh"].values():
                tables = {}
                columns = {"resultants": [_text(name) for name in group.attrs["resultant_names"]]}
                names, texts = group.attrs["cell_array_names"], group.attrs["cell_array_columns"]
                columns |= {_text(name): _text(text).split() for name, text in zip(names, texts)}
                for name, one in columns.items():
                    values = read_field(last, group, name) if one else None
                    if values is not None and len(values):
                        tables[name] = (one, values.reshape(len(values), -1))
                fields[_text(group.attrs["name"])] = (_text(group.attrs["type"]) == "Shell", tables)
        return fields

    def analyses(self):
        """Names and types of the analyses of the deck."""
        lists = ElementTree.fromstring(self.deck()).findall("ParameterList[@name='Analyses']/ParameterList")
        types = [one.find("Parameter[@name='Type']").get("value") for one in lists]
        return [(one.get("name"), type) for one, type in zip(lists, types)]

    def quantities(self):
        """Names of the entries of the history in the deck."""
        path = "ParameterList[@name='Output']/ParameterList[@name='History']/ParameterList"
        return [one.get("name") for one in ElementTree.fromstring(self.deck()).findall(path)]

    def shapes(self, analysis):
        """Shapes that an analysis found, by structure: (shapes, nodes, 6), complex where they are."""
        with self._run.open() as file:
            for link, group in file.get("analyses", {}).items():
                if _without_escapes(link) == analysis:
                    imaginary = group.get("shapes_imaginary", {})
                    return {
                        _without_escapes(name): data[()] + (1j * imaginary[name][()] if name in imaginary else 0.0)
                        for name, data in group.get("shapes", {}).items()
                    }
        return {}

    def tables(self):
        """Tables of analyses."""
        tables = []
        with self._run.open() as file:
            for link, group in file.get("analyses", {}).items():
                for name, data in group.items():
                    if isinstance(data, h5py.Dataset) and data.ndim == 2:
                        columns = [_text(c) for c in data.attrs["names"]]
                        remarks = [_text(r) for r in data.attrs.get("remarks", [])]
                        tables.append(Table(_without_escapes(link), name, columns, _rows(data), remarks))
        return tables


def file_part(name):
    """The part of the name of a file or folder that a name of the deck becomes: see culm/output/file_part.hpp."""
    return re.sub(rb"[^a-z0-9]", b"_", name.encode().lower()).decode()


def _without_escapes(link):
    """The name of which a link is made: / : % | are written as %XX."""
    return urllib.parse.unquote(link)


def _mesh(group):
    ends = group["cell_offsets"][()].tolist()
    nodes = group["connectivity"][()].tolist()
    starts = [0, *ends[:-1]]
    cells = [tuple(nodes[a:b]) for a, b in zip(starts, ends)]
    is_surface = _text(group.attrs["type"]) == "Shell"
    directors = None
    if not is_surface:
        directors = numpy.stack([group[f"director{k}"][()] for k in (1, 2, 3)], axis=2)
    return Mesh(group["position"][()], cells, is_surface, directors)


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _rows(data):
    """A table as lists, with None for the mark of what is absent."""
    mark = data.attrs["_FillValue"]
    return [[None if number == mark else number for number in row] for row in data[()].tolist()]


def _count(number):
    return None if number is None else int(number)
