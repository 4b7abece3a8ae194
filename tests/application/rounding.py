"""What rounding or the size of a step must not decide: on which axes sections stand, where paths cross, factors of small
loads, which of two roots of a pair is shown, from where angles are counted, in which step a jump acts."""

import csv
import math
import re

import numpy

from deck_text import ends_with, entry, last_row, listed, rail, rows
from driver import Case

RUN = "run deck.xml --output out"


def deck(*lists):
    return f'<ParameterList name="culm">{"".join(lists)}</ParameterList>'


def inner(text, *lists):
    """A list with others in it."""
    return text.removesuffix("</ParameterList>") + "".join(lists) + "</ParameterList>"


def beam(curve, **values):
    return inner(entry("b", Type="Beam", Section="s", **values), curve)


def numbers(values):
    return "{" + ", ".join(map(repr, values)) + "}"


# --- the default of Up: of coordinate axes that are alike the first one

FLAT = listed("Sections", entry("s", Type="Rectangle", Young_Modulus="2e11", Poisson_Ratio="0.3", Width="0.02", Height="0.06"))
CURVES = {
    "a line": entry("Curve", Type="Line", From="{0, 0, 0}", To="{3, 0, 0}", Elements="6"),
    "a line that ends at a multiple of a sine": entry("Curve", Type="Line", From="{0, 0, 0}", To="{3*cos(2*pi), 3*sin(2*pi), 0}", Elements="6"),
    "a line with a sum of tenths": entry("Curve", Type="Line", From="{0, 0.1+0.2, 0}", To="{3, 0.3, 0}", Elements="6"),
    "a polyline with a sum of tenths": entry("Curve", Type="Polyline", Points="{0, 0.3, 0, 1.5, 0.1+0.2, 0, 3, 0.3, 0}", Elements="{3, 3}"),
    "a spline with a sum of tenths": entry("Curve", Type="Spline", Points="{0, 0.3, 0, 1.5, 0.3, 0, 3, 0.1+0.2, 0}", Elements="6"),
}


def cantilever(curve):
    return deck(FLAT, listed("Structures", beam(curve, Order="2")),
                listed("Constraints", entry("root", Type="Rigid Support", Node="b/first")),
                listed("Loads", entry("tip", Type="Force", Node="b/last", Force="{0, 0, -1}")),
                listed("Analyses", entry("bend", Type="Static")),
                inner('<ParameterList name="Output"></ParameterList>', listed("History", entry("u", Type="Displacement", Node="b/last"))))


STIFF = -27.0 / (3.0 * 2e11 * 0.02 * 0.06**3 / 12.0)  # the long side across y: d1 is y
ALIKE = [Case(f"sections on {name}", 0, args=RUN, deck=cantilever(curve), leaves=["out"], check=ends_with("u uz [m]", STIFF, 0.01 * abs(STIFF)))
         for name, curve in CURVES.items()]


# --- Rotation: of directors that are alike the first one

def held_turn(axis):
    return deck(listed("Structures", entry("b", Type="Rigid Body", Position="{0, 0, 0}", Mass="2", Inertia="{1, 1, 1.5}")),
                listed("Constraints", entry("s", Type="Spherical Support", Node="b"), entry("r", Type="Rotation", Node="b", Axis=axis)),
                listed("Initial Conditions", entry("v", Type="Velocity", Node="b", Angular_Velocity="{1, 0.5, 0}")),
                listed("Analyses", entry("d", Type="Dynamic", Step="0.01", End_Time="1")),
                inner('<ParameterList name="Output"></ParameterList>', listed("History", entry("r", Type="Rotation", Node="b"))))


# d1 stays in the plane of x and z
HELD = [Case(f"a body whose turn about {axis} is held", 0, args=RUN, deck=held_turn(axis), leaves=["out"], ranks=True,
             check=ends_with("r rz [rad]", -0.22474, 1e-3)) for axis in ("{0, 0, 1}", "{1e-13, 0, 1}", "{0, -1e-13, 1}")]


# --- bifurcations of a shallow arch under a load like its own shape: y = f sin(pi x / l), lambda = f / (2 i).
#     Timoshenko and Gere, Theory of Elastic Stability, 7.6: it bends sideways where the thrust is 4 pi^2 EI / l^2.

RISE, LAMBDA, EI, LENGTH = 0.01, 2.6, 1.0, 1.0
EA = 4.0 * LAMBDA**2 * EI / RISE**2


def crossings():
    """Loads per length at the middle where the thrust is that of the second Euler mode."""
    wave = math.pi / LENGTH
    thrust = 4.0 * wave**2 * EI
    # thrust = EA (f^2 - a^2) wave^2 / 4 with the rise a of the loaded arch; load = EI wave^4 (f - a) + thrust wave^2 a
    a = math.sqrt(RISE**2 - 4.0 * thrust / (EA * wave**2))
    return [EI * wave**4 * (RISE - sign * a) + thrust * wave**2 * sign * a for sign in (1.0, -1.0)]


def arch(increment, **values):
    points = [x for i in range(41) for x in (i / 40, 0.0, RISE * math.sin(math.pi * i / 40))]
    values = {"First_Increment": increment, "Final_Level": "3.5", "Steps": "100", **values}
    path = inner(entry("p", Type="Path", **values), entry("Watch", Node="b/middle", Direction="{0, 0, 1}"))
    return deck(listed("Sections", entry("s", Type="Stiffness Values", EA=EA, GA1="1e5", GA2="1e5", EI1="100", EI2=EI, GIp="100")),
                listed("Structures", beam(entry("Curve", Type="Spline", Points=numbers(points), Elements="20", Up="{0, 0, 1}"), Order="2")),
                listed("Constraints", *(entry(f"pin {end}", Type="Revolute Support", Node=f"b/{end}", Axis="{0, 1, 0}") for end in ("first", "last"))),
                listed("Fields", entry("wave", Type="Formula", Z="-sin(pi*x)")),
                listed("Loads", entry("q", Type="Field Force", Structure="b", Field="wave")), listed("Analyses", path))


def cross_at(number):
    """A check that all crossings, of which there are so many, lie at the two levels."""
    def check(_, out):
        found = [float(level) for level in re.findall(r"^  bifurcation at level (\S+),", out, re.M)]
        if len(found) != number:
            return f"bifurcations at {found}, not {number}"
        beside = [level for level in found if min(abs(level - right) for right in crossings()) > 2e-3 * max(map(abs, crossings()))]
        return f"bifurcations at {beside}, not {crossings()}" if beside else ""

    return check


# beside crossings equilibria near to limit points are not found in long steps; what is told is right here
INTERPOLATED = {"0.5": ["-1.01865"], "2": ["2.96516", "-1.01865"]}
CROSSED = [Case(f"an arch, first increment {increment}", 0, args=RUN, deck=arch(increment), leaves=["out"], check=cross_at(2), ranks=increment == "0.5",
                says=[f"the limit point at level {level} is interpolated" for level in INTERPOLATED.get(increment, [])], silent=False)
           for increment in ("0.2", "0.5", "1", "2")] + [
    # on the crossing path the level turns where it comes back to the first one
    Case("an arch that bends sideways and back", 8, args=RUN, deck=arch("0.5", Steps="22", Bifurcation="Follow"), leaves=["out"],
         silent=False, says=["after 22 steps"], check=cross_at(3)),
]


# --- a column whose path ends on the step with the crossing

def column_path(end):
    path = inner(entry("p", Type="Path", First_Increment="3", Final_Level=end, Bifurcation="Follow", Steps="400", Largest_Length="5"),
                 entry("Watch", Node="b/middle", Direction="{0, 0, 1}"))
    return deck(listed("Sections", entry("s", Type="Stiffness Values", EA="1e6", GA1="1e6", GA2="1e6", EI1="100", EI2="1", GIp="100")),
                listed("Structures", beam(entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0, 0}", Elements="16", Up="{0, 0, 1}"), Order="2")),
                listed("Constraints", entry("a", Type="Revolute Support", Node="b/first", Axis="{0, 1, 0}"),
                       entry("c", Type="Simple Support", Node="b/last", Direction="{0, 0, 1}"),
                       entry("e", Type="Planar Support", Node="b/last", Normal="{0, 1, 0}")),
                listed("Loads", entry("q", Type="Force", Node="b/last", Force="{-1, 0, 0}")), listed("Analyses", path))


UNFOLLOWED = [Case("a path that ends before it could follow another", 0, args=RUN, deck=column_path(1.3 * math.pi**2), leaves=["out"],
                   says=["the path ends on the step in which another one crosses it"])]


# --- a square column: two directions lose their stiffness together, and the determinant keeps its sign

def square_column(increment, **values):
    path = inner(entry("p", Type="Path", First_Increment=increment, Final_Level="1.4", Steps="100", **values),
                 entry("Watch", Node="b/last", Direction="{0, 0, 1}"))
    return pressed_column(path)


def pressed_column(analysis, other_stiffness="1"):
    return deck(listed("Sections", entry("s", Type="Stiffness Values", EA="1e7", GA1="1e7", GA2="1e7", EI1="1", EI2=other_stiffness, GIp="10")),
                listed("Structures", beam(entry("Curve", Type="Line", From="{0, 0, 0}", To="{0, 0, 1}", Elements="10", Up="{1, 0, 0}"), Order="2")),
                listed("Constraints", entry("root", Type="Rigid Support", Node="b/first")),
                listed("Functions", entry("growth", Type="Expression", Expression="t")),
                listed("Loads", entry("q", Type="Force", Node="b/last", Force=numbers([0.0, 0.0, -math.pi**2 / 4.0]), Function="growth")), listed("Analyses", analysis),
                inner('<ParameterList name="Output"></ParameterList>', listed("History", entry("u", Type="Displacement", Node="b/last"))))


def ends_at_pair(folder, _):
    *_, before, last = (row["time"] for row in rows(folder))
    return "" if before < 1.0 < last else f"the last levels are {before}, {last}"


PAIRS = [Case(f"a square column, first increment {increment}", 0, args=RUN, deck=square_column(increment, Bifurcation="Stop"), leaves=["out"],
              silent=False, says=["two directions lost their stiffness"], check=ends_at_pair, ranks=increment == "0.3") for increment in ("0.05", "0.3")]


# --- a column beyond its load, by load control: whatever the number of steps and of iterations in the last one

def pressed(steps, level, other_stiffness, says):
    return Case(f"a column of stiffnesses 1 and {other_stiffness} under {level} times its load in {steps} steps", 0, args=RUN, leaves=["out"],
                deck=pressed_column(entry("s", Type="Static", Steps=steps, Final_Level=level), other_stiffness), says=[says], silent=False)


BEYOND = [pressed(steps, level, "30", "changes its sign") for steps, level in ((1, 1.3), (5, 1.2), (10, 1.05))] + [
    pressed(steps, level, other, "two directions") for steps, level, other in ((1, 1.5, "1"), (2, 1.5, "1"), (3, 1.5, "1"), (1, 2.5, "1"), (1, 6, "1"), (1, 2, "1.44"))]


# --- factors of loads that are small beside the stiffness

def column_under(load):
    return deck(listed("Sections", entry("s", Type="Stiffness Values", EA="1e9", GA1="1e9", GA2="1e9", EI1="100", EI2="1", GIp="100")),
                listed("Structures", beam(entry("Curve", Type="Line", From="{0, 0, 0}", To="{0, 0, 1}", Elements="16", Up="{1, 0, 0}"), Order="2")),
                listed("Constraints", entry("root", Type="Rigid Support", Node="b/first")),
                listed("Loads", entry("q", Type="Force", Node="b/last", Force=f"{{0, 0, -{load}}}")),
                listed("Analyses", entry("b", Type="Buckling", Modes="1")))


def buckles_at(load):
    def check(folder, _):
        with open(folder / "out/analyses/b/buckling.csv", newline="") as file:
            factor = float(next(csv.DictReader(file))["factor"])
        return "" if abs(factor * float(load) / (math.pi**2 / 4.0) - 1.0) < 1e-5 else f"critical load {factor * float(load)}"

    return check


SMALL = [Case(f"a column under {load} N", 0, args=RUN, deck=column_under(load), leaves=["out"], check=buckles_at(load), ranks=load == "1e-9")
         for load in ("1", "1e-6", "1e-9")]


# --- a pendulum on its head beside another body with a damper: s = +-sqrt(m g a / J)

def pendulum(height):
    return deck(listed("Structures", entry("b", Type="Rigid Body", Position="{0, 0, 0}", Mass="2", Centre=f"{{0, 0, {height}}}", Inertia="{0.3, 0.3, 0.3}"),
                       entry("z", Type="Rigid Body", Position="{5, 0, 0}", Mass="1", Inertia="{1, 1, 1}")),
                listed("Constraints", *(entry(f"pin {node}", Type="Revolute Support", Node=node, Axis="{0, 1, 0}") for node in "bz")),
                listed("Loads", entry("g", Type="Gravity"),
                       entry("k", Type="Directed Ground Spring", Node="z", Offset="{0, 0, 1}", Direction="{1, 0, 0}", Stiffness="1000"),
                       entry("c", Type="Rotation Damper", Node="z", Axis="{0, 1, 0}", Damping="1")),
                listed("Analyses", entry("m", Type="Modal", Modes="1", Damping="true")))


FALLING = [Case(f"one mode of a pendulum on its head, {height} m", 0, args=RUN, deck=pendulum(height), leaves=["out"],
                prints=["1 mode growing: the state is unstable"]) for height in (0.3, 0.45, 0.6, 0.675, 0.7, 0.825)]

# --- what nothing resists is a mechanism, not a matter of stiffnesses that differ

def sliding():
    springs = (entry(name, Type="Directed Ground Spring", Node="b", Direction=direction, Stiffness="1000")
               for name, direction in (("x", "{1, 0, 0}"), ("y", "{0, 1, 0}")))
    turns = (entry(f"turn {name}", Type="Rotation", Node="b", Axis=axis)
             for name, axis in (("x", "{1, 0, 0}"), ("y", "{0, 1, 0}"), ("z", "{0, 0, 1}")))
    return deck(listed("Structures", entry("b", Type="Rigid Body", Position="{0, 0, 0}", Mass="10", Inertia="{1, 1, 1}")),
                listed("Constraints", *turns), listed("Loads", *springs, entry("f", Type="Force", Node="b", Force="{1, 0, 0}")),
                listed("Analyses", entry("s", Type="Static")))


FREE = [Case("a body with nothing along z", 4, args=RUN, deck=sliding(), leaves=["out"], says=["Nothing resists this motion"])]


# --- angles between bodies whose axes nothing keeps together are the same in each pose

POSE = numpy.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3.0
AXIS = [0.1, 0.0, 1.0]


def tilting(turn, load=None, joint=None):
    def turned(*vector):
        return numbers((turn @ numpy.array(vector)).tolist())

    between = {"First": "a", "Second": "b", "Axis": turned(*AXIS)}
    bodies = (entry(name, Type="Rigid Body", Position="{0, 0, 0}", Directors=numbers(turn.T.ravel().tolist()), Mass="2", Inertia=inertia)
              for name, inertia in (("a", "{1, 1.1, 1.5}"), ("b", "{0.5, 0.7, 0.6}")))
    return deck(listed("Structures", *bodies),
                listed("Constraints", entry("s", Type="Spherical Joint", First="a", Second="b"), *([entry("j", **between, **joint)] if joint else [])),
                listed("Loads", *([entry("l", **between, **load)] if load else [])),
                listed("Initial Conditions", entry("v", Type="Velocity", Node="b", Angular_Velocity=turned(1.0, 0.5, 0.0))),
                listed("Analyses", entry("d", Type="Dynamic", Step="0.01", End_Time="1")),
                inner('<ParameterList name="Output"></ParameterList>',
                      listed("History", entry("j", Type="Joint Angle", **between), entry("r", Type="Rotation", Node="b"))))


def turns_to(angle, turn):
    """A check of the angle at the end, and of the way that body b has turned, seen in the first pose."""
    def check(folder, _):
        end = last_row(folder)
        found = turn.T @ [end[f"r {name} [rad]"] for name in ("rx", "ry", "rz")]
        return "" if abs(end["j [rad]"] - angle[0]) < 1e-6 and abs(found - angle[1]).max() < 1e-6 else f"{end['j [rad]']}, {found}"

    return check


TILTING = {
    "spring": ({"load": {"Type": "Torsion Spring", "Stiffness": "5"}}, (-0.08225864, [0.97190978, 0.47212059, 0.03263304])),
    "damper": ({"load": {"Type": "Torsion Damper", "Damping": "5"}}, (-0.03670746, [0.98365094, 0.47694948, 0.06193547])),
    "drive": ({"load": {"Type": "Torsion Drive", "Moment": "2", "Function": "Constant"}}, (2.93893817, [1.32724092, 0.34546367, 1.69077424])),
    "joint": ({"joint": {"Type": "Joint Angle", "Angle": "0"}}, (0.0, [0.98691389, 0.47698594, 0.08100449])),
}
POSES = [Case(f"a torsion {name} between bodies that tilt, {pose}", 0, args=RUN, deck=tilting(turn, **values), leaves=["out"], check=turns_to(end, turn),
              says=["made to fit the constraints; largest change 0.071 rad/s at 'b/0', by Joint Angle 'j'"] if "joint" in values else [])
         for name, (values, end) in TILTING.items() for pose, turn in (("in one pose", numpy.eye(3)), ("in another", POSE))]


# --- a force that jumps at a level acts from there on, whatever rounding made of the sum of the increments

def stepped(level):
    return deck(listed("Structures", entry("b", Type="Rigid Body", Position="{0, 0, 0}", Mass="1", Inertia="{1, 1, 1}")),
                listed("Constraints", *rail("b")),
                listed("Functions", entry("jump", Type="Heaviside", Start=level)),
                listed("Loads", entry("k", Type="Directed Ground Spring", Node="b", Direction="{1, 0, 0}", Stiffness="1"),
                       entry("f", Type="Force", Node="b", Force="{1, 0, 0}", Function="jump")),
                listed("Analyses", entry("s", Type="Static", Steps="10")),
                inner('<ParameterList name="Output"></ParameterList>', listed("History", entry("u", Type="Displacement", Node="b"))))


def jumps_at(level):
    def check(folder, _):
        moved = [row["time"] for row in rows(folder) if row["u ux [m]"] > 0.5]
        return "" if moved and abs(min(moved) - level) < 1e-6 else f"moves at {moved}"

    return check


JUMPS = [Case(f"a force from level {i / 10} on", 0, args=RUN, deck=stepped(i / 10), leaves=["out"], check=jumps_at(i / 10)) for i in (1, 3, 6, 7, 8, 9)]

CASES = [*FREE, *ALIKE, *HELD, *CROSSED, *UNFOLLOWED, *PAIRS, *BEYOND, *SMALL, *FALLING, *POSES, *JUMPS]
