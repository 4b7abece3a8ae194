#!/usr/bin/python3
"""Structures and partners, each with steps of its own. Page: doc/verification/couplings.md."""

import functools
import math
import pathlib
import re
import tempfile
import xml.etree.ElementTree as ElementTree

from verify import INPUTS, main

WINDOWS = (0.008, 0.004, 0.002)  # s
TIMES = (0.04, 0.08, 0.12, 0.16)  # s, at which errors of the order are taken
MAST = INPUTS / "coupling/partners.xml"
CHANNEL = INPUTS / "coupling/channel.xml"
TWO_MASSES = """
<ParameterList name="culm">
  <ParameterList name="Structures">
    <ParameterList name="wall">
      <Parameter name="Type" value="Rigid Body"/> <Parameter name="Position" value="{0, 0, 0}"/>
      <Parameter name="Mass" value="1"/> <Parameter name="Inertia" value="{1, 1, 1}"/>
    </ParameterList>
    <ParameterList name="body">
      <Parameter name="Type" value="Rigid Body"/> <Parameter name="Position" value="{0, 1, 0}"/>
      <Parameter name="Mass" value="2"/> <Parameter name="Inertia" value="{1, 1, 1}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Constraints">
    <ParameterList name="wall"><Parameter name="Type" value="Rigid Support"/> <Parameter name="Node" value="wall"/></ParameterList>
    <ParameterList name="rail">
      <Parameter name="Type" value="Prismatic Joint"/> <Parameter name="First" value="wall"/>
      <Parameter name="Second" value="body"/> <Parameter name="Axis" value="{1, 0, 0}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Loads"><ParameterList name="spring">
    <Parameter name="Type" value="Directed Spring"/> <Parameter name="First" value="wall"/>
    <Parameter name="Second" value="body"/> <Parameter name="Direction" value="{1, 0, 0}"/>
    <Parameter name="Frame" value="Node"/> <Parameter name="Stiffness" value="80"/>
  </ParameterList></ParameterList>
  <ParameterList name="Initial Conditions"><ParameterList name="push">
    <Parameter name="Type" value="Velocity"/> <Parameter name="Node" value="body"/>
    <Parameter name="Velocity" value="{1, 0, 0}"/>
  </ParameterList></ParameterList>
  <ParameterList name="Ports"><ParameterList name="hook">
    <Parameter name="Type" value="Points"/> <Parameter name="Points" value="{body}"/>
  </ParameterList></ParameterList>
  <ParameterList name="Coupling">
    <Parameter name="Tolerance" value="1e-12"/> <Parameter name="Window" value="0.04"/>
    <ParameterList name="Partners"><ParameterList name="mass">
      <Parameter name="Type" value="Oscillator"/> <Parameter name="Mass" value="0.5"/>
      <Parameter name="Stiffness" value="30"/> <Parameter name="Steps" value="2"/>
    </ParameterList></ParameterList>
  </ParameterList>
  <ParameterList name="Analyses"><ParameterList name="motion">
    <Parameter name="Type" value="Dynamic"/> <Parameter name="End Time" value="1.2"/> <Parameter name="Step" value="0.01"/>
  </ParameterList></ParameterList>
  <ParameterList name="Output"><ParameterList name="History"><ParameterList name="body">
    <Parameter name="Type" value="Displacement"/> <Parameter name="Node" value="body"/>
  </ParameterList></ParameterList></ParameterList>
</ParameterList>
"""


def parameter(parent, name, value):
    for one in parent.findall("Parameter"):
        if one.get("name") == name:
            one.set("value", str(value))
            return
    parent.insert(0, ElementTree.Element("Parameter", name=name, value=str(value)))


def child(parent, name):
    for one in parent.findall("ParameterList"):
        if one.get("name") == name:
            return one
    return ElementTree.SubElement(parent, "ParameterList", name=name)


def part(parent, name, values):
    made = child(parent, name)
    for key, value in values.items():
        parameter(made, key, value)


class Mast:
    """The mast of the deck with other partners."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.count = 0

    def deck(self, partners=None, masses=(), **coupling):
        """partners: fields by name. masses: of point masses at the top, in the model. coupling: fields of the list."""
        root = ElementTree.parse(MAST).getroot()
        root.remove(child(root, "Coupling"))
        parameter(child(child(root, "Ports"), "top"), "Offset", "{0.3, 0.1, 0}")
        for i, mass in enumerate(masses):
            part(child(root, "Masses"), f"mass {i}", {"Type": "Point Mass", "Node": "mast/last", "Mass": mass,
                                                       "Offset": "{0.3, 0.1, 0}"})
        if partners:
            made = child(root, "Coupling")
            for name, value in coupling.items():
                parameter(made, name.replace("_", " "), value)
            for name, fields in partners.items():
                part(child(made, "Partners"), name, fields)
        self.count += 1
        path = self.folder / f"mast{self.count}.xml"
        ElementTree.ElementTree(root).write(path)
        return path


    @functools.cache
    def heavier(self, culm, mass):
        """History of the mast with a mass in the model."""
        return culm.history(self.deck(masses=[mass]))

    @functools.cache
    def in_water(self, culm, mass, scheme):
        """A run with water at five points."""
        return culm.run(self.deck(water(mass, "wet"), Scheme=scheme, **{"Most Attempts": 400}), quiet=False)


def number(run, pattern):
    return float(re.search(pattern, run.output).group(1))


def gap(run):
    return number(run, r"gap .* J, ([-+.\de]+)")


def attempts(run):
    return number(run, r"([.\d]+) attempts per window")


def largest_difference(one, other):
    return max(abs(a - b) for name in ("top ux [m]", "top uy [m]", "top uz [m]")
               for a, b in zip(one.column(name), other.column(name), strict=True))


def water(mass, port="top"):
    return {"water": {"Type": "Added Mass", "Port": port, "Mass": mass}}


def swing(steps=1, **more):
    return {"swing": {"Type": "Oscillator", "Port": "top", "Mass": 20, "Stiffness": 20000, "Steps": steps, **more}}


def verify_identity(culm, mast, report):
    report.title("A mass behind a port is a mass in the model")
    for mass in (4.5, 45.0, 4500.0):
        together = mast.heavier(culm, mass)
        run = culm.run(mast.deck(water(mass), Tolerance=1e-11), quiet=False)
        report.holds(f"{mass:g} kg, {attempts(run):.1f} attempts per window: top, m",
                     largest_difference(run.history, together), 1e-10)
        report.holds("gap of the interface", abs(gap(run)), 1e-8)
        report.holds("energy balance", run.drift("energy balance"), 1e-11)


def verify_parallel(culm, mast, report):
    report.title("Structure and partner at the same time: the mass in the model again, balance, and two partners")
    for mass in (4.5, 45.0, 4500.0):
        together = mast.heavier(culm, mass)
        run = culm.run(mast.deck(water(mass), Tolerance=1e-11, Parallel="true"), quiet=False)
        report.holds(f"{mass:g} kg, {attempts(run):.1f} attempts per window: top, m",
                     largest_difference(run.history, together), 1e-10)
        report.holds("gap of the interface", abs(gap(run)), 1e-8)
        report.holds("energy balance", run.drift("energy balance"), 1e-11)
    for own, other in ((1, 8), (8, 1), (8, 8)):
        run = culm.run(mast.deck(swing(other), Tolerance=1e-12, Window=0.02, Parallel="true"),
                       [f"Analyses/motion/Step={0.02 / own}"], quiet=False)
        report.holds(f"{own}:{other}, gap over what was exchanged", abs(gap(run)), 1e-12)
    two = {**water(20.0, "wet"), **swing(3)}
    serial, parallel = (culm.run(mast.deck(two, Tolerance=1e-11, Parallel=how), quiet=False) for how in ("false", "true"))
    report.holds(f"two partners, {attempts(serial):.1f} and {attempts(parallel):.1f} attempts per window: top, m",
                 largest_difference(serial.history, parallel.history), 1e-10)
    for scheme in ("Aitken", "Quasi Newton"):
        parallel = culm.run(mast.deck(water(2.0, "wet"), Scheme=scheme, Parallel="true", **{"Most Attempts": 400}), quiet=False)
        found = {}
        for how, run in (("false", mast.in_water(culm, 2.0, scheme)), ("true", parallel)):
            report.check(f"{scheme}: exit code", run.exit, 0, 0)
            found[how] = attempts(run)
        report.note(f"{scheme}, 2 kg at five points: serial {found['false']:.1f}, parallel {found['true']:.1f}")
    for mass, exit in ((0.1, 8), (200.0, 4)):
        run = culm.run(mast.deck(water(mass), Scheme="Explicit", Parallel="true"), quiet=False)
        report.check(f"explicit, {mass:g} kg: exit code", run.exit, exit, 0)
        report.check("it is foreseen", "times that of the structure" in run.errors, mass > 1.0, 0)


def verify_sub_cycling(culm, mast, report):
    report.title("Steps of the structure and of the partner in a window: energy is kept")
    for own, other in ((1, 1), (1, 8), (8, 1), (8, 8)):
        run = culm.run(mast.deck(swing(other), Tolerance=1e-12, Window=0.02), [f"Analyses/motion/Step={0.02 / own}"],
                       quiet=False)
        report.holds(f"{own}:{other}, gap over what was exchanged", abs(gap(run)), 1e-12)
        report.holds("energy balance of the structure", run.drift("energy balance"), 1e-12)
    last = {"Window Load": "Last"}
    run = culm.run(mast.deck(swing(8, **last), Window=0.02), ["Analyses/motion/Step=0.02"], quiet=False)
    report.note(f"with the load of the last step in place of the mean the gap is {gap(run):.2g} of what was exchanged")
    report.holds("its inverse", 1.0 / abs(gap(run)), 100.0)
    report.check("exit code of a broken promise", run.exit, 8, 0)


def verify_order(culm, mast, report):
    report.title("Order of the window, four steps of the structure and two of the partner in each")

    def top(window):
        deck = mast.deck(swing(2), Tolerance=1e-10, Window=window)
        settings = [f"Analyses/motion/Step={window / 4}", "Analyses/motion/End Time=0.16", "Functions/pulse/Type=Expression",
                    "Functions/pulse/Expression=sin(t*pi/0.16)^2", "Loads/push/Function=pulse"]
        history = culm.history(deck, settings)
        return [history.column("top ux [m]")[history.row(time)] for time in TIMES]

    limit = top(WINDOWS[0] / 16)
    errors = [math.dist(top(window), limit) for window in WINDOWS]
    report.note(f"errors at {WINDOWS} s: {errors}")
    for coarse, fine in zip(errors, errors[1:]):
        report.check("order", math.log2(coarse / fine), 2.0, 0.1)


def verify_schemes(culm, mast, report):
    report.title("Attempts per window, water at five points of the lower half")
    for mass in (2.0, 20.0, 200.0):
        found = {}
        for scheme in ("Aitken", "Quasi Newton"):
            run = mast.in_water(culm, mass, scheme)
            found[scheme] = attempts(run) if run.exit == 0 else math.inf
        report.note(f"{mass:g} kg per point: Aitken {found['Aitken']:.1f}, quasi-Newton {found['Quasi Newton']:.1f}")
        report.holds("quasi-Newton over Aitken", found["Quasi Newton"] / found["Aitken"], 1.0 if mass < 10 else 0.6)


def verify_loose(culm, mast, report):
    report.title("Loads that are exchanged once per window")
    for mass, dies in ((0.1, False), (1.0, True), (200.0, True)):
        run = culm.run(mast.deck(water(mass), Scheme="Explicit"), quiet=False)
        warned = "times that of the structure" in run.errors
        report.check(f"{mass:g} kg: warned of", warned, dies, 0)
        report.check("exit code: did not solve, or broken promise", run.exit, 4 if dies else 8, 0)
        for line in run.errors.splitlines():
            if "times that of the structure" in line:
                report.note(line)
    one_way = culm.run(mast.deck(water(200.0), Scheme="One Way"), quiet=False)
    report.check("one way: exit code", one_way.exit, 0, 0)


def verify_limit(culm, report):
    report.title("A wall over a channel, loads exchanged once per window: the limit of Causin, Gerbeau and Nobile")
    for step, end in ((1e-2, 3.0), (1e-3, 0.6), (1e-4, 0.1)):
        times = [f"Analyses/motion/Step={step}", f"Analyses/motion/End Time={end}", "Output/Every=10000"]
        agreed = culm.run(CHANNEL, ["ratio=1", *times])
        for ratio, dies in ((0.95, True), (1.05, False)):
            run = culm.run(CHANNEL, [f"ratio={ratio}", "Coupling/Scheme=Explicit", *times], quiet=False)
            loose, sound = (max(map(abs, one.history.column("middle uz [m]"))) for one in (run, agreed))
            report.note(f"step {step:g} s, masses {ratio}, {len(run.history.levels) - 1} steps: the largest motion is "
                        f"{loose / sound:.3g} times that of a coupling that agrees")
            report.check("it dies", loose > 10.0 * sound, dies, 0)
            report.holds("else it is good, up to a factor of", 1.0 if dies else loose / sound, 2.0)
            if dies:
                report.check("and that was foreseen", "times that of the structure" in run.errors, True, 0)


def verify_closed_form(culm, folder, report, parallel=False):
    """A body on a spring with an oscillator behind its port: two masses, two springs, in closed form."""
    report.title("Two masses on springs, one of them behind the port: order of the window, both sides with steps of their own"
                 + (", at the same time" if parallel else ""))
    deck = pathlib.Path(folder) / "two_masses.xml"
    deck.write_text(TWO_MASSES)
    own, other = 2.0, 0.5  # kg
    stiff, soft = 80.0, 30.0  # N/m
    middle, difference = (stiff + soft) / own + soft / other, (stiff + soft) / own - soft / other
    root = math.sqrt(difference**2 + 4.0 * soft**2 / (own * other))
    slow, fast = math.sqrt(0.5 * (middle - root)), math.sqrt(0.5 * (middle + root))

    def place(time):
        """Of the body; both masses begin in place with 1 m/s."""
        first, second = ((stiff + soft - own * w**2) / soft for w in (slow, fast))  # shapes: (1, first), (1, second)
        share = (second - 1.0) / (second - first)
        return share / slow * math.sin(slow * time) + (1.0 - share) / fast * math.sin(fast * time)

    errors = []
    for window in (0.04, 0.02, 0.01):
        run = culm.run(deck, [f"Coupling/Window={window}", f"Analyses/motion/Step={window / 4}",
                              f"Coupling/Parallel={str(parallel).lower()}"], quiet=False)
        report.holds(f"window {window} s: gap over what was exchanged", abs(gap(run)), 1e-12)
        history = run.history
        errors.append(math.dist([history.column("body ux [m]")[history.row(t)] for t in (0.4, 0.8, 1.2)],
                                [place(t) for t in (0.4, 0.8, 1.2)]))
    report.note(f"errors: {errors}")
    for coarse, fine in zip(errors, errors[1:]):
        report.check("order", math.log2(coarse / fine), 2.0, 0.1)


def closed_tube(rings=7, sides=8, radius=0.1):
    """Points and triangles of a closed tube round the mast."""
    points, faces = [], []
    for ring in range(rings):
        for side in range(sides):
            angle = 2.0 * math.pi * side / sides
            points += [radius * math.cos(angle), radius * math.sin(angle), 1.0 + 4.0 * ring / (rings - 1)]
    points += [0.0, 0.0, 1.0, 0.0, 0.0, 5.0]
    bottom, top = rings * sides, rings * sides + 1
    for side in range(sides):
        after = (side + 1) % sides
        faces += [bottom, after, side, top, (rings - 1) * sides + side, (rings - 1) * sides + after]
        for ring in range(rings - 1):
            a, b, c, d = ring * sides + side, ring * sides + after, (ring + 1) * sides + after, (ring + 1) * sides + side
            faces += [a, b, c, a, c, d]
    return points, faces


def array(values):
    return "{" + ", ".join(map(repr, values)) + "}"


def verify_pressure(culm, mast, report):
    report.title("Constant pressure on a closed surface of 58 points and 112 triangles round the mast")
    points, faces = closed_tube()
    gas = {"gas": {"Type": "Pressure", "Port": "skin", "Pressure": 1e5, "Triangles": array(faces)}}
    tree = ElementTree.parse(mast.deck(gas, Tolerance=1e-11))
    part(child(tree.getroot(), "Ports"), "skin", {"Type": "Cloud", "Points": array(points)})
    deck = mast.folder / "skin.xml"
    tree.write(deck)
    run = culm.run(deck, quiet=False)
    report.holds("gap, against the change of the volume", abs(gap(run)), 1e-9)
    still = culm.history(mast.deck())
    report.holds("top, against the mast without pressure, over its displacement",
                 largest_difference(run.history, still) / max(still.column("top ux [m]")), 1e-3)
    open_deck = mast.folder / "open.xml"
    open_deck.write_text(deck.read_text().replace(array(faces), array(faces[3:])))
    report.check("an open surface keeps no books", "keeps no books" in culm.run(open_deck, quiet=False).output, True, 0)


def verify_last_window(culm, mast, report):
    report.title("A last window that is shorter than the others")
    for scheme in ("Quasi Newton", "Explicit", "One Way"):
        run = culm.run(mast.deck(water(0.1), Scheme=scheme, Window=0.13), quiet=False)
        report.check(f"{scheme}: end", run.history.levels[-1], 0.5, 0.0)


def verify_noise(culm, mast, report):
    report.title("Forces at random")
    noise = {"noise": {"Type": "Random", "Port": "wet", "Force": 500}}
    run = culm.run(mast.deck(noise), quiet=False)
    report.holds("energy balance", run.drift("energy balance"), 1e-11)
    report.holds("gap", abs(gap(run)), 1e-12)
    report.check("attempts per window", attempts(run), 2.0, 0.1)


def verify(culm, report):
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        mast = Mast(folder)
        for part_of_it in (verify_identity, verify_parallel, verify_sub_cycling, verify_order, verify_schemes, verify_loose,
                           verify_pressure, verify_last_window, verify_noise):
            part_of_it(culm, mast, report)
        verify_limit(culm, report)
        verify_closed_form(culm, folder, report)
        verify_closed_form(culm, folder, report, parallel=True)


main(verify)
