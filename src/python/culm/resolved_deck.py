"""A deck as it is used: what `culm check --resolved` writes."""

import pathlib
import tempfile
import xml.etree.ElementTree as ElementTree

from .errors import CulmError

INCLUDE = "{http://www.w3.org/2001/XInclude}include"

OF_FILE, OF_FILES = ("/File Name", "/Input File"), "/File Names"  # ends of paths


class ResolvedDeck:
    """Parameters by their paths, as --set takes them: 'Analyses/motion/Step'."""

    def __init__(self, text):
        self.text = text
        self.variables = set()  # of the deck files, which --set takes by their names
        self.parameters = {}
        self.lists = []
        self._walk(ElementTree.fromstring(text), ())

    @staticmethod
    def of(program, deck, settings=()):
        """What the program makes of a deck file; CulmError if it is wrong."""
        with tempfile.TemporaryDirectory(prefix="culm") as folder:
            path = pathlib.Path(folder) / "resolved.xml"
            program.resolve(deck, path, settings)
            resolved = ResolvedDeck(path.read_text(encoding="utf-8"))
        resolved.variables = _variables(pathlib.Path(deck))
        return resolved

    def matching(self, pattern):
        """Paths of the parameters that a pattern names, in which * is any one name."""
        words = pattern.split("/")
        return [path for path in self.parameters if _matches(path.split("/"), words)]

    def files(self, deck):
        """Names and paths of the files that it reads. Names are relative to the deck file or to the include that has them:
        where files of one name stand beside several of these, all are there."""
        return find_files(self.parameters, sorted(_folders(deck)))

    def states(self):
        """Paths of what it takes from other runs."""
        return find_states(self.parameters)

    def only_files(self, deck):
        """The same as paths by names; an error where several files have one name, which the resolved deck cannot tell apart."""
        files = self.files(deck)
        paths = dict(files)
        for name, path in files:
            if not path.samefile(paths[name]):
                raise CulmError(f"files of the name '{name}' stand in '{path.parent}' and in '{paths[name].parent}'; rename one", 3)
        return paths

    def with_files(self, places):
        """The text of the deck with other places of its files, by their names."""
        root = ElementTree.fromstring(self.text)
        for one in root.iter("Parameter"):
            name, value = f"/{one.get('name')}", one.get("value")
            if name in OF_FILE:
                one.set("value", places.get(value, value))
            elif name == OF_FILES:
                one.set("value", "{" + ", ".join(places.get(file, file) for file in texts(value)) + "}")
        return ElementTree.tostring(root, encoding="unicode")

    def names_in(self, path):
        """The lists in a list: names_in('Output/History') are the quantities of the deck."""
        start = path + "/"
        return [
            one[len(start) :]
            for one in self.lists
            if one.startswith(start) and "/" not in one[len(start) :]
        ]

    def _walk(self, element, place):
        for child in element:
            path = (*place, child.get("name"))
            if child.tag == "ParameterList":
                self.lists.append("/".join(path))
                self._walk(child, path)
            else:
                self.parameters["/".join(path)] = child.get("value")


def find_files(parameters, folders):
    """Names and paths of the files in some folders that parameters of a deck, by their paths, name."""
    names = set()
    for path, value in parameters.items():
        if path.endswith(OF_FILE):
            names.add(value)
        elif path.endswith(OF_FILES):
            names.update(texts(value))
    # potential flow reads these beside it
    names |= {name[:-2] + end for name in names if name.endswith(".1") for end in (".3", ".hst")}
    found = [(name, folder / name) for name in sorted(names) for folder in folders if (folder / name).is_file()]
    return list(dict.fromkeys(found))


def find_states(parameters):
    """Paths of states and shapes of other runs, which are named from where the program runs."""
    patterns = (["Analyses", "*", "Start From"], ["Imperfections", "*", "Run"])
    runs = [
        pathlib.Path(value) for path, value in parameters.items()
        if any(_matches(path.split("/"), pattern) for pattern in patterns)
    ]
    files = [file for run in runs for file in (run, run / "run.checkpoint", run / "run.h5")]
    return [file for file in dict.fromkeys(files) if file.is_file()]


def texts(value):
    """The items of a list as a deck has it."""
    return [item.strip() for item in value.strip().removeprefix("{").removesuffix("}").split(",")]


def _folders(deck):
    return {path.parent for path, _ in _files(deck)}


def _variables(deck):
    return {variable.get("name") for _, root in _files(deck) for variable in root.iter("Variable")}


def _files(deck):
    """A deck file and all its includes: paths, and what they hold."""
    seen, waiting = {}, [deck]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen[path] = ElementTree.parse(path).getroot()
        waiting += [path.parent / one.get("href") for one in seen[path].iter(INCLUDE)]
    return seen.items()


def _matches(path, pattern):
    return len(path) == len(pattern) and all(b in ("*", a) for a, b in zip(path, pattern))
