#!/usr/bin/env python3
"""Files of other programs with lines and numbers changed at random: a deck, or a message of culm.

usage: mutated.py [--seconds N] [--count N] [--seed N] [--only NAME] [--keep FOLDER]

Starts from the samples of whole_files.py. An input with an outcome that was not seen before, a message
without its numbers or other counts in the deck, is changed further, so that mistakes pile up behind
each other. Any other exception, more than 30 s, or a number in the deck that is not finite is a
finding; --keep writes its files into a folder. The test runs a fixed count.
"""

import argparse
import pathlib
import random
import re
import signal
import sys
import time
import traceback
import warnings

from reading import made_of_text
from whole_files import WHOLE_FILES

from culm.errors import CulmError  # noqa: E402

PATIENCE = 30  # s
MOST_PER_SAMPLE = 200  # inputs that are changed further
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
HOSTILE = [b"0", b"-1", b"1", b"2", b"nan", b"inf", b"-inf", b"1e400", b"1e-320", b"1e308", b"99999999999", b"0.5", b"", b"x",
           b"2147483648", b"-0", b"1e5", b"1+5", b"0x10", b"\xff", b"1,2", b"''"]  # fmt: skip


def change_number(data, chance):
    places = list(NUMBER.finditer(data))
    if not places:
        return data
    place = chance.choice(places)
    other = chance.choice(HOSTILE) if chance.random() < 0.7 else chance.choice(places)[0]
    return data[: place.start()] + other + data[place.end() :]


def change_lines(data, chance):
    lines = data.split(b"\n")
    here, there = chance.randrange(len(lines)), chance.randrange(len(lines))
    how = chance.randrange(5)
    if how == 0:
        del lines[here : here + chance.choice([1, 1, 2, 8])]
    elif how == 1:
        lines.insert(there, lines[here])
    elif how == 2:
        lines[here], lines[there] = lines[there], lines[here]
    elif how == 3:
        lines[here : here + 1] = lines[here].split(b",", 1)
    else:
        lines[here] += b", " + lines[there].strip()
    return b"\n".join(lines)


def change_bytes(data, chance):
    if not data:
        return b"0"
    place = chance.randrange(len(data))
    how = chance.randrange(3)
    if how == 0:
        return data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :]
    if how == 1:
        return data[:place] + data[place + chance.choice([1, 2, 16]) :]
    return data[:place] + data[place : place + 16] * chance.choice([1, 2, 50]) + data[place:]


def changed(files, chance):
    files = dict(files)
    for _ in range(chance.choice([1, 1, 2, 4])):
        name = chance.choice(list(files))
        how = chance.choice([change_number, change_number, change_lines, change_bytes])
        files[name] = how(files[name], chance)
    return files


def outcome(format, files):
    """A text that is the same for inputs alike; an exception where it is a finding."""
    try:
        made = made_of_text(format, files)
    except CulmError as error:
        return "refused: " + re.sub(r"\d+", "0", re.sub(r"'[^']*'", "''", str(error)))[-100:]
    wrong = re.search(r'value="[^"]*\b(nan|inf)\b[^"]*"', made.text)
    if wrong:
        raise ValueError(f"the deck has {wrong[0]}")
    return f"deck: {made.count()} {sorted(made.findings.read)}"


def give_up(*_):
    raise TimeoutError(f"more than {PATIENCE} s")


class Hunt:
    def __init__(self, arguments):
        self.chance = random.Random(arguments.seed)
        self.keep = arguments.keep
        self.samples = {
            name: (format, [{file: text.encode() if isinstance(text, str) else text for file, text in files.items()}])
            for name, (format, files) in WHOLE_FILES.items()
            if not arguments.only or arguments.only in name
        }
        self.seen, self.findings, self.executions = set(), {}, 0

    def step(self):
        name = self.chance.choice(list(self.samples))
        format, inputs = self.samples[name]
        files = changed(self.chance.choice(inputs), self.chance)
        self.executions += 1
        signal.alarm(PATIENCE)
        try:
            kind = name + outcome(format, files)
        except Exception as error:
            signal.alarm(0)
            self.find(name, files, error)
            return
        finally:
            signal.alarm(0)
        if kind not in self.seen and len(inputs) < MOST_PER_SAMPLE:
            inputs.append(files)
        self.seen.add(kind)

    def find(self, name, files, error):
        place = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{type(error).__name__} at {pathlib.Path(place.filename).name}:{place.lineno}"
        if where in self.findings:
            return
        self.findings[where] = f"{name}: {where}: {error}"
        if self.keep:
            folder = pathlib.Path(self.keep) / re.sub(r"\W+", "_", where)
            folder.mkdir(parents=True, exist_ok=True)
            for file, data in files.items():
                (folder / file).write_bytes(data)
            (folder / "traceback.txt").write_text("".join(traceback.format_exception(error)))


def main():
    warnings.simplefilter("error")  # numbers that are none must be found before they are used
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    signal.signal(signal.SIGALRM, give_up)
    hunt = Hunt(arguments)
    end = time.monotonic() + arguments.seconds if arguments.seconds else None
    while time.monotonic() < end if end else hunt.executions < arguments.count:
        hunt.step()
    print(f"{hunt.executions} executions, {len(hunt.seen)} outcomes, {len(hunt.findings)} findings")
    sys.exit("\n".join(hunt.findings.values()) if hunt.findings else 0)


if __name__ == "__main__":
    main()
