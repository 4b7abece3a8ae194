#!/usr/bin/env python3
"""The grammar of decks for editors, `culm reference --relax-ng`, as xmllint reads it: it accepts all
sound decks and refuses those that are wrong by form.

usage: grammar.py --culm PROGRAM
"""

import argparse
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile

from driver import derive

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Messages about what stands where; others are about values, names of the user, or what is missing.
FORM = re.compile(
    r"unknown (name|list|type|attribute|element)\b|must be (true or false|an array)|must be a <Parameter|"
    r"text between elements|has no attribute|has an empty attribute|must have type=|must be empty|missing 'Type'"
)


def cases_of(path):
    spec = importlib.util.spec_from_file_location(path.parent.name, path)
    table = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(table)
    return [case for case in table.CASES if isinstance(case.deck, str) and case.args.startswith("run deck.xml")]


def accepted(grammar, files):
    """The files that xmllint accepts."""
    command = ["xmllint", "--noout", "--relaxng", grammar, *files]
    done = subprocess.run(command, capture_output=True, text=True)
    if "compilation failed" in done.stderr or "failed to compile" in done.stderr:
        raise SystemExit(done.stderr)
    return set(re.findall(r"^(.*) validates$", done.stderr, re.M))


def written(folder, case):
    name = folder / (re.sub(r"\W+", "_", case.name) + ".xml")
    name.write_text(derive(case)[0])
    return str(name)


def is_wrong_by_form(case):
    errors = [*(case.errors or []), *case.says]
    return any(FORM.search(error) and "deck.xml:" in error for error in errors)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    culm = parser.parse_args().culm
    complaints = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        grammar = folder / "culm.rng"
        done = subprocess.run([culm, "reference", "--relax-ng"], capture_output=True, text=True, check=True)
        grammar.write_text(done.stdout)
        sound = [str(path) for path in sorted((ROOT / "inputs").rglob("*.xml"))]
        sound += [written(folder, case) for case in cases_of(ROOT / "tests/application/cases.py") if case.exit == 0]
        good = accepted(grammar, sound)
        complaints += [f"a sound deck is refused: {deck}" for deck in sound if deck not in good]
        wrong = {written(folder, case): case for case in cases_of(ROOT / "tests/broken/cases.py")
                 if case.exit == 3 and is_wrong_by_form(case)}
        good = accepted(grammar, list(wrong))
        complaints += [f"wrong by form and accepted: {wrong[deck].name}" for deck in wrong if deck in good]
    print(*complaints, sep="\n")
    print(f"{len(sound)} sound decks, {len(wrong)} wrong by form, {len(complaints)} judged wrongly")
    if len(sound) < 100 or len(wrong) < 20:
        return 1  # the tables were not read
    return 1 if complaints else 0


sys.exit(main())
