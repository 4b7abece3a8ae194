"""A deck as it is used: what `culm check --resolved` writes."""

import pathlib
import tempfile
import xml.etree.ElementTree as ElementTree

INCLUDE = "{http://www.w3.org/2001/XInclude}include"


class ResolvedDeck:
    """Parameters by their paths, as --set takes them: 'Analyses/motion/Step'."""

    def __init__(self, text):
        self.text = text
        self.parameters = {}
        self.lists = []
        self._walk(ElementTree.fromstring(text), ())

    @staticmethod
    def of(program, deck, settings=()):
        """What the program makes of a deck file; CulmError if it is wrong."""
        with tempfile.TemporaryDirectory(prefix="culm") as folder:
            path = pathlib.Path(folder) / "resolved.xml"
            program.resolve(deck, path, settings)
            return ResolvedDeck(path.read_text(encoding="utf-8"))

    def matching(self, pattern):
        """Paths of the parameters that a pattern names, in which * is any one name."""
        words = pattern.split("/")
        return [path for path in self.parameters if _matches(path.split("/"), words)]

    def files(self, deck):
        """Paths of the files that it reads, by their names, which are relative to the deck file or to the include that has
        them."""
        names = {value for path, value in self.parameters.items() if path.endswith("/File Name")}
        folders = sorted(_folders(deck))
        return {name: folder / name for name in sorted(names) for folder in folders if (folder / name).is_file()}

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


def _folders(deck):
    """Of a deck file and of all its includes."""
    folders, seen, waiting = set(), set(), [deck]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        folders.add(path.parent)
        waiting += [path.parent / one.get("href") for one in ElementTree.parse(path).iter(INCLUDE)]
    return folders


def _matches(path, pattern):
    return len(path) == len(pattern) and all(b in ("*", a) for a, b in zip(path, pattern))
