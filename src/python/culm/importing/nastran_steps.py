"""Cases of Nastran as steps, and their supports."""

import re

from .findings import refuse
from .model import Step, Support, supports_along
from .nastran_loads import add_load_set, read_loads

STATIC, MODAL, BUCKLING, NONLINEAR = "101", "103", "105", "106"
SOLUTIONS = {"SESTATIC": STATIC, "STATIC": STATIC, "STATICS": STATIC, "MODES": MODAL, "SEMODES": MODAL,
             "BUCKLING": BUCKLING, "SEBUCKL": BUCKLING, "NLSTATIC": NONLINEAR}  # fmt: skip


def read_steps(reader):
    solution, cases = _case_control(reader)
    if not cases:
        reader.findings.leave_out("the file has no case that is read: the deck finds modes")
        reader.model.steps.append(Step("modes", "modal", reader.deck.cards[0].place))
        cases = [{}]
    else:
        _add_steps(reader, solution, cases)
    _supports(reader, cases)
    read_loads(reader)
    for number, case in enumerate(cases):
        if "LOAD" in case and reader.model.steps[number].kind != "modal":
            add_load_set(reader, case["LOAD"], 1.0, number, set())
    used = {int(case["LOAD"]) for case in cases if "LOAD" in case}
    unused = {number for number, _ in reader.loads} - reader.reached - used
    for number in sorted(unused):
        reader.findings.assume(f"the load set {number} is in no case")


def _case_control(reader):
    """The number of the solution, and the cases that are done, with what all have in common."""
    solution, common, cases = None, {}, []
    for place, text in reader.deck.control:
        if found := re.match(r"SOL\s+(\w+)", text, re.I):
            solution = SOLUTIONS.get(found[1].upper(), found[1])
            if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
                reader.findings.leave_out(f"SOL {found[1]}", place)
        elif found := re.match(r"SUBCASE\s+(\d+)", text, re.I):
            cases.append({**common, "NUMBER": found[1], "PLACE": place})
        elif found := re.match(r"(LOAD|SPC|METHOD|STATSUB|MPC|TEMPERATURE)(\(\w+\))?\s*=\s*(\d+)", text, re.I):
            (cases[-1] if cases else common)[found[1].upper()] = found[3]
            if found[1].upper() in ("MPC", "TEMPERATURE"):
                reader.findings.leave_out(found[1].upper(), place)
        elif found := re.match(r"TITLE\s*=\s*(.*)", text, re.I):
            reader.model.title = found[1] or reader.model.title
    if not cases and reader.deck.control and common:
        cases = [{**common, "NUMBER": "1", "PLACE": reader.deck.control[0][0]}]
    if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
        return solution, []
    return solution, [case for case in cases if "LOAD" in case or "METHOD" in case or solution == MODAL]


def _add_steps(reader, solution, cases):
    for case in cases:
        name, place = f"case {case['NUMBER']}", case["PLACE"]
        if solution == MODAL or (solution == BUCKLING and "METHOD" in case):
            kind = "modal" if solution == MODAL else "buckling"
            reader.model.steps.append(Step(name, kind, place, _modes(reader, case)))
            if kind == "buckling" and "LOAD" not in case:
                before = [one for one in cases if "LOAD" in one and "METHOD" not in one]
                chosen = [one for one in before if one["NUMBER"] == case.get("STATSUB", one["NUMBER"])]
                if not chosen:
                    refuse(place, "buckling needs a static case before it")
                case["LOAD"] = chosen[0]["LOAD"]
        else:
            reader.model.steps.append(Step(name, "static", place, nonlinear=solution == NONLINEAR))
    if solution in (STATIC, BUCKLING) and any(step.kind == "static" for step in reader.model.steps):
        reader.findings.assume("linear static cases become nonlinear ones, which agree where displacements are small")


def _modes(reader, case):
    for name, field in (("EIGRL", 4), ("EIGR", 6), ("EIGB", 5)):
        for card in reader.by_name[name]:
            if card.text(1) == case.get("METHOD"):
                return min(max(card.integer(field, default=10), 1), 100000)
    return 10


def _supports(reader, cases):
    sets = {}
    for number, case in enumerate(cases):
        if "SPC" in case:
            for one in _spc_sets(reader, int(case["SPC"]), set()):
                sets.setdefault(one, set()).add(number)
    if not any("SPC" in case for case in cases):
        everything = {card.integer(1) for name in ("SPC", "SPC1") for card in reader.by_name[name]}
        if everything and not reader.deck.control:
            reader.findings.assume("without case control all SPC hold")
            sets = {one: None for one in everything}
    for node, (freedoms, card) in reader.held.items():
        _support(reader, [node], freedoms, 0.0, card, "grid", None)
    known = set()
    for card in reader.cards("SPC1"):
        known.add(card.integer(1))
        if card.integer(1) in sets:
            nodes = card.numbers(3)
            if card.has_thru(3):
                nodes = [node for node in nodes if node in reader.model.nodes]
            for node in nodes:
                reader.find(reader.model.nodes, node, card, "node")
            _support(reader, nodes, card.text(2), 0.0, card, f"spc {card.integer(1)}", sets[card.integer(1)])
    for card in reader.cards("SPC"):
        known.add(card.integer(1))
        if card.integer(1) in sets:
            for i in (2, 5):
                if card.text(i):
                    value = card.real(i + 2, default=0.0)
                    name = f"spc {card.integer(1)}"
                    _support(reader, [reader.node(card, i)], card.text(i + 1), value, card, name, sets[card.integer(1)])
    for one in set(sets) - known:
        refuse(reader.deck.cards[0].place, f"there is no SPC or SPC1 of the set {one} that a case names")


def _spc_sets(reader, number, seen):
    if number in seen:
        refuse(reader.deck.cards[0].place, f"SPCADD {number} contains itself")
    for card in reader.by_name["SPCADD"]:
        if card.integer(1) == number:
            return [one for part in card.numbers(2) for one in _spc_sets(reader, part, seen | {number})]
    return [number]


def _support(reader, nodes, freedoms, value, card, name, steps):
    if not re.fullmatch("[1-6]+", freedoms):
        refuse(card.place, f"expected degrees of freedom, digits 1 to 6, found '{freedoms}'")
    held = {int(one): value for one in freedoms}
    reader.model.supports += supports_along(reader.axes, Support(list(nodes), held, card.place, name, steps))
