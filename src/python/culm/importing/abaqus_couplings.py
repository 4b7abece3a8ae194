"""Surfaces and couplings of Abaqus and CalculiX."""

from .abaqus_elements import SHELLS
from .findings import refuse
from .keyword_file import integer
from .model import Coupling


def _surface(reader, block):
    name = block.required("NAME")
    faces = []
    for place, cells in block.lines:
        if block.get("TYPE") == "NODE":
            faces.append((reader.find_nodes(cells[0], place), "NODE", place))
        else:
            face = cells[1].upper() if len(cells) > 1 else ""
            faces.append((reader.find_elements(cells[0], place), face, place))
    reader.surfaces[reader.prefix + name] = faces


def _nodes_of_surface(reader, name, place):
    for candidate in (reader.prefix + name, name):
        if candidate in reader.surfaces:
            nodes = []
            for members, face, _ in reader.surfaces[candidate]:
                nodes += members if face == "NODE" else [n for key in members for n in _face(reader, key, face, place)]
            return list(dict.fromkeys(nodes))
    if name in reader.model.node_sets or reader.prefix + name in reader.model.node_sets:
        return reader.find_nodes(name, place)
    refuse(place, f"there is no surface '{name}'")


def _face(reader, key, face, place):
    """Nodes of an element, or of one of its edges."""
    type, nodes, _ = reader.elements[key]
    if not face.startswith("E"):
        return nodes
    corners = 3 if SHELLS.get(type) in (3, 6) else 4
    i = integer(face[1:], place, "an edge, E1 to E4") - 1
    if not 0 <= i < corners:
        refuse(place, f"an element of type {type} has no edge {face}")
    return (nodes[i], nodes[(i + 1) % corners], *nodes[corners + i : corners + i + 1])


def _rigid_body(reader, block):
    reference = reader.find_nodes(block.required("REF NODE"), block.place)[0]
    followers = []
    for name in ("NSET", "TIE NSET"):
        if block.get(name):
            followers += reader.find_nodes(block.get(name), block.place)
    for name in ("PIN NSET",):
        if block.get(name):
            refuse(block.place, f"*RIGID BODY with {name} is not read")
    if block.get("ELSET"):
        for key in reader.find_elements(block.get("ELSET"), block.place):
            followers += reader.elements[key][1]
    if block.get("ROT NODE"):
        # the node whose displacement is the rotation of the body in CalculiX
        turning = reader.find_nodes(block.get("ROT NODE"), block.place)[0]
        reader.rotation_nodes = {**getattr(reader, "rotation_nodes", {}), turning: reference}
    _couple(reader, reference, followers, block, "rigid body")


def _couple(reader, reference, followers, block, name):
    followers = [node for node in dict.fromkeys(followers) if node != reference]
    reader.model.couplings.append(Coupling(reference, followers, block.place, name))
    reader.findings.count("rigid couplings")


def _coupling(reader, block):
    reference = reader.find_nodes(block.required("REF NODE"), block.place)[0]
    nodes = _nodes_of_surface(reader, block.required("SURFACE"), block.place)
    reader.coupling = (reference, nodes, (block.get("CONSTRAINT NAME") or "coupling").lower())


def _kinematic(reader, block):
    if reader.coupling is None:
        refuse(block.place, "*KINEMATIC without *COUPLING before it")
    reference, nodes, name = reader.coupling
    held = set()
    for place, cells in block.lines:
        first = integer(cells[0], place)
        last = integer(cells[1], place) if len(cells) > 1 and cells[1] else first
        held |= set(range(first, last + 1))
    if held and not held >= {1, 2, 3, 4, 5, 6}:
        if not held >= {1, 2, 3}:
            refuse(block.place, "*KINEMATIC that couples some translations only is not read")
        reader.findings.assume("a kinematic coupling of translations only holds rotations, too", block.place)
    _couple(reader, reference, nodes, block, name)


def _distributing(reader, block):
    if reader.coupling is None:
        refuse(block.place, "*DISTRIBUTING without *COUPLING before it")
    reference, nodes, name = reader.coupling
    reader.findings.assume("a distributing coupling is a rigid one, which is stiffer", block.place)
    _couple(reader, reference, nodes, block, name)


def _multi_point(reader, block):
    for place, cells in block.lines:
        kind = cells[0].upper()
        if kind not in ("BEAM", "TIE"):
            refuse(place, f"*MPC of type {kind} is not read; BEAM and TIE are")
        follower = reader.find_nodes(cells[1], place)
        reference = reader.find_nodes(cells[2], place)
        if len(reference) == 1:
            _couple(reader, reference[0], follower, block, f"mpc {kind.lower()}")
        elif len(reference) == len(follower):
            for one, other in zip(reference, follower):
                _couple(reader, one, [other], block, f"mpc {kind.lower()}")
        else:
            refuse(place, f"{len(follower)} nodes cannot follow {len(reference)}")


BLOCKS = {
    "SURFACE": _surface,
    "RIGID BODY": _rigid_body,
    "COUPLING": _coupling,
    "KINEMATIC": _kinematic,
    "DISTRIBUTING": _distributing,
    "MPC": _multi_point,
}
