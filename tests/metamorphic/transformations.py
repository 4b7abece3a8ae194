"""Changes of a resolved deck after which its results are known: other units, another pose, another order.

A change works on the deck as `culm check --resolved` writes it, in which every value stands in SI units, and on the
histories and tables of its run. What a parameter means is read from `culm reference`: its unit, and whether a vector
is one of space or of directors.
"""

import copy
import math
import re
import xml.etree.ElementTree as ElementTree

import numpy as np

# exponents of mass, length and time
UNITS = {
    "1": (0, 0, 0), "m": (0, 1, 0), "s": (0, 0, 1), "kg": (1, 0, 0), "N": (1, 1, -2), "Pa": (1, -1, -2), "J": (1, 2, -2),
    "W": (1, 2, -3), "Hz": (0, 0, -1), "rad": (0, 0, 0), "K": (0, 0, 0), "%": (0, 0, 0), "deg": (0, 0, 0),
}  # fmt: skip


def dimension(unit):
    """Exponents of mass, length and time of a unit, such as 'N m/rad'; None if it is none."""
    total, sign = np.zeros(3), 1
    for token in re.findall(r"/|[^\s/]+", unit):
        if token == "/":
            sign = -1
            continue
        name, _, power = token.partition("^")
        if name not in UNITS:
            return None
        total += sign * float(power or 1) * np.array(UNITS[name])
    return total


class Reference:
    """What `culm reference` says of each parameter, by its path, with the names of the user left open, and its type."""

    def __init__(self, text):
        self.entries = {}
        for section in re.split(r"^## ", text, flags=re.M)[1:]:
            title, _, body = section.partition("\n")
            places = re.search(r"^In (.*)\.$", body, flags=re.M)
            paths = re.findall(r"`([^`]*)`", places[1]) if places else [""]
            parameters = dict(re.findall(r"^- `([^`]+)` – (.*)$", body, flags=re.M))
            for path in paths:
                self.entries.setdefault((path, title), {}).update(parameters)

    def about(self, path, kind, name):
        """The words on a parameter of the list at a path, a sequence of names, of a type; None if there are none."""
        for (where, title), parameters in self.entries.items():
            if name not in parameters:
                continue
            pattern = where.split(" / ") if where else []
            if kind not in (None, title) and title != pattern[-1:] and not self._untyped(title, pattern):
                continue
            if len(pattern) == len(path) and all(p == "<name>" or p == q for p, q in zip(pattern, path)):
                return parameters[name]
        return None

    @staticmethod
    def _untyped(title, pattern):
        """Whether a section is about lists that have no type."""
        return pattern and (title == pattern[-1] or title in ("Node Set", "Element Set", "Branch", "Surface"))


def parameters(root, path=()):
    """All parameters of a deck: path of the list, type of it, element, name."""
    kind = next((p.get("value") for p in root.findall("Parameter") if p.get("name") == "Type"), None)
    for child in root:
        if child.tag == "Parameter":
            yield path, kind, child, child.get("name")
        elif child.tag == "ParameterList":
            yield from parameters(child, (*path, child.get("name")))


def numbers(element):
    """The value of a parameter as a list, and whether it stands in braces."""
    text = element.get("value").strip()
    if text.startswith("{"):
        inner = text[1:-1].strip()
        return [float(x) for x in inner.split(",")] if inner else [], True
    return [float(text)], False


def write(element, values, braces):
    if values == numbers(element)[0]:
        return
    element.attrib.pop("isDefault", None)
    text = [repr(float(v)) for v in values]
    element.set("value", "{" + ", ".join(text) + "}" if braces else text[0])


def is_numeric(words):
    return words is not None and words.startswith("number")


def unit_of(words):
    """The unit in words as 'number > 0 N/m^2, required. …', '1' if there is none."""
    head = re.split(r", (?:required|optional|default|\d|at least|a multiple)", words, maxsplit=1)[0]
    head = re.sub(r"^numbers?|between \S+ and \S+|[<>]=?\s*\S+|\b(in|and)\b", " ", head)
    return head.split(".")[0].strip(" ,") or "1"


def find(root, *names):
    for name in names:
        root = next((c for c in root if c.tag == "ParameterList" and c.get("name") == name), None)
        if root is None:
            return None
    return root


def value(entry, name):
    return next((p.get("value") for p in entry.findall("Parameter") if p.get("name") == name), None)


class Unsuitable(Exception):
    """A deck holds what the change cannot tell how to change."""


def refuse(root, reasons):
    """Raises where a list of that name holds anything, or a parameter of that name stands anywhere."""
    for name in reasons.get("lists", ()):
        found = find(root, name)
        if found is not None and len(found):
            raise Unsuitable(name)
    for _, _, element, name in parameters(root):
        if name in reasons.get("parameters", ()):
            raise Unsuitable(f"{name} = {element.get('value')}")


class Scale:
    """Other units of mass, length and time. Powers of two change no digit, so results differ where a number that ought to
    have a unit hides in the program, and nowhere else."""

    RAMP = "Ramp in a second"

    def __init__(self, mass, length, time=1.0):
        self.factors = (mass, length, time)
        self.name = f"mass x {mass:g}, length x {length:g}, time x {time:g}"

    def factor(self, exponents):
        return math.prod(f**e for f, e in zip(self.factors, exponents))

    def deck(self, root, reference):
        refuse(root, {
            "lists": ("Signals", "Fields", "Coupling", "Airfoils", "Flows"),
            "parameters": ("File Name", "Run", "File"),
        })  # fmt: skip
        root = copy.deepcopy(root)
        stretched = self.factors[2] != 1.0
        if stretched:
            self._check_time(root)
        for path, kind, element, name in parameters(root):
            words = reference.about(path, kind, name)
            if name == "Expression" and stretched:
                element.set("value", re.sub(r"\bt\b", f"(t/{self.factors[2]!r})", element.get("value")))
            if not is_numeric(words):
                continue
            values, braces = numbers(element)
            exponents = self._exponents(root, path, kind, name, words, len(values))
            write(element, [v * self.factor(e) for v, e in zip(values, exponents)], braces)
        return root

    def _check_time(self, root):
        for analysis in find(root, "Analyses"):
            if value(analysis, "Type") not in ("Dynamic", "Modal", "Matrices"):
                raise Unsuitable("levels beside times")
        ramp = ElementTree.SubElement(find(root, "Functions"), "ParameterList", name=self.RAMP)
        for name, text in (("Type", "Linear Then Constant"), ("Duration", "1")):
            ElementTree.SubElement(ramp, "Parameter", name=name, value=text)
        # supports that move nothing have no function to name
        amounts = [(path, element) for path, _, element, name in parameters(root) if name in ("Translation", "Angle")]
        still = {path for path, _ in amounts} - {path for path, element in amounts if element.get("isDefault") != "true"}
        for path, _, element, name in parameters(root):
            if name.endswith("Function") and element.get("value") == "Ramp" and path not in still:
                element.set("value", self.RAMP)

    def _exponents(self, root, path, kind, name, words, count):
        translation, rotation = np.zeros(3), np.array([0, 1, 0])
        arms = [translation] * 3 + [rotation] * 3
        if count in (21, 36) and kind in ("Stiffness Matrix", "Restoring"):
            base = np.array({
                ("Stiffness Matrix", "Stiffness"): (1, 1, -2), ("Stiffness Matrix", "Mass"): (1, -1, 0),
                ("Restoring", "Stiffness"): (1, 0, -2), ("Restoring", "Damping"): (1, 0, -1),
                ("Restoring", "Quadratic Damping"): (1, -1, 0),
            }[kind, name])  # fmt: skip
            if name == "Quadratic Damping":
                raise Unsuitable("Quadratic Damping")
            pairs = [(i, j) for i in range(6) for j in range(6) if count == 36 or j >= i]
            return [base + arms[i] + arms[j] for i, j in pairs]
        if kind == "Restoring" and name == "Preload":
            return [np.array((1, 1, -2)) + arm for arm in arms]
        if kind == "Section Stress" and name in ("Normal", "Shear 1", "Shear 2"):
            return [np.array((0, -2, 0)) - arm for arm in arms]
        if kind == "Path" and name == "First Increment":
            if value(find(root, *path), "Control") == "Displacement":
                return [np.array((0, 1, 0))]
        if kind == "Delta" and name == "Intensity":
            return [np.array((0, 0, 1))]
        exponents = dimension(unit_of(words))
        if exponents is None:
            raise Unsuitable(f"unit of {name}: {words[:60]}")
        return [exponents] * count

    def column(self, name, columns):
        """What a column of the changed run is in the units of the first one."""
        unit = re.search(r"\[([^\]]*)\]$", name)
        if name == "time":
            return np.array(columns[name]) / self.factors[2]
        if unit is None:
            return np.array(columns[name])
        exponents = dimension(unit[1].replace("kg^0.5", "kg^0.5"))
        if exponents is None:
            raise Unsuitable(f"unit of the column {name}")
        return np.array(columns[name]) / self.factor(exponents)


def turned(vector, times=1):
    """x, y, z become y, z, x: no digit changes."""
    for _ in range(times):
        vector = [vector[2], vector[0], vector[1]]
    return list(vector)


class Turn:
    """The axes of space change their places: x becomes y, y becomes z and z becomes x."""

    name = "turned: x, y, z become y, z, x"
    IN_DIRECTORS = re.compile(r"in (its|the|their) directors|along (its|the) directors|along d1|items?, .*in its own")
    # columns of space in histories, by what stands before the unit
    TRIPLES = ("ux uy uz", "x y z", "rx ry rz", "vx vy vz", "wx wy wz", "ax ay az", "Fx Fy Fz", "Mx My Mz", "lx ly lz", "Lx Ly Lz")

    def deck(self, root, reference):
        refuse(root, {"lists": ("Flows", "Coupling", "Signals", "Ports"), "parameters": ("Run", "Field", "File Name", "Quadratic Damping")})
        root = copy.deepcopy(root)
        for path, kind, element, name in parameters(root):
            words = reference.about(path, kind, name)
            if not is_numeric(words):
                continue
            values, braces = numbers(element)
            if name == "Rotation" and "Mesh" in path:
                values = self._frame(values)
            elif kind == "Restoring" and len(values) in (6, 21, 36):
                values = self._restoring(values)
            elif self._in_space(path, kind, name, words, values):
                values = [x for i in range(0, len(values), 3) for x in turned(values[i : i + 3])]
            else:
                continue
            write(element, values, braces)
        return root

    def _in_space(self, path, kind, name, words, values):
        if path and path[0] == "Sections" or "Mesh" in path and name != "Origin":
            return False
        if "3 items" not in words and "9 items" not in words and "a multiple of 3" not in words and "a multiple of 9" not in words:
            return False
        if kind and kind.startswith("Follower") or self.IN_DIRECTORS.search(words) or name in ("Size", "Inertia", "Expansions", "Radii"):
            return False
        return len(values) % 3 == 0

    @staticmethod
    def _frame(rotation):
        """Of a mesh: its own turn, then that of the axes, as one vector."""
        from scipy.spatial.transform import Rotation

        axes = Rotation.from_matrix(np.array([turned(row) for row in np.eye(3)]).T)
        return list((axes * Rotation.from_rotvec(rotation)).as_rotvec())

    @staticmethod
    def _restoring(values):
        if len(values) == 6:
            return turned(values[:3]) + turned(values[3:])
        full = np.zeros((6, 6))
        if len(values) == 36:
            full[:] = np.reshape(values, (6, 6))
        else:
            full[np.triu_indices(6)] = values
            full = np.triu(full) + np.triu(full, 1).T
        where = [2, 0, 1, 5, 3, 4]
        return list(full[np.ix_(where, where)].ravel())

    def column(self, name, columns):
        stem = re.fullmatch(r"(.*?)(\S+)( \[[^\]]*\])", name)
        if stem is None:
            return np.array(columns[name])
        for triple in self.TRIPLES:
            triple = triple.split()
            if stem[2] in triple:
                other = triple[(triple.index(stem[2]) + 1) % 3]
                return np.array(columns.get(stem[1] + other + stem[3], columns[name]))
        return np.array(columns[name])


class Reorder:
    """Entries of lists whose order means nothing come in the reverse order."""

    name = "entries in reverse order"
    LISTS = ("Sections", "Materials", "Structures", "Imperfections", "Masses", "Node Sets", "Element Sets", "Functions",
             "Fields", "Signals", "Constraints", "Flows", "Airfoils", "Loads")  # fmt: skip

    def deck(self, root, reference):
        root = copy.deepcopy(root)
        changed = False
        for name in self.LISTS:
            found = find(root, name)
            if found is not None and len(found) > 1:
                changed = True
                found[:] = list(found)[::-1]
        if not changed:
            raise Unsuitable("single entries")
        return root

    def column(self, name, columns):
        return np.array(columns[name])


class InTurn:
    """One change after the other, the second of which leaves columns as they are."""

    def __init__(self, first, second):
        self.first, self.second = first, second
        self.name = f"{first.name}; {second.name}"
        self.column = first.column

    def deck(self, root, reference):
        return self.second.deck(self.first.deck(root, reference), reference)
