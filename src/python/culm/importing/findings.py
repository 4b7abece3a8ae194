"""What an importer has read, assumed and left out, by name and place, and the mistakes that end it."""

import dataclasses
import difflib
import pathlib

from ..errors import CulmError

DECK_ERROR = 3
FILE_ERROR = 6


@dataclasses.dataclass(frozen=True)
class Place:
    """Where something stands in a file."""

    file: str
    line: int

    def __str__(self):
        return f"{self.file}:{self.line}"


def refuse(place, text, code=DECK_ERROR):
    """Ends the import: the file is wrong, or holds what would make a wrong deck."""
    raise CulmError(f"{place}: {text}", code)


def did_you_mean(name, names):
    """The nearest valid name, as the end of a message; empty if none is near."""
    near = difflib.get_close_matches(str(name), [str(one) for one in names], 1)
    return f" – did you mean '{near[0]}'?" if near else ""


class Findings:
    """Sentences about a file, each with the places it holds for."""

    def __init__(self):
        self.read = {}  # name -> how many, or what
        self.assumed = {}  # sentence -> places
        self.left_out = {}  # sentence -> places

    def count(self, name, number=1):
        self.read[name] = self.read.get(name, 0) + number

    def assume(self, sentence, place=None):
        self.assumed.setdefault(sentence, []).append(place)

    def look_at_end(self, path):
        """Says that a file ends within a line, where that may be the middle of a number."""
        data = pathlib.Path(path).read_bytes()
        if data and not data.endswith((b"\n", b"\r")):
            place = Place(str(path), data.count(b"\n") + 1)
            self.assume("a file that ends within a line is whole: if it was cut, its last number is wrong", place)

    def leave_out(self, sentence, place=None):
        """Something of the file that acts on the result and is not in the deck."""
        self.left_out.setdefault(sentence, []).append(place)


def with_places(sentence, places, most=3):
    """The sentence, with the first places that it holds for."""
    known = list(dict.fromkeys(str(place) for place in places if place is not None))
    if not known:
        return sentence
    more = f" and {len(known) - most} others" if len(known) > most else ""
    return f"{sentence} ({', '.join(known[:most])}{more})"
