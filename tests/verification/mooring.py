#!/usr/bin/python3
"""C20: mooring lines at rest, a spar on three of them. Page: doc/verification/mooring.md."""

import pathlib
import re
import tempfile

import numpy as np
from verify import INPUTS, main

DECK = "offshore/moored_spar.xml"
HELD = [f"Constraints/{axis}/{one}" for axis, direction in
        (("roll", "{1, 0, 0}"), ("pitch", "{0, 1, 0}"), ("yaw", "{0, 0, 1}"))
        for one in ("Type=Rotation", "Node=spar", f"Axis={direction}")]
# h, z, L, w, EA, whether there is a seabed; H, V and the length on it; allowed [m]
LINES = {
    "hanging free, inextensible": ((100, 20, 130, 1000, 1e16, "false"), (39804.646976, 76764.775284, 0.0), 1e-8),
    "on the ground, inextensible": ((400, 200, 500, 800, 1e17, "true"), (96643.4804, 237751.7901, 202.81026), 1e-5),
    "on the ground, MoorPy": ((400, 200, 500, 800, 7.51e12, "true"), (96643.428, 237751.755, 202.810306), 1e-4)}
ALONE = [f"Analyses/{one}/Inactive={{weight, buoyancy, waterplane, line 2, line 3}}" for one in ("rest", "pulled", "decay")]


def pulled_line(culm, data, H, V, friction=0.0):
    """How far the fairlead of line 1 moves from (h, z) under H and V, its length on the ground, and the tension at its anchor."""
    h, z, length, weight, stiffness, seabed = data
    entry = "Loads/line 1"
    # nothing moves, so the certificate of the motion that follows has nothing to relate rounding to
    history = culm.run(DECK, [
        f"{entry}/Offset={{0, 0, 0}}", f"{entry}/Anchor={{{h}, 0, {-z}}}", f"{entry}/Length={length}",
        f"{entry}/Weight={weight}", f"{entry}/EA={stiffness}", f"{entry}/Seabed={seabed}", f"{entry}/Friction={friction}", *HELD, *ALONE,
        f"Loads/pull/Force={{{-H}, 0, {V}}}", "Loads/pull/Function=Constant", "Output/History/line 2/Load=line 1",
        "Analyses/decay/End Time=0.5"]).history
    return (max(abs(history.column(f"spar u{x} [m]")[1]) for x in "xz"),
            *(history.column(f"line 1 {name}")[1] for name in ("grounded [m]", "anchor [N]")))


def place_by_pieces(H, V, length, weight, stiffness, friction, pieces=100000):
    """Where the fairlead is, and the tension at the anchor: sums over pieces of the line, from the fairlead down."""
    s = length - (np.arange(pieces) + 0.5) * length / pieces  # from the anchor
    vertical = np.maximum(V - weight * (length - s), 0.0)
    grounded = length - V / weight
    tension = np.where(vertical > 0.0, np.hypot(H, vertical), np.maximum(H - friction * weight * (grounded - s), 0.0))
    stretched = (1.0 + tension / stiffness) * length / pieces
    cosine = np.where(vertical > 0.0, H / np.hypot(H, vertical), 1.0)
    return np.sum(stretched * cosine), np.sum(stretched * np.sqrt(1.0 - cosine**2)), max(H - friction * weight * grounded, 0.0)


def verify_lines(culm, report):
    report.title("C20: a fairlead pulled by H and V stays at (h, z) [m]")
    for name, (data, (H, V, grounded), allowed) in LINES.items():
        moved, found, _ = pulled_line(culm, data, H, V)
        report.check(f"{name}: moves", moved, 0.0, allowed)
        report.check(f"{name}: on the ground", found, grounded, 1e-4)


def verify_friction(culm, report):
    report.title("friction on the seabed")
    *_, anchor = pulled_line(culm, (400, 200, 500, 800, 7.51e12, "true"), 96643.428, 237751.755, 0.1)
    report.relative("tension at the anchor, MoorPy [N]", anchor, 80418.604, 1e-6)
    for friction in (0.1, 1.0):
        h, z, wanted = place_by_pieces(9e4, 2.3e5, 500, 800, 2e6, friction)
        moved, _, anchor = pulled_line(culm, (h, z, 500, 800, 2e6, "true"), 9e4, 2.3e5, friction)
        report.check(f"a soft line, C_B = {friction}, by sums over pieces: moves [m]", moved, 0.0, 1e-5)
        report.check("tension at the anchor [N]", anchor, wanted, 1.0)
    run = culm.run(DECK, [f"Loads/line {i}/Friction=0.5" for i in (1, 2, 3)], quiet=False)
    report.holds("free decay, C_B = 0.5: energy balance", run.drift("energy balance"), 1e-9)
    report.note(f"work of friction {run.books()['work of loads']:.4g} J")


def verify_spar(culm, report):
    report.title("OC3-Hywind's lines at rest: Jonkman (2010), four digits")
    settings = [*HELD, "Loads/pull/Force={-100, 0, 0}", "Analyses/decay/End Time=0.5"]
    history = culm.run(DECK, settings).history
    pull = 3.0 * history.column("line 1 V [N]")[1]
    report.relative("vertical force of three lines [N]", pull, 1607000.0, 5e-4)
    moved = history.column("spar ux [m]")
    rest, pulled = (moved[max(row for row, one in enumerate(history.analyses) if one == number)] for number in (0, 1))
    report.relative("stiffness in surge [N/m]", -100.0 / (pulled - rest), 41180.0, 5e-4)
    report.title("free decay, 200 s")
    for form in ("Null Space", "Multipliers"):
        run = culm.run(DECK, [f"Solver/Form={form}"], quiet=False)
        report.holds(f"{form}: energy balance", run.drift("energy balance"), 1e-9)


def verify_waves(culm, report):
    report.title("the spar of water/spar.xml on these three lines in irregular waves, 30 s")
    pattern = r'    <ParameterList name="line.*?\n    </ParameterList>\n'
    lines = "".join(re.findall(pattern, (INPUTS / DECK).read_text(), re.S)[:3])
    afloat = (INPUTS / "water/spar.xml").read_text()
    springs = re.findall(pattern, afloat, re.S)
    for spring in springs:
        afloat = afloat.replace(spring, lines if spring == springs[0] else "")
    variables = '<Variable name="Rf" value="5.2"/><Variable name="Ra" value="853.87"/>'
    afloat = afloat.replace('<ParameterList name="Structures">', variables + '<ParameterList name="Structures">', 1).replace(
        'value="spar"', 'value="turbine"')
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        deck = pathlib.Path(folder) / "moored.xml"
        deck.write_text(afloat)
        for friction in (0.0, 0.5):
            run = culm.run(deck, [f"Loads/line {i}/Friction={friction}" for i in (1, 2, 3)], quiet=False)
            for what in ("energy balance", "linear momentum", "angular momentum"):
                report.holds(f"C_B = {friction}: {what}", run.drift(what), 1e-9)
            report.note(f"it drifts by {max(map(abs, run.history.column('deck ux [m]'))):.3f} m")


def verify(culm, report):
    verify_lines(culm, report)
    verify_friction(culm, report)
    verify_spar(culm, report)
    verify_waves(culm, report)


main(verify)
