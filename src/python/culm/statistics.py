"""Statistics of histories: means over time, extremes, and loads that do the damage of a history.

Ranges are counted by the rainflow method of ASTM E1049-85 (2017), 5.4.4.
"""

import dataclasses

import numpy as np

EXPONENTS = (4, 10)  # of curves of stress against cycles: about those of steel and of glass fibres
EQUIVALENT_FREQUENCY = 1.0  # [Hz]


@dataclasses.dataclass
class Statistics:
    """Of one column; damage-equivalent loads by exponent."""

    mean: float
    least: float
    largest: float
    deviation: float
    equivalents: dict


def reversals(values):
    """First and last value, and those between at which the sign of the slope changes."""
    kept = []
    for value in values:
        if len(kept) > 1 and (kept[-1] - kept[-2]) * (value - kept[-1]) >= 0.0:
            kept[-1] = value
        elif not kept or value != kept[-1]:
            kept.append(value)
    return kept


def rainflow(values):
    """Ranges of a history and how often each occurs, a half or a whole cycle, as they are found."""
    found = []
    stack = []
    for value in reversals(values):
        stack.append(value)
        while len(stack) > 2:
            former = abs(stack[-2] - stack[-3])
            if abs(stack[-1] - stack[-2]) < former:
                break
            if len(stack) == 3:
                found.append((former, 0.5))
                del stack[0]
            else:
                found.append((former, 1.0))
                del stack[-3:-1]
    return found + [(abs(b - a), 0.5) for a, b in zip(stack, stack[1:])]


def equivalent_load(values, duration, exponent):
    """The range that, EQUIVALENT_FREQUENCY times a second, does the damage of all ranges of a history (Palmgren, Miner)."""
    damage = sum(count * size**exponent for size, count in rainflow(values))
    return (damage / (EQUIVALENT_FREQUENCY * duration)) ** (1.0 / exponent)


def of_column(times, values):
    """Statistics of a column that is linear between rising times, of which there must be two."""
    times, values = np.asarray(times, float), np.asarray(values, float)
    if len(times) < 2 or len(times) != len(values):
        raise ValueError(f"{len(times)} times and {len(values)} values; statistics need at least 2 times, and a value at each")
    duration = times[-1] - times[0]
    weights = np.zeros(len(times))
    weights[1:] += 0.5 * np.diff(times)
    weights[:-1] += 0.5 * np.diff(times)
    mean = (weights * values).sum() / duration
    deviation = np.sqrt((weights * (values - mean) ** 2).sum() / duration)
    equivalents = {m: equivalent_load(values.tolist(), duration, m) for m in EXPONENTS}
    return Statistics(mean, values.min(), values.max(), deviation, equivalents)
