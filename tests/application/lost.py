"""What was once lost without a word: turns within a step, nodes named twice, functions without amounts."""

import csv
import math

from deck_text import cut, ends_with, entry, last_row, listed
from driver import BASE, Case

RUN = "run deck.xml --output out --quiet"


STATIC = cut(BASE, '<ParameterList name="bend">', "</ParameterList>")
FORCE = cut(BASE, '<ParameterList name="tip force">', "</ParameterList>")
LOADS = cut(BASE, '<ParameterList name="Loads">', "</ParameterList>\n  </ParameterList>")
CLAMP = cut(BASE, '<ParameterList name="clamp">', "</ParameterList>")
HISTORY = '<ParameterList name="History">'
SOLVER = '<ParameterList name="Solver">'
TWIST_STIFFNESS = 2e3 / 2.0  # GIp / L


# --- turns that are prescribed

TWIST = entry("twist", Type="Stress Resultants", Structure="beam", Element="1")


def twisted(kind, angle, steps, **more):
    """Change of the deck: the tip is turned about the axis, and nothing else acts."""
    turn = entry("turn", Type=kind, Node="beam/last", Axis="{1, 0, 0}", Angle=angle, **more)
    held = "" if kind == "Rigid Support" else "".join(
        entry(f"held {i}", Type="Simple Support", Node="beam/last", Direction=direction)
        for i, direction in enumerate(("{0, 1, 0}", "{0, 0, 1}")))
    return [
        (CLAMP, CLAMP + turn + held),
        (LOADS, ""),
        (STATIC, entry("bend", Type="Static", Steps=steps)),
        (HISTORY, HISTORY + TWIST),
        ('name="Elements" value="4"', 'name="Elements" value="40"'),
    ]


def is_twisted(angle):
    moment = TWIST_STIFFNESS * angle
    # 40 elements of order 1: two thirds of the square of a turn, see doc/theory/beam.md
    return ends_with("twist M3 [N m]", moment, (angle / 40) ** 2 * moment)


TURNS = [
    Case(f"{kind}, {angle:g} rad in {steps} steps", 0, change=twisted(kind, angle, steps),
         args=RUN, leaves=["out"], check=is_twisted(angle), ranks=True)
    for kind, angle, steps in (("Rotation", 2.0, 1), ("Rotation Local", math.pi, 1), ("Rigid Support", 2 * math.pi, 1),
                               ("Rotation", 2 * math.pi, 2))
]

# Two bodies on a hinge, of which the second is turned or spins against the first.
SPINNING = """<ParameterList name="culm">
  <ParameterList name="Structures">%(bodies)s</ParameterList>
  <ParameterList name="Functions">%(functions)s</ParameterList>
  <ParameterList name="Constraints">%(constraints)s</ParameterList>
  <ParameterList name="Loads">%(loads)s</ParameterList>
  <ParameterList name="Initial Conditions">%(start)s</ParameterList>
  <ParameterList name="Analyses">
    <ParameterList name="spin">
      <Parameter name="Type" value="Dynamic"/>
      <Parameter name="End Time" value="4"/>
      <Parameter name="Step" value="1"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">%(history)s</ParameterList>
  </ParameterList>
</ParameterList>
"""
BODY = dict(Type="Rigid Body", Position="{0, 0, 0}", Mass="1", Inertia="{1, 2, 2.5}")
AXIS = "{0, 0, 1}"
HUB, ARM = entry("hub", **BODY), entry("arm", **BODY)
GROUND = entry("ground", Type="Rigid Support", Node="hub")
HINGE = entry("hinge", Type="Revolute Joint", First="hub", Second="arm", Axis=AXIS)
ANGLE = entry("angle", Type="Joint Angle", First="hub", Second="arm", Axis=AXIS)


def spinning(constraints, start, loads="", history=ANGLE,
             functions=entry("time", Type="Linear", Duration="1") + entry("always", Type="Constant")):
    return SPINNING % dict(bodies=HUB + ARM, functions=functions, constraints="".join(constraints), loads=loads,
                           start=start, history=history)


def turning(node, speed):
    return entry(f"spin of {node}", Type="Velocity", Node=node, Angular_Velocity=f"{{0, 0, {speed}}}")


MOTIONS = [
    Case(f"{name} by {speed} rad in each step", 0, args=RUN, leaves=["out"],
         deck=spinning((GROUND, HINGE, drive), turning("arm", speed)),
         says=["attempts at a step failed and were cut back, "],
         check=ends_with("angle [rad]", 4.0 * speed, 1e-9))
    for name, speed, drive in (
        ("angle of a joint", 6, entry("drive", Type="Joint Angle", First="hub", Second="arm", Axis=AXIS, Angle="6",
                                      Function="time")),
        ("angular velocity", 7, entry("drive", Type="Angular Velocity", Node="arm", Axis=AXIS, Angular_Velocity="7",
                                      Function="always")),
    )
]


def counts_all_turns(folder, _):
    """Of two bodies that spin against each other at 4.2 rad/s, less what steps of so much leave out."""
    row = last_row(folder)
    angle, spring = row["angle [rad]"], row["spring angle [rad]"]
    if abs(angle - spring) > 1e-9:
        return f"the history counts {angle}, the spring {spring}"
    return "" if 0.8 * 16.8 < -angle < 16.8 else f"they turned by {angle} rad"


# --- what is counted over several analyses

MOTION = cut(SPINNING, '<ParameterList name="Analyses">', "</ParameterList>\n  </ParameterList>")
SPRING = entry("spring", Type="Torsion Spring", First="hub", Second="arm", Axis=AXIS, Stiffness="1")


def led(angle, *analyses):
    """The arm is led by an angle for each unit of the level, against a torsion spring."""
    drive = entry("drive", Type="Joint Angle", First="hub", Second="arm", Axis=AXIS, Angle=angle, Function="time")
    deck = spinning((GROUND, HINGE, drive), turning("arm", 0), SPRING, ANGLE + entry("spring", Type="Link", Load="spring"))
    return deck.replace(MOTION, listed("Analyses", *analyses))


def begins_and_ends(column, *values):
    """The first and the last value in each analysis."""

    def check(folder, _):
        with open(folder / "out/history.csv", newline="") as file:
            names, *rows = list(csv.reader(file))
        found = []
        for analysis in sorted({row[names.index("analysis")] for row in rows}):
            own = [row[names.index(column)] for row in rows if row[names.index("analysis")] == analysis]
            found.append((float(own[0] or "nan"), float(own[-1] or "nan")))
        wrong = [pair for pair, value in zip(found, values) if value and max(abs(pair[0] - value[0]), abs(pair[1] - value[1])) > 1e-9]
        return f"{column} goes by {found}" if wrong or len(found) != len(values) else ""

    return check


THERE = dict(Type="Static", Steps="20")

# --- sets, functions, formulas

WEIGHED = [
    (SOLVER, listed("Node Sets", entry("both", Nodes="{beam/last, beam/4}")) + SOLVER),
    (FORCE, FORCE.replace('"beam/last"', '"both"')),
    (HISTORY, HISTORY + entry("root", Type="Reaction", Node="beam/first")),
]
FALLING = '<ParameterList name="culm"><ParameterList name="Structures">' + HUB + "</ParameterList>%s</ParameterList>"


def pushed(kind, step="0.1", **function):
    return FALLING % (
        listed("Functions", entry("push", Type=kind, **function))
        + listed("Loads", entry("push", Type="Force", Node="hub", Force="{1, 0, 0}", Function="push"))
        + listed("Analyses", entry("fly", Type="Dynamic", End_Time="1", Step=step))
        + listed("Output", listed("History", entry("hub", Type="Velocity", Node="hub")))
    )


def seen_by_chance(period):
    return [f"warning: function 'push' goes up and down within the time step from 0 s to 0.1 s: what it does there is "
            "lost or taken for something slower; take shorter steps"] if period < 0.3 else []


# --- supports that come in later

FOLLOWED = (STATIC, entry("free", Type="Static", Steps="1", Inactive="{prop}")
            + entry("propped", Type="Static", Start_Level="1", Final_Level="2", Steps="1"))
INNER = FORCE.replace("tip force", "inner force").replace("beam/last", "beam/middle")


def propped(prop, *more):
    return [(CLAMP, CLAMP + "@@" + prop), FOLLOWED, (FORCE, FORCE + INNER), *more]


LATE = "deck.xml:{line}: Constraints / prop: 'propped' begins where beam/..."
PROP = entry("prop", Type="Simple Support", Node="beam/last", Direction="{0, 0, 1}")
IDLE = ["warning: Force 'tip force' moves nothing: "]

# --- heat in a bar between two walls

HELD = [
    (CLAMP, CLAMP + CLAMP.replace("clamp", "wall").replace("first", "last")),
    ('<Parameter name="GIp" value="2e3"/>', '<Parameter name="GIp" value="2e3"/><Parameter name="Expansion" value="1e-5"/>'),
    ('name="Elements" value="4"', 'name="Elements" value="20"'),
]


def heated(steps, value):
    heat = entry("heat", Type="Temperature", Structure="beam", Value=value)
    return [*HELD, (STATIC, entry("bend", Type="Static", Steps=steps)), (FORCE, heat)]


# --- reactions

PUT_BETWEEN = entry("prop", Type="Simple Support", Node="beam@0.4", Direction="{0, 0, 1}", Translation="1e-3")

# A strip of 2 x 0.2 m in the plane z = 1, clamped along x = 0 and lifted by 0.1 N along x = 2.
STRIP = """<ParameterList name="culm">
  <ParameterList name="Materials">
    <ParameterList name="soft">
      <Parameter name="Type" value="Isotropic"/>
      <Parameter name="Young Modulus" value="2e9"/>
      <Parameter name="Poisson Ratio" value="0"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Structures">
    <ParameterList name="strip">
      <Parameter name="Type" value="Shell"/>
      <Parameter name="Material" value="soft"/>
      <Parameter name="Thickness" value="0.02"/>
      <ParameterList name="Mesh">
        <Parameter name="Type" value="Plane"/>
        <Parameter name="Side 1" value="{2, 0, 0}"/>
        <Parameter name="Side 2" value="{0, 0.2, 0}"/>
        <Parameter name="Elements" value="{4, 1}"/>
        <Parameter name="Origin" value="{0, 0, 1}"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Constraints">%s</ParameterList>
  <ParameterList name="Loads">
    <ParameterList name="lift">
      <Parameter name="Type" value="Line Force"/>
      <Parameter name="Structure" value="strip/u1"/>
      <Parameter name="Force" value="{0, 0, 0.5}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Solver"><Parameter name="Form" value="%s"/></ParameterList>
  <ParameterList name="Analyses">
    <ParameterList name="bend"><Parameter name="Type" value="Static"/><Parameter name="Steps" value="1"/></ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">
      <ParameterList name="corner">
        <Parameter name="Type" value="Reaction"/><Parameter name="Node" value="strip/u0 v0"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""
CLAMPED = entry("clamp", Type="Rigid Support", Node="strip/u0")


def bends(folder, _):
    """At each of two corners half of the force, and of its moment about the edge."""
    row = last_row(folder)
    found = [row[f"corner {name}"] for name in ("Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]")]
    expected = [0.0, 0.0, -0.05, 0.0, 0.1]
    return "" if max(abs(a - b) for a, b in zip(found, expected)) < 1e-6 else f"the reaction is {found}"


# Nodes of a beam of 2 m, unevenly spaced; it is propped at 1.4 m.
PLACES = (0, 0.28, 0.62, 1, 1.3, 1.62, 2)
UNEVEN_NODES = entry("Curve", Type="Nodes", Positions="{" + ", ".join(f"{x}, 0, 0" for x in PLACES) + "}",
                     Directors="{" + ", ".join(["0, 0, 1, 0, -1, 0, 1, 0, 0"] * len(PLACES)) + "}")
CURVE = cut(BASE, '<ParameterList name="Curve">', "</ParameterList>")
PUT_AT = entry("prop", Type="Simple Support", Node="beam@0.7", Direction="{0, 0, 1}", Translation="1e-3")
ROOT = entry("root", Type="Reaction", Node="beam/first")


def has_arm(arm, force=None):
    """The reaction at the root is that of a force at a distance."""

    def check(folder, _):
        row = last_row(folder)
        found = row["root Fz [N]"], -row["root My [N m]"] / row["root Fz [N]"]
        is_right = abs(found[1] - arm) < 1e-4 and (force is None or abs(found[0] - force) < 1e-6)
        return "" if is_right else f"the force at the root is {found[0]}, at {found[1]} m"

    return check


# --- levels

COMPRESSED = FORCE.replace("{0, 0, 100}", "{-100, 0, 0}")
SPUN = entry("spin", Type="Rotating Frame", Axis="{1, 0, 0}", Speed="1")
HEAVY = ('<Parameter name="GIp" value="2e3"/>', '<Parameter name="GIp" value="2e3"/><Parameter name="rhoA" value="5"/>'
         '<Parameter name="rhoI1" value="0.01"/><Parameter name="rhoI2" value="0.01"/>')
BUCKLED = (STATIC, entry("buckling", Type="Buckling", Modes="2"))
GROWN = listed("Functions", entry("grown", Type="Expression", Expression="%s")) + SOLVER


def critical_levels(expected):
    """Whether the first factor has a critical level."""

    def check(folder, _):
        with open(folder / "out/analyses/buckling/buckling.csv", newline="") as file:
            first = next(csv.DictReader(file))
        return "" if bool(first["critical level"]) == expected else f"the first row is {first}"

    return check


UNEVEN = ["warning: loads do not grow evenly from level 0 to level 1, "]
ON_THE_WAY = entry("there", Type="Path", First_Increment="0.5", Final_Level="2")
ENDED = "but 'on' holds 'Ramp', which Force 'tip force' follows, between 0 and 1, where it jumps to: "
LINEAR = listed("Functions", entry("grown", Type="Linear", Duration="1")) + SOLVER


def led_on(**then):
    return (STATIC, ON_THE_WAY + entry("on", **then))


FOLLOWS = (FORCE, FORCE.replace("</ParameterList>", '<Parameter name="Function" value="grown"/></ParameterList>'))
STRETCHED = entry("pull", Type="Simple Support", Node="beam/last", Direction="{1, 0, 0}", Translation="1e-6", Function="grown")

# --- loads in sections

SECTIONS = "".join(entry(f"at {station}", Type="Section Loads", Structure="beam", Station=station, Axes="Space")
                   for station in ("0.1", "0.5", "0.9"))
# An L of two legs of 2 m, along x and up, lifted and pulled at its end.
LEGS = entry("Curve", Type="Polyline", Points="{0, 0, 0, 2, 0, 0, 2, 0, 2}", Elements="{%s}", Up="{0, 1, 0}")
BY_STATICS = ((0.4, 0.0), (2.0, 0.0), (2.0, 1.6))


def carries_end_force(x, z, force):
    """Moments about y of a force (Fx, Fz) at (x, z), within what the beam bends."""

    def check(folder, _):
        row = last_row(folder)
        found = [row[f"at {station} My [N m]"] for station in ("0.1", "0.5", "0.9")]
        expected = [(z - at[1]) * force[0] - (x - at[0]) * force[1] for at in BY_STATICS]
        return "" if max(abs(a - b) for a, b in zip(found, expected)) < 1e-3 else f"moments are {found}, not {expected}"

    return check


# --- weight

CARRIED = entry("carried", Type="Rigid Connection", Node="hub", Master="beam/last")

# --- motions after statics

MOVED = entry("moved", Type="Dynamic", End_Time="0.05", Step="0.01")


def stands_still(folder, _):
    """In the last of three analyses, where the second ended."""
    with open(folder / "out/history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    places = [float(row["tip z [m]"]) for row in rows if row["analysis"] == "2"]
    end = [float(row["tip z [m]"]) for row in rows if row["analysis"] == "1"][-1]
    return "" if max(abs(place - end) for place in places) <= 1e-9 else f"the tip goes from {end} by {places}"


# 4 pi^2 EI / L^2 over EA times the expansion, less what shear takes: 1437 K about d1, 1895 K about d2
CROSSING = "between the levels %s and %s the determinant of the stiffness changes its sign"

# Beck's column: it flutters at 20.05 EI / L^2, here about d1, and does not buckle
STIFF = [
    ('<Parameter name="EA" value="2e3" unit="kN"/>', '<Parameter name="EA" value="1e13"/>'),
    ('<Parameter name="GA1" value="1e6"/>', '<Parameter name="GA1" value="1e12"/>'),
    ('<Parameter name="GA2" value="1e6"/>', '<Parameter name="GA2" value="1e12"/>'),
    ('name="Order" value="1"', 'name="Order" value="2"'),
    ('name="Elements" value="4"', 'name="Elements" value="8"'),
]
PUSHED = [
    (FORCE, entry("thrust", Type="Follower Force", Node="beam/last", Force="{0, 0, -1}", Function="grown")),
    (SOLVER, LINEAR),
    (STATIC, entry("flutter", Type="Flutter", Modes="2", Levels="{0, 1e4, 1.4e4, 1.6e4}")),
]


def flutters(level):
    def check(folder, _):
        with open(folder / "out/analyses/flutter/onset.csv", newline="") as file:
            first = next(csv.DictReader(file))
        found = float(first["level"] or "nan")
        return "" if abs(found - level) <= 1e-2 * level else f"the first row is {first}"

    return check


# --- nodes of shells

SHEET = ('<ParameterList name="culm">'
         + listed("Materials", entry("steel", Type="Isotropic", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="8000"))
         + """<ParameterList name="Structures"><ParameterList name="sheet">
  <Parameter name="Type" value="Shell"/>
  <Parameter name="Material" value="steel"/>
  <Parameter name="Thickness" value="0.01"/>"""
         + entry("Mesh", Type="Plane", Side_1="{1, 0, 0}", Side_2="{0, 0.2, 0}", Elements="{4, 1}")
         + """</ParameterList></ParameterList>
%s</ParameterList>""")
SUPPORTED = listed("Constraints", entry("clamp", Type="Rigid Support", Node="sheet/u0"))
SAGS = listed("Loads", entry("weight", Type="Gravity")) + listed("Analyses", entry("sag", Type="Static", Steps="1"))
CORNER = "sheet/u1 v0"


def beside_director(*entries):
    """The deck of a sheet under its weight, and of what is fixed to nodes of it."""
    return SHEET % (SUPPORTED + "".join(entries) + SAGS)


# --- modes


def swings(*wanted):
    """Whether the modes have these frequencies [Hz] and damping ratios, all to 1e-6."""

    def check(folder, _):
        with open(folder / "out/analyses/modes/modes.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        found = [(float(row["frequency [Hz]"]), float(row["damping ratio"])) for row in rows]
        same = len(found) == len(wanted) and all(
            abs(f - g) <= 1e-6 * max(1.0, g) and abs(z - y) <= 1e-6 for (f, z), (g, y) in zip(found, wanted))
        return "" if same else f"the modes are {found}"

    return check


def sprung(*loads, modes=6):
    """Modes of a body of 1 kg, with damping, under springs and dampers."""
    return FALLING % (listed("Loads", *loads)
                      + listed("Analyses", entry("modes", Type="Modal", Modes=modes, Damping="true")))


OFF = "{0, 0.3, 0}"
# of 100 N/m and 2 N s/m on 1 kg, at the centre or 0.3 m beside it with 2.5 kg m^2 about z
CENTRED = (math.sqrt(99.0) / (2.0 * math.pi), 0.1)
BESIDE = 1.0 + 0.3**2 / 2.5
SWUNG = (math.sqrt(100.0 * BESIDE - BESIDE**2) / (2.0 * math.pi), 0.1 * math.sqrt(BESIDE))
FREE = (0.0, 0.0)
BEAM_MODES = (STATIC, entry("modes", Type="Modal", Modes="8", Damping="true"))
DAMPED_BEAM = ('<Parameter name="Section" value="bar"/>',
               '<Parameter name="Section" value="bar"/><Parameter name="Damping" value="1e-5"/>')


def spun(speed):
    """A body on springs that turns about an axis of its own, then its modes."""
    stiffness = "{" + ", ".join("0" if i != j or i == 5 else "100" for i in range(6) for j in range(6)) + "}"
    return FALLING % (
        listed("Loads", entry("mount", Type="Restoring", Node="hub", Stiffness=stiffness))
        + listed("Initial Conditions", turning("hub", speed))
        + listed("Analyses", entry("spin", Type="Dynamic", End_Time="0.01", Step="1e-3"),
                 entry("modes", Type="Modal", Modes="6", Damping="true")))


def sheet(size, damping):
    """Modes of a sheet of this size [m], with damping."""
    deck = SHEET % (SUPPORTED + listed("Analyses", entry("modes", Type="Modal", Modes="6", Damping="true")))
    for old, new in (("0.01", f"{0.01 * size:g}"), ("{1, 0, 0}", f"{{{size:g}, 0, 0}}"), ("{0, 0.2, 0}", f"{{0, {0.2 * size:g}, 0}}"),
                     ('"Density" value="8000"/>', f'"Density" value="8000"/><Parameter name="Damping" value="{damping:g}"/>')):
        assert deck.count(old) == 1
        deck = deck.replace(old, new)
    return deck


def has_sheet_modes(size):
    """Frequencies in proportion to 1 / size, and ratios of half the damping times the circular frequency."""

    def check(folder, _):
        with open(folder / "out/analyses/modes/modes.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        found = [float(row["frequency [Hz]"]) * size for row in rows]
        ratios = [float(row["damping ratio"]) / (math.pi * 1e-6 * f) for row, f in zip(rows, found)]
        wanted = (8.2431647, 59.893353, 83.353286, 160.38595, 230.81902, 277.82638)
        same = len(found) == 6 and all(abs(f / g - 1.0) < 1e-6 for f, g in zip(found, wanted))
        return "" if same and max(abs(ratio - 1.0) for ratio in ratios) < 1e-3 else f"{found}, ratios {ratios}"

    return check


def has_free_motions_once(folder, _):
    with open(folder / "out/analyses/modes/modes.csv", newline="") as file:
        frequencies = [float(row["frequency [Hz]"]) for row in csv.DictReader(file)]
    at_rest = sum(f == 0.0 for f in frequencies)
    return "" if at_rest == 6 and len(frequencies) == 8 else f"the frequencies are {frequencies}"


CLAY = entry("clay", Type="Clay", Top="0", Strength="1e3", Unit_Weight="8e3", Strain="0.01").replace(
    "</ParameterList>", entry("Shaft", Friction="1e3", Displacements="{1e-3}", Fractions="{1}").replace(
        "</ParameterList>", "%s</ParameterList>") + "</ParameterList>")

CASES = [
    *TURNS,
    Case("modes of a body that moves freely, beside a damped one", 0, args=RUN, leaves=["out"],
         deck=sprung(entry("spring", Type="Directed Ground Spring", Node="hub", Direction="{1, 0, 0}", Stiffness="100"),
                     entry("damper", Type="Directed Ground Damper", Node="hub", Direction="{1, 0, 0}", Damping="2")),
         check=swings(*[FREE] * 5, CENTRED)),
    Case("modes of a body that moves freely, beside a damped one that turns it", 0, args=RUN, leaves=["out"],
         deck=sprung(entry("spring", Type="Directed Ground Spring", Node="hub", Direction="{1, 0, 0}", Stiffness="100", Offset=OFF),
                     entry("damper", Type="Directed Ground Damper", Node="hub", Direction="{1, 0, 0}", Damping="2", Offset=OFF)),
         check=swings(*[FREE] * 5, SWUNG)),
    *(
        Case(f"modes of a body on a {kind}Ground Damper where it stands, spring by {next(iter(spring))}", 0, args=RUN, leaves=["out"],
             deck=sprung(entry("spring", Type=f"{kind}Ground Spring", Node="hub", **spring, **more),
                         entry("damper", Type=f"{kind}Ground Damper", Node="hub", Damping="2", **more)),
             check=swings(*[FREE] * (6 - axes), *[CENTRED] * axes))
        for kind, axes, more in (("", 3, {}), ("Plane ", 2, dict(Normal="{0, 0, 1}")))
        for spring in (dict(Stiffness="100"), dict(Elongations="{-1, 1}", Forces="{-100, 100}"))
    ),
    *(
        Case(f"damped modes of a sheet of {size:g} m", 0, args=RUN, leaves=["out"], deck=sheet(size, 1e-6 * size),
             check=has_sheet_modes(size))
        for size in (1.0, 1e-2, 1e-4)
    ),
    Case("modes of a body that nothing but a brake holds", 0, args=RUN, leaves=["out"],
         deck=sprung(entry("brake", Type="Rotation Damper", Node="hub", Axis="{0, 0, 1}", Damping="0.5"), modes=7),
         check=swings(*[FREE] * 6, (0.0, 1.0))),
    Case("modes of a body that turns slowly", 0, args=RUN, leaves=["out"], deck=spun("1e-3")),
    Case("modes of a body that turns fast", 0, args=RUN, leaves=["out"], deck=spun("20"), ranks=True,
         says=["warning: the state is in motion and turns by up to 20 rad/s, but modes are those of a structure that stands still "]),
    Case("modes of a damped beam that flies", 0, args=RUN, leaves=["out"], ranks=True,
         change=[HEAVY, DAMPED_BEAM, (CLAMP, ""), (LOADS, ""), BEAM_MODES], check=has_free_motions_once),
    Case("a mass beside the director of a shell", 3, args=RUN,
         deck=beside_director(listed("Masses", entry("mass", Type="Point Mass", Node=CORNER, Mass="5", Offset="{0, 0.2, 0}"))),
         says=["Masses / mass / Offset: node 'sheet/8' of a shell has one director: only the first component may differ"]),
    Case("points that are watched beside the director of a shell", 3, args=RUN,
         deck=beside_director(listed("Output", listed(
             "History", *(entry(kind, Type=kind, Node=CORNER, Offset="{0, 0.3, 0}") for kind in ("Position", "Acceleration")),
             entry("far", Type="Distance", Node=CORNER, To="sheet/u0 v0", To_Offset="{0, 0, 0.1}")))),
         says=[f"Output / History / {place}: node 'sheet/{node}' of a shell has one director: only the first component may "
               for place, node in (("Position / Offset", 8), ("Acceleration / Offset", 8), ("far / To Offset", 0))]),
    Case("a point that is watched along the director of a shell", 0, args=RUN, leaves=["out"],
         deck=beside_director(listed("Output", listed(
             "History", entry("root", Type="Position", Node="sheet/u0 v0", Offset="{0.3, 0, 0}")))),
         check=ends_with("root z [m]", 0.3, 1e-12)),
    Case(
        "a jump by more than a quarter of a turn",
        4,
        change=[*twisted("Rotation", 2.0, 4, Function="jump"),
                (SOLVER, listed("Functions", entry("jump", Type="Heaviside", Start="0.5")) + SOLVER)],
        args=RUN,
        says=["Likely cause: the rotation that Rotation 'turn' prescribes leads further at once "],
        leaves=["out"],
    ),
    *MOTIONS,
    Case(
        "a jump by more than a step of a motion may turn",
        4,
        args=RUN,
        deck=spinning((GROUND, HINGE, entry("drive", Type="Joint Angle", First="hub", Second="arm", Axis=AXIS, Angle="3",
                                            Function="jump")),
                      turning("arm", 0), functions=entry("jump", Type="Heaviside", Start="1.5")),
        says=["Likely cause: the rotation that Joint Angle 'drive' prescribes leads "],
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "bodies that spin against each other",
        0,
        args=RUN,
        deck=spinning(
            (entry("axle", Type="Revolute Support", Node="hub", Axis=AXIS), HINGE),
            turning("hub", 2.1) + turning("arm", -2.1),
            entry("spring", Type="Torsion Spring", First="hub", Second="arm", Axis=AXIS, Stiffness="1e-6"),
            ANGLE + entry("spring", Type="Link", Load="spring"),
        ),
        says=["attempts at a step failed and were cut back, "],
        leaves=["out"],
        check=counts_all_turns,
        ranks=True,
    ),
    Case(
        "turns that are counted anew from the reference, and go on from where an analysis ended",
        0,
        args=RUN,
        deck=led(10, entry("there", **THERE), entry("again", **THERE, Start_From="Reference"),
                 entry("on", **THERE, Start_From="there", Start_Level="1", Final_Level="2")),
        says=["the initial velocities of the deck are lost"],
        leaves=["out"],
        check=begins_and_ends("angle [rad]", (0, 10), (0, 10), (10, 20)),
        ranks=True,
    ),
    Case(
        "a torsion spring that comes in later counts from the reference",
        0,
        args=RUN,
        deck=led(2, entry("free", **THERE, Inactive="{spring}"), entry("sprung", **THERE, Start_Level="1", Final_Level="2")),
        says=["the initial velocities of the deck are lost"],
        leaves=["out"],
        check=begins_and_ends("spring angle [rad]", None, (2, 4)),
        ranks=True,
    ),
    Case("a node that a set names twice", 0, change=WEIGHED, args=RUN, leaves=["out"],
         check=ends_with("root Fz [N]", -100.0, 1e-6)),
    Case(
        "an element that a set names twice",
        3,
        change=[(SOLVER, listed("Element Sets", "@@" + entry("some", Structure="beam", Elements="{0, 2, 0}")) + SOLVER)],
        errors=["deck.xml:{line}: Element Sets / some / Elements: names element 0 more than once"],
    ),
    *(
        Case(
            f"a {function} of a {kind} without its amount",
            3,
            change=[(CLAMP, CLAMP + "@@" + entry("turn", Type=kind, Node="beam/last", **more))],
            errors=[f"deck.xml:{{line}}: Constraints / turn / {function}: moves nothing: it is a factor on '{amount}', "
                    "which is missing"],
        )
        for kind, function, amount, more in (
            ("Rotation", "Function", "Angle", dict(Axis="{1, 0, 0}", Function="Constant")),
            ("Simple Support", "Function", "Translation", dict(Direction="{1, 0, 0}", Function="Constant")),
            ("Spherical Support", "Function", "Translation", dict(Function="Constant")),
            ("Rigid Support", "Function", "Translation", dict(Angle="0.1", Function="Constant")),
            ("Rigid Support", "Angle Function", "Angle", dict(Translation="{1, 0, 0}", Angle_Function="Constant")),
        )
    ),
    Case(
        "a start that moves nothing",
        3,
        change=[(SOLVER, listed("Initial Conditions", "@@" + entry("swung", Type="Displacement", Node="beam/last"),
                                entry("pushed", Type="Velocity", Node="beam/last")) + SOLVER)],
        errors=["deck.xml:{line}: Initial Conditions / swung: moves nothing: give 'Translation' or 'Angle'",
                "deck.xml:{line}: Initial Conditions / pushed: moves nothing: give 'Velocity' or 'Angular Velocity'"],
    ),
    Case(
        "velocities without a motion",
        0,
        args=RUN,
        change=[(SOLVER, listed("Initial Conditions", entry("pushed", Type="Velocity", Node="beam/last",
                                                            Velocity="{0, 0, 1}")) + SOLVER)],
        says=["warning: the initial velocities of the deck are lost: they act in analyses of type 'Dynamic' only, and "
              "there is none\n"],
        results="out",
        last_level=1.0,
    ),
    Case(
        "a restoring force of nothing",
        3,
        change=[(FORCE, "@@" + entry("mount", Type="Restoring", Node="beam/last"))],
        errors=["deck.xml:{line}: Loads / mount: resists nothing: give 'Stiffness', 'Damping', 'Quadratic Damping' or "
                "'Preload'"],
    ),
    Case(
        "what is left of the friction of clay, beside a curve",
        3,
        change=[(FORCE, entry("soil", Type="Soil", Structure="beam", Ground="{0, 0, 0}", Down="{1, 0, 0}", Diameter="0.1").replace(
            "</ParameterList>", listed("Layers", CLAY % '@@<Parameter name="Residual" value="0.5"/>') + "</ParameterList>"))],
        errors=["deck.xml:{line}: Loads / soil / Layers / clay / Shaft / Residual: is of the curve of API RP 2A, but "
                "'Displacements' gives another"],
    ),
    Case(
        "a bar between the points of a line",
        0,
        change=[(FORCE, FORCE + entry("bar", Type="Cylinder Contact", Structure="beam", Radius="0.05", Bar_Radius="0.05",
                                      Stiffness="1e6", From="{1.75, -1, 0.14}", To="{1.75, 1, 0.14}"))],
        args=RUN,
        says=["warning: Cylinder Contact 'bar' has points on its line 0.289 m apart, and the bar lies 0.0775 m deeper"],
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "radii of nothing",
        3,
        change=[(HISTORY, HISTORY + "@@" + entry("gap", Type="Distance", Node="beam/last", To="beam/first", Radii="{1, 1}"))],
        errors=["deck.xml:{line}: Output / History / gap / Radii: belongs to 'Structure', which is missing"],
    ),
    *(
        Case(f"a sine of period {period}", 0, args=RUN, deck=pushed("Sinusoidal", Period=period),
             says=seen_by_chance(period), never=["BROKEN", "promises"], leaves=["out"])
        for period in (0.1, 0.2, 0.4)
    ),
    Case("words in formulas", 0, args=RUN, leaves=["out"],
         deck=pushed("Expression", step="0.01", Expression="t&gt;0.25 and t&lt;0.5 or t&gt;0.95 ? 2 : 0"),
         check=ends_with("hub vx [m/s]", 0.6, 1e-9)),
    Case("a support that comes in where the structure is not", 3, args=RUN, change=propped(PROP),
         errors=[LATE], results="out", ranks=True),
    Case("a connection that comes in where the structure is not", 3, args=RUN,
         change=propped(entry("prop", Type="Rigid Connection", Node="beam/last", Master="beam/middle")),
         errors=[LATE], results="out"),
    Case("one that is an equation leads it back", 0, args=RUN,
         change=propped(PROP, ('value="Null Space"', 'value="Multipliers"')), says=IDLE, results="out",
         last_level=2.0, check=ends_with("tip z [m]", 0.0, 1e-9)),
    *(
        Case(f"a bar that buckles between walls as it gets warm, {steps} steps", 0, args=RUN,
             change=heated(steps, 1700), says=[CROSSING % levels], results="out", last_level=1.0)
        for steps, levels in ((1, ("0", "1")), (10, ("0.8", "0.9")))
    ),
    Case("a bar between walls that does not buckle", 0, args=RUN, change=heated(1, 1300), never=["determinant"], results="out",
         last_level=1.0),
    Case("a bar that bends freely as it gets warm", 0, args=RUN,
         change=[HELD[1], (FORCE, entry("heat", Type="Temperature", Structure="beam", Value="3000", Gradient="{0, 50}"))],
         never=["determinant"], results="out", last_level=1.0),
    Case(
        "a reaction of a support between nodes",
        3,
        change=[(CLAMP, CLAMP + PUT_BETWEEN), (HISTORY, HISTORY + "@@" + entry("prop", Type="Reaction", Constraint="prop"))],
        errors=["deck.xml:{line}: Output / History / prop / Constraint: 'prop' acts on 2 nodes, with a share of its "
                "force at each; name one of them as 'Node'"],
    ),
    *(
        Case(f"the moment by which a shell is clamped, {form}", 0, args=RUN, deck=STRIP % (CLAMPED, form), leaves=["out"],
             check=bends, ranks=True)
        for form in ("Null Space", "Multipliers")
    ),
    *(
        Case(f"a place on a beam of order {order} whose nodes are not evenly spaced", 0, args=RUN, leaves=["out"],
             change=[(LOADS, ""), (CLAMP, CLAMP + PUT_AT), (HISTORY, HISTORY + ROOT), (CURVE, UNEVEN_NODES),
                     ('name="Order" value="1"', f'name="Order" value="{order}"')], check=has_arm(1.4))
        for order in (1, 2, 3)
    ),
    *(
        Case(f"a table along a beam of order {order} whose nodes are not evenly spaced", 0, args=RUN, leaves=["out"],
             change=[(FORCE, entry("line", Type="Line Load", Structure="beam", Positions="{0, 1}", Forces="{0, 0, 0, 0, 0, 3}")),
                     (HISTORY, HISTORY + ROOT), (CURVE, UNEVEN_NODES),
                     ('name="Order" value="1"', f'name="Order" value="{order}"')], check=has_arm(4.0 / 3.0, -3.0))
        for order in (1, 2, 3)
    ),
    *(
        Case(f"a critical level under {what}", 0, args=RUN, change=[HEAVY, BUCKLED, *change], says=[] if even else UNEVEN,
             leaves=["out"], check=critical_levels(even), ranks=True)
        for what, even, change in (
            ("a force that grows with the level", True, [(FORCE, COMPRESSED)]),
            ("a force that grows with its square", False,
             [(FORCE, COMPRESSED.replace("</ParameterList>", '<Parameter name="Function" value="grown"/></ParameterList>')),
              (SOLVER, GROWN % "t^2")]),
            ("a speed that grows with the level", False, [(FORCE, SPUN)]),
        )
    ),
    *(
        Case(f"a load that a path has led to level 2, {what}", 0, args=RUN, change=[HEAVY, led_on(**then), *change], says=says,
             never=[] if says else ["Ramp"], leaves=["out"])
        for what, then, change, says in (
            ("in a motion", dict(Type="Dynamic", End_Time="2.01", Step="0.01"), [], [ENDED]),
            ("at rest", dict(Type="Static", Start_Level="2", Final_Level="3", Steps="1"), [], [ENDED]),
            ("at rest from the beginning", dict(Type="Static", Steps="1"), [], []),
            ("by a function of its own", dict(Type="Dynamic", End_Time="2.01", Step="0.01"), [FOLLOWS, (SOLVER, LINEAR)], []),
        )
    ),
    *(
        Case(f"a ramp up to level {level}", 0, args=RUN,
             change=[(STATIC, entry("bend", Type="Static", Final_Level=level)), *change], says=says,
             never=[] if says else ["Ramp"], leaves=["out"])
        for level, change, says in (
            (5, [], ["warning: nothing grows beyond level 1, where 'Ramp' ends, which Force 'tip force' follows: "]),
            (1, [], []),
            (4, [FOLLOWS, (SOLVER, LINEAR)], []),
        )
    ),
    Case("stresses of what relaxes", 0, args=RUN,
         change=[HEAVY, (STATIC, entry("pulled", Type="Dynamic", End_Time="0.1", Step="0.01")), (LOADS, ""),
                 (SOLVER, LINEAR), (CLAMP, CLAMP + STRETCHED),
                 ('<Parameter name="Section" value="bar"/>', '<Parameter name="Section" value="bar"/>'
                  + listed("Relaxation", entry("slow", Time="1", Ratios="{0.5}"))),
                 (HISTORY, HISTORY + entry("inner", Type="Stress Resultants", Structure="beam", Element="0"))],
         says=["warning: Stress Resultants 'inner' is that of the lasting stiffness of 'beam': what its branches of "],
         leaves=["out"]),
    Case("a follower force that is little beside stiffnesses that hardly act", 0, args=RUN, change=[HEAVY, *STIFF, *PUSHED],
         leaves=["out"], check=flutters(20.0509 * 3e3 / 4.0)),
    *(
        Case(f"a linear beam under {what}", 0, args=RUN, leaves=["out"],
             change=[('name="Order" value="1"/>', 'name="Order" value="2"/><Parameter name="Fidelity" value="Linear"/>'),
                     (FORCE, FORCE.replace("{0, 0, 100}", f"{{{force}, 0, 1}}"))],
             check=ends_with("tip z [m]", 8.0 / (3.0 * 4e3) + 2.0 / 1e6, 1e-9))
        for what, force in (("compression", -500), ("tension", 500))
    ),
    *(
        Case(f"a motion after {what} after a motion", 0, args=RUN, leaves=["out"],
             change=[HEAVY,
                     (STATIC, MOVED + between + entry("on", Type="Dynamic", End_Time="1.05", Step="0.01"))],
             check=stands_still, ranks=True)
        for what, between in (
            ("statics", entry("rest", Type="Static", Steps="1")),
            ("a path", entry("rest", Type="Path", First_Increment="0.5", Final_Level="1")),
        )
    ),
    *(
        Case(f"loads in sections of an L of {elements} elements, order {order}", 0, args=RUN, leaves=["out"],
             change=[(CURVE, LEGS % elements), (FORCE, FORCE.replace("{0, 0, 100}", "{0.1, 0, 0.1}")),
                     ('name="Order" value="1"', f'name="Order" value="{order}"'), (HISTORY, HISTORY + SECTIONS)],
             check=carries_end_force(2.0, 2.0, (0.1, 0.1)), ranks=True)
        for elements, order in (("1, 1", 2), ("1, 3", 1), ("3, 2", 2), ("4, 4", 3))
    ),
    Case("a body at rest, seen from a frame that begins to turn", 0, args=RUN, leaves=["out"],
         deck=FALLING % (
             listed("Loads", entry("spin", Type="Rotating Frame", Axis="{0, 0, 1}", Point="{-1, 0, 0}", Speed="3"))
             + listed("Analyses", entry("turn", Type="Dynamic", End_Time="0.5", Step="1e-3"))
             + listed("Output", listed("History", entry("hub", Type="Position", Node="hub")))),
         check=ends_with("hub y [m]", -math.sin(0.5 * 3.0 * 0.5**2), 1e-6), ranks=True),
    Case("modes at levels beyond the ramp", 0, args=RUN, leaves=["out"],
         change=[HEAVY, (FORCE, SPUN), (STATIC, entry("modes", Type="Campbell", Modes="2", Levels="{0, 1, 1.5}"))],
         says=["warning: nothing grows beyond level 1, where 'Ramp' ends, which Rotating Frame 'spin' follows: "]),
    Case("a blade that is soft before it is stretched", 0, args=RUN, never=["determinant"], leaves=["out"],
         change=[HEAVY, (FORCE, entry("spin", Type="Rotating Frame", Axis="{0, 0, 1}", Speed="25")),
                 (STATIC, entry("bend", Type="Static", Steps="1")),
                 ('name="Order" value="1"', 'name="Order" value="2"'), ('name="Elements" value="4"', 'name="Elements" value="8"')]),
    *(
        Case(f"weight of a beam {what} density", 0, args="run deck.xml --output out", leaves=["out"],
             change=[(LOADS, listed("Loads", entry("weight", Type="Gravity"))),
                     ('<ParameterList name="Structures">', f'<ParameterList name="Structures">{HUB}'), *change],
             prints=[] if HEAVY in change else ["note: Gravity 'weight' does not pull 'beam': there is no density or mass\n"],
             never=["does not pull"] if HEAVY in change else [], silent=False)
        for what, change in (("without", [(CLAMP, CLAMP + CARRIED)]), ("with", [(CLAMP, CLAMP + CARRIED), HEAVY]))
    ),
]
