#!/usr/bin/env python3
"""Files that are cut or have a flipped bit: a message, or a deck with all that the file still holds.

usage: damaged.py [--count N]     (so many flips for each file; cuts are at every 5 %)

If less is read than of the whole file, without a message that the whole file does not give, the deck
is wrong in silence, and of a file that is cut any other deck. A number that is another one by the flip
is what the file then says.
"""

import argparse
import collections
import random
import sys
import warnings

from reading import made_of_text
from whole_files import WHOLE_FILES

from culm.errors import CulmError  # noqa: E402


def outcome(format, files):
    """(deck, message); one of them is None. Any other error is a bug."""
    try:
        return made_of_text(format, files), None
    except CulmError as error:
        return None, str(error)


def totals(deck):
    """How many were read of each; of elements all types together, for a flipped bit can make one type of another."""
    found = collections.Counter()
    for name, count in deck.findings.read.items():
        if isinstance(count, int):
            found["elements" if name.startswith("elements ") else name] += count
    return found


def is_silent(deck, whole):
    """Whether something is missing from the deck, and nothing says so."""
    found, counts = totals(deck), totals(whole)
    lost = any(found.get(name, 0) < count for name, count in counts.items())
    fewer = any(deck.count().get(name, 0) < whole.count().get(name, 0) for name in ("Structures", "Analyses"))
    return (lost or fewer) and not deck.messages() - whole.messages()


def contents(data):
    return data.encode() if isinstance(data, str) else data


def damage(format, name, files, whole, count, complaints, outcomes):
    main = next(iter(files))
    for target in files:
        data = contents(files[target])
        for percent in range(0, 100, 5):
            cut = {**files, target: data[: len(data) * percent // 100]}
            deck, message = outcome(format, cut)
            outcomes[deck is None] += 1
            if deck is not None and deck.text != whole.text and not deck.messages() - whole.messages():
                complaints.append(f"{name}: {target} cut at {percent} %: another deck without a word")
            if message is not None and not message.strip():
                complaints.append(f"{name}: {target} cut at {percent} %: an empty message")
    generator = random.Random(1)
    for _ in range(count):
        target = generator.choice(list(files)) if len(files) > 1 else main
        data = bytearray(contents(files[target]))
        place, bit = generator.randrange(len(data)), generator.randrange(8)
        data[place] ^= 1 << bit
        deck, _ = outcome(format, {**files, target: bytes(data)})
        outcomes[deck is None] += 1
        if deck is not None and is_silent(deck, whole):
            complaints.append(f"{name}: bit {bit} of byte {place} of {target} flipped: a deck without a word")


def main():
    warnings.simplefilter("error")  # numbers that are none must be found before they are used
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--only")
    arguments = parser.parse_args()
    complaints, outcomes = [], [0, 0]
    for name, (format, files) in WHOLE_FILES.items():
        if arguments.only and arguments.only not in name:
            continue
        damage(format, name, files, made_of_text(format, files), arguments.count, complaints, outcomes)
    print(f"{sum(outcomes)} damaged files: {outcomes[1]} refused, {outcomes[0]} decks, {len(complaints)} complaints")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main()
