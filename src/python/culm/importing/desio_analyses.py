"""Simulations of DeSiO-Structure."""

from .findings import refuse

ARC_CONTROLS = {1: "Linearised Sphere", 2: "Normal Plane", 3: "Sphere"}


def _static(entry, row, findings):
    final, step = row.values[:2]
    _check_step(step, final, row)
    entry.add("Type", "Static").add("Final Level", final).add("Steps", max(1, round(final / step)))


def _dynamic(entry, row, findings):
    end, step = row.values[:2]
    _check_step(step, end, row)
    entry.add("Type", "Dynamic").add("Start Time", 0).add("End Time", end).add("Step", step)


def _path(entry, row, findings):
    final, step = row.values[:2]
    _check_step(step, final, row)
    entry.add("Type", "Path").add("Final Level", final).add("First Increment", step)
    if len(row.values) > 4:
        control = ARC_CONTROLS.get(int(row.values[4]))
        if control is None:
            refuse(row.place, f"the arc-length method must be 1, 2 or 3, got {row.values[4]:g}")
        entry.add("Control", control)
    if len(row.values) > 5 and row.values[5] > 0:
        entry.add("Desired Iterations", int(row.values[5]))


def _modes(type):
    def make(entry, row, findings):
        if not 1 <= row.values[0] <= 1e5:
            refuse(row.place, f"the number of modes must be between 1 and 100000, got {row.values[0]:g}")
        entry.add("Type", type).add("Modes", int(row.values[0]))
        if len(row.values) > 2 and row.values[2] > 0.0:
            findings.assume("of modes the lowest ones are found, whatever the least value of the file is", row.place)

    return make


def _check_step(step, end, row):
    if not 0.0 < step or not 0.0 < end or end / step > 1e7:
        refuse(row.place, f"end and step must be > 0 and at most 1e7 steps apart, got {end:g} and {step:g}")


# kind -> (entry, row, findings), which fills the list of an analysis of a deck
ANALYSES = {
    "static": _static,
    "dynamic": _dynamic,
    "static_arc": _path,
    "modal": _modes("Modal"),
    "buckling": _modes("Buckling"),
}
