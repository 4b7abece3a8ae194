"""What the verification programs share: runs, comparisons that are printed and counted, plots.

Each program offers verify(culm, report) and may offer plot(culm, path) and fine(culm, report), what
takes too long for every run of the tests. By hand:

    tests/verification/roll_up.py --culm build/release/src/culm [--plot roll_up.png] [--fine]
"""

import argparse
import cmath
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "kit"))
from culm_runs import INPUTS, Culm  # noqa: E402, F401


class Report:
    """Prints every comparison and remembers whether all of them held."""

    def __init__(self):
        self.failures = 0

    def title(self, text):
        print(f"\n{text}")

    def check(self, what, found, wanted, tolerance):
        """|found - wanted| <= tolerance, numbers or lists of numbers (largest difference)."""
        pairs = list(zip(found, wanted)) if isinstance(found, (list, tuple)) else [(found, wanted)]
        difference = max(abs(a - b) for a, b in pairs)
        self.holds(f"{what}: {_text(found)}, reference {_text(wanted)}", difference, tolerance)

    def relative(self, what, found, wanted, tolerance):
        """|found - wanted| <= tolerance |wanted| in the Euclidean norm of numbers or lists."""
        a = found if isinstance(found, (list, tuple)) else [found]
        b = wanted if isinstance(wanted, (list, tuple)) else [wanted]
        error = math.dist(a, b) / math.hypot(*b)
        self.holds(f"{what}: {_text(found)}, reference {_text(wanted)}, relative", error, tolerance)

    def holds(self, what, error, tolerance):
        sound = error <= tolerance  # false for a NaN
        self.failures += not sound
        mark = "" if sound else "   <-- VIOLATED"
        print(f"  {what} error {error:.2e} (allowed {tolerance:.1e}){mark}")

    def note(self, text):
        print(f"  {text}")


def _text(value):
    if isinstance(value, (list, tuple)):
        return "(" + ", ".join(f"{v:.8g}" for v in value) + ")"
    return f"{value:.8g}"


def gain(books):
    """What the energies of a run gained beyond what its certificate books (`Run.books`) [J]."""
    energies = sum(books[f"{kind} energy"] for kind in ("kinetic", "strain", "potential"))
    flows = books["work of loads"] + books["work of drives"]
    return energies - flows + books["energy taken by dampers"] + books["energy taken by dissipation"]


def richardson(coarse, fine, order=2, ratio=2):
    """The limit of quantities whose error falls with the given power of the mesh width."""
    factor = ratio**order
    if isinstance(coarse, (list, tuple)):
        return [richardson(a, b, order, ratio) for a, b in zip(coarse, fine)]
    return fine + (fine - coarse) / (factor - 1)


def romberg(values, orders=(2, 4)):
    """Repeated Richardson extrapolation of values on meshes that are halved each time."""
    for order in orders[: len(values) - 1]:
        values = [richardson(a, b, order) for a, b in zip(values, values[1:])]
    return values[-1]


def poles(times, values, order=6):
    """Exponents of a sum of decaying oscillations, by a matrix pencil of the given order."""
    import numpy as np

    columns = len(values) // 3
    hankel = np.lib.stride_tricks.sliding_window_view(values, columns + 1)
    _, _, right = np.linalg.svd(hankel, full_matrices=False)
    basis = right[:order].conj().T
    shift = np.linalg.lstsq(basis[:-1], basis[1:], rcond=None)[0]
    return [cmath.log(z) / (times[1] - times[0]) for z in np.linalg.eigvals(shift)]


def main(verify, plot=None, fine=None):
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True, help="the program")
    if plot:
        parser.add_argument("--plot", help="draw the figure of the page into this file instead")
    if fine:
        parser.add_argument("--fine", action="store_true", help="fine meshes as well")
    arguments = parser.parse_args()
    culm = Culm(arguments.culm, keeps=True)
    if plot and arguments.plot:
        plot(culm, arguments.plot)
        return
    report = Report()
    verify(culm, report)
    if fine and arguments.fine:
        fine(culm, report)
    print(f"\n{report.failures} violations" if report.failures else "\nall held")
    sys.exit(1 if report.failures else 0)


def figure(columns=1, height=3.6, rows=1):
    """A figure of the pages and its axes, an array of them where there are several; reference as markers, culm as lines."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot

    style = {"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.4}
    pyplot.rcParams.update(style)
    return pyplot.subplots(rows, columns, figsize=(4.4 * columns + 0.4, height), layout="constrained")


def mesh_axis(axes, counts):
    """Plain numbers at the meshes of a logarithmic axis."""
    axes.set_xticks(counts, [str(n) for n in counts])
    axes.set_xticks([], minor=True)


def save(fig, path):
    fig.savefig(path, dpi=110)
    print(path)
