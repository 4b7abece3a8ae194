"""Sound decks and command lines: what culm prints and leaves behind."""

import csv
import pathlib
import re
import sys

from deck_text import entry
from driver import BASE, Case

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "src/python"))
from culm.results import Results  # noqa: E402


def history(folder):
    """The levels in history.csv."""
    return [line.split(",")[0] for line in (folder / "history.csv").read_text().splitlines()[1:]]


# A rigid body that nothing holds, for one analysis.
BODY = """<ParameterList name="culm">
  <ParameterList name="Structures">
    <ParameterList name="ball">
      <Parameter name="Type" value="Rigid Sphere"/>
      <Parameter name="Radius" value="1"/>
      <Parameter name="Density" value="10"/>
      <Parameter name="Position" value="{1, 2, 3}"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Loads">
    <ParameterList name="weight">
      <Parameter name="Type" value="Gravity"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Analyses">
    <ParameterList name="only">
      <Parameter name="Type" value="%s"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">
      <ParameterList name="tip">
        <Parameter name="Type" value="Position"/>
        <Parameter name="Node" value="ball"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""


def has_levels(folder, *levels):
    found = history(folder)
    return "" if found == list(levels) else f"the history has the levels {found}"


BLADE = pathlib.Path(__file__).resolve().parents[2] / "inputs/turbine/generic_blade"
BLADE_FILES = {name: (BLADE / name).read_text() for name in ("driver.inp", "beamdyn.inp", "blade.inp")}


def is_imported(folder, _):
    found = sorted(path.name for path in folder.iterdir())
    wanted = sorted([*BLADE_FILES, "driver.xml", "driver.report.txt"])
    return "" if found == wanted else f"there is {found}"


AIR = pathlib.Path(__file__).resolve().parents[2] / "inputs/air"


def in_two_flows(deck):
    """Goland's wing with a second load of strips, in a flow of its own, and a rotor of both."""

    def entries(**pairs):
        return "".join(f'<Parameter name="{key}" value="{value}"/>' for key, value in pairs.items())

    start = deck.index('<ParameterList name="air on the wing">')
    strips = deck[start : deck.index("</ParameterList>", start)] + "</ParameterList>\n"
    other = strips.replace("air on the wing", "more air").replace('"Flow" value="air"', '"Flow" value="other"')
    blades = "{air on the wing, more air}"
    rotor = f'<ParameterList name="rotor">{entries(Type="Rotor", Hub="wing/first", Axis="{1, 0, 0}", Blades=blades)}'
    flow = f'<ParameterList name="other">{entries(Type="Uniform", Density=1, Velocity="{9, 0, 0}")}</ParameterList>'
    return deck.replace(strips, strips + other + rotor + "</ParameterList>\n").replace(
        '<ParameterList name="Flows">', '<ParameterList name="Flows">' + flow
    )


def is_version(_, stdout):
    lines = r"\d+\.\d+\.\d+\ncommit: ([0-9a-f]{7,}(-dirty)?|unknown)\nbuild: \w+, .+\ndeck format: \d+\n"
    return "" if re.fullmatch(lines, stdout) else f"'{stdout}' is no version"


def is_help_of_culm(_, stdout):
    # libraries must not add theirs
    return "" if stdout.startswith("culm: ") else "there is something before the help"


def old_results(folder):
    """A folder from an earlier run that had more steps, and broke off."""
    out = folder / "out"
    out.mkdir()
    for name in ("run.h5", "run.h5.journal", "run.xdmf", "run.pvd"):
        (out / name).write_text("old")
    (out / "history.csv").write_text("time,tip x [m]\n" + "0,0\n" * 1000)


def describes_a_box(_, stdout):
    named = re.findall(r"^- `(.*?)`", stdout, re.MULTILINE)
    wanted = ["Young Modulus", "Poisson Ratio", "Width", "Height"]
    lacking = [name for name in wanted if name not in named]
    return f"not described: {lacking}" if lacking else ""


def is_page(name, headings):
    """Checks that a page is whole, and has its pictures within."""

    def check(folder, _):
        text = (folder / name).read_text(encoding="utf-8")
        lacking = [one for one in [*(f"<h2>{h}</h2>" for h in headings), "data:image/png", "</html>"] if one not in text]
        return f"{name} lacks {lacking}" if lacking else ""

    return check


def has_findings(*kinds, grade=True):
    """Checks run.h5, and that its last state is that of the history."""

    def check(folder, _):
        found = Results(folder / "out/run.h5").findings()
        same = [one.kind for one in found] == list(kinds) and all(one.is_broken == grade for one in found)
        return "" if same else f"run.h5 has {found}"

    return check


def cell(folder, row, column):
    """A cell of history.csv, row 0 below the names."""
    with open(folder / "out/history.csv", newline="") as file:
        rows = list(csv.reader(file))
    return rows[row + 1][rows[0].index(column)]


def has_cells(*wanted):
    """Checks cells of the history: (row, column, value), a number or a text."""

    def check(folder, _):
        for row, column, value in wanted:
            found = cell(folder, row, column)
            same = found == value if isinstance(value, str) else abs(float(found) - value) < 1e-12
            if not same:
                return f"'{column}' in row {row} is {found}"
        return ""

    return check


def ends_at(state, rows):
    """Checks the number of rows of the history, and the index of the last state in run.h5."""

    def check(folder, _):
        found = history(folder / "out")
        states = Results(folder / "out/run.h5").states()
        same = len(found) == rows and states[-1:] == [state]
        return "" if same else f"the history has {found}, states are {states}"

    return check


def promise(*names):
    """The last line of a run that broke promises."""
    words = ("1 of its promises does not hold", "warning") if len(names) == 1 else (
        f"{len(names)} of its promises do not hold", "warnings")
    return f"The run came to its end, but {words[0]}: {', '.join(names)}; see the {words[1]} above.\n"


STATIC = (
    '<Parameter name="Type" value="Static"/>\n      <Parameter name="Steps" value="2"/>'
)
PATH = (
    '<Parameter name="Type" value="Path"/>\n      <Parameter name="Steps" value="2"/>\n'
    '      <Parameter name="%s" value="1"/>'
)
TIP_FORCE = '<Parameter name="Type" value="Force"/>\n      <Parameter name="Node" value="beam/last"/>'
CLAMP_FORCE = TIP_FORCE.replace("last", "first")
RUN = "run deck.xml --output out --quiet"
DYNAMIC = ('<Parameter name="Type" value="Dynamic"/>\n      <Parameter name="Step" value="0.01"/>\n      '
           '<Parameter name="End Time" value="0.05"/>')
HEAVY = ('<Parameter name="EI2" value="4e3"/>', '<Parameter name="EI2" value="4e3"/><Parameter name="rhoA" value="1"/>'
         '<Parameter name="rhoI1" value="1e-3"/><Parameter name="rhoI2" value="1e-3"/>')
IDLE = "warning: %s moves nothing: all of it acts where supports hold the model and goes straight into them\n"


# A body on a base that stands, and one on that body, by joints.
STACK = f"""<ParameterList name="culm">
  <ParameterList name="Structures">{"".join(
    entry(name, Type="Rigid Body", Position=f"{{{x}, 0, 0}}", Mass="10", Inertia="{1, 1, 1}")
    for x, name in enumerate(("base", "box", "lid"))
)}</ParameterList>
  <ParameterList name="Constraints">
    {entry("foot", Type="Rigid Support", Node="base")}
    {entry("lower", Type="Weld", First="base", Second="box")}
    {entry("upper", Type="Weld", First="box", Second="lid")}
  </ParameterList>
  <ParameterList name="Loads">{entry("push", Type="Force", Node="lid", Force="{0, 0, 100}", Function="Constant")}
  </ParameterList>
  {entry("Solver", Form="Null Space")}
  <ParameterList name="Analyses">{entry("motion", Type="Dynamic", Step="0.1", End_Time="0.2")}</ParameterList>
</ParameterList>
"""

# A square plate that is held along an edge, under loads.
PLATE = f"""<ParameterList name="culm">
  <ParameterList name="Materials">{entry("m", Type="Isotropic", Young_Modulus="1e9", Poisson_Ratio="0.3")}</ParameterList>
  <ParameterList name="Structures">
    <ParameterList name="plate">
      <Parameter name="Type" value="Shell"/>
      <Parameter name="Material" value="m"/>
      <Parameter name="Thickness" value="0.01"/>
      {entry("Mesh", Type="Plane", Side_1="{1, 0, 0}", Side_2="{0, 1, 0}", Elements="{2, 2}")}
    </ParameterList>
  </ParameterList>
  <ParameterList name="Constraints">{entry("clamp", Type="Rigid Support", Node="plate/u0")}</ParameterList>
  <ParameterList name="Loads">%s</ParameterList>
  <ParameterList name="Analyses">{entry("bend", Type="Static", Steps="2")}</ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">{entry("tip", Type="Position", Node="plate/8")}</ParameterList>
  </ParameterList>
</ParameterList>
"""

def strip(name, **values):
    """A load of the air on the beam."""
    known = {"Type": "Strip", "Structure": "beam", "Flow": "wind", "Chord": "0.1", "Axis_At": "0.25", "Airfoil": "thin"}
    return entry(name, **{key: value for key, value in (known | values).items() if value != ""})


# A surface in the air on the beam.
RINGS = entry("rings", Type="Vortex Lattice", Flow="wind").replace(
    "</ParameterList>",
    '<ParameterList name="Surfaces"><ParameterList name="one"><Parameter name="Structure" value="beam"/>'
    '<Parameter name="Chord" value="0.1"/><Parameter name="Panels" value="{2, 4}"/></ParameterList></ParameterList>'
    "</ParameterList>")


def in_wind(*strips, **flow):
    """The change of the deck that puts it into a wind."""
    flow = flow or {"Type": "Uniform", "Velocity": "{0, 0, 1}"}
    return (
        '<ParameterList name="Loads">',
        f'<ParameterList name="Airfoils">{entry("thin", Type="Thin")}</ParameterList>'
        f'<ParameterList name="Flows">{entry("wind", Density="1", **flow)}</ParameterList>'
        '<ParameterList name="Loads">' + "".join(strips),
    )


HALF = (
    '<ParameterList name="Solver">',
    f'<ParameterList name="Functions">{entry("half", Type="Constant", Intensity="0.5")}'
    f'{entry("fade", Type="Expression", Expression="1 - t")}</ParameterList><ParameterList name="Solver">',
)

# Two bodies, 2 m from each other along x; the second begins with a velocity.
HINGED = """<ParameterList name="culm">
  <ParameterList name="Structures">
    <ParameterList name="hub">%(body)s<Parameter name="Position" value="{0, 0, 0}"/></ParameterList>
    <ParameterList name="arm">%(body)s<Parameter name="Position" value="{2, 0, 0}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Constraints">%(constraints)s</ParameterList>
  <ParameterList name="Initial Conditions">%(start)s</ParameterList>
  <ParameterList name="Analyses">
    <ParameterList name="swing">
      <Parameter name="Type" value="Dynamic"/>
      <Parameter name="End Time" value="0.02"/>
      <Parameter name="Step" value="0.01"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output">
    <ParameterList name="History">
      <ParameterList name="arm"><Parameter name="Type" value="Position"/><Parameter name="Node" value="arm"/></ParameterList>
      <ParameterList name="energy"><Parameter name="Type" value="Energy"/></ParameterList>
      %(watch)s
    </ParameterList>
  </ParameterList>
</ParameterList>
"""
BODY_VALUES = (
    '<Parameter name="Type" value="Rigid Body"/><Parameter name="Mass" value="3"/>'
    '<Parameter name="Inertia" value="{1, 1, 1}"/>'
)
GROUND = entry("ground", Type="Rigid Support", Node="hub")
HINGE = entry("hinge", Type="Revolute Joint", First="hub", Second="arm", Position="{0, 0, 0}", Axis="{0, 1, 0}")
BOLT = entry("bolt", Type="Rigid Connection", Master="hub", Node="arm")


SPIN = entry("spin", Type="Velocity", Node="arm", Angular_Velocity="{0, 3, 0}", About="{0, 0, 0}")


def hinged(constraints, velocity, watch="", start=None):
    start = start or entry("push", Type="Velocity", Node="arm", Velocity=velocity)
    return HINGED % dict(body=BODY_VALUES, constraints=constraints, start=start, watch=watch)


TYPES = ["Stiffness Matrix", "Tube", "Beam", "Polyline", "Rigid Support", "Force", "Static"]

CASES = [
    Case("version", 0, args="--version", check=is_version, ranks=True),
    Case(
        "help",
        0,
        args="--help",
        prints=["\n  run ", "\n  check ", "\n  reference "],
        check=is_help_of_culm,
        ranks=True,
    ),
    Case(
        "help of a verb",
        0,
        args="run --help",
        prints=["deck TEXT REQUIRED", "--set TEXT", "--quiet", "--output TEXT", "--strict", "8 done, all results"],
    ),
    Case(
        "check counts and leaves nothing",
        0,
        args="check deck.xml",
        prints=[
            "\nbeam                          5        4            0\n",
            "\nRigid Support 'clamp'                    by elimination               beam/0\n",
            "\nunknowns: 24 (0 multipliers)\ndegrees of freedom: 24\nmatrix entries: ",
            "\nlinear solver: Block LU, automatic: fronts of ",
            "\nBeam, director, order 1 ",
            "\nForce, tip force ",
            "\nthe deck is sound\n",
        ],
        ranks=True,
    ),
    Case(
        "check in the other form",
        0,
        args="check deck.xml --set 'Solver/Form=Multipliers'",
        # twelve of the clamp, six of each other node
        prints=["\nunknowns: 96 (36 multipliers)\ndegrees of freedom: 24\nmatrix entries: "],
    ),
    Case(
        "run with the other linear solver",
        0,
        args="run deck.xml --output out --set 'Solver/Linear Solver=MUMPS'",
        prints=["\nFactorisation, MUMPS ", "\nlinear solver: MUMPS, as the deck says\n"],
        results="out",
        last_level=1.0,
        ranks=True,
    ),
    Case(
        "statics of a free body",
        4,
        deck=BODY % "Static",
        says=[
            "The equations are singular at level 0, before the first step.\n"
            "Likely cause: a mechanism. Nothing resists this motion:\n",
            "\n'ball' turns about the axis ",
            "; nothing holds it\n",
        ],
        silent=False,
        results="out",
        last_level=0.0,
        ranks=True,
    ),
    Case(
        "modes of a free body",
        0,
        deck=BODY % "Modal",
        # its modes are rigid motions, so there is no warning that vibrations were lost
        says=["warning: the state is no equilibrium: "],
        never=["all 6 modes are at 0 Hz"],
        prints=["\n6 modes at 0 Hz: rigid-body motions and mechanisms\n"],
        results="out",
        last_level=0.0,
        ranks=True,
    ),
    Case(
        "a path that its steps end before its target",
        8,
        args=RUN,
        change=[(STATIC, PATH % "Final Level")],
        errors=[
            "warning: the path ended at level ...",
            promise("path (bend)").strip(),
        ],
        results="out",
        check=has_findings("path"),
        ranks=True,
    ),
    Case(
        "a path that arrives",
        0,
        args=RUN + " --strict",
        change=[(STATIC, (PATH % "Final Level").replace('"2"', '"20"'))],
        silent=True,
        results="out",
        last_level=1.0,
        check=has_findings(),
    ),
    Case(
        "one over what is zero, on the rank that has it",
        5,
        args=RUN,
        change=[
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Signals">'
                + entry("height", Type="Displacement", Node="beam/last", Direction="{0, 0, 1}")
                + entry("inverse", Type="Product", Signals="{height}", Powers="{-1}")
                + '</ParameterList><ParameterList name="Loads">',
            ),
        ],
        says=["Product 'inverse' has no finite value at time"],
        results="out",
    ),
    Case(
        "what starts beyond its limits",
        3,
        args=RUN,
        change=[
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Signals">'
                + entry("pitch", Type="Lag", Signal="Ramp", Time_Constant="1", Upper="2", Initial="3")
                + entry("angle", Type="Actuator", Signal="Ramp", Frequency="1", Lower="0", Initial="-1")
                + '</ParameterList><ParameterList name="Loads">',
            ),
        ],
        says=["pitch / Initial: must not be beyond 'Lower' or 'Upper', got 3",
              "angle / Initial: must not be beyond 'Lower' or 'Upper', got -1"],
    ),
    Case(
        "weight and a sea of another world",
        0,
        args=RUN,
        change=[
            (
                '<ParameterList name="Loads">',
                f'<ParameterList name="Masses">{entry("tip mass", Type="Point Mass", Node="beam/last", Mass="1")}</ParameterList>'
                '<ParameterList name="Flows">'
                + entry("sea", Type="Still Water", Depth="10", Level="100", Up="{0, 1, 0}", Gravity="9")
                + '</ParameterList><ParameterList name="Loads">'
                + entry("weight", Type="Gravity", Acceleration="{0, -3, 0}"),
            ),
        ],
        says=["warning: Loads / weight pulls with 3 m/s^2, but Flows / sea has Gravity = 9: weight and buoyancy do not match"],
        results="out",
        last_level=1.0,
        check=has_findings("gravity", grade=False),
    ),
    Case(
        "two loads of the air on one section",
        3,
        args=RUN,
        change=[in_wind(strip("air"), strip("tail", Axis_At="-2"), strip("more air", Chord="0.2", Axis_At="0.5"))],
        says=["'beam' has the strips 'air' in the same place: the air would act on it twice"],
    ),
    Case(
        "an angle at the quarter chord with what thin airfoils have at three quarters",
        3,
        args=RUN,
        change=[in_wind(strip("air", Angle_At="0.25", Lag="Jones"))],
        says=["Angle At", "must be 0.75 with 'Lag' = Jones and with 'Apparent Mass'"],
    ),
    Case(
        "a beam, and one of its nodes by two names",
        3,
        args=RUN,
        change=[in_wind(*(strip(name, Structure="", Node=node, Length="0.5")
                          for name, node in (("air", "beam/last"), ("fin", "beam/3"), ("more air", "beam/4"))))],
        says=["'beam/4' has the strips 'air' in the same place: the air would act on it twice"],
    ),
    Case(
        "a beam and a node of it",
        3,
        args=RUN,
        change=[in_wind(strip("air"), strip("more air", Structure="", Node="beam/3", Length="0.5"))],
        says=["'beam/3' has the strips 'air' in the same place: the air would act on it twice"],
    ),
    Case(
        "two halves of the air",
        0,
        args=RUN,
        change=[
            in_wind(strip("air", Function="half"), strip("more air", Function="half")),
            HALF,
        ],
        results="out",
        last_level=1.0,
        check=has_findings(),
    ),
    Case(
        "functions by which the air acts twice",
        0,
        args=RUN,
        change=[in_wind(strip("air", Function="Ramp"), strip("more air", Function="Ramp", Stations="3"))],
        says=["warning: Strip 'air' and Strip 'more air' lie in the same place and act at the same time, by their "
              "functions with more than the whole air together: it acts on the structure twice\n"],
        results="out",
        last_level=1.0,
        check=has_findings("air twice", grade=False),
        ranks=True,
    ),
    Case(
        "a current that goes upwards",
        3,
        args=RUN,
        change=[(
            '<ParameterList name="Loads">',
            '<ParameterList name="Flows"><ParameterList name="sea"><Parameter name="Type" value="Still Water"/>'
            '<Parameter name="Depth" value="20"/>'
            + entry("Current", Type="Uniform", Speed="1", Direction="{0, 0, 1}")
            + '</ParameterList></ParameterList><ParameterList name="Loads">',
        )],
        says=["Flows / sea / Current / Direction: 'Direction' and 'Up' must not be parallel or zero"],
    ),
    *(
        Case(
            f"air on what stands at the ground of its wind, {name}",
            0,
            args=RUN,
            change=[
                in_wind(load, Type="Power Law", Speed="10", Height="10", Exponent="0", Up="{0, 1, 0}"),
            ],
            says=[f"warning: {name} meets no wind: all of it stands at the ground of its flow or below, where the "
                  "height along 'Up' above the origin is 0; put the structure higher, or take a 'Uniform' flow\n"],
            results="out",
            last_level=1.0,
            check=has_findings("below ground", grade=False),
            ranks=True,
        )
        for name, load in (("Strip 'air'", strip("air")), ("Vortex Lattice 'rings'", RINGS))
    ),
    Case(
        "functions by which loads of the air take turns",
        0,
        args=RUN,
        change=[in_wind(strip("air", Function="Ramp"), strip("more air", Function="fade")), HALF],
        results="out",
        last_level=1.0,
        check=has_findings(),
    ),
    Case(
        "air on what a rotating frame turns, in a wind that does not turn with it",
        3,
        args=RUN,
        change=[
            (
                '<ParameterList name="Loads">',
                f'<ParameterList name="Masses">{entry("tip mass", Type="Point Mass", Node="beam/last", Mass="1")}</ParameterList>'
                f'<ParameterList name="Airfoils">{entry("thin", Type="Thin")}</ParameterList>'
                f'<ParameterList name="Flows">{entry("wind", Type="Uniform", Density="1", Velocity="{1, 0, 1}")}</ParameterList>'
                '<ParameterList name="Loads">'
                + entry("air", Type="Strip", Structure="beam", Flow="wind", Chord="0.1", Axis_At="0.25", Airfoil="thin")
                + entry("turning", Type="Rotating Frame", Axis="{0, 0, 1}", Speed="0.1", Function="Constant"),
            ),
        ],
        says=["Strip 'air' stands in a rotating frame, but its wind is not the same from all sides: at station 0 it is {1, 0, 1} "
              "m/s in the frame, and {0.7071, -0.7071, 1} after 45 degrees"],
    ),
    Case(
        "vortex rings on what a rotating frame turns",
        3,
        args="check deck.xml",
        change=[
            (
                '<ParameterList name="Loads">',
                f'<ParameterList name="Masses">{entry("tip mass", Type="Point Mass", Node="beam/last", Mass="1")}</ParameterList>'
                f'<ParameterList name="Airfoils">{entry("thin", Type="Thin")}</ParameterList>'
                '<ParameterList name="Flows">'
                + entry("wind", Type="Uniform", Density="1", Velocity="{0, 0, 1}")
                + entry("about", Type="Uniform", Density="1", Velocity="{0, 0, 1}").replace(
                    "</ParameterList>",
                    '<ParameterList name="Tower Influence"><Parameter name="Structure" value="beam"/>'
                    '<Parameter name="Diameters" value="{0.1, 0.1}"/></ParameterList></ParameterList>')
                + '</ParameterList><ParameterList name="Loads">'
                + entry("air", Type="Strip", Structure="beam", Flow="about", Chord="0.1", Airfoil="thin")
                + RINGS
                + entry("turning", Type="Rotating Frame", Axis="{0, 0, 1}", Speed="0.1"),
            ),
        ],
        says=["Loads / rings: stands on what a load 'Rotating Frame' turns, whose speed it does not see"],
    ),
    Case(
        "a load on the clamp, on the page",
        8,
        args="run deck.xml --output out --report",
        change=[(TIP_FORCE, CLAMP_FORCE)],
        says=[IDLE % "Force 'tip force'", promise("idle load (bend)")],
        prints=["out/report.html\n"],
        silent=False,
        results="out",
        last_level=1.0,
        check=lambda folder, _: has_findings("idle load")(folder, _)
        or ("" if '<p class="broken">idle load (bend, at 1): Force' in (folder / "out/report.html").read_text()
            else "it is not on the page"),
        ranks=True,
    ),
    Case(
        "one of three loads on the clamp",
        0,
        args=RUN,
        change=[('<ParameterList name="Loads">', '<ParameterList name="Loads">'
                 + entry("into the clamp", Type="Force", Node="beam/first", Force="{0, 0, 1}")
                 + entry("push", Type="Force", Node="beam/2", Force="{0, 1, 0}"))],
        says=[IDLE % "Force 'into the clamp'"],
        never=["'push'", "'tip force'"],
        silent=False,
        results="out",
        last_level=1.0,
        check=has_findings("idle load", grade=False),
        ranks=True,
    ),
    *(
        Case(
            f"a load on what only joints hold, {form}",
            8,
            deck=STACK,
            args=RUN,
            change=[('"Null Space"', f'"{form}"')],
            says=[IDLE % "Force 'push'", promise("idle load (motion)")],
            silent=False,
            leaves=["out"],
            ranks=True,
        )
        for form in ("Null Space", "Multipliers")
    ),
    Case(
        "a load on what a joint lets turn",
        0,
        deck=STACK,
        args=RUN,
        change=[('value="Weld"/><Parameter name="First" value="base"/>',
                 'value="Revolute Joint"/><Parameter name="Axis" value="{0, 1, 0}"/><Parameter name="First" value="base"/>')],
        never=["moves nothing"],
        silent=False,
        leaves=["out"],
    ),
    Case(
        "a load that is zero in all steps",
        0,
        args=RUN,
        change=[
            ('<ParameterList name="Loads">', '<ParameterList name="Loads">'
             + entry("late", Type="Force", Node="beam/last", Force="{0, 0, 1}", Function="fade in later")),
            ('<ParameterList name="Solver">', f'<ParameterList name="Functions">{entry("fade in later", Type="Table", Times="{0, 10, 20}", Values="{0, 0, 1}")}'
             '</ParameterList><ParameterList name="Solver">'),
        ],
        says=["warning: Force 'late' never acts: it is zero in all steps\n"],
        results="out",
        last_level=1.0,
        check=has_findings("idle load", grade=False),
        ranks=True,
    ),
    Case(
        "a moment on a shell that turns about its director in part",
        0,
        deck=PLATE % entry("twist", Type="Moment", Node="plate/8", Moment="{0, 3, 4}"),
        args=RUN,
        says=["warning: Moment 'twist' is not carried as a whole: 80 % of it at 'plate/8' turn about the director of the "
              "shell, which resists no such moment; take "],
        leaves=["out"],
        check=has_findings("lost moment", grade=False),
    ),
    Case(
        "a motion in which nothing moves",
        0,
        args="run deck.xml --output out",
        change=[
            (STATIC, DYNAMIC),
            HEAVY,
            ('value="{0, 0, 100}"/>', 'value="{0, 0, 100}"/><Parameter name="Function" value="late"/>'),
            ('<ParameterList name="Solver">', f'<ParameterList name="Functions">{entry("late", Type="Table", Times="{0, 10, 20}", Values="{0, 0, 1}")}'
             '</ParameterList><ParameterList name="Solver">'),
        ],
        says=["warning: Force 'tip force' never acts: it is zero in all steps\n"],
        prints=["not judged: nothing moves but rounding\n"],
        silent=False,
        results="out",
        last_level=0.05,
        check=has_findings("idle load", grade=False),
        ranks=True,
    ),
    Case(
        "a velocity of a node that follows another, which stands still",
        0,
        args=RUN,
        change=[
            (STATIC, DYNAMIC),
            HEAVY,
            ('<ParameterList name="Structures">', '<ParameterList name="Structures">'
             + entry("plate", Type="Rigid Body", Position="{2, 0, 0}", Mass="1", Inertia="{1, 1, 1}")),
            ('<ParameterList name="Constraints">', '<ParameterList name="Constraints">'
             + entry("bolt", Type="Rigid Connection", Node="beam/last", Master="plate")),
            ('<ParameterList name="Solver">', f'<ParameterList name="Initial Conditions">{entry("push", Type="Velocity", Node="beam/last", Velocity="{0, 3, 0}")}'
             '</ParameterList><ParameterList name="Solver">'),
        ],
        says=["warning: initial velocities were made to fit the constraints; largest change 3 m/s at 'beam/4', by Rigid "
              "Connection 'bolt'\n"],
        results="out",
        last_level=0.05,
        check=has_findings("initial velocities", grade=False),
        ranks=True,
    ),
    Case(
        "a load on the clamp beside one that acts, constraints as equations",
        0,
        args=RUN,
        change=[
            (TIP_FORCE, CLAMP_FORCE),
            ("Null Space", "Multipliers"),
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Loads">'
                + entry("twist", Type="Moment", Node="beam/last", Moment="{9, 0, 0}")
                + entry("on both", Type="Force", Node="beam", Force="{0, 1, 0}"),
            ),
        ],
        says=[IDLE % "Force 'tip force'"],
        results="out",
        last_level=1.0,
        ranks=True,
    ),
    Case(
        "loads on a node that a support and a drive hold",
        8,
        args=RUN,
        change=[
            (TIP_FORCE, CLAMP_FORCE),
            ('"Rigid Support"/>', '"Revolute Support"/><Parameter name="Axis" value="{0, 1, 0}"/>'),
            (
                '<ParameterList name="Constraints">',
                '<ParameterList name="Constraints">'
                + entry("turned", Type="Rotation", Node="beam/first", Axis="{0, 1, 0}", Angle="0.1"),
            ),
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Loads">'
                + entry("turning", Type="Moment", Node="beam/first", Moment="{0, 9, 0}"),
            ),
        ],
        says=[
            "warning: 2 loads, Moment 'turning' the first of them, move nothing: all of them act where supports hold "
            "the model and go straight into them\n"
        ],
        results="out",
        last_level=1.0,
        ranks=True,
    ),
    Case(
        "forces that rounding leaves out of balance",
        8,
        args=RUN + " --strict",
        change=[('"2e3" unit="kN"', '"2e15"'), ("{0, 0, 100}", "{0, 0, 1e-3}")],
        says=["warning: rounding leaves forces out of balance by ", promise("rounding (bend)")],
        results="out",
        last_level=1.0,
        check=has_findings("rounding", grade=False),
        ranks=True,
    ),
    Case(
        "a certificate that is broken",
        8,
        deck=hinged(GROUND + HINGE, "{0, 0, 0}", start=SPIN).replace(
            '"0.01"/>', '"0.01"/>' + entry("Newton", Force_Tolerance="0.1", Constraint_Tolerance="1e-2")
        ),
        args=RUN,
        says=["warning: the certificate is broken: ", promise("certificate (swing)")],
        check=has_findings("certificate"),
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "a warning where nothing but good runs will do",
        8,
        deck=BODY % "Modal",
        args=RUN + " --strict",
        says=["warning: the state is no equilibrium: ", promise("no equilibrium (only)")],
        results="out",
        last_level=0.0,
        check=has_findings("no equilibrium", grade=False),
    ),
    Case(
        "the first row has the velocities of the start",
        0,
        deck=hinged(GROUND + HINGE, "{0, 0, 4}"),
        args=RUN,
        # of the two motions that the hinge leaves of 3 kg at 4 m/s, v = 2 m w, the nearest by energy
        says=["warning: initial velocities were made to fit the constraints; largest change ", " at 'arm/0', by Revolute Joint 'hinge'\n"],
        check=has_cells((0, "time", 0.0), (0, "energy kinetic [J]", 12.0 / 13.0 * 24.0)),
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "the first row of a motion that starts later",
        0,
        deck=hinged("", "{0, 0, 4}").replace(
            '"0.01"/>', '"0.01"/><Parameter name="Start Time" value="0.01"/>'
        ),
        args=RUN,
        silent=True,
        check=has_cells((0, "time", 0.01), (0, "energy kinetic [J]", 24.0), (1, "time", 0.02)),
        leaves=["out"],
    ),
    Case(
        "a velocity at a support",
        0,
        deck=hinged(entry("ground", Type="Rigid Support", Node="arm"), "{0, 0, 4}"),
        args=RUN,
        says=["largest change 4 m/s at 'arm/0', by Rigid Support 'ground'\n"],
        check=has_cells((0, "energy kinetic [J]", 0.0)),
        leaves=["out"],
    ),
    Case(
        "a quantity that does not exist in an analysis",
        0,
        args=RUN,
        change=[
            (
                '<ParameterList name="Constraints">',
                '<ParameterList name="Constraints">'
                + entry("held", Type="Simple Support", Node="beam/last", Direction="{0, 1, 1}"),
            ),
            (
                '<ParameterList name="bend">',
                entry("free", Type="Static", Steps="1", Inactive="{held}") + '<ParameterList name="bend">',
            ),
            (
                '<ParameterList name="History">',
                '<ParameterList name="History">'
                + entry("own", Type="Reaction", Node="beam/last", Constraint="held"),
            ),
        ],
        silent=True,
        check=lambda folder, _: has_cells((0, "own Fx [N]", ""), (1, "own Mz [N m]", ""), (3, "own Fx [N]", 0.0))(folder, _)
        or ("" if Results(folder / "out/run.h5").history()[1][2] is None else "the mark is not in run.h5"),
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "a watched point beyond the range of numbers",
        5,
        args=RUN,
        deck=hinged(
            "", "{0, 0, 4}", entry("far", Type="Position", Node="hub", Offset="{1.5e308, 1.5e308, 0}")
        ).replace(
            '"{0, 0, 0}"/>', '"{0, 0, 0}"/><Parameter name="Directors" value="{0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}"/>', 1
        ),
        says=["The watched 'far y' became infinite at the start.\n"],
        check=ends_at(0, 0),
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "a reaction beyond the range of numbers",
        5,
        args=RUN,
        change=[
            (TIP_FORCE, CLAMP_FORCE),
            ("{0, 0, 100}", "{0, 0, 1.2e308}"),
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Loads">'
                + entry("more", Type="Force", Node="beam/first", Force="{0, 0, 1.2e308}"),
            ),
            (
                '<ParameterList name="History">',
                '<ParameterList name="History">' + entry("support", Type="Reaction", Node="beam/first"),
            ),
        ],
        errors=[
            "The watched 'support Fz' became infinite in step 2 of 'bend', at 1.",
            "Likely cause: a load, stiffness or length beyond the range of numbers.",
            "Try: check units and load functions.",
        ],
        check=ends_at(1, 2),
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "forces whose sum is beyond the range of numbers",
        5,
        args=RUN,
        change=[
            ("{0, 0, 100}", "{0, 0, 1.7e308}"),
            (
                '<ParameterList name="Loads">',
                '<ParameterList name="Loads">'
                + entry("more", Type="Force", Node="beam/last", Force="{0, 0, 1.7e308}")
                + entry("most", Type="Force", Node="beam/last", Force="{0, 0, 1.7e308}"),
            ),
        ],
        says=["check units and load functions"],
        leaves=["out"],
        ranks=True,
    ),
    Case(
        "wind beyond the range of numbers",
        5,
        deck=(AIR / "typical_section.xml").read_text(),
        args="run deck.xml --output out --quiet --set V=1e200",
        says=["The mass is not finite at the beginning of the motion.", "check units and functions"],
        leaves=["out"],
    ),
    Case(
        "flutter in a wind that is always the same",
        8,
        deck=(AIR / "goland_flutter.xml").read_text(),
        args="run deck.xml --output out --quiet --strict --set Flows/air/Function=Constant",
        says=["the modes are the same at all levels of 'Flutter': nothing that acts on them changes"],
        leaves=["out"],
    ),
    Case(
        "rotor whose blades stand in two flows",
        3,
        deck=in_two_flows((AIR / "goland_flutter.xml").read_text()),
        args="check deck.xml",
        says=["Loads / rotor / Blades: 'more air' stands in another flow than 'air on the wing'; a rotor has one"],
    ),
    Case(
        "airfoil from a file without rows",
        3,
        deck=(AIR / "typical_section.xml")
        .read_text()
        .replace('value="Thin"/>', 'value="Polar"/>\n      <Parameter name="File Name" value="polar.csv"/>'),
        files={"polar.csv": ""},
        args="check deck.xml",
        errors=["polar.csv: a polar needs at least three angles, got 0"],
    ),
    Case("check, quiet", 0, args="check deck.xml --quiet", silent=True),
    Case(
        "import",
        0,
        deck=None,
        files=BLADE_FILES,
        args="import openfast driver.inp",
        prints=["10 matrices of stiffness and of mass: symmetric", "\nwritten: driver.xml, "],
        leaves=["driver.xml", "driver.report.txt"],
        check=is_imported,
        ranks=True,
    ),
    Case(
        "import replaces nothing",
        6,
        deck=None,
        files={**BLADE_FILES, "driver.xml": "mine"},
        args="import openfast driver.inp",
        errors=["driver.xml: exists and may have been edited: remove it, or name another file ..."],
        check=lambda folder, _: "" if (folder / "driver.xml").read_text() == "mine" else "replaced",
    ),
    Case(
        "import of a mistake",
        3,
        deck=None,
        files={**BLADE_FILES, "beamdyn.inp": BLADE_FILES["beamdyn.inp"].replace("kp_total ", "kp_totl ")},
        args="import openfast driver.inp",
        errors=["beamdyn.inp: kp_total: is missing"],
        ranks=True,
    ),
    Case(
        "import of a file that is not there",
        6,
        deck=None,
        args="import openfast driver.inp",
        errors=["driver.inp: there is no such file"],
        ranks=True,
    ),
    Case(
        "reference of a type",
        0,
        args="reference Box",
        prints=["## Box\n", "In `Sections / <name>`.\n"],
        check=describes_a_box,
        ranks=True,
    ),
    Case(
        "run with its page",
        0,
        args="run deck.xml --output out --report",
        prints=["out/report.html\n"],
        results="out",
        last_level=1.0,
        check=is_page("out/report.html", ["Histories", "Effects and what they cost", "Deck as it was used"]),
    ),
    Case(
        "page of a run that is not there",
        6,
        deck=None,
        args="report out",
        errors=["culm report: there is no run.h5 in 'out'"],
    ),
    Case(
        "effects",
        0,
        args="effects deck.xml --output out --only flexibility",
        # a rigid beam carries the force into its clamp
        prints=[
            "\nFor changes below 1 % this scene needs flexibility of ",
            " needed BROKEN [1]\n",
            "\n[1] idle load (bend, at 1): Force 'tip force' moves nothing: ",
        ],
        leaves=["out"],
        check=is_page("out/effects.html", ["What it contains", "What happens without"]),
    ),
    Case(
        "study of runs that break a promise",
        8,
        change=[
            (TIP_FORCE, CLAMP_FORCE),
        ],
        args="study deck.xml --vary mesh=1:2*2 --repeat 1 --output out",
        prints=["\n[1] idle load (bend, at 1): Force 'tip force' moves nothing: "],
        silent=False,
        leaves=["out"],
        check=lambda folder, _: is_page("out/study.html", ["Runs"])(folder, _)
        or ("" if (folder / "out/study.html").read_text().count('<tr class="broken">') == 2 else "rows are not marked"),
    ),
    Case(
        "an effect that is not there",
        2,
        args="effects deck.xml --output out --only magnetism",
        errors=["culm effects: --only magnetism: this scene has ..."],
    ),
    Case(
        "effects of a mistake",
        3,
        change=[("Elements", "Elments")],
        args="effects deck.xml --output out",
        says=["unknown name 'Elments' – did you mean 'Elements'?"],
    ),
    Case(
        "hard cases by key",
        0,
        deck=None,
        args="hard --list --only MR IP",
        prints=["mass ratio; beam/tip_mass.xml\n", "\na mechanism in statics "],
    ),
    Case(
        "a hard case as a whole, far beyond its margin, too",
        0,
        deck=None,
        args="hard --quick --only 'roll-up on few elements'",
        prints=["\nroll-up on few elements  ", " runs, "],
    ),
    Case(
        "a hard case that there is not",
        2,
        deck=None,
        args="hard --only unheard-of",
        errors=["culm hard: no case has one of ['unheard-of'] in its keys or name; see --list"],
    ),
    Case(
        "margins that are not there",
        6,
        deck=None,
        args="hard --compare missing.json",
        errors=["culm hard: missing.json: [Errno 2] No such file or directory: 'missing.json'"],
    ),
    Case(
        "reference of everything",
        0,
        args="reference",
        check=lambda _, stdout: ", ".join(t for t in TYPES if f"# {t}\n" not in stdout),
    ),
    Case(
        "run",
        0,
        prints=["bend: 1 of 1, step 2, ", "2 steps accepted, 0 cut back", "\n  out/run.h5\n"],
        results="out",
        last_level=1.0,
        check=lambda folder, _: has_levels(folder / "out", "0", "0.5", "1"),
        ranks=True,
    ),
    Case(
        "run, quiet",
        0,
        args="run --quiet deck.xml --output out",
        silent=True,
        results="out",
        last_level=1.0,
        ranks=True,
    ),
    Case(
        "--set replaces a value and may be repeated",
        0,
        args="run deck.xml --output out --set Analyses/bend/Steps=4 --set L=1+2",
        results="out",
        last_level=1.0,
        check=lambda folder, _: has_levels(folder / "out", "0", "0.25", "0.5", "0.75", "1")
        or ("" if "\n0,3,0,0,0,0\n" in (folder / "out/history.csv").read_text() else "L is not 3"),
    ),
    Case(
        "results go to results/<name of the deck>",
        0,
        args="run 'a deck.xml'",
        files={"a deck.xml": BASE},
        results="results/a deck",
        last_level=1.0,
    ),
    Case(
        "a second run replaces the results of the first",
        0,
        times=2,
        results="out",
        last_level=1.0,
        check=lambda folder, _: has_levels(folder / "out", "0", "0.5", "1"),
    ),
    Case(
        "a run replaces the remains of another",
        0,
        prepare=old_results,
        results="out",
        last_level=1.0,
        check=lambda folder, _: has_levels(folder / "out", "0", "0.5", "1"),
    ),
    Case(
        "a run needs nothing to write but its output folder",
        0,
        args="run {folder}/deck.xml --output {folder}/far/away",
        cwd="/proc",  # where not even root can write
        results="far/away",
        last_level=1.0,
    ),
    Case(
        "a warning is no error",
        0,
        args="run deck.xml --output out --quiet",
        change=[
            (
                '<Parameter name="Type" value="Line"/>\n'
                '        <Parameter name="From" value="{0, 0, 0}"/>\n'
                '        <Parameter name="To" value="{L, 0, 0}"/>\n'
                '        <Parameter name="Up" value="{0, 0, 1}"/>',
                '<Parameter name="Type" value="Arc"/>\n'
                '        <Parameter name="Centre" value="{0, 0, 0}"/>\n'
                '        <Parameter name="Axis" value="{0, 0, 1}"/>\n'
                '        <Parameter name="From" value="{L, 0, 0}"/>\n'
                '        <Parameter name="Angle" value="90" unit="deg"/>',
            ),
            ('<ParameterList name="beam">', '@@<ParameterList name="beam">'),
        ],
        silent=True,
        says=[
            "warning: deck.xml:{line}: Structures / beam: element 0 of 'beam', of order 1, is turned by 0.393 rad "
            "between its ends before any load: its strain energy under a given load is 17.2 % too high; take ",
        ],
        results="out",
        last_level=1.0,
        ranks=True,
    ),
]
