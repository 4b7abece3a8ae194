"""Orders, limits and distances on sequences whose limits are known."""

import unittest

import numpy

from culm.quantities import Measure, Watched
from culm.study.fit import order_of_differences, order_of_errors
from culm.study.reference import corner_limit, limit

SIZES = [0.8, 0.4, 0.2, 0.1, 0.05]


class FakeHistory:
    def __init__(self, levels, **columns):
        self.levels = list(levels)
        self.names = list(columns)
        self.columns = {name: list(values) for name, values in columns.items()}

    def owned(self, quantities):
        return {one: {name: "" for name in self.names if name.startswith(f"{one} ")} for one in quantities}


def history(levels, **columns):
    return FakeHistory(levels, **{name.replace("_", " ") + " [m]": values for name, values in columns.items()})


def measure(*histories, norm="rms"):
    return Measure([Watched("tip", entry="tip")], norm, histories)


class Orders(unittest.TestCase):
    def test_of_a_pure_power(self):
        for p in (1.0, 2.0, 4.0, 6.0):
            errors = [3.0 * h**p for h in SIZES]
            self.assertAlmostEqual(order_of_errors(SIZES, errors).value, p, 6)
            differences = [a - b for a, b in zip(errors, errors[1:])]
            self.assertAlmostEqual(order_of_differences(SIZES, differences).value, p, 6)

    def test_of_unequal_ratios(self):
        sizes = [1.0, 0.7, 0.3, 0.2]
        values = [h**3 for h in sizes]
        found = order_of_differences(sizes, [a - b for a, b in zip(values, values[1:])])
        self.assertAlmostEqual(found.value, 3.0, 6)

    def test_interval_covers_the_truth_as_often_as_it_says(self):
        generator = numpy.random.default_rng(1)
        covered = 0
        for _ in range(400):
            # three values: the tail is not chosen by its interval
            errors = [h**2 * numpy.exp(0.1 * generator.standard_normal()) for h in SIZES[:3]]
            found = order_of_errors(SIZES[:3], errors)
            covered += abs(found.value - 2.0) <= found.half_width
        self.assertGreater(covered, 0.92 * 400)
        self.assertLess(covered, 0.98 * 400)

    def test_coarse_values_off_the_law_are_left_out(self):
        errors = [h**2 for h in SIZES]
        errors[0] *= 5.0
        found = order_of_errors(SIZES, errors)
        self.assertAlmostEqual(found.value, 2.0, 6)
        self.assertEqual(found.used, 4)

    def test_two_values_have_no_interval(self):
        self.assertIsNone(order_of_errors([2.0, 1.0], [4.0, 1.0]).half_width)

    def test_none_where_errors_grow_or_vanish(self):
        self.assertIsNone(order_of_errors([2.0, 1.0, 0.5], [1.0, 2.0, 4.0]))
        self.assertIsNone(order_of_errors([2.0, 1.0, 0.5], [1.0, 0.5, 0.0]))


class Limits(unittest.TestCase):
    def setUp(self):
        self.times = numpy.linspace(0.0, 1.0, 5)
        self.exact = numpy.column_stack([numpy.sin(self.times), numpy.cos(self.times)])
        self.error = numpy.column_stack([self.times, 1.0 - self.times])
        self.measure = measure(history(self.times, tip_x=self.times, tip_y=self.times))
        self.measure.refer_to(self.exact)

    def states(self, law):
        return [self.exact + law(h) * self.error for h in SIZES]

    def test_uncertainty_bounds_the_error_of_the_limit(self):
        # with a term of higher order that the extrapolation does not know
        for law in (lambda h: h**2 + 0.5 * h**4, lambda h: h**2 - 0.4 * h**3, lambda h: h**4 + h**6):
            for count in (3, 4, 5):
                found = limit(SIZES[:count], self.states(law)[:count], self.measure)
                error = self.measure.size(found.value - self.exact)
                self.assertLess(error, found.uncertainty["tip"])
                self.assertLess(error, self.measure.size(self.states(law)[count - 1] - self.exact))

    def test_noise_is_not_extrapolated(self):
        states = [self.exact + a * self.error for a in (0.3, 0.1, -0.2)]
        found = limit(SIZES[:3], states, self.measure)
        self.assertTrue(numpy.array_equal(found.value, states[-1]))
        self.assertGreaterEqual(found.uncertainty["tip"], self.measure.size(states[-1] - self.exact))

    def test_corrections_of_two_sizes_add_up(self):
        def state(h, k):
            return self.exact + (h**2 + 0.3 * k**4) * self.error

        lines = [
            (SIZES, [state(h, SIZES[-1]) for h in SIZES]),
            (SIZES, [state(SIZES[-1], k) for k in SIZES]),
        ]
        found = corner_limit(state(SIZES[-1], SIZES[-1]), lines, self.measure)
        self.assertLess(self.measure.size(found.value - self.exact), 1e-10)


class Distances(unittest.TestCase):
    def test_common_levels_of_different_steps(self):
        coarse = history([0.0, 0.5, 1.0], tip_x=[0.0, 1.0, 2.0])
        fine = history([0.0, 0.25, 0.5, 0.75, 1.0], tip_x=[0.0, 9.0, 1.5, 9.0, 2.0])
        one = measure(coarse, fine)
        self.assertEqual(list(one.levels), [0.0, 0.5, 1.0])
        self.assertEqual(one.state(fine)[:, 0].tolist(), [0.0, 1.5, 2.0])

    def test_levels_that_were_not_met_by_cubics(self):
        levels = numpy.linspace(0.0, 1.0, 12)
        coarse = history([0.0, 0.3, 0.77, 1.0], tip_x=[0.0] * 4)
        fine = history(levels, tip_x=levels**3)
        self.assertTrue(numpy.allclose(measure(coarse, fine).state(fine)[:, 0], [0.0, 0.027, 0.77**3, 1.0]))

    def test_what_came_before_time_began_again_is_left_out(self):
        run = history([0.0, 1.0, 0.0, 0.5, 1.0], tip_x=[7.0, 7.0, 0.0, 1.0, 2.0])
        self.assertEqual(list(measure(run).levels), [0.0, 0.5, 1.0])

    def test_norms(self):
        run = history([0.0, 1.0, 2.0], tip_x=[0.0, 3.0, 0.0], tip_y=[0.0, 4.0, 1.0])
        for norm, size in (("rms", (0.5 * 25.0 + 0.25) ** 0.5), ("max", 5.0), ("end", 1.0)):
            one = measure(run, norm=norm)
            self.assertAlmostEqual(one.size(one.state(run)), size)

    def test_is_relative_to_the_reference(self):
        run = history([0.0, 1.0], tip_x=[2.0, 2.0])
        one = measure(run)
        one.refer_to(one.state(run))
        self.assertAlmostEqual(one.size(0.1 * one.state(run)), 0.1)


if __name__ == "__main__":
    unittest.main()
