"""Results of a run for people who work in Python: pandas frames and numpy arrays by the names of the deck."""

import dataclasses
import pathlib

import numpy
import pandas

from .errors import CulmError
from .history import frame_of, owners_of
from .results import Results, _text, _without_escapes
from .run_file import RunFile
from .state_tables import read_field


@dataclasses.dataclass
class State:
    """A recorded state. Arrays by the name of a structure, one row per node or element."""

    path: pathlib.Path
    index: int  # number of the record
    time: float  # [s], or level
    analysis: str  # that made it, or that begins with it
    step: int  # of the analysis; 0 is its start

    def position(self, structure):
        """(nodes, 3) [m]"""
        return self._array(structure, "position")

    def displacement(self, structure):
        """From the reference, (nodes, 3) [m]"""
        return self._array(structure, "displacement")

    def directors(self, structure):
        """(nodes, 3, 3): element [node, :, k] is the director d_{k+1}."""
        return numpy.stack([self._array(structure, f"director{k}") for k in (1, 2, 3)], axis=2)

    def velocity(self, structure):
        """(nodes, 3) [m/s], where Output / Velocities asks for them"""
        return self._array(structure, "velocity")

    def angular_velocity(self, structure):
        """(nodes, 3) [rad/s], likewise"""
        return self._array(structure, "angular velocity")

    def constraint_forces(self, name):
        """What a support, joint or drive exerts on the structure: a frame with a row for each of its nodes,
        place x y z [m], force Fx Fy Fz [N] and moment about the node Mx My Mz [N m], all in space; where
        Output / Constraint Forces asks for them, and of states that a step led to."""
        prefix = "constraint forces: "
        with RunFile(self.path).open() as file:
            group = file[f"steps/{self.index:06}"].get("%arrays", {})
            found = {_without_escapes(link): link for link in group}
            if prefix + name not in found:
                known = [array.removeprefix(prefix) for array in found if array.startswith(prefix)]
                if not known:
                    raise KeyError(f"no forces of a constraint '{name}', nor of any other, in state {self.index}; states have them with 'Constraint Forces' in "
                                   "'Output', but for those in which an analysis begins or a run was ended from outside")
                raise KeyError(f"no forces of a constraint '{name}' among: {', '.join(known)}")
            values = group[found[prefix + name]][()]
        return pandas.DataFrame(values, columns=["x", "y", "z", "Fx", "Fy", "Fz", "Mx", "My", "Mz"])

    def resultants(self, structure):
        """A frame with the stress resultants of the elements, in the directors of their sections."""
        with RunFile(self.path).open() as file:
            names = [_text(name) for name in _group(file["mesh"], structure).attrs["resultant_names"]]
        return pandas.DataFrame(self._array(structure, "resultants"), columns=names)

    def _array(self, structure, name):
        with RunFile(self.path).open() as file:
            values = read_field(file[f"steps/{self.index:06}"], _group(file["mesh"], structure), name)
        if values is None:
            raise KeyError(f"'{structure}' has no {name}")
        return values


@dataclasses.dataclass
class Modes:
    """What a modal or buckling analysis found."""

    table: pandas.DataFrame  # a row per mode, as in its CSV file, and remarks
    shapes: dict  # by structure: (modes, nodes, 6), displacement and rotation; complex of complex modes


class Run:
    """A run by its folder.

    history   frame of all quantities, with the analysis, its step, and the time or level as index
    analyses  names of the analyses in the deck
    quantities  names of what the history watches
    states    recorded states
    tables    frames by name, such as tables["modes/modes"]
    scalars   numbers of the report by name
    findings  broken promises and warnings
    report    how the run ended, in words
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        path = self.folder / "run.h5"
        if not path.exists():
            raise CulmError(f"there is no run.h5 in '{folder}'", 6)
        self._path = path
        results = Results(path)
        self.analyses = [name for name, _ in results.analyses()]
        self.quantities = results.quantities()
        self.scalars = results.scalars()
        self.findings = results.findings()
        self.report = results.report()
        self.history = self._read_history()
        self.states = self._read_states()
        self.tables = {
            f"{one.analysis}/{one.name}": _frame(one.columns, one.rows, one.remarks) for one in results.tables()
        }

    def __repr__(self):
        return f"<culm run '{self.folder}': {len(self.history)} rows, {len(self.states)} states>"

    def structures(self):
        """Names of the structures, and of each the mesh in the reference."""
        return Results(self._path).meshes()

    def modes(self, analysis):
        """What a modal or buckling analysis found."""
        table = next((t for name, t in self.tables.items() if name.startswith(f"{analysis}/")), None)
        if table is None:
            raise KeyError(f"no table of an analysis '{analysis}' among: {', '.join(self.tables)}")
        return Modes(table, Results(self._path).shapes(analysis))

    def columns(self, quantity):
        """The part of the history that shows one quantity of the deck, by the names of components."""
        if quantity not in self.quantities:
            raise KeyError(f"no quantity '{quantity}' among: {', '.join(self.quantities)}")
        owners = owners_of(list(self.history.columns), self.quantities)
        return self.history[[column for column, (owner, _) in owners.items() if owner == quantity]]

    def plot(self, quantity, axes=None):
        """Draws a quantity over time or level, a line for each component and analysis. Returns the axes."""
        import matplotlib.pyplot as pyplot

        axes = axes if axes is not None else pyplot.subplots(layout="constrained")[1]
        for (name, part), style in zip(_by_analysis(self.columns(quantity)), _STYLES * len(self.analyses)):
            times = part.index.get_level_values("time")
            for number, column in enumerate(part.columns):
                axes.plot(times, part[column], style, color=f"C{number}", label=f"{column}, {name}")
        axes.set(xlabel="time [s] or level")
        axes.set_title(quantity, parse_math=False)  # names of a deck, in which $ is a letter as any other
        with pyplot.rc_context({"text.parse_math": False}):
            axes.legend(fontsize="small")
        return axes

    def _read_history(self):
        frame = frame_of(self.folder / "history.csv").reset_index()
        frame["analysis"] = [self.analyses[number] for number in frame["analysis"]]
        return frame.set_index(["analysis", "step", "time"])

    def _read_states(self):
        with RunFile(self._path).open() as file:
            states = [
                State(self._path, int(s["index"]), float(s["time"]), self.analyses[int(s["analysis"])], int(s["step"]))
                for s in (group.attrs for group in file["steps"].values())
            ]
        return sorted(states, key=lambda state: state.index)


_STYLES = ["-", "--", ":", "-."]


def _by_analysis(frame):
    """Name and rows of each analysis, in the order of the run."""
    names = frame.index.get_level_values("analysis")
    for name in dict.fromkeys(names):
        part = frame[names == name]
        if len(part) > 1:  # a start alone is a point
            yield name, part


def _frame(columns, rows, remarks):
    frame = pandas.DataFrame(rows, columns=columns)
    return frame.assign(remark=remarks) if remarks else frame


def _group(parent, name):
    """The group of a structure or analysis by its name."""
    for link, group in parent.items():
        if _without_escapes(link) == name:
            return group
    raise KeyError(f"no '{name}' among: {', '.join(map(_without_escapes, parent))}")
