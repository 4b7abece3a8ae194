"""Places that cannot be written, or belong to another run."""

import fcntl
import re

from broken.pieces import INCLUDE, LOADS, function_file, unwritable
from driver import BASE, Case


def keeps_what_it_had(folder, _):
    """The steps until the disk was full are in the index, and their pictures are there."""
    steps = re.findall(r'file="(.*?)"', (folder / "out/run.pvd").read_text())
    lost = [name for name in steps if not (folder / "out" / name).is_file()]
    if lost or len(steps) < 10:
        return f"{len(steps)} steps, without picture: {lost}"
    return "" if (folder / "out/run.h5").stat().st_size > 100_000 else "run.h5 is too small"


LOCKS = []  # files that stay open, and locked, as long as this program runs


def lock(folder):
    """Somebody else owns the folder `out`."""
    (folder / "out").mkdir()
    LOCKS.append(open(folder / "out/run.lock", "w"))
    fcntl.flock(LOCKS[-1], fcntl.LOCK_EX)
    LOCKS[-1].write("process 4711 on elsewhere\n")
    LOCKS[-1].flush()


def is_as_it_was(folder, _):
    same = (folder / "deck.xml").read_text() == BASE
    return "" if same else "the deck was written over"


OWNED = "another run writes here: process 4711 on elsewhere; wait for its end, or take another folder"


def overwritten(name, args, error, **more):
    return Case(name, 6, args=args, errors=[error], check=is_as_it_was, **more)


CASES = [
    Case(
        "folder that another run writes into",
        6,
        prepare=lock,
        errors=["out: " + OWNED],
        args="run deck.xml --output out --report",
        ranks=True,
    ),
    overwritten(
        "resolved deck over the deck",
        "check deck.xml --resolved deck.xml",
        "deck.xml: is read by the deck and would be overwritten; write elsewhere",
        ranks=True,
    ),
    overwritten(
        "resolved deck over the deck by a link",
        "check deck.xml --resolved link.xml",
        "link.xml: is read by the deck, as deck.xml, and would be overwritten; write elsewhere",
        prepare=lambda folder: (folder / "link.xml").symlink_to("deck.xml"),
    ),
    overwritten(
        "resolved deck over the deck by another name",
        "check deck.xml --resolved other.xml",
        "other.xml: is read by the deck, as deck.xml, and would be overwritten; write elsewhere",
        prepare=lambda folder: (folder / "other.xml").hardlink_to(folder / "deck.xml"),
    ),
    Case(
        "resolved deck over an include",
        6,
        change=[(LOADS, INCLUDE)],
        files={"loads.xml": LOADS},
        args="check deck.xml --resolved ./loads.xml",
        errors=[
            "./loads.xml: is read by the deck, as loads.xml, and would be overwritten; write elsewhere"
        ],
    ),
    Case(
        "resolved deck where a file of an include is another one",
        6,
        change=[(LOADS, INCLUDE.replace("loads.xml", "parts/functions.xml") + LOADS)],
        files={
            "parts/functions.xml": function_file("rise.csv").replace("@@", ""),
            "parts/rise.csv": "0, 0\n1, 1\n",
            "rise.csv": "0, 0\n1, 2\n",
        },
        args="check deck.xml --resolved resolved.xml",
        errors=["rise.csv: would be read in place of parts/rise.csv, which parts/functions.xml:..."],
    ),
    Case(
        "results over a table",
        6,
        change=[(LOADS, function_file("history.csv") + LOADS)],
        files={"history.csv": "0, 0\n1, 1\n"},
        args="run deck.xml --output .",
        errors=[
            "./history.csv: is read by the deck, as history.csv, and would be overwritten; "
            "write elsewhere"
        ],
        ranks=True,
    ),
    unwritable(
        "output folder with a name too long for files",
        "a: File name too long",
        "run deck.xml --output " + "a" * 300,
    ),
    unwritable(
        "output folder below a file",
        "deck.xml/out: Not a directory",
        "run deck.xml --output deck.xml/out",
        ranks=True,
    ),
    unwritable("output folder is a file", "deck.xml: ", "run deck.xml --output deck.xml"),
    unwritable(
        "folder in the place of run.h5",
        "out/run.h5: cannot replace: Is a directory",
        prepare=lambda folder: (folder / "out/run.h5").mkdir(parents=True),
        ranks=True,
    ),
    unwritable(
        "no space at the start",
        "out/run.h5.part: cannot write file: write: File too large\n",
        file_size=4096,
        leaves=["out"],
    ),
    unwritable(
        "no space in the middle",
        "out/run.h5: cannot write file: write: File too large\n",
        "run deck.xml --output out --set Analyses/bend/Steps=100 --quiet",
        file_size=200_000,
        leaves=["out"],
        never=["warning", "internal error"],
        check=keeps_what_it_had,
    ),
]
