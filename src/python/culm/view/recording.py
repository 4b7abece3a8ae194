"""What a run recorded, read for the page: structures, states, shapes."""

import dataclasses
import urllib.parse

import numpy

from ..errors import CulmError
from ..resolved_deck import ResolvedDeck
from ..results import Results
from ..run_file import RunFile
from ..state_tables import read_field


@dataclasses.dataclass
class Held:
    """Nodes of a structure that a constraint acts on."""

    name: str
    type: str  # "Rigid Support"
    nodes: numpy.ndarray


@dataclasses.dataclass
class Loaded:
    """Nodes of a structure that a load acts on."""

    name: str
    type: str  # "Force"
    nodes: numpy.ndarray
    actions: numpy.ndarray  # (nodes, 6): force [N] and moment [N m]


@dataclasses.dataclass
class Outlines:
    """Cross-sections of a line: polygons in (xi1, xi2) [m]."""

    of_node: numpy.ndarray  # number of the polygon; -1 for none
    ends: numpy.ndarray  # of the polygons in `points`
    points: numpy.ndarray  # (points, 2)


@dataclasses.dataclass
class CellField:
    """Numbers of the cells of a structure in each state."""

    name: str  # of the dataset
    columns: list


@dataclasses.dataclass
class NodeField(CellField):
    """Numbers of its nodes."""


@dataclasses.dataclass
class Structure:
    """A structure in its reference."""

    link: str  # name of its groups
    name: str
    kind: str  # "Beam", "Shell" or "Body"
    position: numpy.ndarray  # (nodes, 3) [m]
    directors: dict  # (nodes, 3) by number
    connectivity: numpy.ndarray  # nodes of all cells
    ends: numpy.ndarray  # of the cells in it
    outlines: Outlines | None
    held: list
    loaded: list
    fields: list


@dataclasses.dataclass
class Shapes:
    """Modes or buckling shapes of an analysis."""

    analysis: str
    state: int | None  # index of the state that they are about; None where it is not recorded
    names: list
    real: dict  # (shapes, nodes, 6) by the names of structures
    imaginary: dict  # the same, or empty


class Recording:
    """The result file of a run, open. Raises CulmError, and turns what HDF5 says into one."""

    def __init__(self, run):
        path = run / "run.h5" if run.is_dir() else run
        if not path.exists():
            what = f"there is no run.h5 in '{run}'" if run.is_dir() else f"there is no '{run}'"
            raise CulmError(f"{what}; 'culm view' wants the folder of a run", 6)
        if path.suffix == ".xml":
            raise CulmError(f"'{path}' is a deck, no run; 'culm check {path} --view model.html' shows its model", 6)
        self.path = path
        self.folder = path.parent
        self._run = RunFile(path)

    def __enter__(self):
        self._file = None
        try:
            self._file = self._run.open()
            if _text(self._file.attrs.get("format", "")) != "culm run":
                raise CulmError(f"'{self.path}' is not the result file of a run", 6)
            self._steps = sorted(self._file["steps"].values(), key=lambda step: int(step.attrs["index"]))
            self.deck = ResolvedDeck(_text(self._file["deck/xml"][()]))
        except CulmError:
            if self._file is not None:
                self._file.close()
            raise
        except Exception as error:
            raise self._run.damaged(error) from error
        return self

    def __exit__(self, kind, error, trace):
        self._file.close()
        # h5py raises what it likes where a file is damaged
        if isinstance(error, (OSError, KeyError, RuntimeError)):
            raise self._run.damaged(error) from error

    @property
    def title(self):
        return _text(self._file["deck"].attrs["title"]) or self.folder.resolve().name

    @property
    def version(self):
        return _text(self._file["deck"].attrs["version"])

    @property
    def ending(self):
        """The first paragraph of the report; empty if the run has not come to its end."""
        if "report/text" not in self._file:
            return ""
        return _text(self._file["report/text"][()]).split("\n\n")[0].strip()

    @property
    def broken(self):
        """The promises that the run broke, as sentences."""
        return [str(one) for one in Results(self.path).findings() if one.is_broken]

    @property
    def times(self):
        """Time [s] or level of each state."""
        return [float(step.attrs["time"]) for step in self._steps]

    @property
    def indices(self):
        """Numbers of the states."""
        return [int(step.attrs["index"]) for step in self._steps]

    def structures(self):
        """In the order of their numbers."""
        groups = sorted(self._file["mesh"].items(), key=lambda item: int(item[1].attrs["number"]))
        return [_structure(link, group) for link, group in groups]

    def values(self, state, structure, name):
        """A field of a structure, with the number of a state in the order of `times`."""
        return read_field(self._steps[state], self._file["mesh"][structure.link], name)

    def links(self):
        """Springs, dampers, drives and mooring lines of a model that is shown before it is solved: type, name, and both
        ends of each, (links, 2, 3)."""
        found = []
        for link, data in self._steps[0].get("%arrays", {}).items() if self._steps else ():
            words = urllib.parse.unquote(link).split(": ", 2)
            if words[0] == "link":
                found.append((words[1], words[2], data[()].reshape(-1, 2, 3)))
        return found

    def shapes(self):
        """By the order of the names of analyses."""
        names = {link: _text(g.attrs["name"]) for link, g in self._file["mesh"].items()}
        found = []
        for link, group in self._file.get("analyses", {}).items():
            if "shapes" not in group:
                continue
            state = group.attrs.get("state")
            sets = [
                {names[one]: data[()] for one, data in group[part].items()} if part in group else {}
                for part in ("shapes", "shapes_imaginary")
            ]
            shapes = [_text(name) for name in group["shapes"].attrs["names"]]
            found.append(Shapes(urllib.parse.unquote(link), None if state is None else int(state), shapes, *sets))
        return found


def _structure(link, group):
    directors = {k: group[f"director{k}"][()] for k in (1, 2, 3) if f"director{k}" in group}
    return Structure(
        link,
        _text(group.attrs["name"]),
        _text(group.attrs["type"]),
        group["position"][()],
        directors,
        group["connectivity"][()],
        group["cell_offsets"][()],
        _outlines(group),
        [
            Held(_text(data.attrs["name"]), _text(data.attrs["type"]), data[()])
            for data in group.get("constraints", {}).values()
        ],
        [
            Loaded(_text(one.attrs["name"]), _text(one.attrs["type"]), one["nodes"][()], one["actions"][()])
            for one in group.get("loads", {}).values()
        ],
        _fields(group),
    )


def _outlines(group):
    if "outline_of_node" not in group:
        return None
    return Outlines(*(group[f"outline_{part}"][()] for part in ("of_node", "ends", "points")))


def _fields(group):
    fields = []
    resultants = [_text(name) for name in group.attrs["resultant_names"]]
    if resultants:
        fields.append(CellField("resultants", resultants))
    names, columns = group.attrs["cell_array_names"], group.attrs["cell_array_columns"]
    fields += [CellField(_text(name), _text(text).split()) for name, text in zip(names, columns)]
    counts = group["node_array_columns"][()]
    for name, count in zip(group.attrs["node_array_names"], counts):
        fields.append(NodeField(_text(name), ["x", "y", "z"] if count == 3 else [str(i) for i in range(count)]))
    return fields


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
