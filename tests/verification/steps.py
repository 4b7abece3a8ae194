#!/usr/bin/python3
"""How well steps converge: the tolerance is met, or rounding is named; balances are kept.

Page: doc/verification/steps.md.
"""

import re

from verify import main  # puts culm_runs on the path

# deck, its motions, and what shortens it
DECKS = {
    "turbine": ("turbine/nrel5mw/turbine_operation.xml", ("start-up", "emergency stop"),
                ["stop=2", "end=4"]),
    "rotor": ("flight/rotor.xml", ("motion",), []),
    "spaghetti": ("flight/spaghetti_3d.xml", ("motion",), []),
    "chain": ("flight/chain.xml", ("motion",), []),
    "masses 1 to 1e6": ("hard/mass_ratio.xml", ("motion",), []),
    "stiffnesses 10 to 1e9": ("hard/stiffness_ratio.xml", ("motion",), []),
    "driven bars": ("joint/driven_bars.xml", ("motion",), ["Analyses/motion/End Time=1"]),
}
REFRESH = ("Every Iteration", "On Slow Convergence")
HELD = re.compile(r"in (\d+) of the steps rounding holds forces above 'Force Tolerance', "
                  r"most at (.*): (\S+)")


class Steps:
    """What the closing words of a run say about its steps."""

    def __init__(self, culm, deck, refresh, tolerance):
        path, motions, settings = DECKS[deck]
        newton = [f"Analyses/{motion}/Newton/{name}={value}" for motion in motions
                  for name, value in (("Force Tolerance", tolerance), ("Refresh", refresh))]
        run = culm.run(path, [*settings, *newton, "Output/Every=1000"], quiet=False)
        self.exit = run.exit
        if run.exit != 0:
            return
        self.accepted = int(re.search(r"(\d+) steps accepted", run.output).group(1))
        self.iterations = run.iterations()
        self.residual = float(re.search(r"residual: forces (\S+),", run.output).group(1))
        self.energy = run.drift("energy balance")
        self.broken = run.output.count("BROKEN")
        held = HELD.search(run.output)
        self.held = int(held.group(1)) if held else 0
        self.row = held.group(2) if held else ""


def verify_deck(culm, report, deck, tolerances):
    report.title(f"{deck}: tolerance, refresh, steps, iterations, worst residual, held, energy")
    for refresh in REFRESH:
        for tolerance in tolerances:
            steps = Steps(culm, deck, refresh, tolerance)
            what = f"{tolerance:g}, {refresh}"
            report.check(f"{what}: exit code", steps.exit, 0, 0)
            if steps.exit != 0:
                continue
            report.note(f"{steps.accepted} steps, {steps.iterations} iterations, residual "
                        f"{steps.residual:.1e}, {steps.held} held {steps.row}, "
                        f"energy {steps.energy:.1e}")
            report.check("broken promises", steps.broken, 0, 0)
            if not steps.held:
                report.holds("worst residual over the tolerance", steps.residual / tolerance, 1.05)


def verify(culm, report):
    for deck in DECKS:
        verify_deck(culm, report, deck, (1e-8, 1e-12))


def fine(culm, report):
    for deck in DECKS:
        verify_deck(culm, report, deck, (1e-8, 1e-10, 1e-12))


if __name__ == "__main__":
    main(verify, fine=fine)
