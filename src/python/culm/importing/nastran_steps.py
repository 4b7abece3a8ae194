"""Cases of Nastran as steps, and their supports."""

import re

from .findings import refuse
from .model import Step, Support, supports_along
from .nastran_loads import add_load_set, read_loads

STATIC, MODAL, BUCKLING, NONLINEAR = "101", "103", "105", "106"
SOLUTIONS = {"SESTATIC": STATIC, "STATIC": STATIC, "STATICS": STATIC, "MODES": MODAL, "SEMODES": MODAL,
             "BUCKLING": BUCKLING, "SEBUCKL": BUCKLING, "NLSTATIC": NONLINEAR}  # fmt: skip


READ = ("LOAD", "SPC", "METHOD", "STATSUB", "MPC", "TEMPERATURE")
# What acts and is not read; requests of output do not.
ACTING = (
    "DEFORM", "SUBCOM", "SUBSEQ", "SYM", "SYMCOM", "SYMSEQ", "REPCASE", "K2GG", "M2GG", "B2GG", "P2G", "NSM", "SUPORT1",
    "BCONTACT", "BGSET", "BCSET", "MFLUID", "K2PP", "M2PP", "A2GG", "K42GG", "PRETENSION", "BOLTLD", "CLOAD",
    "ANALYSIS",
)  # fmt: skip


def read_steps(reader):
    solution, cases, all_cases = _case_control(reader)
    if not cases:
        reader.findings.leave_out("the file has no case that is read: the deck finds modes")
        reader.model.steps.append(Step("modes", "modal", reader.deck.cards[0].place))
        cases = [{"SPC": case["SPC"]} for case in all_cases if "SPC" in case][:1] or [{}]
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
    """The number of the solution, the cases that are done, with what all have in common, and all that are there."""
    solution, common, cases = None, {}, []
    for place, text in reader.deck.control:
        word = re.match(r"\w*", text)[0].upper()
        command = next((name for name in READ + ACTING if _means(word, name)), None)
        if found := re.match(r"SOL\s+(\w+)", text, re.I):
            solution = SOLUTIONS.get(found[1].upper(), found[1])
            if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
                reader.findings.leave_out(f"SOL {found[1]}", place)
        elif _means(word, "SUBCASE") and (found := re.match(r"\w+\s*=?\s*(\d+)", text)):
            cases.append({**common, "NUMBER": found[1], "PLACE": place})
        elif command in ACTING:
            reader.findings.leave_out(f"{command} of the case control", place)
        elif command and (found := re.match(r"\w+\s*(\([\w, ]+\))?\s*=\s*(\d+)", text)):
            (cases[-1] if cases else common)[command] = found[2]
            if command in ("MPC", "TEMPERATURE"):
                reader.findings.leave_out(command, place)
        elif found := re.match(r"TITLE\s*=\s*(.*)", text, re.I):
            reader.model.title = found[1] or reader.model.title
    if not cases and reader.deck.control and common:
        cases = [{**common, "NUMBER": "1", "PLACE": reader.deck.control[0][0]}]
    if solution not in (STATIC, MODAL, BUCKLING, NONLINEAR):
        return solution, [], cases
    done = [case for case in cases if "LOAD" in case or "METHOD" in case or solution == MODAL]
    for case in cases:
        if case not in done:
            reader.findings.leave_out("a case without LOAD", case["PLACE"])
    return solution, done, cases


def _means(word, name):
    """Names may be cut after their fourth letter."""
    return name.startswith(word) and len(word) >= min(4, len(name))


def _add_steps(reader, solution, cases):
    preloads = {case["STATSUB"] for case in cases if "STATSUB" in case} if solution == MODAL else set()
    numbers = {case["NUMBER"] for case in cases}
    for case in cases:
        name, place = f"case {case['NUMBER']}", case["PLACE"]
        is_preload = case["NUMBER"] in preloads
        if (solution == MODAL and not is_preload) or (solution == BUCKLING and "METHOD" in case):
            kind = "modal" if solution == MODAL else "buckling"
            step = Step(name, kind, place, _modes(reader, case))
            if kind == "modal" and "STATSUB" in case:
                if case["STATSUB"] not in numbers:
                    refuse(place, f"there is no case {case['STATSUB']} that STATSUB names")
                step.preloaded = f"case {case['STATSUB']}"
            reader.model.steps.append(step)
            if kind == "buckling" and "LOAD" not in case:
                before = [one for one in cases if "LOAD" in one and "METHOD" not in one]
                chosen = [one for one in before if one["NUMBER"] == case.get("STATSUB", one["NUMBER"])]
                if not chosen:
                    refuse(place, "buckling needs a static case before it")
                case["LOAD"] = chosen[0]["LOAD"]
        else:
            reader.model.steps.append(Step(name, "static", place, nonlinear=solution == NONLINEAR))
    if solution != NONLINEAR and any(step.kind == "static" for step in reader.model.steps):
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
    for one in sorted(known - set(sets)):
        reader.findings.assume(f"the support set {one} is in no case")
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
