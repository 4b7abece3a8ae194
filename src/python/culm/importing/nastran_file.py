"""Cards of Nastran: free, small and large fields, continuations, includes; and its case control."""

import dataclasses
import pathlib
import re

from .findings import Place, refuse
from .keyword_file import DEEPEST, read_text
from .nastran_replication import Replication

REAL = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([ED]?[+-]?[0-9]+)?"


@dataclasses.dataclass
class Card:
    """@param fields  after the name, as they stand; fields of lines that go on follow"""

    name: str
    fields: list
    place: Place
    asked: set = dataclasses.field(default_factory=set)  # numbers of fields that were asked for

    def text(self, i):
        """Field i, from 1; empty if it is not there."""
        self.asked.add(i)
        return self.fields[i - 1].strip() if 0 < i <= len(self.fields) else ""

    def integer(self, i, what="a whole number", default=None):
        text = self.text(i)
        if not text and default is not None:
            return default
        if not re.fullmatch(r"[+-]?[0-9]{1,10}", text):
            refuse(self.place, f"{self.name}, field {i}: expected {what}, found '{text[:20]}'")
        return int(text)

    def real(self, i, what="a number", default=None):
        text = self.text(i).upper()
        if not text and default is not None:
            return default
        found = re.fullmatch(REAL, text)
        if not found:
            refuse(self.place, f"{self.name}, field {i}: expected {what}, found '{text[:20]}'")
        exponent = (found[2] or "").lstrip("ED")
        value = float(found[1] if not found[2] else f"{found[1]}E{exponent}")
        if not abs(value) < float("inf"):
            refuse(self.place, f"{self.name}, field {i}: {text} is too large")
        return -value if text.startswith("-") else value

    def numbers(self, first):
        """Whole numbers from field `first` on, with `THRU` and `BY`."""
        words = [self.text(i) for i in range(first, len(self.fields) + 1)]
        words = [word for word in words if word]
        found, i = [], 0
        while i < len(words):
            if i + 2 < len(words) and words[i + 1].upper() == "THRU":
                a, b = (self._whole(words[k]) for k in (i, i + 2))
                step = 1
                if i + 4 < len(words) and words[i + 3].upper() == "BY":
                    step = self._whole(words[i + 4])
                    i += 2
                if step < 1 or not a <= b <= a + 10**7:
                    refuse(self.place, f"{self.name}: {a} THRU {b} BY {step} cannot be")
                found += range(a, b + 1, step)
                i += 3
            else:
                found.append(self._whole(words[i]))
                i += 1
        return found

    def fill_in(self, defaults):
        """Puts values into fields that are empty.

        @param defaults  by the numbers of fields"""
        self.fields += [""] * (max(defaults, default=0) - len(self.fields))
        for i, value in defaults.items():
            self.fields[i - 1] = self.fields[i - 1].strip() or value

    def unread(self):
        """Numbers of fields that hold something and that nobody asked for."""
        return [i for i, text in enumerate(self.fields, 1) if text.strip() and i not in self.asked]

    def has_thru(self, first):
        return any(self.text(i).upper() == "THRU" for i in range(first, len(self.fields) + 1))

    def _whole(self, text):
        if not re.fullmatch(r"[0-9]{1,10}", text):
            refuse(self.place, f"{self.name}: expected a whole number, found '{text[:20]}'")
        return int(text)


@dataclasses.dataclass
class Deck:
    """@param control  (place, words) of the lines before BEGIN BULK
    @param is_closed  whether ENDDATA ends it, or it has cards alone"""

    control: list
    cards: list
    is_closed: bool
    parameters: list  # cards PARAM of the case control


def read_deck(path):
    lines = list(_lines(pathlib.Path(path), 0))
    for place, text in lines:
        first, *others = text.upper().split()
        if first == "BEGIN" and others not in ([], ["BULK"]):
            refuse(place, f"a model in parts, here '{' '.join(others)[:20]}', is not read, as superelements are")
    begin = next((i for i, (_, text) in enumerate(lines) if re.match(r"BEGIN\s+BULK", text.strip(), re.I)), None)
    control = [] if begin is None else [(place, text.strip()) for place, text in lines[:begin]]
    bulk = lines if begin is None else lines[begin + 1 :]
    end = next((i for i, (_, text) in enumerate(bulk) if text.strip().upper().startswith("ENDDATA")), None)
    if begin is not None and end is None:
        refuse(lines[-1][0], "the file ends without ENDDATA")
    parameters = [
        Card("PARAM", [cell.strip() for cell in re.split("[,=]", text)[1:]], place)
        for place, text in control
        if re.match(r"PARAM\s*,", text, re.I)
    ]
    return Deck(control, _cards(bulk[:end]), end is not None, parameters)


def _lines(path, depth):
    waiting = None
    for number, raw in enumerate(read_text(path).split("\n"), 1):
        place = Place(str(path), number)
        text = raw.split("$")[0].rstrip().expandtabs(8)
        if not text.strip():
            continue
        if waiting is not None:
            text, waiting = waiting + text.strip(), None
        if re.match(r"\s*INCLUDE\b", text, re.I):
            name = re.sub(r"^\s*INCLUDE\s*", "", text, flags=re.I).strip()
            if name[:1] in "'\"" and (len(name) < 2 or name[-1] != name[0]):
                waiting = text
                continue
            if depth == DEEPEST:
                refuse(place, f"files include each other more than {DEEPEST} deep")
            yield from _lines(path.parent / name.strip("'\""), depth + 1)
            continue
        yield place, text


def _cards(lines):
    cards, mark = [], ""
    replication = Replication()
    for place, text in lines:
        name, fields, next_mark = _fields(text, place)
        if name.startswith("="):
            cards += replication.cards(cards[-1] if cards else None, name, fields, place)
            mark = ""
            continue
        replication.end()
        if name[:1] in ("", "+", "*"):
            if not cards:
                refuse(place, "a line that goes on, without a card before it")
            own = name.strip("+*")
            # the first of its eight characters, in column 73, does not count
            if own and mark and own not in (mark.strip("+*"), mark[1:]):
                refuse(place, f"goes on a card that calls its next line '{mark.strip('+*')}', not '{own}': such lines must follow their card")
            if len(fields) == 8:  # after half a line of wide fields
                cards[-1].fields += [""] * (-len(cards[-1].fields) % 8)
            cards[-1].fields += fields
        else:
            cards.append(Card(name, fields, place))
        mark = next_mark
    return cards


def _fields(text, place):
    """(name, or what calls a line that goes on; fields; what calls the next line)"""
    if "," in text[:10]:  # else commas belong to a field
        first, *rest = [cell.strip() for cell in text.split(",")]
        size = 4 if first.startswith("*") or first.endswith("*") else 8
        mark = rest[size] if len(rest) > size else ""
        if any(rest[size + 1 :]) or re.fullmatch(REAL, mark.upper()):
            refuse(place, f"a line has more than {size} values: they go on in a line that begins with +")
        rest = rest[:size] + [""] * (size - len(rest))
    else:
        first = text[:8].strip()
        width, size = (16, 4) if first.endswith("*") or first.startswith("*") else (8, 8)
        rest = [text[8 + i * width : 8 + (i + 1) * width].strip() for i in range(size)]
        mark = text[72:80].strip()
    name = first.upper()
    return (name if name[:1] in "+*" else name.rstrip("*")), rest, mark.upper()
