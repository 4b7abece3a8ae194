"""Cards of Nastran that say how they differ from the one before: `=` the same field, `==` all that follow too,
`*n` so much more, and in the place of the name `=` one card, `=n` as many more by the same differences."""

import dataclasses
import re

from .findings import refuse

COUNT = re.compile(r"=(?:\(?([0-9]{1,6})\)?)?")
WHOLE = re.compile(r"[+-]?[0-9]{1,10}")
LINE = 8  # values of a card of one line


class Replication:
    """Makes such cards; knows the differences of the last one."""

    def __init__(self):
        self._differences = None

    def cards(self, last, name, fields, place):
        """What a line means.

        @param last  the card before, None if there is none;  @param name, fields  of the line"""
        found = COUNT.fullmatch(name)
        if last is None or not found:
            refuse(place, f"'{name}' is no name of a card, nor a repetition of the one before")
        if any(text.strip() for text in last.fields[LINE:]):
            refuse(place, f"{last.name} of several lines cannot be repeated: write the cards out")
        if found[1] is None:
            self._differences = fields
        elif self._differences is None or any(fields):
            refuse(place, f"'{name}' repeats a line that begins with '=', which must stand before it, and has no values")
        made = []
        for _ in range(int(found[1] or 1)):
            last = _another(last, self._next(last, place), place)
            made.append(last)
        return made

    def end(self):
        """Another card has come."""
        self._differences = None

    def _next(self, last, place):
        before = [text.strip() for text in last.fields[:LINE]] + [""] * (LINE - len(last.fields))
        made = []
        for old, text in zip(before, self._differences):
            if text == "==":
                return made + before[len(made) :]
            increment = re.fullmatch(r"\*\(?([^()]+)\)?", text)
            made.append(old if text == "=" else _sum(last, old, increment[1], place) if increment else text)
        return made


def _another(card, fields, place):
    return dataclasses.replace(card, fields=fields, place=place, asked=set())


def _sum(card, old, increment, place):
    if WHOLE.fullmatch(old) and WHOLE.fullmatch(increment):
        return str(int(old) + int(increment))
    one, other = (_another(card, [text], place) for text in (old, increment))
    return repr(one.real(1) + other.real(1))
