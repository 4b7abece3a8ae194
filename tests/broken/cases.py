"""Decks and command lines that are wrong, each with the exit code and the text it must give.

One mistake gives one line that names file, line, deck path, rule and value found. errors= is all
of stderr, so a follow-up message fails the case as well as a missing one.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from broken import commands, equations, files, mechanics, names, structure, values, writing  # noqa: E402

CASES = [
    case
    for table in (names, values, structure, mechanics, files, equations, commands, writing)
    for case in table.CASES
]
