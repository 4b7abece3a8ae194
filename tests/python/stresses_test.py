"""What the pictures of stresses show."""

import unittest

import numpy
from culm import stresses

LAYER = ["S11", "S22", "S33", "S23", "S13", "S12"]


def beam(rows):
    return False, {"resultants": (["N1", "N2", "N3", "M1", "M2", "M3"], numpy.array(rows, float))}


def shell(**tables):
    return True, {name.replace("_", " "): table for name, table in tables.items()}


class Stresses(unittest.TestCase):
    def test_beams_show_force_bending_and_torsion(self):
        found = {one.title: one for one in stresses.of_state({"bar": beam([[0, 0, 5, 3, 4, -2], [0, 0, -1, 0, 0, 0]])}, 1.0)}
        self.assertEqual(sorted(found), ["bending moment", "normal force", "torsion moment"])
        numpy.testing.assert_allclose(found["bending moment"].values["bar"], [5, 0])
        numpy.testing.assert_allclose(found["normal force"].values["bar"], [5, -1])

    def test_layers_show_the_largest_stress_of_von_mises(self):
        top = (LAYER, numpy.array([[100.0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 50.0]]))
        bottom = (LAYER, numpy.array([[-300.0, 0, 0, 0, 0, 0], [70.0, 70.0, 70.0, 0, 0, 0]]))
        (found,) = stresses.of_state({"wall": shell(stress_layer_0_top=top, stress_layer_0_bottom=bottom)}, 1.0)
        self.assertEqual(found.unit, "Pa")
        numpy.testing.assert_allclose(found.values["wall"], [300, 50 * 3**0.5])

    def test_shells_show_the_principal_force_of_the_larger_size(self):
        columns = ["N11", "N22", "N12", "M11", "M22", "M12", "Q1", "Q2"]
        table = (columns, numpy.array([[3.0, 1, 0, 0, 0, 0, 0, 0], [0, 0, -2, 0, 0, 0, 0, 0], [-5, 1, 0, 0, 0, 0, 0, 0]]))
        (found,) = stresses.of_state({"wall": shell(resultants=table)}, 1.0)
        numpy.testing.assert_allclose(found.values["wall"], [3, 2, -5])

    def test_rounding_is_no_picture(self):
        found = stresses.of_state({"bar": beam([[0, 0, 1e-9, 40, 0, 0]])}, 2.0)
        self.assertEqual([one.title for one in found], ["bending moment"])
        self.assertEqual(stresses.of_state({"body": (False, {})}, 2.0), [])


if __name__ == "__main__":
    unittest.main()
