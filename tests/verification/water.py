#!/usr/bin/python3
"""C17 to C19: waves on a pile, pressure on a brace, floating and wet frequencies. Page: doc/verification/water.md."""

import base64
import math
import pathlib
import re
import subprocess
import tempfile

import numpy as np
from verify import INPUTS, figure, main, save

G, RHO = 9.80665, 1025.0
PILE, BRACE, HEAVE, TUBE = (f"water/{name}.xml" for name in ("wave_on_pile", "brace", "heave", "wet_tube"))
HEIGHT, PERIOD, DEPTH, DIAMETER = 6.0, 10.0, 20.0, 6.0


def wave_number(omega, depth):
    k = omega**2 / G
    for _ in range(200):
        k -= (G * k * math.tanh(k * depth) - omega**2) / (
            G * math.tanh(k * depth) + G * k * depth / math.cosh(k * depth) ** 2)
    return k


def pile(phase, wheeler):
    """Force [N], and moment about the bed [N m], of the wave on a rigid pile at the time 0."""
    a, omega = 0.5 * HEIGHT, 2.0 * math.pi / PERIOD
    k = wave_number(omega, DEPTH)
    surface = a * math.cos(phase) if wheeler else 0.0
    xi, weights = np.polynomial.legendre.leggauss(40)
    z = -DEPTH + 0.5 * (1.0 + xi) * (DEPTH + surface)
    weights = 0.5 * weights * (DEPTH + surface)
    profile = DEPTH * (z - surface) / (DEPTH + surface) if wheeler else z
    shape = np.cosh(k * (profile + DEPTH)) / math.sinh(k * DEPTH)
    u, pull = a * omega * shape * math.cos(phase), a * omega**2 * shape * math.sin(phase)
    load = 0.5 * RHO * DIAMETER * np.abs(u) * u + RHO * 2.0 * math.pi / 4.0 * DIAMETER**2 * pull
    return float(weights @ load), float(weights @ (load * (z + DEPTH)))


def found_on_pile(culm, phase, *settings):
    history = culm.history(PILE, [f"p={phase!r}", "Sections/steel/Young Modulus=210e13", *settings])
    return -history.column("bed Fx [N]")[-1], -history.column("bed My [N m]")[-1]


def verify_pile(culm, report):
    report.title("C17: a wave on a pile, to still water")
    for name, phase, wanted in (("inertia", math.pi / 2.0, (1324297.0, 14314150.0)),
                                ("drag", 0.0, (207599.0, 2416500.0))):
        found = found_on_pile(culm, phase)
        report.relative(f"largest {name}, force [N]", found[0], pile(phase, False)[0], 1e-7)
        report.relative(f"largest {name}, moment [N m]", found[1], pile(phase, False)[1], 1e-7)
        report.relative(f"largest {name}, printed", found, wanted, 2e-6)
    report.title("stretched after Wheeler")
    for phase in (0.0, 1.0, 2.5, 4.0):
        found = found_on_pile(culm, phase, "Flows/sea/Stretching=Wheeler")
        report.relative(f"phase {phase:g}, force [N]", found[0], pile(phase, True)[0], 1e-7)
        report.relative(f"phase {phase:g}, moment [N m]", found[1], pile(phase, True)[1], 1e-7)


def pressed(start, axis, length, radii, faces, about):
    """Force and moment of the pressure of still water on the outside of a cone. Along each line of the mantle the
    pressure is linear up to the surface; around the axis all is periodic and smooth."""
    t = axis / np.linalg.norm(axis)
    e1 = np.cross(t, (0.0, 1.0, 0.0))
    e1 /= np.linalg.norm(e1)
    e2 = np.cross(t, e1)
    slope = (radii[1] - radii[0]) / length
    xi, weights = np.polynomial.legendre.leggauss(4)
    force, moment = np.zeros(3), np.zeros(3)

    def press(place, area):
        nonlocal force, moment
        part = RHO * G * min(place[2], 0.0) * area
        force = force + part
        moment = moment + np.cross(place - about, part)

    count = 400
    for angle in 2.0 * math.pi * np.arange(count) / count:
        radial = math.cos(angle) * e1 + math.sin(angle) * e2
        line = t + slope * radial
        bottom = start + radii[0] * radial
        wet = length if line[2] <= 0.0 else min(length, max(0.0, -bottom[2] / line[2]))
        for x, w in zip(xi, weights):
            s = 0.5 * (1.0 + x) * wet
            radius = radii[0] + slope * s
            press(start + s * t + radius * radial,
                  (radial - slope * t) * radius * 2.0 * math.pi / count * 0.5 * w * wet)
        for at, radius, out in faces:
            for x, w in zip(xi, weights):
                r = 0.5 * (1.0 + x) * radius
                press(start + at * length * t + r * radial,
                      out * t * r * 2.0 * math.pi / count * 0.5 * w * radius)
    return np.concatenate((force, moment))


def brace():
    """By pressure on all that is wet: the mantle, and inside the wall and the bulkhead in the middle."""
    start, axis = np.array((0.0, 0.0, -10.0)), np.array((10.0, 0.0, 10.0 * math.sqrt(3.0)))
    half = 0.5 * np.linalg.norm(axis)
    outer = pressed(start, axis, half, (2.0, 1.75), (), start)
    upper = pressed(start + 0.5 * axis, axis, half, (1.75, 1.5), (), start)
    inner = pressed(start, axis, half, (1.95, 1.7), ((1.0, 1.7, 1.0),), start)
    return outer + upper - inner


def verify_brace(culm, report):
    report.title("C18: pressure on a brace that the surface cuts, by volume and by surface")
    history = culm.history(BRACE, ["Sections/steel/Young Modulus=210e12"])
    names = ["Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]", "Mz [N m]"]
    found = [-history.column(f"leg {name}")[-1] for name in names]
    wanted = brace()
    # of steel a thousand times as stiff, for real steel bends and changes the force by 1.1e-4
    report.relative("force [N]", found[:3], list(wanted[:3]), 1e-6)
    report.relative("moment [N m]", found[3:], list(wanted[3:]), 1e-6)


def period_in_steps(omega, step):
    """Period of an oscillator in the conserving scheme."""
    return math.pi * step / math.atan(0.5 * omega * step)


def period(times, values):
    """From sines fitted to free oscillations, by the relation of three values in a row."""
    v = np.array(values) - np.mean(values)
    # v[i-1] + v[i+1] = 2 cos(omega h) v[i] + constant
    rows = np.column_stack((v[1:-1], np.ones(len(v) - 2)))
    cosine = np.linalg.lstsq(rows, v[:-2] + v[2:], rcond=None)[0][0] / 2.0
    return 2.0 * math.pi * (times[1] - times[0]) / math.acos(cosine)


def verify_heave(culm, report):
    report.title("C19: a floating cylinder")
    step, radius, draft = 0.05, 5.0, 20.0
    area = math.pi * radius**2
    mass = RHO * area * draft
    for c in (0.0, 1.0):
        run = culm.run(HEAVE, [f"c={c}"], quiet=False)
        history = run.history
        omega = math.sqrt(RHO * G * area / (mass + c * RHO * 2.0 / 3.0 * math.pi * radius**3))
        found = period(history.levels, history.column("float uz [m]"))
        report.relative(f"heave, c = {c:g}, period [s]", found, period_in_steps(omega, step), 1e-9)
        report.note(f"without the step: {2.0 * math.pi / omega:.6f} s")
        for what in ("energy balance", "linear momentum"):
            report.holds(what, run.drift(what), 1e-12)
    tilt = 1e-3
    directors = f"{{{math.cos(tilt)}, 0, {-math.sin(tilt)}, 0, 1, 0, {math.sin(tilt)}, 0, {math.cos(tilt)}}}"
    settings = [f"Structures/float/Directors={directors}",
                f"Structures/float/Position={{{-10.0 * math.sin(tilt)}, 0, {-10.0 * math.cos(tilt)}}}",
                "Analyses/motion/End Time=60"]
    history = culm.history(HEAVE, settings)
    # its own, and that of the water that moves along across the axis
    inertia = mass * (3.0 * radius**2 + draft**2) / 12.0 + mass * draft**2 / 12.0
    omega = math.sqrt(RHO * G * math.pi * radius**4 / 4.0 / inertia)
    found = period(history.levels, history.column("tilt ry [rad]"))
    # moments are nonlinear in the tilt, by its square
    report.relative("roll by 1e-3 rad, period [s]", found, period_in_steps(omega, step), tilt**2)


def verify_modes(culm, report):
    report.title("C19: modes of a flooded tube in water, fourth order of the segments")
    dry = 7850.0 * math.pi * (0.5**2 - 0.48**2)
    wet = dry + RHO * math.pi * (0.5**2 + 0.48**2)
    errors = []
    for segments in (20, 40, 80):
        tables = culm.succeed(TUBE, [f"Loads/water/Segments={segments}"]).tables
        ratios = [tables["wet/modes"].at(row, "frequency [Hz]") / tables["dry/modes"].at(row, "frequency [Hz]")
                  for row in (1, 3, 5)]
        errors.append(max(abs(r / math.sqrt(dry / wet) - 1.0) for r in ratios))
        report.note(f"{segments} segments: modes 1, 3, 5: {', '.join(f'{r:.9f}' for r in ratios)}")
    report.holds("wet over dry, 40 segments", errors[1], 1e-6)
    report.check("order", math.log2(errors[0] / errors[2]) / 2.0, 4.0, 0.5)


def verify_energy(culm, report):
    report.title("energy and momenta in waves")
    for deck, names in (("storm", ("energy balance",)),
                        ("spar", ("energy balance", "linear momentum", "angular momentum"))):
        run = culm.run(f"water/{deck}.xml", quiet=False)
        for what in names:
            report.holds(f"{deck}, {what}", run.drift(what), 1e-9)


def array_of(picture, name, kind):
    """An array of a VTU file by the name, or the last one of this kind of list."""
    text = re.findall(rf'<{kind}>(.*?)</{kind}>', picture, re.DOTALL)[0]
    data = re.findall(rf'<DataArray[^>]*{re.escape(name)}[^>]*>([^<]*)<', text)[-1]
    return np.frombuffer(base64.b64decode(data)[8:], dtype="<f8")


def verify_surface(culm, report):
    report.title("surface in pictures, at the end")
    settings = ["Flows/sea/Shown=90", "Analyses/motion/End Time=5", "Output/Every=50"]
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        command = [culm.program, "run", "--quiet", str(INPUTS / "water/floating_pipe.xml"), "--output", folder]
        subprocess.run(command + [w for one in settings for w in ("--set", one)], check=True)
        picture = sorted((pathlib.Path(folder) / "run_fluid_vtu").iterdir())[-1].read_text()
    places = array_of(picture, "", "Points").reshape(-1, 3)
    found = array_of(picture, "elevation [m]", "PointData")
    omega = 2.0 * math.pi / 7.0
    ahead = places[:, :2] @ np.array((1.0, 0.3)) / math.hypot(1.0, 0.3)
    k = omega**2 / 9.81  # the water is deep: tanh k d is 1 - 1e-7
    wanted = 1.5 * np.cos(k * ahead - omega * 5.0)
    report.holds("elevation [m]", float(np.max(np.abs(found - wanted))), 3e-6)
    report.check("places: largest x, y [m]", [float(v) for v in places.max(axis=0)[:2]], [45.0, 45.0], 1e-9)
    report.holds("height of the places [m]", float(np.max(np.abs(places[:, 2] - found))), 1e-12)


def verify(culm, report):
    verify_pile(culm, report)
    verify_brace(culm, report)
    verify_heave(culm, report)
    verify_modes(culm, report)
    verify_energy(culm, report)
    verify_surface(culm, report)


def plot(culm, path):
    fig, axes = figure(2)
    phases = np.linspace(0.0, 2.0 * math.pi, 25)
    for stretching, line in (("None", "C0"), ("Wheeler", "C1")):
        found = [found_on_pile(culm, p, f"Flows/sea/Stretching={stretching}")[0] for p in phases]
        axes[0].plot(phases, [1e-6 * f for f in found], line, label=f"Stretching = {stretching}")
        axes[0].plot(phases, [1e-6 * pile(p, stretching == "Wheeler")[0] for p in phases], line + "o", ms=4)
    axes[0].set(title="Wave of 6 m and 10 s on a pile", xlabel="phase [rad]", ylabel="force [MN]")
    axes[0].legend()
    history = culm.history("water/spar.xml", ["Analyses/motion/End Time=120"])
    axes[1].plot(history.levels, history.column("deck ux [m]"), label="surge [m]")
    axes[1].plot(history.levels, history.column("deck uz [m]"), label="heave [m]")
    axes[1].plot(history.levels, [100.0 * t for t in history.column("tilt ry [rad]")], label="100 × pitch [rad]")
    axes[1].set(title="Spar in irregular waves", xlabel="time [s]")
    axes[1].legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
