"""Archives of ANSYS as CDWRITE makes them: commands with commas, and blocks of numbers in fixed columns."""

import dataclasses
import pathlib
import re

from .findings import Place, refuse
from .keyword_file import number, read_text

BLOCKS = {"NBLOCK", "EBLOCK", "ETBLOCK", "RLBLOCK", "CMBLOCK", "SECBLOCK"}
LOADS = {"DBLOCK": "D", "FBLOCK": "F", "SFEBLOCK": "SFE"}  # blocks whose rows are the fields of a command each


@dataclasses.dataclass
class Command:
    """@param fields  after the name
    @param rows    (place, cells) of a block"""

    name: str
    fields: list
    place: Place
    rows: list
    asked: set = dataclasses.field(default_factory=set)  # numbers of fields that were asked for

    def unread(self):
        """Numbers of fields that hold something and that nobody asked for."""
        return [i for i, text in enumerate(self.fields, 1) if text.strip() and i not in self.asked]

    def text(self, i):
        self.asked.add(i)
        return self.fields[i - 1].strip() if 0 < i <= len(self.fields) else ""

    def integer(self, i, what="a whole number"):
        return whole(self.text(i), self.place, f"{self.name}, field {i}: {what}")

    def real(self, i, what="a number", default=None):
        if not self.text(i) and default is not None:
            return default
        return number(self.text(i), self.place, f"{self.name}, field {i}: {what}")


def is_tag(text):
    """Whether a field says how a command is written, as in N,R5.3,LOC,-1 and MPDATA,UNBL,1,EX,..."""
    return text.upper() == "UNBL" or text.upper().startswith("R")


def whole(text, place, what):
    if not re.fullmatch(r"[+-]?[0-9]{1,12}", text.strip()):
        refuse(place, f"expected {what}, found '{text.strip()[:20]}'")
    return int(text)


def read_commands(path):
    """@return commands in their order, and whether they end as a file does"""
    lines = [(Place(str(path), i), line) for i, line in enumerate(read_text(pathlib.Path(path)).split("\n"), 1)]
    commands, at = [], 0
    while at < len(lines):
        place, raw = lines[at]
        at += 1
        text = raw.split("!")[0].strip()
        if not text:
            continue
        cells = [cell.strip() for cell in text.split(",")]
        name = cells[0].upper()
        if name.startswith(("/", "*")):  # words of these may follow a blank
            name = name.split()[0]
        command = Command(name, cells[1:], place, [])
        if name in BLOCKS or name in LOADS:
            at = _block(command, lines, at)
        commands += _commands_of(command) if name in LOADS else [command]
    return commands, bool(commands) and commands[-1].name in ("FINISH", "FINI", "SOLVE", "/EOF", "/GO")


def _commands_of(block):
    """SFEBLOCK gives the label of all its rows, which stands after two numbers in SFE."""
    label = [block.text(2)] if block.name == "SFEBLOCK" else []
    return [Command(LOADS[block.name], [*cells[:2], *label, *cells[2:]], place, []) for place, cells in block.rows]


def _block(command, lines, at):
    """Reads the rows of a block; @return the line after it."""
    if at == len(lines):
        refuse(command.place, f"the file ends within {command.name}")
    if command.name == "SECBLOCK":
        for _ in range(_count(command, 1)):
            if at == len(lines):
                refuse(command.place, "the file ends within SECBLOCK")
            command.rows.append((lines[at][0], [cell.strip() for cell in lines[at][1].split(",")]))
            at += 1
        return at
    widths = _widths(lines[at])
    at += 1
    if command.name == "RLBLOCK":
        second = _widths(lines[at]) if at < len(lines) else []
        return _real_constants(command, lines, at + 1, widths, second)
    limit = _count(command, 3) if command.name == "CMBLOCK" else None
    read = 0
    while limit is None or read < limit:
        if at == len(lines):
            refuse(command.place, f"the file ends within {command.name}")
        place, raw = lines[at]
        at += 1
        if re.match(r"\s*-1\b", raw) and command.name != "CMBLOCK" or re.match(r"(N|D|F|SFE),", raw.upper()):
            return at
        cells = _cut(raw, widths)
        if not cells:
            refuse(place, f"an empty line within {command.name}")
        if command.name in LOADS and len(raw.rstrip()) > sum(widths):
            refuse(place, f"a line of {command.name} is longer than its format")
        read += len(cells)
        command.rows.append((place, cells))
    return at


def _real_constants(command, lines, at, first, more):
    for _ in range(_count(command, 1)):
        if at == len(lines):
            refuse(command.place, "the file ends within RLBLOCK")
        place, raw = lines[at]
        at += 1
        cells = _cut(raw, first)
        count = whole(cells[1] if len(cells) > 1 else "", place, "the number of constants")
        while len(cells) < 2 + count:
            if at == len(lines) or not more:
                refuse(place, "the file ends within real constants")
            cells += _cut(lines[at][1], more)
            at += 1
        command.rows.append((place, cells))
    return at


def _count(command, i):
    found = command.integer(i, "a count")
    if not 0 <= found <= 10**8:
        refuse(command.place, f"{command.name}: {found} is no count")
    return found


def _widths(line):
    """Of the columns that a format as (3i9,6e21.13e3) or (i9,a6,2(pg16.9)) gives."""
    place, text = line
    text = text.split("!")[0].strip()
    if not re.fullmatch(r"\(\s*[0-9a-zA-Z.,\s()]+\)", text):
        refuse(place, f"expected a format, as (3i9,6e21.13e3), found '{text[:40]}'")
    widths = []
    for part in text[1:-1].split(","):
        found = re.fullmatch(r"\s*(\d*)\s*\(?[pP]?[iIeEgGfFaA](\d+)(\.\d+)?([eE]\d+)?\)?\s*", part)
        if not found or not 0 < int(found[2]) < 100 or int(found[1] or 1) > 1000:
            refuse(place, f"the format '{text[:40]}' is not understood")
        widths += [int(found[2])] * int(found[1] or 1)
    return widths


def _cut(line, widths):
    """Cells of a line by their columns, as many as there are."""
    cells, at = [], 0
    for width in widths:
        cell = line[at : at + width].strip()
        if at >= len(line.rstrip()):
            break
        cells.append(cell)
        at += width
    return cells
