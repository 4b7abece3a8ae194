"""Finds how far a number can grow before a run is no longer good."""

import dataclasses
import math


@dataclasses.dataclass(frozen=True)
class Margin:
    last_good: float  # nan if not even the recommended value is good
    first_bad: float  # inf if none was found
    verdict: object  # of the first bad value; of the last good one if none was found

    @property
    def is_open(self):
        """No limit was found."""
        return math.isinf(self.first_bad)


def search(judge, recommended, limit, growth=10.0, resolution=1.1, whole=False):
    """Geometric growth up to recommended * limit, then bisection of the exponent.

    What is found is the first limit on the way: beyond it values may be good again.

    @param judge       verdict, with .good, of a value
    @param resolution  ends when first bad over last good is not more than this
    @param whole       only whole numbers make sense
    """
    rounded = (lambda value: float(round(value))) if whole else (lambda value: value)
    verdict = judge(recommended)
    if not verdict.good:
        return Margin(math.nan, recommended, verdict)
    good, end = recommended, rounded(recommended * limit)
    while True:
        value = min(rounded(good * growth), end)
        latest = judge(value)
        if not latest.good:
            return _bisect(judge, good, value, latest, resolution, rounded)
        if value == end:
            return Margin(end, math.inf, latest)
        good = value


def _bisect(judge, good, bad, verdict, resolution, rounded):
    while bad / good > resolution:
        middle = rounded(math.sqrt(good * bad))
        if middle in (good, bad):
            break
        latest = judge(middle)
        if latest.good:
            good = middle
        else:
            bad, verdict = middle, latest
    return Margin(good, bad, verdict)
