"""The search for the largest value that is good."""

import collections
import math
import unittest

from culm.hard.search import search

Verdict = collections.namedtuple("Verdict", "good value")


class Judge:
    """Good up to a limit; remembers what it was asked."""

    def __init__(self, limit):
        self.limit = limit
        self.asked = []

    def __call__(self, value):
        self.asked.append(value)
        return Verdict(value <= self.limit, value)


class SearchTest(unittest.TestCase):
    def test_brackets_the_limit(self):
        judge = Judge(321.0)
        margin = search(judge, 2.0, 1e6, growth=10.0, resolution=1.1)
        self.assertLessEqual(margin.last_good, 321.0)
        self.assertGreater(margin.first_bad, 321.0)
        self.assertLessEqual(margin.first_bad / margin.last_good, 1.1)
        self.assertEqual(margin.verdict.value, margin.first_bad)
        self.assertFalse(margin.is_open)

    def test_is_cheap(self):
        judge = Judge(321.0)
        search(judge, 2.0, 1e6, growth=10.0, resolution=1.1)
        # the recommended value, three decades, log2(log(10)/log(1.1)) halvings of the exponent
        self.assertLessEqual(len(judge.asked), 1 + 3 + 5)

    def test_growth_without_limit_ends_at_the_limit(self):
        judge = Judge(math.inf)
        margin = search(judge, 2.0, 250.0, growth=10.0)
        self.assertTrue(margin.is_open)
        self.assertEqual(margin.last_good, 500.0)
        self.assertEqual(judge.asked, [2.0, 20.0, 200.0, 500.0])

    def test_a_recommended_value_that_is_bad(self):
        margin = search(Judge(1.0), 2.0, 1e6)
        self.assertTrue(math.isnan(margin.last_good))
        self.assertEqual(margin.first_bad, 2.0)

    def test_finds_the_first_limit_on_the_way(self):
        margin = search(lambda x: Verdict(x < 5 or x > 50, x), 1.0, 1e3, growth=10.0)
        self.assertLess(margin.last_good, 5.0)

    def test_coarse(self):
        judge = Judge(3.0e4)
        margin = search(judge, 1.0, 1e6, growth=100.0, resolution=3.0)
        self.assertLessEqual(margin.first_bad / margin.last_good, 3.0)
        self.assertEqual(len(judge.asked), 4 + 3)

    def test_whole_numbers(self):
        judge = Judge(7.0)
        margin = search(judge, 1.0, 100.0, growth=4.0, whole=True)
        self.assertEqual((margin.last_good, margin.first_bad), (7.0, 8.0))
        self.assertTrue(all(value == round(value) for value in judge.asked))


if __name__ == "__main__":
    unittest.main()
