"""The table of margins on the terminal."""

import math

KINDS = {
    "good": "no limit found",
    "cut back": "steps must be cut",
    "inaccurate": "inaccurate",
    "wrong": "a law is broken",
    "failed": "ends, diagnosed",
    "faulty": "FAULT",
}
FORMAT = "{:36} {:6} {:>9} {:>9} {:>9}  {}"


class Terminal:
    def list(self, cases, refusals):
        for case in cases:
            print(f"{case.name:36} {case.keys:6} {case.stressor}; {case.deck}")
        for one in refusals:
            print(f"{one.name:40} {one.keys:2} {one.deck}")

    def open(self):
        print(FORMAT.format("case", "keys", "advised", "last good", "margin", "beyond"))

    def show(self, entry):
        print(
            FORMAT.format(
                entry.name,
                entry.keys,
                number(entry.recommended),
                number(entry.last_good),
                (">= " if entry.is_open else "") + number(entry.margin),
                describe(entry),
            ),
            flush=True,
        )

    def show_refusals(self, refused):
        if refused:
            print("\nill-posed")
        for one in refused:
            print(f"{one.name:40} {one.how}{'  FAULT' if one.kind == 'faulty' else ''}")

    def count(self, runs, cpu):
        print(f"\n{runs} runs, {cpu:.0f} s CPU")

    def close(self, faulty, shrunk):
        for name in faulty:
            print(f"not diagnosed: {name}")
        for change in shrunk:
            print(f"margin shrank: {change}")


def describe(entry):
    """What happens beyond the margin, in a few words."""
    if entry.kind == "good" and not entry.is_open:
        return "good where it was not before: measure anew"
    words = KINDS[entry.kind]
    if entry.how:
        words += f": {entry.how}"
    if entry.kind in ("inaccurate", "wrong") and not entry.told:
        words += " (silent)"
    return words


def number(value):
    return "–" if math.isnan(value) else f"{value:.3g}"
