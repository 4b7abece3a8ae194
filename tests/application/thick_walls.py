"""Walls without a shear correction: what the warning says of displacements and frequencies is what the correction
changes, and thin walls hear nothing."""

import argparse
import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.program import Program  # noqa: E402

WARNING = re.compile(r"(displacements are|frequency is) about (\S+) % too (small|high) without a shear correction")
PLATE = ROOT / "inputs/shell/angle_ply.xml"
MODES = ROOT / "inputs/modes/plate.xml"
# To first order in what is missing: the stiffer state, whose energies tell, is not the softer one.
SHARE_OF_ERROR = 0.3


def deflection(run):
    return abs(run.history.column("centre uz [m]")[-1])


def flexibility(run):
    rate = float(re.search(r"^ +1 +(\S+) Hz", run.output, re.M).group(1))
    return 1.0 / rate


# deck, what gives way, the wall, settings: thick and thin
CASES = {
    "plate under load": (PLATE, deflection, "shell", ["h=0.25"], ["h=0.05"]),
    "path of a plate": (
        PLATE,
        deflection,
        "shell",
        ["h=0.25", "Analyses/loading/Type=Path"],
        ["h=0.05", "Analyses/loading/Type=Path"],
    ),
    "modes of a plate": (MODES, flexibility, "plate", ["Structures/plate/Thickness=5"], []),
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--culm", required=True)
    program = Program(parser.parse_args().culm)
    complaints = []
    with tempfile.TemporaryDirectory(prefix="culm") as name:
        folder = pathlib.Path(name)

        def run(deck, settings, wall, correction):
            found = program.run(deck, folder, [*settings, f"Structures/{wall}/Shear Correction={correction}"])
            if not found.succeeded:
                sys.exit(found.errors)
            return found, WARNING.search(found.errors)

        for title, (deck, measure, wall, thick, thin) in CASES.items():
            bare, warning = run(deck, thick, wall, "None")
            without = measure(bare)
            mended, silence = run(deck, thick, wall, "Equilibrium")
            error = 100.0 * (measure(mended) / without - 1.0)
            said = float(warning.group(2)) if warning else 0.0
            print(f"{title}: {error:.2f} % too stiff, the warning says {said} %")
            if abs(said - error) > SHARE_OF_ERROR * error:
                complaints.append(f"{title}: {bare.errors}")
            if silence or run(deck, thin, wall, "None")[1]:
                complaints.append(f"{title}: warned without need")
    for complaint in complaints:
        print(f"FAILED: {complaint}")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
