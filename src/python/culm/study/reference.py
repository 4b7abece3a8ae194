"""What the runs of a study are measured against: a limit by Richardson extrapolation, or a file."""

import dataclasses

import numpy

from .fit import order_of_differences

ROUNDING = 1e-10  # relative differences below this are not those of a discretisation
LEAST_ORDER = 0.3  # slower than this is no convergence to extrapolate


@dataclasses.dataclass
class Limit:
    """A limit of a sequence of states, or the correction towards it."""

    value: numpy.ndarray
    uncertainty: dict  # by quantity, relative


def limit(sizes, states, measure):
    """The limit of states on sizes that shrink, quantity by quantity.

    Three states give the order p and q = q3 + (q3 – q2)/((h2/h3)^p – 1). The uncertainty is the
    difference of this from the one of the three states before, at least a tenth of the correction;
    with three states only it is the correction itself. Differences that do not fall are not
    extrapolated: the last two of them are the uncertainty.
    """
    value = states[-1].copy()
    uncertainty = {}
    for title, part in measure.parts.items():
        columns = [state[:, part] for state in states]

        def norm(difference, title=title, part=part, shape=states[-1].shape):
            full = numpy.zeros(shape)
            full[:, part] = difference
            return measure.sizes(full)[title]

        value[:, part], uncertainty[title] = _limit_of_one(list(sizes), columns, norm)
    return Limit(value, uncertainty)


def corner_limit(corner, lines, measure):
    """The limit in several sizes at once: a state at the finest of all of them, and for each size the
    states along it that end there. Corrections and uncertainties add up."""
    value = corner.copy()
    uncertainty = dict.fromkeys(measure.parts, 0.0)
    for sizes, states in lines:
        one = limit(sizes, states, measure)
        value += one.value - corner
        for title in uncertainty:
            uncertainty[title] += one.uncertainty[title]
    return Limit(value, uncertainty)


def _limit_of_one(sizes, states, norm):
    if len(states) == 1:
        return states[0], 0.0
    differences = [norm(b - a) for a, b in zip(states, states[1:])]
    last = differences[-1]
    if len(states) == 2:
        return states[-1], last
    if max(differences[-2:]) < ROUNDING:
        return states[-1], max(differences[-2:])
    now = _extrapolate(sizes[-3:], states[-3:], differences[-2:])
    if now is None:
        return states[-1], max(differences[-2:])
    correction = norm(now - states[-1])
    before = _extrapolate(sizes[-4:-1], states[-4:-1], differences[-3:-1]) if len(states) > 3 else None
    if before is None:
        return now, correction
    return now, max(norm(now - before), 0.1 * correction)


def _extrapolate(sizes, states, differences):
    order = order_of_differences(sizes, differences) if min(differences) > 0.0 else None
    if order is None or order.value < LEAST_ORDER:
        return None
    ratio = sizes[-2] / sizes[-1]
    return states[-1] + (states[-1] - states[-2]) / (ratio**order.value - 1.0)
