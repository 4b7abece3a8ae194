#!/usr/bin/python3
"""Which order of beam elements a given accuracy costs least with. Page: doc/verification/beam_elements.md."""

import dataclasses
import math
import resource

from verify import main

ORDERS = (1, 2, 3)


@dataclasses.dataclass
class Problem:
    """A deck with beams of one mesh. Meshes count intervals between nodes, so that they cost about
    the same with each order; errors are relative to the finest mesh of order 3."""

    name: str
    deck: str
    structures: tuple
    result: object  # of a run: a list of numbers
    intervals: tuple = (12, 24, 48)
    settings: tuple = ()
    elements: str = "n"
    nodes: object = None  # settings by the number of intervals

    def run(self, culm, order, elements):
        intervals = order * elements
        settings = list(self.settings) + (self.nodes(intervals) if self.nodes else [])
        for structure in self.structures:
            text = self.elements.replace("n", str(elements))
            settings += [f"Structures/{structure}/Curve/Elements={text}",
                         f"Structures/{structure}/Order={order}"]
        return culm.succeed(self.deck, settings)

    def error(self, run, reference):
        found = self.result(run)
        return math.dist(found, reference) / math.hypot(*reference)


def end_of(quantity):
    return lambda run: run.history.vector(quantity)


def frequencies(run):
    """Of the first six modes, each of which counts alike."""
    return [math.log(f) for f in run.tables["modes/modes"].column("frequency [Hz]")[:6]]


def lee_point(intervals):
    """A fifth of the beam from the corner, which has two nodes."""
    return [f"Node Sets/load point/Nodes={{frame/{intervals + 1 + intervals // 5}}}"]


PROBLEMS = (
    Problem("cantilever rolled up to a half circle", "beam/roll_up.xml", ("beam",), end_of("tip"),
            settings=("Analyses/roll up/Steps=100", "Analyses/roll up/Final Level=0.5")),
    Problem("45 degree bend", "beam/bend_45.xml", ("bend",), end_of("tip"),
            settings=("Analyses/bending/Steps=100",)),
    Problem("elastica", "beam/elastica.xml", ("beam",), end_of("tip")),
    Problem("composite cantilever", "beam/composite_cantilever.xml", ("beam",), end_of("tip")),
    Problem("Princeton beam", "beam/princeton_beam.xml", ("beam",), end_of("tip")),
    Problem("tapered tower", "beam/tapered_tower.xml", ("tower",), end_of("top")),
    Problem("blade of the NREL 5 MW", "turbine/nrel5mw/blade_static.xml", ("blade",), end_of("tip")),
    Problem("Lee's frame, path to 0.9 of its limit", "beam/lee_frame_path.xml", ("frame",),
            end_of("load point"), (30, 60, 120), ("Analyses/loading/Final Level=1.67",),
            "{n, n}", lee_point),
    Problem("flying spaghetti, plane, 5 s", "flight/spaghetti_2d.xml", ("beam",), end_of("upper"),
            settings=("Analyses/motion/End Time=5", "Analyses/motion/Step=0.02")),
    Problem("flying spaghetti, space, 5 s", "flight/spaghetti_3d.xml", ("beam",), end_of("other end"),
            settings=("Analyses/motion/End Time=5",)),
    Problem("right-angle cantilever, 6 s", "beam/right_angle_cantilever.xml",
            ("root leg", "tip leg"), end_of("tip"), (6, 12, 24), ("Analyses/motion/End Time=6",)),
    Problem("hinged beam that falls, 1.2 s", "beam/hinged_beam.xml", ("beam",), end_of("tip"),
            settings=("Analyses/motion/End Time=1.2",)),
    Problem("modes of a cantilever", "modes/cantilever.xml", ("beam",), frequencies),
    Problem("modes of a frame", "modes/l_frame.xml", ("frame",), frequencies, elements="{n, n}"),
    Problem("modes in rotation", "modes/rotating_beam.xml", ("beam",),
            lambda run: [math.log(f) for f in run.tables["modes/modes"].column("frequency [Hz]")[:4]]),
)


def cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measured(culm, problem, order, elements, repetitions):
    """A run, and the least CPU time of some [s]."""
    times = []
    for _ in range(repetitions):
        before = cpu()
        run = problem.run(culm, order, elements)
        times.append(cpu() - before)
    return run, min(times)


def compare(culm, report, problem, repetitions=3):
    reference = problem.result(problem.run(culm, 3, 2 * problem.intervals[-1] // 3))
    report.title(problem.name)
    found = {}
    for intervals in problem.intervals:
        for order in ORDERS:
            run, time = measured(culm, problem, order, intervals // order, repetitions)
            found[order, intervals] = problem.error(run, reference)
            report.note(f"order {order}, {intervals // order:3d} elements, {intervals:3d} intervals: "
                        f"error {found[order, intervals]:.2e}, CPU {time:.2f} s")
    return found


def verify(culm, report):
    """With as many nodes, order 2 is better by far where beams bend much."""
    for name in ("45 degree bend", "flying spaghetti, space, 5 s"):
        problem = next(p for p in PROBLEMS if p.name == name)
        reference = problem.result(problem.run(culm, 3, 16))
        report.title(f"{name}, 24 intervals")
        errors = [problem.error(problem.run(culm, order, 24 // order), reference) for order in (1, 2)]
        report.holds(f"order 1 {errors[0]:.2e}, order 2", errors[1], errors[0] / 50.0)


def fine(culm, report):
    for problem in PROBLEMS:
        compare(culm, report, problem)


if __name__ == "__main__":
    main(verify, fine=fine)
