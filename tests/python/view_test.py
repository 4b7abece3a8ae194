"""What pages of runs are made of: packed numbers, coarser meshes, shapes of bodies."""

import unittest

import numpy

from culm.resolved_deck import ResolvedDeck
from culm.view import packing
from culm.view.bodies import shape_of
from culm.view.page_file import MODULES, PARTS
from culm.view.recording import Structure
from culm.view.thinning import thinned


def strip(columns, rows):
    """A plane of quadrilaterals."""
    x, y = numpy.meshgrid(numpy.arange(columns + 1.0), numpy.arange(rows + 1.0), indexing="ij")
    position = numpy.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1)
    corner = (numpy.arange(columns)[:, None] * (rows + 1) + numpy.arange(rows)).ravel()
    cells = numpy.stack([corner, corner + rows + 1, corner + rows + 2, corner + 1], axis=1)
    ends = 4 * (numpy.arange(len(cells)) + 1)
    return Structure("plane", "plane", "Shell", position, {}, cells.ravel(), ends, None, [], [], [])


def line(elements):
    position = numpy.zeros((elements + 1, 3))
    position[:, 0] = numpy.arange(elements + 1)
    cells = numpy.stack([numpy.arange(elements), numpy.arange(elements) + 1], axis=1)
    ends = 2 * (numpy.arange(elements) + 1)
    return Structure("line", "line", "Beam", position, {}, cells.ravel(), ends, None, [], [], [])


class PackingTest(unittest.TestCase):
    def test_floats_read_back_in_single_precision(self):
        values = numpy.random.default_rng(1).normal(size=(4, 5, 3))
        numpy.testing.assert_array_equal(packing.unpacked(packing.floats(values)), values.astype("f4"))

    def test_halves_are_good_to_half_a_step_of_each_column(self):
        values = numpy.random.default_rng(2).normal(size=(7, 11, 2)) * [1.0, 1e6]
        error = numpy.abs(packing.unpacked(packing.halves(values)) - values).max(axis=(0, 1))
        extent = values.max(axis=(0, 1)) - values.min(axis=(0, 1))
        self.assertTrue((error <= 0.5001 * extent / 65535).all(), error)

    def test_a_constant_column_reads_back_exactly(self):
        values = numpy.full((3, 2, 1), 0.1)
        numpy.testing.assert_array_equal(packing.unpacked(packing.halves(values)), values)


class ThinningTest(unittest.TestCase):
    def test_what_is_small_stays(self):
        part = thinned(strip(4, 3), 12)
        self.assertEqual(part.cells.tolist(), list(range(12)))
        self.assertEqual(part.nodes.tolist(), list(range(20)))

    def test_a_plane_stays_closed(self):
        plane = strip(60, 40)
        part = thinned(plane, 300)
        self.assertTrue(100 <= len(part.cells) <= 300, len(part.cells))
        starts = [0, *part.ends[:-1]]
        place = plane.position[part.nodes]
        area = 0.0
        for start, end in zip(starts, part.ends):
            x, y = place[part.connectivity[start:end], :2].T
            area += 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
        # without the rim that the outermost nodes cut off
        width, height = numpy.ptp(place[:, 0]), numpy.ptp(place[:, 1])
        self.assertAlmostEqual(area, width * height, delta=0.1 * width * height)

    def test_a_line_stays_connected(self):
        part = thinned(line(5000), 100)
        self.assertTrue(40 <= len(part.cells) <= 100, len(part.cells))
        cells = part.connectivity.reshape(-1, 2)
        numpy.testing.assert_array_equal(cells[1:, 0], cells[:-1, 1])


class BodiesTest(unittest.TestCase):
    def test_shapes_are_those_of_the_deck(self):
        deck = ResolvedDeck(
            '<ParameterList name="culm"><ParameterList name="Structures">'
            '<ParameterList name="box"><Parameter name="Type" value="Rigid Box"/>'
            '<Parameter name="Size" value="{1, 2, 3}"/></ParameterList>'
            '<ParameterList name="beam"><Parameter name="Type" value="Beam"/></ParameterList>'
            "</ParameterList></ParameterList>"
        )
        self.assertEqual(shape_of(deck, "box"), {"kind": "box", "size": [1.0, 2.0, 3.0]})
        self.assertIsNone(shape_of(deck, "beam"))


class ModulesTest(unittest.TestCase):
    def test_all_modules_are_in_the_page(self):
        self.assertEqual(sorted(MODULES), sorted(path.stem for path in PARTS.glob("*.js")))


if __name__ == "__main__":
    unittest.main()
