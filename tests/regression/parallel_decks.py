#!/usr/bin/env python3
"""Chooses the decks that run on several ranks, too: few that contain everything all decks contain.

usage: parallel_decks.py [--why]

What a deck contains: each choice of a word, such as a Type, a Fidelity or a Linear Solver, with the
parameter and the outermost list in which it stands, and each exit code with which a variant of the
deck must fail. The deck with the most that is still missing comes first, per
second of its run as far as ../costs.txt knows; decks that the choice can do without leave it again.
--why names what each deck was chosen for.
"""

import argparse
import collections
import pathlib
import re
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
INPUTS = ROOT / "inputs"
EXPECTED = ROOT / "tests/regression/expected"
COSTS = ROOT / "tests/costs.txt"
USUAL_COST = 0.3  # s; what costs.txt leaves out takes less than a second
INCLUDE = "{http://www.w3.org/2001/XInclude}include"
WORD = re.compile(r"[A-Z][A-Za-z0-9 -]*")


def decks():
    """Names of all decks, such as beam/roll_up, in order."""
    found = (path.relative_to(INPUTS) for path in sorted(INPUTS.rglob("*.xml")))
    return [str(path.with_suffix("")) for path in found if "include" not in path.parts]


def contents(name):
    """All that a deck contains, as a set of texts."""
    root = _read(INPUTS / f"{name}.xml")
    names = {one.get("name") for one in root.iter() if one.tag != "Parameter"}
    found = set()
    for section in root.findall("ParameterList"):
        for parameter in section.iter("Parameter"):
            key, value = parameter.get("name"), parameter.get("value", "")
            # a word that is the name of something else chooses nothing
            if WORD.fullmatch(value) and (key == "Type" or value not in names):
                found.add(f"{section.get('name')}: {key} = {value}")
    expected = EXPECTED / f"{name}.xml"
    if expected.exists():
        failures = ElementTree.parse(expected).getroot().findall("Fails")
        found |= {f"failure with exit code {failure.get('exit')}" for failure in failures}
    return found


def _read(path):
    """The deck with what it includes."""
    root = ElementTree.parse(path).getroot()
    for parent in list(root.iter()):
        for i, child in enumerate(parent):
            if child.tag == INCLUDE:
                parent[i] = _read(path.parent / child.get("href"))
    return root


def read_costs():
    """Seconds by the name of a deck, of those that costs.txt has."""
    costs = collections.defaultdict(lambda: USUAL_COST)
    if COSTS.exists():
        for line in COSTS.read_text().splitlines():
            words = line.split()
            if len(words) == 3 and words[0].startswith("regression."):
                costs[words[0].removeprefix("regression.")] = float(words[2])
    return costs


def choose(contains, cost):
    """Few and cheap keys of `contains` whose sets have all elements of all sets, by the greedy rule.

    @param cost  function of a key
    """
    missing = set().union(*contains.values())
    chosen = []
    while missing:
        best = max(contains, key=lambda name: len(contains[name] & missing) / cost(name))
        chosen.append(best)
        missing -= contains[best]
    for name in sorted(chosen, key=cost, reverse=True):
        others = set().union(*(contains[other] for other in chosen if other != name))
        if contains[name] <= others:
            chosen.remove(name)
    return chosen


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--why", action="store_true", help="say what each deck is for")
    options = parser.parse_args()
    costs = read_costs()
    contains = {name: contents(name) for name in decks()}
    chosen = choose(contains, lambda name: max(costs[name.replace("/", ".")], USUAL_COST))
    for name in sorted(chosen):
        print(f"{name}.xml")
        if options.why:
            others = set().union(*(contains[other] for other in chosen if other != name))
            print("".join(f"    {one}\n" for one in sorted(contains[name] - others)), end="")


if __name__ == "__main__":
    main()
