"""Models of imported files as decks: meshes, nodes of folds, supports, sums of loads."""

import pathlib
import tempfile
import unittest

import numpy

from culm.errors import CulmError
from culm.importing import abaqus, calculix, desio
from culm.importing.beam_chains import beam_chains
from culm.importing.deck import Deck
from culm.importing.findings import Place
from culm.importing.model import (
    BeamElement,
    Coupling,
    Layer,
    Material,
    Model,
    NodeLoad,
    Section,
    ShellElement,
    Step,
    Support,
    Wall,
)
from culm.importing.quads import Quads, area

HERE = Place("file", 1)


def sheet(elements, nodes):
    """A model of shell elements of one wall."""
    model = Model("sheet")
    model.nodes = {number: numpy.array(place, float) for number, place in nodes.items()}
    model.materials["steel"] = Material("Isotropic", {"Young Modulus": 1.0, "Poisson Ratio": 0.3, "Density": 2.0}, HERE)
    model.walls["wall"] = Wall([Layer(0.1, "steel")], HERE)
    model.shells = [ShellElement(i + 1, tuple(e), "wall", HERE) for i, e in enumerate(elements)]
    model.steps = [Step("step 1", "static", HERE)]
    return model


SQUARE = {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0)}
BENT = {**SQUARE, 5: (1, 0, 1), 6: (1, 1, 1)}


def entries(root, name):
    """Entries of a list of the deck: name -> its parameters."""
    (found,) = [one for one in root.lists() if one.name == name]
    return {one.name: {item[0]: item[1] for item in one.items if isinstance(item, tuple)} for one in found.lists()}


def total_area(model):
    quads = Quads(model)
    return area(numpy.array([[quads.positions[n] for n in quad] for quad in quads.quads])).sum(), quads


class PathsTest(unittest.TestCase):
    def test_messages_name_what_was_asked_for(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            empty = folder / "empty.inp"
            empty.touch()
            for module in (abaqus, calculix):
                with self.assertRaisesRegex(CulmError, f"{empty}: the file has no elements"):
                    module.read(empty, None)
            with self.assertRaisesRegex(CulmError, f"{folder}/none: is not there"):
                desio.read(folder / "none", None)
            with self.assertRaisesRegex(CulmError, f"{folder}: has no simulationinput_structure.txt"):
                desio.read(folder, None)


class QuadsTest(unittest.TestCase):
    def test_triangles_and_quadrilaterals_become_a_mesh_that_fits(self):
        model = sheet([(1, 2, 3, 4), (2, 5, 3)], {**SQUARE, 5: (2, 0.5, 0)})
        found, quads = total_area(model)
        self.assertAlmostEqual(found, 1.5, 14)
        self.assertEqual(len(quads.quads), 7)
        # the node between 2 and 3 is one
        self.assertEqual(len({node for quad in quads.quads for node in quad}), 5 + 6 + 2)

    def test_an_eight_node_element_keeps_a_quadratic_surface(self):
        nodes = {1: (0, 0), 2: (1, 0), 3: (1, 1), 4: (0, 1), 5: (0.5, 0), 6: (1, 0.5), 7: (0.5, 1), 8: (0, 0.5)}
        model = sheet([(1, 2, 3, 4, 5, 6, 7, 8)], {n: (x, y, x**2 + x * y) for n, (x, y) in nodes.items()})
        quads = Quads(model)
        middle = quads.positions[quads.quads[0][2]]
        numpy.testing.assert_allclose(middle, (0.5, 0.5, 0.5), atol=1e-15)

    def test_a_quadrilateral_with_two_corners_at_one_node_is_a_triangle(self):
        self.assertAlmostEqual(total_area(sheet([(1, 2, 3, 3)], SQUARE))[0], 0.5, 14)

    def test_supports_of_both_ends_hold_new_nodes_of_free_edges(self):
        model = sheet([(1, 2, 3), (1, 3, 4)], SQUARE)
        quads = Quads(model)
        self.assertEqual(len(quads.with_added([1, 2])), 3)
        self.assertEqual(len(quads.with_added([1, 3])), 2)  # inside
        self.assertEqual(len(quads.with_added([1, 2, 3])), 3 + 3 + 1)  # the element as a whole


class FoldTest(unittest.TestCase):
    def setUp(self):
        self.model = sheet([(1, 2, 3, 4), (2, 5, 6, 3)], BENT)

    def test_a_force_on_a_fold_is_shared_by_its_nodes(self):
        self.model.node_loads = [NodeLoad([2, 1], numpy.array([0, 0, 6.0, 0, 0, 0]), HERE, "force", {0})]
        root, _ = Deck(self.model, "deck").write()
        forces = {values["Node"]: values["Force"] for values in entries(root, "Loads").values()}
        self.assertEqual(sorted(forces.values()), ["{0, 0, 3}", "{0, 0, 6}"])

    def test_each_side_of_a_fold_is_held_by_its_own_director(self):
        self.model.supports = [Support([2], {4: 0.0}, HERE)]  # about x: one director turns along y, one not
        root, _ = Deck(self.model, "deck").write()
        held = entries(root, "Constraints")
        self.assertEqual([one["Type"] for one in held.values()], ["Director Support"])
        self.assertEqual([one["Direction"] for one in held.values()], ["{0, 1, 0}"])

    def test_the_mass_is_that_of_the_elements(self):
        self.assertAlmostEqual(Deck(self.model, "deck").mass(), 0.1 * 2.0 * 2.0, 14)


class RimTest(unittest.TestCase):
    def part(self, nodes):
        model = sheet([(1, 2, 3, 4), (2, 5, 6, 3)], {**SQUARE, 5: (2, 0, 0), 6: (2, 1, 0)})
        model.supports = [Support(nodes, {3: 0.0}, HERE, "held")]
        deck = Deck(model, "deck")
        deck.write()
        return deck.parts[0]

    def test_supports_along_the_rim_are_lines_that_a_finer_mesh_keeps(self):
        part = self.part([1, 2, 5])
        self.assertEqual((part.point_sets, len(part.line_sets["held"])), ({}, 2))

    def test_supports_inside_or_of_single_points_are_points(self):
        for nodes in ([2, 3], [1], [1, 4, 6]):
            part = self.part(nodes)
            self.assertEqual((part.line_sets, len(part.point_sets["held"])), ({}, len(nodes)))


class SupportTest(unittest.TestCase):
    def held(self, freedoms, values=None):
        model = sheet([(1, 2, 3, 4)], SQUARE)
        model.supports = [Support([1], dict.fromkeys(freedoms, 0.0) | (values or {}), HERE)]
        root, _ = Deck(model, "deck").write()
        return [(one["Type"], one.get("Direction")) for one in entries(root, "Constraints").values()], model

    def test_all_six_clamp(self):
        self.assertEqual(self.held([1, 2, 3, 4, 5, 6])[0], [("Rigid Support", None)])

    def test_a_plane_of_symmetry(self):
        self.assertEqual(
            self.held([1, 5, 6])[0], [("Simple Support", "{1, 0, 0}"), ("Director Support", "{1, 0, 0}")]
        )

    def test_turning_about_the_normal_is_not_held_and_that_is_said(self):
        found, model = self.held([6])
        self.assertEqual(found, [])
        self.assertTrue(any("about the normal" in one for one in model.findings.assumed))


class BeamTest(unittest.TestCase):
    def model(self, nodes, elements, up=(0, 1, 0)):
        model = Model("frame")
        model.nodes = {number: numpy.array(place, float) for number, place in nodes.items()}
        model.sections["bar"] = Section("Circle", {"Young Modulus": 1.0, "Radius": 1.0}, 3.0, HERE)
        model.beams = [BeamElement(i + 1, tuple(e), "bar", up, HERE) for i, e in enumerate(elements)]
        model.steps = [Step("step 1", "static", HERE)]
        return model

    def test_a_kink_has_two_nodes(self):
        nodes = {1: (0, 0, 0), 2: (1, 0, 0), 3: (2, 0, 0), 4: (2, 0, 1), 5: (2, 0, 2)}
        (chain,) = beam_chains(self.model(nodes, [(1, 2), (2, 3), (3, 4), (4, 5)]))
        self.assertEqual(chain.numbers, [0, 2, 4, 7, 9])

    def test_members_that_meet_are_joined(self):
        nodes = {1: (0, 0, 0), 2: (1, 0, 0), 3: (2, 0, 0), 4: (1, 0, 1)}
        root, _ = Deck(self.model(nodes, [(1, 2), (2, 3), (4, 2)]), "deck").write()
        self.assertEqual(len(entries(root, "Structures")), 3)
        self.assertEqual([c["Type"] for c in entries(root, "Constraints").values()], ["Rigid Connection"] * 2)

    def test_the_direction_of_a_section_along_its_axis_is_refused(self):
        with self.assertRaisesRegex(CulmError, "along its axis"):
            beam_chains(self.model({1: (0, 0, 0), 2: (0, 1, 0)}, [(1, 2)]))


class CouplingTest(unittest.TestCase):
    def test_a_reference_node_without_mass_is_a_body_and_that_is_said(self):
        model = sheet([(1, 2, 3, 4)], {**SQUARE, 9: (0.5, 0.5, 1)})
        model.couplings = [Coupling(9, [1, 2], HERE)]
        model.node_loads = [NodeLoad([9], numpy.array([1.0, 0, 0, 0, 0, 0]), HERE, "force", {0})]
        root, _ = Deck(model, "deck").write()
        self.assertEqual(entries(root, "Structures")["node 9"]["Type"], "Rigid Body")
        self.assertEqual(entries(root, "Loads")["force"]["Node"], "node 9")
        self.assertTrue(any("without mass" in one for one in model.findings.assumed))

    def test_a_load_on_a_node_of_nothing_is_refused(self):
        model = sheet([(1, 2, 3, 4)], {**SQUARE, 9: (0.5, 0.5, 1)})
        model.node_loads = [NodeLoad([9], numpy.array([1.0, 0, 0, 0, 0, 0]), HERE, "force", {0})]
        with self.assertRaisesRegex(CulmError, "node 9 is loaded"):
            Deck(model, "deck").write()


if __name__ == "__main__":
    unittest.main()
