"""Supports, loads and steps of Abaqus and CalculiX.

Loads and supports of a step go on in the steps after it until they are changed; every step of the deck begins in
the reference with all loads that act in it, which is the same as long as what is loaded is elastic. In Abaqus those of
a perturbation step – modes, buckling, or one that says so – end with it, and buckling is under those of its step alone.
"""

import collections
import dataclasses

from .abaqus_loads import ON_SURFACE, collect_element_loads, collect_node_loads, make_element_load
from .abaqus_nodes import refuse_directions
from .findings import did_you_mean, refuse
from .keyword_file import integer, is_integer, number, numbers_of
from .model import Step, Support, supports_along

NAMED_SUPPORTS = {
    "ENCASTRE": {1, 2, 3, 4, 5, 6},
    "PINNED": {1, 2, 3},
    "XSYMM": {1, 5, 6},
    "YSYMM": {2, 4, 6},
    "ZSYMM": {3, 4, 5},
    "XASYMM": {2, 3, 4},
    "YASYMM": {1, 3, 5},
    "ZASYMM": {1, 2, 6},
}
KINDS = {"STATIC": "static", "FREQUENCY": "modal", "BUCKLE": "buckling"}
# steps that are not done; what they hold is left out
OTHER_KINDS = {
    "DYNAMIC", "MODAL DYNAMIC", "STEADY STATE DYNAMICS", "HEAT TRANSFER", "VISCO", "GREEN", "COMPLEX FREQUENCY",
    "COUPLED TEMPERATURE-DISPLACEMENT", "UNCOUPLED TEMPERATURE-DISPLACEMENT", "SENSITIVITY", "ELECTROMAGNETICS",
}  # fmt: skip


class Open:
    """The step that is read."""

    def __init__(self, block, number_, name, before):
        self.number = number_
        self.name = name
        self.place = block.place
        self.nonlinear = before is not None and before.nonlinear  # once it is, later steps are, too
        if block.has("NLGEOM"):
            self.nonlinear = (block.get("NLGEOM") or "YES") != "NO"
        self.perturbation = block.has("PERTURBATION")
        self.kind = None
        self.modes = 10
        self.renewed = set()  # keywords of which the first one with OP=NEW has ended what was before
        self.before = None  # loads that act again after it


class Acting:
    """What acts in the step that is read, and what each step had: loads by what they act on."""

    def __init__(self):
        self.nodes = {}  # (node, direction) -> (value, place, number of the step that gave it)
        self.elements = []  # ElementEntry
        self.history = []  # (step, nodes, elements)


@dataclasses.dataclass(frozen=True)
class ElementEntry:
    """A load on elements. Loads of one step add up, even on the same elements; one of a later step replaces those of its
    label there."""

    label: str
    members: tuple
    values: tuple
    place: object
    step: int


def read_step_block(reader, block):
    """@return whether the block is one of these"""
    if block.keyword in KINDS or block.keyword in OTHER_KINDS:
        _kind(reader, block)
        return True
    action = {
        "STEP": _step,
        "END STEP": _end_step,
        "BOUNDARY": _boundary,
        "CLOAD": _node_loads,
        "DLOAD": _element_loads,
        "DSLOAD": _surface_loads,
        "AMPLITUDE": _amplitude,
        "NODE PRINT": _watch,
    }.get(block.keyword)
    if action is None:
        return False
    action(reader, block)
    return True


def _acting(reader):
    if not hasattr(reader, "acting"):
        reader.acting = Acting()
    return reader.acting


def _step(reader, block):
    if reader.step is not None:
        refuse(block.place, f"*STEP within the step of line {reader.step.place.line}: *END STEP is missing")
    acting = _acting(reader)
    number_ = len(acting.history)
    name = block.get("NAME") or f"step {number_ + 1}"
    taken = [step.name for step, _, _ in acting.history]
    name = name.lower() if name.lower() not in taken else f"{name.lower()} {number_ + 1}"
    before = next((step for step, _, _ in reversed(acting.history) if not _is_perturbation(step)), None)
    reader.step = Open(block, number_, name, before)


def _kind(reader, block):
    if reader.step is None:
        refuse(block.place, f"*{block.keyword} outside a step")
    reader.step.kind = KINDS.get(block.keyword, block.keyword)
    for place, cells in block.lines if block.keyword in KINDS else []:
        for cell in cells:
            number(cell or "0", place, f"a number of *{block.keyword}")
    if reader.program == "Abaqus" and reader.step.before is None and _is_perturbation(reader.step):
        _begin_perturbation(reader)
    if block.keyword in ("FREQUENCY", "BUCKLE") and block.lines:
        place, cells = block.lines[0]
        reader.step.modes = integer(cells[0], place, "the number of modes") if cells[0] else 10
        if not 1 <= reader.step.modes <= 100000:
            refuse(place, f"the number of modes must be between 1 and 100000, got {reader.step.modes}")


def _is_perturbation(step):
    return step.perturbation or step.kind in ("modal", "buckling")


def _begin_perturbation(reader):
    """Its loads are its own: on top of those before in statics, alone in buckling."""
    acting, now = _acting(reader), reader.step.number
    reader.step.before = dict(acting.nodes), list(acting.elements)
    if reader.step.kind == "buckling":
        acting.nodes.clear()
        acting.elements.clear()
        _stop_motions(reader, now)
    acting.nodes.update({key: (value, place, now) for key, (value, place, _) in acting.nodes.items()})
    acting.elements[:] = [dataclasses.replace(entry, step=now) for entry in acting.elements]


def _stop_motions(reader, now):
    """What is moved in the steps before is held in this one."""
    moved = [one for one in reader.model.supports if any(one.held.values()) and (one.steps is None or now in one.steps)]
    for one in moved:
        steps = set(range(reader.step_count)) if one.steps is None else one.steps
        held = dataclasses.replace(one, held=dict.fromkeys(one.held, 0.0), steps={now})
        one.steps = steps - {now}
        reader.model.supports.append(held)


def _end_step(reader, block):
    if reader.step is None:
        refuse(block.place, "*END STEP without *STEP before it")
    acting = _acting(reader)
    acting.history.append((reader.step, dict(acting.nodes), list(acting.elements)))
    if reader.step.before is not None:
        acting.nodes, acting.elements = reader.step.before
    reader.step = None


def _steps_from(reader):
    """In which what the step gives acts."""
    now = reader.step.number
    return {now} if reader.step.before is not None else set(range(now, reader.step_count))


def _amplitude(reader, block):
    reader.findings.leave_out("*AMPLITUDE: loads grow in proportion to the level", block.place)


def _boundary(reader, block):
    step = reader.step
    if step is not None and _renews(reader, block):
        everything = {i: None for i in range(1, 7)}
        _end_supports(reader, [node for one in reader.model.supports for node in one.nodes], everything, _steps_from(reader))
    if block.get("TYPE") not in (None, "DISPLACEMENT"):
        reader.findings.leave_out(f"*BOUNDARY of TYPE {block.get('TYPE')}", block.place)
        return
    if block.get("LOAD CASE") not in (None, "1"):
        reader.findings.leave_out("supports of LOAD CASE=2 of *BOUNDARY: modes of buckling are held as the load is", block.place)
        return
    steps = None if step is None else _steps_from(reader)
    groups = collections.defaultdict(dict)
    places = {}
    for place, cells in block.lines:
        key = cells[0].upper()
        places.setdefault(key, place)
        if len(cells) < 2 or not cells[1]:
            refuse(place, "expected a node or set, and what is held of it")
        if cells[1].upper() in NAMED_SUPPORTS:
            groups[key].update({i: 0.0 for i in NAMED_SUPPORTS[cells[1].upper()]})
            continue
        if not is_integer(cells[1]):
            refuse(place, f"unknown support '{cells[1]}'{did_you_mean(cells[1].upper(), NAMED_SUPPORTS)}")
        first = integer(cells[1], place, "a degree of freedom")
        last = integer(cells[2], place) if len(cells) > 2 and cells[2] else first
        value = number(cells[3], place) if len(cells) > 3 and cells[3] else 0.0
        if not 1 <= first <= last:
            refuse(place, f"degrees of freedom must rise from 1, got {first} to {last}")
        if last > 6:
            reader.findings.leave_out("boundary conditions on degrees of freedom above 6", place)
        groups[key].update({i: value for i in range(first, min(last, 6) + 1)})
    for key, held in groups.items():
        nodes, held = _by_rotation_node(reader, reader.find_nodes(key, places[key]), held)
        if held:
            _end_supports(reader, nodes, held, set(range(reader.step_count)) if steps is None else steps)
            reader.model.supports.append(Support(nodes, held, places[key], _support_name(key), steps))
    reader.findings.count("lines of supports", len(block.lines))


def _end_supports(reader, nodes, held, now):
    """What is given another value in some steps does not act in these."""
    taken, kept = set(nodes), []
    every = set(range(reader.step_count))
    for one in reader.model.supports:
        other = {i for i in held if i in one.held and one.held[i] != held[i]}
        common = [node for node in one.nodes if node in taken] if other else []
        if not common:
            kept.append(one)
            continue
        steps = (every if one.steps is None else one.steps) - now
        parts = [
            dataclasses.replace(one, nodes=[node for node in one.nodes if node not in taken]),
            dataclasses.replace(one, nodes=common, held={i: value for i, value in one.held.items() if i not in other}),
            dataclasses.replace(one, nodes=common, held={i: one.held[i] for i in other}, steps=steps),
        ]
        kept += [part for part in parts if part.nodes and part.held and (part.steps is None or part.steps)]
    reader.model.supports[:] = kept


def _support_name(key):
    return f"node {key}" if is_integer(key) else key.lower()


def _by_rotation_node(reader, nodes, held):
    """The translations of a ROT NODE of CalculiX are the rotations of its rigid body."""
    turning = getattr(reader, "rotation_nodes", {})
    if len(nodes) == 1 and nodes[0] in turning:
        return [turning[nodes[0]]], {i + 3: value for i, value in held.items() if i <= 3}
    return nodes, held


def _watch(reader, block):
    if block.get("NSET") and any("U" in map(str.upper, cells) for _, cells in block.lines):
        reader.model.watched += reader.find_nodes(block.get("NSET"), block.place)


def _renews(reader, block):
    """Whether the block ends what was before: the first one of its keyword with OP=NEW in a step."""
    if block.get("OP") != "NEW" or block.keyword in reader.step.renewed:
        return False
    reader.step.renewed.add(block.keyword)
    return True


def _in_step(reader, block):
    if reader.step is None:
        refuse(block.place, f"*{block.keyword} outside a step")
    for name in ("AMPLITUDE", "FOLLOWER", "TIME DELAY", "LOAD CASE", "SECTOR", "OMEGA0", "SUBMODEL"):
        if block.has(name):
            reader.findings.leave_out(f"{name} of *{block.keyword}", block.place)


def _node_loads(reader, block):
    _in_step(reader, block)
    acting = _acting(reader).nodes
    if _renews(reader, block):
        acting.clear()
    now = reader.step.number
    for place, cells in block.lines:
        if len(cells) < 3:
            refuse(place, "expected node or set, direction, value")
        direction = integer(cells[1], place, "a direction, 1 to 6")
        if not 1 <= direction <= 6:
            refuse(place, f"a force acts along 1 to 6, got {direction}")
        value = number(cells[2], place)
        for node in reader.find_nodes(cells[0], place):
            nodes, turned = _by_rotation_node(reader, [node], {direction: value})
            for i, one in turned.items():
                key = (nodes[0], i)
                # loads of one step on one node add up, those of an earlier step are replaced
                before = acting[key][0] if key in acting and acting[key][2] == now else 0.0
                acting[key] = (before + one, place, now)
    reader.findings.count("lines of node loads", len(block.lines))


def _element_loads(reader, block):
    _in_step(reader, block)
    if _renews(reader, block):
        _acting(reader).elements[:] = [entry for entry in _acting(reader).elements if entry.label.startswith(ON_SURFACE)]
    for place, cells in block.lines:
        if len(cells) < 3:
            refuse(place, "expected element or set, kind of load, value")
        label = cells[1].upper()
        whole = not cells[0] and label == "GRAV"
        members = tuple(reader.elements) if whole else tuple(reader.find_elements(cells[0], place))
        values = numbers_of(cells[2:], place)
        if not values:
            refuse(place, f"{label} without a value")
        _add_element_load(reader, label, members, values, place)
    reader.findings.count("lines of element loads", len(block.lines))


def _add_element_load(reader, label, members, values, place):
    acting, now, taken = _acting(reader), reader.step.number, set(members)
    kept = []
    for entry in acting.elements:
        if entry.label == label and entry.step != now and not taken.isdisjoint(entry.members):
            entry = dataclasses.replace(entry, members=tuple(one for one in entry.members if one not in taken))
        if entry.members:
            kept.append(entry)
    acting.elements[:] = [*kept, ElementEntry(label, tuple(members), tuple(values), place, now)]


def _surface_loads(reader, block):
    _in_step(reader, block)
    if _renews(reader, block):
        _acting(reader).elements[:] = [entry for entry in _acting(reader).elements if not entry.label.startswith(ON_SURFACE)]
    for place, cells in block.lines:
        name = cells[0].strip('"').upper()
        if name not in reader.surfaces:
            refuse(place, f"there is no surface '{name}'{did_you_mean(name, reader.surfaces)}")
        if len(cells) < 3 or cells[1].upper() != "P":
            reader.findings.leave_out(f"*DSLOAD of kind {cells[1] if len(cells) > 1 else '?'}", place)
            continue
        for members, face, _ in reader.surfaces[name]:
            # pressure on a face pushes it
            side = {"SPOS": -1.0, "SNEG": 1.0}.get(face)
            if side is None:
                refuse(place, f"pressure on the face {face or 'none'} of surface '{name}': SPOS or SNEG is read")
            _add_element_load(reader, f"{ON_SURFACE}{face}", members, [side * number(cells[2], place)], place)
    reader.findings.count("lines of surface loads", len(block.lines))


def finish_steps(reader):
    """Steps and loads of the model, when the whole file is known."""
    if reader.step is not None:
        refuse(reader.step.place, "the file ends within this step: *END STEP is missing")
    history = _acting(reader).history
    for support in reader.model.supports:
        for node in support.nodes:
            refuse_directions(reader, node, support.held)
    reader.model.supports = [part for one in reader.model.supports for part in supports_along(reader.axes, one)]
    kept = [entry for entry in history if entry[0].kind in KINDS.values()]
    for step, _, _ in history:
        if step.kind is None:
            refuse(step.place, "the step does not say what it is: *STATIC, *FREQUENCY or *BUCKLE")
        if step.kind not in KINDS.values():
            reader.findings.leave_out(f"a step of *{step.kind}", step.place)
    model = reader.model
    if not kept:
        reader.findings.leave_out("the file has no step that is read: the deck finds modes")
        last = len(history) - 1
        model.supports[:] = [one for one in model.supports if one.steps is None or last in one.steps]
        for one in model.supports:
            one.steps = None
        place = next(iter(reader.elements.values()))[2]
        model.steps.append(Step("modes", "modal", place))
        return
    _make_steps(reader, kept)
    node_loads, element_loads = {}, {}
    for number_, (step, nodes, elements) in enumerate(kept):
        if step.kind == "modal":
            continue
        if step.kind == "buckling" and model.steps[number_].preloaded:
            continue
        collect_node_loads(reader, nodes, number_, node_loads)
        collect_element_loads(reader, elements, number_, element_loads)
    model.node_loads += node_loads.values()
    for entry, steps in element_loads.items():
        make_element_load(reader, entry, steps)


def _make_steps(reader, kept):
    """A step of modes starts from the static one before it, where that is what the file asks for: in Abaqus where that one
    is nonlinear, in CalculiX by PERTURBATION, too."""
    before, is_abaqus = None, reader.program == "Abaqus"
    for step, _, _ in kept:
        preloaded = None
        asks = before is not None and (before.nonlinear or (step.kind == "buckling" if is_abaqus else step.perturbation))
        if step.kind != "static" and asks:
            preloaded = before.name
        if step.kind == "static" and step.perturbation and before is not None:
            text = "a static PERTURBATION step gives the whole state, under all loads that act, not its part of it"
            reader.findings.assume(text, step.place)
        if step.kind == "buckling" and preloaded:
            reader.findings.leave_out("the static step before *BUCKLE: factors are those of the load of the step alone", step.place)
            preloaded = None
        reader.model.steps.append(Step(step.name, step.kind, step.place, step.modes, step.nonlinear, preloaded))
        if step.kind == "static" and not (is_abaqus and step.perturbation):
            before = step
    if any(step.kind == "static" and not step.nonlinear for step, _, _ in kept):
        reader.findings.assume("linear static steps become nonlinear ones, which agree where displacements are small")
    numbers = {step.number: i for i, (step, _, _) in enumerate(kept)}
    for support in reader.model.supports:
        if support.steps is not None:
            support.steps = {new for old, new in numbers.items() if old in support.steps}
            support.steps = None if len(support.steps) == len(kept) else support.steps
    reader.model.supports[:] = _merged([one for one in reader.model.supports if one.steps is None or one.steps], len(kept))
    names = [step.name for step in reader.model.steps]
    for number_, step in enumerate(reader.model.steps):
        static = number_ if step.preloaded is None else names.index(step.preloaded)
        if any(one.steps is not None and (number_ in one.steps) != (static in one.steps) for one in reader.model.supports):
            reader.findings.leave_out("other supports of modes than of the loaded state that they start from", step.place)


def _merged(supports, count):
    """Those that a file gives anew in each step as one."""
    found = {}
    for one in supports:
        first = found.setdefault((tuple(one.nodes), tuple(sorted(one.held.items())), str(one.axes)), one)
        if first is not one and first.steps is not None:
            steps = set(range(count)) if one.steps is None else first.steps | one.steps
            first.steps = None if len(steps) == count else steps
    return list(found.values())
