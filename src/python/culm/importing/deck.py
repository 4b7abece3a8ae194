"""A finite-element model as a deck, with meshes of shells in files beside it."""

import collections
import dataclasses

import numpy

from .beam_chains import beam_chains
from .deck_text import List, unique_name
from .findings import refuse
from .places import Places, directors, is_smooth
from .quads import Quads
from .shell_parts import is_isotropic, shell_parts
from .supports import add_supports

FARTHEST = 1e12  # m
FAINT = 1e-9  # mass of a reference node that has none, of the mass of the model
MOST_WATCHED = 5  # nodes in the history
SMALL_SHELL_MOMENT = 1e-6  # part of a moment about a director that is rounding


class Deck:
    """@param stem  of the names of mesh files"""

    def __init__(self, model, stem):
        self.model = model
        self.stem = stem
        _refuse_far_nodes(model)
        self.quads = Quads(model)
        self.parts = shell_parts(model, self.quads)
        self.chains = beam_chains(model)
        self._name_structures()
        self.places = Places(self.chains, self.parts)
        self.root = List("culm")
        self.root.add("Title", model.title)
        self.inactive = collections.defaultdict(set)  # name -> steps it acts in
        self.meshes = {}  # file name -> text

    def write(self):
        """@return the deck, and the texts of mesh files by name"""
        self._refuse_what_is_loose()
        self._add_materials()
        self._add_sections()
        structures = self.root.list("Structures")
        self._add_beams(structures)
        shells = self._add_shells(structures)
        bodies = self._add_bodies()
        structures.items += [body for body in bodies.items]
        node_sets = self.root.list("Node Sets")
        element_sets = self.root.list("Element Sets")
        masses = self.root.list("Masses")
        self.constraints = constraints = self.root.list("Constraints")
        loads = self.root.list("Loads")
        self._add_masses(masses)
        self._add_connections(constraints)
        self._add_couplings(constraints)
        steps = add_supports(self.model, self.places, self.quads, constraints)
        self.inactive.update({name: where for name, where in steps.items() if where is not None})
        self._add_node_loads(loads)
        self._add_element_loads(loads, element_sets)
        self._keep_sets()
        for name, names in self.places.sets.items():
            node_sets.list(name).add("Nodes", names)
        self._add_analyses()
        self._add_output()
        for part, mesh in shells:
            comment = f"Shell '{part.name}' of {self.model.title}"
            self.meshes[mesh] = part.mesh_text("".join(c if c.isprintable() else "?" for c in comment))
        return self.root, self.meshes

    def mass(self):
        """Of all that has any, from the elements of the file [kg]."""
        total = sum(one.mass for one in self.model.masses)
        for part in self.parts:
            layers = part.wall.layers
            per_area = sum(
                layer.thickness * self.model.materials[layer.material].values.get("Density", 0.0) for layer in layers
            )
            total += per_area * part.area()
        for chain in self.chains:
            total += self.model.sections[chain.section].mass * chain.lengths.sum()
        return float(total)

    def _name_structures(self):
        taken = set()
        for structure in (*self.parts, *self.chains):
            structure.name = unique_name(structure.name, taken)
            taken.add(structure.name)

    def _refuse_what_is_loose(self):
        for part in self.parts:
            flat = numpy.flatnonzero(
                numpy.linalg.norm(
                    numpy.cross(
                        part.positions[part.corners[:, 2]] - part.positions[part.corners[:, 0]],
                        part.positions[part.corners[:, 3]] - part.positions[part.corners[:, 1]],
                    ),
                    axis=1,
                )
                <= 0.0
            )
            if len(flat):
                element = self.model.shells[part.elements[flat[0]]]
                refuse(element.place, f"element {element.number} has no area")
            shared = part.shared_places()
            if shared:
                a, b = shared[0]
                self.model.findings.assume(
                    f"{len(shared)} pairs of nodes at one place are one node, as {name_of(a)} and {name_of(b)}"
                )

    def _add_materials(self):
        used = {layer.material for part in self.parts for layer in part.wall.layers}
        if not used:
            return
        materials = self.root.list("Materials")
        for name in sorted(used):
            material = self.model.materials[name]
            entry = materials.list(name, f"{material.place}", material.type)
            for key, value in material.values.items():
                entry.add(key, value)

    def _add_sections(self):
        used = dict.fromkeys(chain.section for chain in self.chains)
        if not used:
            return
        sections = self.root.list("Sections")
        for name in used:
            section = self.model.sections[name]
            entry = sections.list(name, f"{section.place}", section.type)
            for key, value in section.values.items():
                entry.add(key, value)

    def _add_beams(self, structures):
        for chain in self.chains:
            first = self.model.beams[chain.elements[0]]
            many = f", {len(chain.elements)} elements from {name_of(first.number)} on" if len(chain.elements) > 1 else ""
            beam = structures.list(chain.name, f"{first.place}: element {name_of(first.number)}{many}", "Beam")
            beam.add("Section", chain.section)
            curve = beam.list("Curve", type="Polyline")
            curve.add("Points", chain.positions.ravel())
            curve.add("Up", numpy.array(chain.up, float))
            curve.add("Elements", [1])
        self.model.findings.count("beams of the deck", len(self.chains))

    def _add_shells(self, structures):
        shells = []
        for part in self.parts:
            first = self.model.shells[part.elements[0]]
            shell = structures.list(part.name, f"{part.wall.place}; its first element at {first.place}", "Shell")
            layers = part.wall.layers
            if len(layers) == 1:
                shell.add("Material", layers[0].material)
                shell.add("Thickness", layers[0].thickness)
            else:
                shell.add("Materials", [layer.material for layer in layers])
                shell.add("Thicknesses", [layer.thickness for layer in layers])
            if not is_isotropic(part.wall, self.model):
                shell.add("Angles", [layer.angle for layer in layers], "deg")
                if part.axis is not None:
                    shell.add("Reference Axis", numpy.array(part.axis, float))
            shell.add("Shear Correction", "Equilibrium")
            if part.fold_angle != numpy.radians(20.0):
                shell.add("Fold Angle", float(part.fold_angle))
            mesh = f"{self.stem}.{part.name}.msh"
            shell.list("Mesh", type="Gmsh").add("File Name", mesh)
            shells.append((part, mesh))
        return shells

    def _add_bodies(self):
        """Rigid bodies for nodes that lead others, or have inertia, and have no triad of a beam."""
        bodies = List("bodies")
        inertia = {mass.node: mass for mass in self.model.masses if mass.inertia is not None or any(mass.offset)}
        weights, at_node = collections.Counter(), collections.defaultdict(list)
        for mass in self.model.masses:
            weights[mass.node] += mass.mass
            at_node[mass.node].append(mass)
        wanted = {}
        for coupling in self.model.couplings:
            if not any(not spot.is_shell for spot in self.places.spots.get(coupling.reference, [])):
                wanted[coupling.reference] = coupling.place
        for node, mass in inertia.items():
            wanted.setdefault(node, mass.place)
        scale = self.mass() or 1.0
        size = self._size()
        for node, place in wanted.items():
            name = self.places.unique_structure(f"node {name_of(node)}")
            body = bodies.list(name, f"{place}", "Rigid Body").add("Position", self.model.nodes[node])
            mass = weights[node]
            centre, tensor = _centre_and_inertia(at_node[node])
            if mass <= 0.0:
                mass = FAINT * scale
                self.model.findings.assume(f"reference nodes without mass get {mass:.3g} kg", place)
            faint = mass * (1e-3 * size) ** 2
            if not tensor[:3].all():
                tensor[:3] += faint
                self.model.findings.assume("point masses that turn get a small inertia", place)
            body.add("Mass", mass).add("Inertia", tensor)
            if centre.any():
                body.add("Centre", centre)
            del weights[node]
            self.places.add_body(node, name)
        self._weights = weights
        return bodies

    def _size(self):
        points = numpy.array(list(self.model.nodes.values()))
        return float(numpy.linalg.norm(points.max(axis=0) - points.min(axis=0)))

    def _add_masses(self, masses):
        places = {mass.node: mass.place for mass in self.model.masses}
        groups = collections.defaultdict(list)
        for node, mass in self._weights.items():
            if not self.places.spots.get(node):
                followed = any(node in coupling.followers for coupling in self.model.couplings)
                refuse(
                    places[node],
                    f"node {name_of(node)} has a mass, but belongs to no element, and "
                    + (
                        "followers of a coupling that belong to none are left out; give the mass to the reference of the coupling"
                        if followed
                        else "nothing holds it to the structure"
                    ),
                )
            groups[(mass, self.places.copies(node))].append(node)
        for (mass, copies), nodes in groups.items():
            name = unique_name("mass", {one.name for one in masses.lists()})
            entry = masses.list(name, f"{places[nodes[0]]}", "Point Mass")
            entry.add("Node", self.places.one_name(nodes, name)).add("Mass", mass / copies)

    def _add_connections(self, constraints):
        """Structures that share nodes of the file hold together there."""
        rigid = collections.defaultdict(list)
        seams = collections.defaultdict(list)
        for node, spots in self.places.spots.items():
            leader = spots[0]
            for spot in spots[1:]:
                if not leader.is_shell:
                    rigid[(self.places.names([node], "joint")[0], spot.is_shell)].append((node, spot))
                else:
                    kind = "Smooth Connection" if is_smooth(leader, spot, node) else "Fold Connection"
                    seams[(leader.structure.name, spot.structure.name, kind)].append((node, leader, spot))
        for (master, _), members in rigid.items():
            for node, spot in members:
                name = self._connection_name("joint", constraints)
                follower = self.places.one_name([node], f"at node {name_of(node)}", lambda _, spot=spot: spot)
                entry = constraints.list(name, f"at node {name_of(node)} of the file", "Rigid Connection")
                entry.add("Node", follower).add("Master", master)
        for (first, second, kind), members in seams.items():
            nodes = [node for node, _, _ in members]
            spots = {node: spot for node, _, spot in members}
            name = self._connection_name(f"{first} and {second}", constraints)
            entry = constraints.list(name, f"{len(nodes)} nodes of the file that both have", kind)
            entry.add("First", self.places.one_name(nodes, f"to {second}"))
            entry.add("Second", self.places.one_name(nodes, f"to {first}", lambda node, spots=spots: spots[node]))
            # a set is joined by nearest places, and these are equal
            entry.add("Tolerance", 1e-3 * min(part.shortest_edge for part in self.parts))

    def _connection_name(self, name, constraints):
        return unique_name(name, {one.name for one in constraints.lists()})

    def _joined_couplings(self):
        """Those that lead node by node from one as one: it has nodes that were added between them, too."""
        found = {}
        for coupling in self.model.couplings:
            _, followers = found.setdefault((coupling.reference, coupling.name), (coupling, {}))
            followers.update(dict.fromkeys(coupling.followers))
        return [dataclasses.replace(first, followers=list(followers)) for first, followers in found.values()]

    def _add_couplings(self, constraints):
        for coupling in self._joined_couplings():
            master = self.places.names([coupling.reference], coupling.name)[0]
            followers = [n for n in self.quads.with_added(coupling.followers) if n != coupling.reference]
            loose = [node for node in followers if not self.places.spots.get(node)]
            if loose:
                self.model.findings.assume(
                    f"nodes of couplings that belong to no element are left out, as {name_of(loose[0])}", coupling.place
                )
            followers = [node for node in followers if self.places.spots.get(node)]
            if not followers:
                continue
            for group in (True, False):
                nodes = [node for node in followers if self.places.leader(node).is_shell == group]
                if not nodes:
                    continue
                name = self._connection_name(coupling.name, constraints)
                entry = constraints.list(name, f"{coupling.place}", "Rigid Connection")
                entry.add("Node", self.places.one_name(nodes, name)).add("Master", master)

    def _load_name(self, load, loads):
        """Another one than those of constraints, too: Inactive names both."""
        return unique_name(load.name, {one.name for one in (*loads.lists(), *self.constraints.lists())})

    def _add_node_loads(self, loads):
        for load in self.model.node_loads:
            groups = collections.defaultdict(list)
            for node in load.nodes:
                if not self.places.spots.get(node):
                    refuse(load.place, f"node {name_of(node)} is loaded, but belongs to nothing")
                groups[self.places.copies(node)].append(node)
            for copies, nodes in groups.items():
                for kind, vector in (("Force", load.vector[:3]), ("Moment", load.vector[3:])):
                    if not numpy.any(vector):
                        continue
                    if kind == "Moment":
                        self._tell_lost_moments(nodes, vector, load)
                    name = self._load_name(load, loads)
                    entry = loads.list(name, f"{load.place}", kind)
                    entry.add("Node", self.places.one_name(nodes, load.name)).add(kind, vector / copies)
                    self.inactive[name] = load.steps

    def _tell_lost_moments(self, nodes, vector, load):
        for node in nodes:
            spot = self.places.leader(node)
            if not spot.is_shell:
                continue
            part = max(abs(directors(spot, node) @ vector)) / numpy.linalg.norm(vector)
            if part > SMALL_SHELL_MOMENT:
                self.model.findings.leave_out("parts of moments about the normal of a shell", load.place)

    def _add_element_loads(self, loads, element_sets):
        for load in self.model.element_loads:
            if load.kind == "gravity":
                name = self._load_name(load, loads)
                entry = loads.list(name, f"{load.place}", "Gravity").add("Acceleration", numpy.array(load.value, float))
                entry.add("Function", "Ramp")
                self.inactive[name] = load.steps
        on_shells = [load for load in self.model.element_loads if load.kind in ("pressure", "surface")]
        for part in self.parts:
            self._add_loads_on_shell(part, on_shells, loads)
        on_beams = [load for load in self.model.element_loads if load.kind == "line"]
        for chain in self.chains:
            for load in on_beams:
                self._add_load_on_beam(chain, load, loads, element_sets)

    def _add_loads_on_shell(self, part, on_shells, loads):
        """Loads overlap, and an element of a Gmsh file has one group: each set of loads makes one."""
        signature = collections.defaultdict(tuple)
        chosen = [set(load.elements) for load in on_shells]
        for q, element in enumerate(part.elements):
            signature[q] = tuple(i for i, members in enumerate(chosen) if element in members)
        groups = collections.defaultdict(list)
        for q, which in signature.items():
            groups[which].append(q)
        for which, members in groups.items():
            if not which:
                continue
            target = part.name
            if len(groups) > 1:
                group = unique_name(on_shells[which[0]].name, set(part.quad_sets))
                part.quad_sets[group] = members
                target = f"{part.name}/{group}"
            for i in which:
                load = on_shells[i]
                name = self._load_name(load, loads)
                kind = "Pressure" if load.kind == "pressure" else "Surface Force"
                entry = loads.list(name, f"{load.place}", kind).add("Structure", target)
                if load.kind == "pressure":
                    entry.add("Pressure", float(load.value))
                else:
                    entry.add("Force", numpy.array(load.value, float))
                self.inactive[name] = load.steps

    def _add_load_on_beam(self, chain, load, loads, element_sets):
        members = set(load.elements)
        segments = [i for i, element in enumerate(chain.elements) if element in members]
        if not segments:
            return
        name = self._load_name(load, loads)
        target = chain.name
        if len(segments) < len(chain.elements):
            target = unique_name(f"{load.name} on {chain.name}", {one.name for one in element_sets.lists()})
            element_sets.list(target).add("Structure", chain.name).add("Elements", segments)
        entry = loads.list(name, f"{load.place}", "Line Force").add("Structure", target)
        entry.add("Force", numpy.array(load.value, float))
        self.inactive[name] = load.steps

    def _keep_sets(self):
        """Sets that nothing in the file uses, in the meshes that they belong to."""
        for part in self.parts:
            places = collections.defaultdict(list)
            for q, element in enumerate(part.elements):
                places[element].append(q)
            taken = set()
            for name, members in self.model.surface_sets.items():
                chosen = [q for element in members for q in places[element] if q not in taken]
                if len(chosen) < sum(len(places[element]) for element in members):
                    self.model.findings.assume(f"elements in several surfaces are in the first only, not in '{name}'")
                taken.update(chosen)
                if chosen:
                    part.quad_sets[unique_name(name, set(part.quad_sets))] = chosen
            for name, lines in self.model.edge_sets.items():
                pieces = [piece for line in lines for piece in self.quads.pieces(line)]
                chosen = [tuple(part.points[node] for node in one) for one in pieces if set(one) <= set(part.points)]
                if chosen:
                    part.line_sets[unique_name(name, set(part.line_sets))] = chosen
            for name, nodes in self.model.point_sets.items():
                chosen = [part.points[node] for node in nodes if node in part.points]
                if chosen:
                    part.point_sets[unique_name(name, {*part.point_sets, *part.line_sets})] = chosen

    def _add_analyses(self):
        analyses = self.root.list("Analyses")
        steps = self.model.steps
        for number, step in enumerate(steps):
            comment = f"{step.place}"
            if number == 0 and step.kind == "static" and not step.nonlinear:
                comment += "; the file asks for small displacements, culm counts large ones as well"
            entry = analyses.list(step.name, comment, {"static": "Static", "modal": "Modal", "buckling": "Buckling"}[step.kind])
            acting = number
            if step.preloaded is not None:
                acting = next(i for i, other in enumerate(steps) if other.name == step.preloaded)
            if number > 0:
                entry.add("Start From", step.preloaded or "Reference")
            if step.kind == "static":
                entry.add("Steps", 10 if step.nonlinear else 1)
            else:
                entry.add("Modes", step.modes)
            idle = [name for name, acts in self.inactive.items() if acting not in acts]
            if idle:
                entry.add("Inactive", idle)

    def _add_output(self):
        """The displacements of nodes that the file watches, and of the first that are loaded."""
        history = List("History")
        seen = []
        for nodes in [self.model.watched, *(load.nodes for load in self.model.node_loads)]:
            for node in nodes:
                if node in seen or len(seen) == MOST_WATCHED or not self.places.spots.get(node):
                    continue
                if self.places.copies(node) > 1:
                    continue
                seen.append(node)
                name = f"displacement of node {name_of(node)}"
                target = self.places.names([node], f"node {name_of(node)}")[0]
                history.list(name, type="Displacement").add("Node", target)
        self.root.list("Output").items.append(history)


def _refuse_far_nodes(model):
    """Squares of lengths must be numbers."""
    for number, position in model.nodes.items():
        if not numpy.abs(position).max() < FARTHEST:
            place = (model.shells or model.beams)[0].place if model.shells or model.beams else model.title
            refuse(place, f"node {name_of(number)} of its model lies at {position.tolist()}, which no structure does")


def _centre_and_inertia(masses):
    """Of all masses at one node: their centre from it, and 11, 22, 33, 23, 13, 12 about that."""
    total = sum(one.mass for one in masses)
    places = [(one.mass, numpy.array(one.offset, float)) for one in masses]
    if len(masses) == 1:
        centre = places[0][1]
    else:
        centre = sum((mass * place for mass, place in places), numpy.zeros(3)) / (total or 1.0)
    tensor = sum((numpy.array(one.inertia, float) for one in masses if one.inertia is not None), numpy.zeros(6))
    for mass, place in places:
        arm = place - centre
        about = mass * ((arm @ arm) * numpy.eye(3) - numpy.outer(arm, arm))
        tensor += about[(0, 1, 2, 1, 0, 0), (0, 1, 2, 2, 2, 1)]
    return centre, tensor


def name_of(number):
    """A number of the file as it is said."""
    return " ".join(str(part) for part in number) if isinstance(number, tuple) else str(number)
