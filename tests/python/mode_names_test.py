"""Names of modes: which structure moves most, and along which of its axes."""

import unittest

import numpy
from culm.mode_names import describe, name_modes
from culm.results import Mesh

ROTOR = numpy.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).T  # d1 along z, d2 along x, d3 along y


def blade():
    """Five nodes along y with their directors."""
    position = numpy.outer(numpy.arange(5.0), [0.0, 1.0, 0.0])
    return Mesh(position, [(i, i + 1) for i in range(4)], False, numpy.tile(ROTOR, (5, 1, 1)))


def shape(direction, curve=lambda s: s**2):
    result = numpy.zeros((5, 6))
    result[:, :3] = numpy.outer(curve(numpy.arange(5.0)), direction)
    return result


class ModeNames(unittest.TestCase):
    def test_bending_is_told_in_the_axes_of_the_section(self):
        self.assertEqual(describe(blade(), shape([0, 0, 2])), "along d1, 100 %")
        self.assertEqual(describe(blade(), shape([3, 0, 1])), "along d2, 90 %")

    def test_the_phase_of_a_complex_mode_does_not_matter(self):
        self.assertEqual(describe(blade(), 1j * shape([3, 0, 1])), "along d2, 90 %")

    def test_the_motion_of_the_root_is_none_of_the_structure(self):
        carried = shape([0, 0, 1])
        turn = numpy.array([0.3, 0.0, -0.2])
        carried[:, :3] += [5.0, 0.0, 0.0] + numpy.cross(turn, blade().position)
        carried[:, 3:] += turn
        self.assertEqual(describe(blade(), carried), "along d1, 100 %")
        rigid = shape([0, 0, 0])
        rigid[:, :3] = [5.0, 0.0, 0.0]
        self.assertEqual(describe(blade(), rigid), "")

    def test_a_beam_that_twists_more_than_it_bends_is_in_torsion(self):
        twisted = shape([0, 0, 0.01])
        twisted[:, 3:] = numpy.outer(numpy.arange(5.0), [0.0, 0.3, 0.1])  # the axis is y
        self.assertEqual(describe(blade(), twisted), "torsion, 90 %")
        bent = shape([0, 0, 1])
        bent[:, 3:] = numpy.outer(2.0 * numpy.arange(5.0), [1.0, 0.4, 0.0])
        self.assertEqual(describe(blade(), bent), "along d1, 100 %")
        self.assertEqual(describe(blade(), shape([0, 1, 0])), "along d3, 100 %")

    def test_bodies_and_shells_move_along_axes_in_space(self):
        body = Mesh(numpy.zeros((1, 3)), [(0,)], False, numpy.tile(ROTOR, (1, 1, 1)))
        self.assertEqual(describe(body, numpy.array([[3.0, 1.0, 0.0, 9.0, 9.0, 9.0]])), "along x, 90 %")
        wall = Mesh(blade().position, [], True)
        self.assertEqual(describe(wall, shape([0, 0, 2])), "along z, 100 %")

    def test_a_mode_is_called_by_the_structure_with_most_of_the_energy(self):
        shapes = {"blade 1": numpy.stack([shape([0, 0, 1]), shape([1, 0, 0])]), "tower": numpy.zeros((2, 5, 6))}
        names = name_modes({"blade 1": blade(), "tower": blade()}, shapes, ["blade 1 60 %, tower 40 %", "mast 90 %"])
        self.assertEqual(names, ["blade 1 flap, along d1, 100 %", ""])

    def test_blades_flap_as_they_bend_first_and_the_tower_moves_with_or_across_that(self):
        still = numpy.zeros((5, 6))
        blade_moves = [still, shape([0, 0, 1]), shape([1, 0, 0]), still]
        tower_moves = [shape([0, 0, 1]), still, still, shape([1, 0, 0])]
        meshes = {"blade 1": blade(), "tower": blade()}
        shapes = {"blade 1": numpy.stack(blade_moves), "tower": numpy.stack(tower_moves)}
        names = name_modes(meshes, shapes, ["tower 90 %", "blade 1 60 %", "blade 1 70 %", "tower 80 %"])
        self.assertEqual([name.split(",")[0] for name in names], ["tower fore-aft", "blade 1 flap", "blade 1 edge", "tower side to side"])


if __name__ == "__main__":
    unittest.main()
