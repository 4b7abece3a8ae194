"""Files of HAWC2: sections by stations (st), and the blocks of a htc file."""

import dataclasses
import pathlib
import re

import numpy

from .findings import FILE_ERROR, Place, refuse
from .keyword_file import DEEPEST, number, read_text

CLASSIC = ("r", "m", "x_cg", "y_cg", "ri_x", "ri_y", "x_sh", "y_sh", "E", "G", "I_x", "I_y", "I_p", "k_x", "k_y", "A",
           "pitch", "x_e", "y_e")  # fmt: skip
FULL = ("r", "m", "x_cg", "y_cg", "ri_x", "ri_y", "pitch", "x_e", "y_e")  # and the upper triangle of 6x6

HIGHEST = 3  # folders above that of a htc file, in which files that it names are looked for


@dataclasses.dataclass
class Stations:
    """@param rows  one for each station: its numbers by name, and `K`, 21 values, if it has a full matrix"""

    rows: list
    place: Place
    is_full: bool


def read_stations(path, set_number, subset):
    """The stations of a set and subset, as `set 1 1` in a htc file names them."""
    lines = [(Place(str(path), i), line.split(";")[0].strip()) for i, line in enumerate(read_text(path).split("\n"), 1)]
    within, found = None, []
    for i, (place, line) in enumerate(lines):
        if mark := re.match(r"#\s*(\d+)", line):
            within = int(mark[1])
            found.append((within, None))
        elif mark := re.match(r"\$\s*(\d+)\s+(\d+)", line):
            found.append((within, int(mark[1])))
            if within == set_number and int(mark[1]) == subset:
                return _rows(lines[i + 1 :], int(mark[2]), place)
    known = ", ".join(f"{one} {other}" for one, other in found if other is not None)
    refuse(Place(str(path), 1), f"there is no set {set_number} {subset}; there are: {known or 'none'}")


def _rows(lines, count, place):
    if not 2 <= count <= 10**5:
        refuse(place, f"expected at least 2 stations, found {count}")
    table = []
    for where, line in lines:
        if len(table) == count:
            break
        if not line:
            continue
        if line[0] in "#$":
            refuse(where, f"{count} stations are announced, {len(table)} are there")
        words = line.split()
        if len(words) not in (len(CLASSIC), len(FULL) + 21):
            refuse(where, f"a station has {len(CLASSIC)} numbers, or {len(FULL) + 21} with a full matrix; found {len(words)}")
        table.append((where, [number(word, where) for word in words]))
    if len(table) < count:
        refuse(place, f"{count} stations are announced, {len(table)} are there")
    full = len(table[0][1]) != len(CLASSIC)
    rows = []
    for where, values in table:
        if (len(values) != len(CLASSIC)) != full:
            refuse(where, "stations of both kinds in one table")
        row = dict(zip(FULL if full else CLASSIC, values))
        if full:
            row["K"] = numpy.array(values[len(FULL) :])
        row["place"] = where
        rows.append(row)
    return Stations(rows, place, full)


@dataclasses.dataclass
class Block:
    """@param lines   (place, words);  @param blocks  those within"""

    name: str
    place: Place
    lines: list
    blocks: list

    def all(self, name):
        return [one for one in self.blocks if one.name == name]

    def first(self, name):
        """The words of the first line that begins with `name`; None if there is none."""
        return next(((place, words) for place, words in self.lines if words[0] == name), None)


def read_htc(path):
    root = Block("file", Place(str(path), 1), [], [])
    _read_into([root], pathlib.Path(path), pathlib.Path(path), 0)
    return root


def find_file(htc, name, place):
    """A file that a htc file names. HAWC2 counts from the folder that it is started in, mostly the one above that of the file."""
    name = pathlib.PureWindowsPath(name).as_posix()
    tried = [htc.parent / name, *(htc.parent / ("../" * up + name) for up in range(1, HIGHEST + 1))]
    for one in tried:
        if one.is_file():
            return one
    refuse(place, f"the file {name} is not there, from the folder of {htc.name} or up to {HIGHEST} above it", FILE_ERROR)


def _read_into(stack, htc, path, depth):
    opened = len(stack)
    for i, raw in enumerate(read_text(path).split("\n"), 1):
        words = raw.split(";")[0].lower().split()
        original = raw.split(";")[0].split()
        place = Place(str(path), i)
        if not words:
            continue
        if words[0] == "begin" and len(words) > 1:
            block = Block(words[1], place, [], [])
            stack[-1].blocks.append(block)
            stack.append(block)
        elif words[0] == "end":
            if len(stack) <= 1 or len(words) < 2 or words[1] != stack[-1].name:
                refuse(place, f"'{' '.join(words[:2])}' does not end {stack[-1].name}")
            stack.pop()
        elif words[0] == "exit":
            break
        elif words[0] == "continue_in_file" and len(words) > 1:
            if depth == DEEPEST:
                refuse(place, f"files include each other more than {DEEPEST} deep")
            _read_into(stack, htc, find_file(htc, original[1], place), depth + 1)
        else:
            # names of files keep their capitals
            stack[-1].lines.append((place, [words[0], *original[1:]]))
    if len(stack) != opened:
        refuse(stack[-1].place, f"the block {stack[-1].name} has no end")
