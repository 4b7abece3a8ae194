#!/usr/bin/env python3
"""What only Abaqus has: parts and instances in their places, surfaces, couplings, named supports."""

import sys

import numpy
import samples
from reading import made_of_text


def main():
    made = made_of_text("abaqus", samples.parts())
    model = made.made
    # the second strip stands: from (2.5, 0, 0), along z
    expected = {("FLAT", 3): (2, 0, 0), ("UP", 1): (2.5, 0, 0), ("UP", 3): (2.5, 0, 2), ("UP", 6): (2.5, 1, 2)}
    (coupling,) = model.couplings
    pressure = next(load for load in model.element_loads if load.kind == "pressure")
    facts = {
        "instances are not in their places": all(numpy.allclose(model.nodes[n], x) for n, x in expected.items()),
        f"the mass is {made.mass}": abs(made.mass - (4 * 0.1 * 7850 + 50)) < 1e-9,
        f"{coupling.followers} follow": coupling.reference == 1
        and set(coupling.followers) == {("FLAT", 3), ("FLAT", 6), ("UP", 1), ("UP", 4)},
        "the pressure on SPOS does not push against the normal": pressure.value == -1000 and len(pressure.elements) == 2,
        "the feet are not held": set(model.supports[0].nodes) == {("FLAT", 1), ("FLAT", 4)} and len(model.supports[0].held) == 6,
        "the modes do not start from the loaded state": model.steps[1].preloaded == "push",
        "the sum of forces is another one": numpy.allclose(
            sum(len(load.nodes) * load.vector[:3] for load in model.node_loads), [0, 300, -40]
        ),
    }
    sys.exit("\n".join(complaint for complaint, holds in facts.items() if not holds) or 0)


if __name__ == "__main__":
    main()
