"""Files of Abaqus and CalculiX as blocks: a keyword, its parameters, the lines of data below."""

import dataclasses
import pathlib
import re

from ..errors import CulmError
from .findings import FILE_ERROR, Place, refuse

DEEPEST = 20  # includes within includes
MOST_BYTES = 2**30
SHORTEST = 4  # beginning of a parameter's name that stands for it
NUMBER = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)(E[+-]?[0-9]+)?"


@dataclasses.dataclass
class Block:
    """@param lines  (place, cells) of each line of data
    @param asked  names of parameters that were asked for"""

    keyword: str
    parameters: dict  # upper case; values as they stand, None for flags
    place: Place
    lines: list
    asked: set = dataclasses.field(default_factory=set)

    def get(self, name):
        """A parameter in upper case without quotation marks; None if it is not there."""
        value = self.parameters.get(self._as_written(name))
        return None if value is None else value.strip('"').upper()

    def required(self, name):
        value = self.get(name)
        if not value:
            refuse(self.place, f"*{self.keyword} needs the parameter {name}")
        return value

    def has(self, name):
        return self._as_written(name) in self.parameters

    def _as_written(self, name):
        """The name, or its beginning if that is what the file has: NLGEO is NLGEOM."""
        short = [one for one in self.parameters if len(one) >= SHORTEST and name.startswith(one)]
        found = name if name in self.parameters or len(short) != 1 else short[0]
        self.asked.add(found)
        return found

    def unread(self):
        """Parameters that nobody asked for."""
        return [name for name in self.parameters if name not in self.asked]


def read_blocks(path, depth=0):
    """All blocks of a file and of those it includes."""
    path = pathlib.Path(path)
    blocks = []
    for number, line in _logical_lines(path):
        place = Place(str(path), number)
        if line.startswith("*"):
            keyword, parameters = _keyword(line, place)
            if keyword == "INCLUDE":
                if depth == DEEPEST:
                    refuse(place, f"files include each other more than {DEEPEST} deep")
                name = parameters.get("INPUT")
                if not name:
                    refuse(place, "*INCLUDE needs the parameter INPUT")
                blocks += read_blocks(path.parent / name.strip('"'), depth + 1)
                continue
            blocks.append(Block(keyword, parameters, place, []))
        elif not blocks:
            refuse(place, f"expected a keyword, as *NODE, found '{line[:40]}'")
        else:
            blocks[-1].lines.append((place, _cells(line)))
    return blocks


def read_text(path):
    """The text of a file, with lines that end in "\\n", whichever way the file ends them; what is not UTF-8 is
    taken as Latin-1."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise CulmError(f"{path}: is not there, or no regular file", FILE_ERROR)
    if path.stat().st_size > MOST_BYTES:
        raise CulmError(f"{path}: is larger than 1 GB", FILE_ERROR)
    data = path.read_bytes()
    if b"\0" in data:
        line = data[: data.index(b"\0")].count(b"\n") + 1
        refuse(Place(str(path), line), "holds a zero byte, so it is no text file")
    try:
        text = data.decode("utf-8-sig")  # the mark of editors of Windows is no character
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def number(cell, place, what="a number"):
    """A real number; Fortran's D is an E."""
    text = cell.strip().upper().replace("D", "E")
    value = float(text) if re.fullmatch(NUMBER, text) else float("nan")
    if not abs(value) < float("inf"):
        refuse(place, f"expected {what}, found '{cell[:40]}'")
    return value


def numbers_of(cells, place, what="a number"):
    """Real numbers, of which one that is left out is 0; behind the last one there are none."""
    count = max((i + 1 for i, cell in enumerate(cells) if cell), default=0)
    return [number(cell or "0", place, what) for cell in cells[:count]]


def is_integer(text):
    return re.fullmatch(r"[+-]?[0-9]{1,18}", text) is not None


def integer(cell, place, what="a whole number"):
    text = cell.strip()
    if not is_integer(text):
        refuse(place, f"expected {what}, found '{cell[:40]}'")
    return int(text)


def _logical_lines(path):
    """Lines without comments; those of keywords that end with a comma go on in the next."""
    waiting, start = "", 0
    for number_, raw in enumerate(read_text(path).split("\n"), 1):
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if waiting:
            line = waiting + line
        else:
            start = number_
        waiting = ""
        if line.startswith("*") and line.endswith(","):
            waiting = line
            continue
        yield start, line
    if waiting:
        refuse(Place(str(path), start), "the file ends within a keyword line")


def _cells(line):
    """What stands between commas; within quotes they belong to a name."""
    cells = re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', line) if '"' in line else line.split(",")
    return [cell.strip() for cell in cells]


def _keyword(line, place):
    first, *rest = _cells(line[1:])
    parameters = {}
    for cell in rest:
        if not cell:
            continue
        name, _, value = cell.partition("=")
        parameters[" ".join(name.upper().split())] = value.strip() if "=" in cell else None
    keyword = " ".join(first.upper().split())
    if not keyword:
        refuse(place, "a keyword line without a keyword")
    return keyword, parameters
