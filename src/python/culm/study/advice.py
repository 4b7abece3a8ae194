"""What accuracy costs: the Pareto front, one sentence, and the deck that reaches a target."""

import dataclasses
import math

DECADES = [10.0**-k for k in range(1, 10)]
SHARE_OF_TARGET = 0.9  # what an interpolated setting aims at


@dataclasses.dataclass
class Promise:
    """Settings that should reach a target."""

    settings: list  # without those that all runs share
    label: str
    error: float
    cpu: float
    index: tuple | None  # of a run that was made; None for one between two of them


def front(points):
    """The points that no other one beats in both cost and error, from cheap to dear."""
    best = []
    succeeded = [point for point in points if point.succeeded]
    for point in sorted(succeeded, key=lambda p: (p.record.cpu, p.bound)):
        if not best or point.bound < best[-1].bound:
            best.append(point)
    return best


def sentence(judgement):
    """'one per cent costs 0.8 s with …, 0.1 per cent 5 s with …'."""
    choices = []  # (decade, point): the tightest decade for which a run is the cheapest
    for decade in DECADES:
        reached = [point for point in judgement.points.values() if point.succeeded and point.bound <= decade]
        if not reached:
            break
        cheapest = _cheapest(reached)
        if choices and choices[-1][1] is cheapest:
            choices.pop()
        choices.append((decade, cheapest))
    if not choices:
        best = min(point.bound for point in judgement.points.values() if point.succeeded)
        return f"no run reached ten per cent; the best error is {best:.2g}"
    parts = [
        f"{per_cent(decade)} {'costs ' if i == 0 else ''}{seconds(point.record.cpu)} with "
        f"{judgement.label(point.index)}"
        for i, (decade, point) in enumerate(choices[-4:])
    ]
    return "; ".join(parts)


def _cheapest(points):
    """The most accurate of those that cost as much as the cheapest one, by the spread of its times."""
    least = min(points, key=lambda point: point.record.cpu)
    as_cheap = [point for point in points if point.record.cpu <= max(least.record.times)]
    return min(as_cheap, key=lambda point: (point.bound, point.record.cpu))


def promises(judgement, target):
    """Settings that should reach a target, the cheapest first; empty if no run did."""
    found = [
        Promise(
            _settings(judgement, point.index),
            judgement.label(point.index),
            point.bound,
            point.record.cpu,
            point.index,
        )
        for point in front(judgement.points.values())
        if point.bound <= target
    ]
    if not found:
        return []
    for index, point in judgement.points.items():
        for a in judgement.refined:
            neighbour = (*index[:a], index[a] + 1, *index[a + 1 :])
            fine = judgement.points.get(neighbour)
            if fine and point.succeeded and fine.succeeded and point.bound > target >= fine.bound:
                found += _between(judgement, point, fine, a, target)
    return sorted(found, key=lambda promise: promise.cpu)


def _between(judgement, coarse, fine, a, target):
    """A setting between a run that misses the target and its finer neighbour along an axis that reaches
    it: error and cost follow power laws between the two."""
    axis = judgement.axes[a]
    fall = math.log(coarse.bound / fine.bound)
    aim = max(SHARE_OF_TARGET * target, math.sqrt(fine.bound * target))
    value = axis.between(coarse.index[a], fine.index[a], math.log(coarse.bound / aim) / fall)
    if value is None:
        return []
    first, last = axis.number(coarse.index[a]), axis.number(fine.index[a])
    share = math.log(float(value) / first) / math.log(last / first)  # of what was rounded
    settings, labels = [], []
    for other, i in zip(judgement.axes, coarse.index):
        settings += axis.settings_of(value) if other is axis else other.settings(i)
        labels.append(f"{axis.leaf}={value}" if other is axis else other.label(i))
    cpu = coarse.record.cpu * (fine.record.cpu / coarse.record.cpu) ** share
    return [Promise(settings, ", ".join(labels), coarse.bound * math.exp(-share * fall), cpu, None)]


def _settings(judgement, index):
    return [setting for axis, i in zip(judgement.axes, index) for setting in axis.settings(i)]


def per_cent(share):
    names = {0.1: "ten per cent", 0.01: "one per cent"}
    for value, name in names.items():
        if math.isclose(share, value):
            return name
    return f"{100.0 * share:g} per cent" if share > 5e-6 else f"{share:.0e}"


def seconds(time):
    return f"{time:.2g} s" if time < 100.0 else f"{time:.0f} s"
