"""Observed orders of convergence with confidence intervals."""

import dataclasses
import math

import numpy

# 97.5 % quantiles of Student's t by degrees of freedom
STUDENT = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228]
LEAST, MOST = 0.05, 12.0  # orders that are looked for


@dataclasses.dataclass
class Order:
    """An observed order: value, half of its 95 % interval (None from two values), and how many of the
    finest values it rests on."""

    value: float
    half_width: float | None
    used: int

    def __str__(self):
        if self.half_width is None:
            return f"{self.value:.2f}"
        return f"{self.value:.2f} ± {max(self.half_width, 0.005):.2f}"


def order_of_differences(sizes, differences):
    """The p of q(h) = q + C h^p from d_i = |q(h_i) – q(h_i+1)|, which needs no limit.

    @param sizes        one more than differences, from coarse to fine
    """
    sizes = numpy.asarray(sizes, float)
    return _best_tail(
        lambda p, first: numpy.log(sizes[first:-1] ** p - sizes[first + 1 :] ** p), differences
    )


def order_of_errors(sizes, errors):
    """The p of e(h) = C h^p."""
    sizes = numpy.asarray(sizes, float)
    return _best_tail(lambda p, first: p * numpy.log(sizes[first:]), errors)


def _best_tail(model, data):
    """The coarsest values are left out as long as that makes the interval smaller: they need not yet
    show the order. None where there is no order."""
    data = numpy.asarray(data, float)
    if len(data) < 2 or not numpy.all(data > 0.0):
        return None
    firsts = range(max(len(data) - 2, 1))  # at least three values, if there are so many
    orders = [_fit(lambda p, first=first: model(p, first), numpy.log(data[first:])) for first in firsts]
    orders = [order for order in orders if order is not None]
    # of equal ones the first, which rests on most values
    return min(orders, key=lambda order: round(order.half_width or 0.0, 4)) if orders else None


def _fit(model, values):
    """Least squares of values = c + model(p) over c and p."""

    def misfit(p):
        rest = values - model(p)
        return rest - rest.mean()

    p = 2.0
    for _ in range(60):
        step = 1e-5 * p
        slope = (misfit(p + step) - misfit(p - step)) / (2.0 * step)
        change = -(slope @ misfit(p)) / max(slope @ slope, 1e-300)
        p = min(max(p + max(min(change, 1.0), -0.5 * p), LEAST), MOST)
        if abs(change) < 1e-10:
            break
    if p in (LEAST, MOST):
        return None
    freedom = len(values) - 2
    if freedom == 0:
        return Order(p, None, len(values))
    rest = misfit(p)
    quantile = STUDENT[freedom - 1] if freedom <= len(STUDENT) else 2.0
    return Order(p, quantile * math.sqrt(rest @ rest / freedom / (slope @ slope)), len(values))
