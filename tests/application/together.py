"""What works alone must work together: frames that turn and linear or rigid shells, heat and paths, heat and plastic
neighbours, joints under load that statics leave slightly open."""

import csv
import math
import pathlib

from deck_text import ends_with, entry, last_row, listed, rail, rows
from driver import Case

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"
RUN = "run deck.xml --output out --quiet"


def deck(*lists):
    return f'<ParameterList name="culm">{"".join(lists)}</ParameterList>'


def rows_of(folder, column):
    """Texts of a column, with the analysis and the step of each row."""
    with open(folder / "out/history.csv", newline="") as file:
        names, *rows = list(csv.reader(file))
    return [(int(row[names.index("analysis")]), int(row[names.index("step")]), row[names.index(column)]) for row in rows]


# --- a plate of 2 m by 1 m whose centre is 2 m from an axis

STEEL = listed("Materials", entry("steel", Type="Isotropic", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800"))
MASS = 7800 * 2.0 * 1.0 * 0.05
HUB = entry("hub", Type="Rigid Box", Position="{0, 0, 0}", Size="{0.1, 0.1, 0.1}", Density="1000")


def plate(fidelity):
    mesh = entry("Mesh", Type="Plane", Origin="{1, -0.5, 0}", Side_1="{2, 0, 0}", Side_2="{0, 1, 0}", Elements="{4, 2}")
    options = f'<Parameter name="Material" value="steel"/><Parameter name="Thickness" value="0.05"/>{mesh}'
    return (f'<ParameterList name="plate"><Parameter name="Type" value="Shell"/>'
            f'<Parameter name="Fidelity" value="{fidelity}"/>{options}</ParameterList>')


def turning(fidelity, **which):
    """The plate on a hub that is held, or held by its own body, in a frame that turns with 10 rad/s."""
    held = "plate body" if fidelity == "Rigid" else "hub"
    carried = "" if fidelity == "Rigid" else entry("root", Type="Rigid Connection", Node="plate/u0", Master="hub")
    return deck(
        STEEL, listed("Structures", plate(fidelity), HUB),
        listed("Constraints", carried, entry("hub", Type="Rigid Support", Node="hub"),
               entry("body", Type="Rigid Support", Node="plate body") if fidelity == "Rigid" else ""),
        listed("Loads", entry("spin", Type="Rotating Frame", Axis="{0, 0, 1}", Speed="10", **which)),
        listed("Analyses", entry("spin", Type="Static", Steps="1")),
        listed("Output", listed("History", entry("held", Type="Reaction", Node=held))),
    )


TURNING = [
    Case(f"a turning frame and a shell of fidelity {fidelity}, {'named' if which else 'all'}", 0, args=RUN, leaves=["out"],
         deck=turning(fidelity, **which), check=ends_with("held Fx [N]", -MASS * 2.0 * 10.0**2, 0.01 * MASS * 200), ranks=True)
    for fidelity in ("Full", "Linear", "Rigid")
    for which in ({}, {"Structures": "{plate, hub}"})
]


def flying(node, *more):
    return deck(
        STEEL, listed("Structures", plate("Rigid")),
        listed("Initial Conditions", entry("throw", Type="Velocity", Node=node, Velocity="{1, 2, 3}")),
        listed("Analyses", entry("fly", Type="Dynamic", Step="0.01", End_Time="0.1")),
        listed("Output", listed("History", entry("body", Type="Position", Node="plate body"))), *more)


# --- a bar between two clamps, heated by 20 K

BAR = listed("Sections", *(
    entry(name, Type="Rectangle", Width="0.05", Height="0.05", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800",
          **more).replace("</ParameterList>", f"{plasticity}</ParameterList>")
    for name, more, plasticity in (("bar", {"Expansion": "1.2e-5"}, ""),
                                   ("soft", {}, entry("Plasticity", Yield_Stress="2e8", Isotropic_Hardening="1e9")))))
THRUST = 2e11 * 0.05**2 * 1.2e-5 * 20  # E A alpha T
GROWS = listed("Functions", entry("grows", Type="Linear", Duration="1"))


def beam(name, section, x, y):
    curve = entry("Curve", Type="Line", From=f"{{{x}, {y}, 0}}", To=f"{{{x + 2}, {y}, 0}}", Up="{0, 0, 1}", Elements="4")
    return entry(name, Type="Beam", Section=section).replace("</ParameterList>", f"{curve}</ParameterList>")


def clamps(name):
    return entry(f"{name} first", Type="Rigid Support", Node=f"{name}/first") + entry(
        f"{name} last", Type="Rigid Support", Node=f"{name}/last")


def heated(analyses, structures=beam("bar", "bar", 0, 0), constraints=clamps("bar")):
    return deck(
        BAR, GROWS, listed("Structures", structures), listed("Constraints", constraints),
        listed("Loads", entry("heat", Type="Temperature", Structure="bar", Value="20", Function="grows")),
        listed("Analyses", analyses),
        listed("Output", listed("History", entry("bar", Type="Stress Resultants", Structure="bar", Element="1"),
                                entry("all", Type="Energy"))),
    )


def starts_with(column, analysis, value):
    """A check of the row in which an analysis begins."""
    def check(folder, _):
        found = [float(text) for number, step, text in rows_of(folder, column) if (number, step) == (analysis, 0)]
        return "" if len(found) == 1 and abs(found[0] - value) <= 1e-6 * abs(value) else f"{column} begins with {found}, not {value}"

    return check


# another one as long and as stiff is pressed by it
ALONG = heated(
    entry("heat", Type="Path", First_Increment="0.3", Final_Level="1"), beam("bar", "bar", 0, 0) + beam("cold", "bar", 2, 0),
    entry("left", Type="Rigid Support", Node="bar/first") + entry("right", Type="Rigid Support", Node="cold/last")
    + entry("weld", Type="Rigid Connection", Node="cold/first", Master="bar/last"))
STIFFNESS = 2e11 * 0.05**2 / 2.0  # of one of them

HEATED = [
    Case("a path that heat alone follows", 0, args=RUN, leaves=["out"], deck=ALONG,
         check=ends_with("bar N3 [N]", -THRUST / 2, 1e-3 * THRUST), ranks=True),
    Case("the energy at its end", 0, args=RUN, leaves=["out"], deck=ALONG,
         check=ends_with("all strain [J]", (THRUST / 2) ** 2 / STIFFNESS, 0.1)),
    Case("the stress with which an analysis begins that starts from an earlier one", 0, args=RUN, leaves=["out"],
         deck=heated(entry("warm", Type="Static", Final_Level="0.5", Steps="1")
                     + entry("hot", Type="Static", Start_Level="0.5", Final_Level="1", Steps="1")
                     + entry("again", Type="Static", Start_From="warm", Start_Level="0.5", Final_Level="0.6", Steps="1")),
         check=starts_with("bar N3 [N]", 2, -0.5 * THRUST)),
    Case("the energy of two heats on one bar", 0, args=RUN, leaves=["out"],
         deck=heated(entry("heat", Type="Static", Steps="1")).replace(
             '<ParameterList name="Loads">', '<ParameterList name="Loads">' + entry(
                 "more", Type="Temperature", Structure="bar", Value="20")),
         check=ends_with("all strain [J]", (2 * THRUST) ** 2 / 2 / STIFFNESS, 1e-6 * THRUST**2 / STIFFNESS)),
    Case("heat on a beam beside one that yields", 0, args=RUN, leaves=["out"],
         deck=heated(entry("heat", Type="Static", Steps="1"), beam("bar", "bar", 0, 0) + beam("pile", "soft", 0, 1),
                     clamps("bar") + clamps("pile")),
         check=ends_with("bar N3 [N]", -THRUST, 1e-6 * THRUST)),
]

# --- joints

BOXES = "".join(entry(name, Type="Rigid Box", Position=f"{{{x}, 0, 0}}", Size="{1, 1, 1}", Density="1000")
                for name, x in (("a", 0), ("b", 2)))


def is_empty_in_statics(folder, _):
    """Cells of an acceleration, in statics and where a motion begins: empty; in its steps: not."""
    for number, step, text in rows_of(folder, "shake ax [m/s^2]"):
        if (text == "") != (number == 1 or step == 0):
            return f"analysis {number}, step {step}: '{text}'"
    return ""


# --- a wheel that turns by 10 rad/s, whose partner sees windows of ten steps

WHEEL = deck(
    listed("Structures", *(entry(name, Type="Rigid Body", Position="{0, 0, 0}", Mass="1", Inertia="{1, 1, 1}")
                           for name in ("base", "wheel"))),
    listed("Constraints", entry("ground", Type="Rigid Support", Node="base"),
           entry("axle", Type="Revolute Joint", First="base", Second="wheel", Axis="{0, 0, 1}")),
    listed("Initial Conditions", entry("spin", Type="Velocity", Node="wheel", Angular_Velocity="{0, 0, 10}")),
    listed("Ports", entry("wheel", Type="Points", Points="{wheel}")),
    listed("Analyses", entry("turn", Type="Dynamic", Step="0.05", End_Time="2")),
    listed("Output", listed("History", entry("angle", Type="Joint Angle", First="base", Second="wheel", Axis="{0, 0, 1}"))))


def sees_all_steps(folder, report):
    angle = last_row(folder)["angle [rad]"]
    if abs(angle - 20.0) > 0.5:
        return f"the wheel has turned by {angle} rad"
    return "" if "40 steps accepted" in report else f"40 steps were made, and the report says\n{report[:400]}"


WINDOWS = Case("turns and steps within windows of a coupling", 0, leaves=["out"], deck=WHEEL, silent=False,
               args="couple deck.xml --partner dashpot --damping 1e-9 --window 0.5 --output out", check=sees_all_steps)

def sprung(*analyses):
    spring = entry("spring", Type="Torsion Spring", First="base", Second="wheel", Axis="{0, 0, 1}", Stiffness="0.1")
    return WHEEL.replace('<ParameterList name="Analyses">', listed("Loads", spring) + '<ParameterList name="Analyses">' + "".join(
        entry(name, Type="Dynamic", Step="0.05", Start_Time="0", End_Time="0.5", **more) for name, more in analyses))


JOINED = [
    WINDOWS,
    Case("a spring that does not act for an analysis forgets its turns", 0, args=RUN, leaves=["out"],
         deck=sprung(("with", {}), ("without", {"Inactive": "{spring}"})),
         says=["warning: Torsion Spring 'spring' begins anew: "]),
    Case("a start by more than half a turn beside a spring that counts turns", 0, args=RUN, leaves=["out"],
         deck=sprung().replace('<ParameterList name="spin">', entry(
             "turned", Type="Displacement", Node="wheel", Axis="{0, 0, 1}", Angle="3*pi/2") + '<ParameterList name="spin">'),
         says=["turns by 4.71239 rad, which is more than half a turn: springs and drives that count turns begin at -1.5708 rad"]),
    Case("a spring that acts later has nothing to forget", 0, args=RUN, leaves=["out"],
         deck=sprung(("without", {"Inactive": "{spring}"})), says=["warning: port 'wheel' has no loads"], never=["begins anew"]),
    Case("weight of what supports move", 0, args=RUN, leaves=["out"],
         deck=deck(listed("Structures", BOXES.replace("name=\"b\"", "name=\"arm\"")), GROWS,
                   listed("Constraints", entry("held", Type="Rigid Support", Node="a"),
                          entry("arm", Type="Rigid Support", Node="arm", Axis="{0, 1, 0}", Angle="1", Angle_Function="grows")),
                   listed("Loads", entry("weight", Type="Gravity")),
                   listed("Analyses", entry("turn", Type="Dynamic", Step="0.1", End_Time="1")),
                   listed("Output", listed("History", entry("arm", Type="Reaction", Node="arm")))),
         says=["warning: Gravity 'weight' moves nothing: "]),
    Case("the force of a spring where an analysis starts from the reference again", 0, args=RUN, leaves=["out"],
         deck=deck(BAR, listed("Structures", beam("bar", "bar", 0, 0)),
                   listed("Constraints", entry("held", Type="Rigid Support", Node="bar/first")),
                   listed("Loads", entry("push", Type="Force", Node="bar/last", Force="{0, 0, 50}"),
                          entry("prop", Type="Directed Ground Spring", Node="bar/last", Direction="{0, 0, 1}", Stiffness="1e4")),
                   listed("Analyses", entry("one", Type="Static", Steps="1"),
                          entry("two", Type="Static", Steps="1", Start_From="Reference")),
                   listed("Output", listed("History", entry("prop", Type="Link", Load="prop")))),
         check=starts_with("prop F [N]", 1, 0.0)),
    Case("two bodies on one connection in free flight along it", 0, args=RUN, leaves=["out"],
         deck=deck(listed("Structures", BOXES),
                   listed("Constraints", entry("rod", Type="Rigid Connection", Node="b", Master="a")),
                   listed("Initial Conditions", entry("throw", Type="Velocity", Node="a", Velocity="{0.1, 0.2, 0.3}"),
                          entry("with it", Type="Velocity", Node="b", Velocity="{0.1, 0.2, 0.3}")),
                   listed("Analyses", entry("fly", Type="Dynamic", Step="0.01", End_Time="0.1")),
                   listed("Output", listed("History", entry("b", Type="Position", Node="b")))),
         check=ends_with("b y [m]", 0.02, 1e-12), ranks=True),
    Case("accelerations in statics between motions", 0, args=RUN, leaves=["out"],
         deck=deck(BAR, listed("Structures", beam("bar", "bar", 0, 0)),
                   listed("Constraints", entry("held", Type="Rigid Support", Node="bar/first")),
                   listed("Loads", entry("push", Type="Force", Node="bar/last", Force="{0, 0, 50}", Function="Constant")),
                   listed("Analyses", entry("one", Type="Dynamic", Step="0.01", End_Time="0.05"),
                          entry("rest", Type="Static", Start_Level="1", Final_Level="2", Steps="2"),
                          entry("two", Type="Dynamic", Start_Time="2", Step="0.01", End_Time="2.05")),
                   listed("Output", listed("History", entry("shake", Type="Acceleration", Node="bar/last")))),
         check=is_empty_in_statics),
]

# --- little that moves among much that cancels: energies and momenta are kept to the rounding of what there is

SPAR = INPUTS / "offshore/moored_spar.xml"
SHORT = " --set Loads/pull/Force={-0.5,0,0} --set Analyses/decay/Step=0.05 --set 'Analyses/decay/End Time=0.5'"

CANCELS = [
    Case("a heated bar that hardly swings", 0, args=RUN, leaves=["out"],
         deck=deck(BAR, listed("Structures", beam("bar", "bar", 0, 0)),
                   listed("Constraints", entry("held", Type="Rigid Support", Node="bar/first")),
                   listed("Loads", entry("heat", Type="Temperature", Structure="bar", Value="50"),
                          entry("push", Type="Force", Node="bar/last", Force="{0, 0, 0.01}", Function="Constant")),
                   listed("Analyses", entry("heat", Type="Static", Steps="1", Inactive="{push}"),
                          entry("swing", Type="Dynamic", Start_Time="1", End_Time="1.1", Step="1e-3")),
                   listed("Output", listed("History", entry("bar", Type="Position", Node="bar/last"))))),
    Case("a moored spar that hardly moves", 0, args=RUN + SHORT, leaves=["out"], deck=SPAR.read_text(), ranks=True),
]

# --- a pile in a wave that stands still at its crest, on a foot that no water touches

PILE = (INPUTS / "water/wave_on_pile.xml").read_text()
CREST = PILE.replace('name="Buoyancy" value="false"', 'name="Dry Ends" value="{first}"').replace(
    '<ParameterList name="History">', '<ParameterList name="History">' + entry("sea", Type="Waves", Load="waves"))


def waves_lift_nothing(stretching):
    """Pressure acts across the pile, so its foot is pressed by nothing but what the theory leaves out."""
    return Case(f"a crest at a pile with a dry foot, {stretching}", 0, leaves=["out"], deck=CREST,
                args=f"{RUN} --set p=0 --set Flows/sea/Stretching={stretching}",
                check=ends_with("bed Fz [N]", 0.0, 2e-3 * 1025 * 9.80665 * 28.27))


CRESTS = [waves_lift_nothing(stretching) for stretching in ("None", "Vertical", "Wheeler")] + [
    Case("the sea that statics see", 0, leaves=["out"], deck=CREST, args=f"{RUN} --set p=0",
         check=ends_with("sea elevation [m]", 3.0, 1e-12)),
]

# --- a cantilever of 1 m whose height falls from 0.2 to 0.1 m, bent about its wider side by a turn of its tip


def yielding(name, cells, width):
    rectangle = entry(name, Type="Rectangle", Width=width, Height="0.1", Young_Modulus="2e11", Poisson_Ratio="0.3")
    return rectangle.replace("</ParameterList>", entry("Plasticity", Yield_Stress="2.5e8", Kinematic_Hardening="2e7",
                                                       Cells=cells) + "</ParameterList>")


def tapered(cells, *widths):
    curve = entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0, 0}", Up="{0, 0, 1}", Elements="10")
    return deck(
        listed("Sections", yielding("a", "{20, 2}", widths[0]), yielding("b", cells, widths[1])),
        listed("Structures", entry("bar", Type="Beam", Sections="{a, b}", Section_Positions="{0, 1}", Order="2").replace(
            "</ParameterList>", f"{curve}</ParameterList>")),
        listed("Constraints", entry("held", Type="Rigid Support", Node="bar/first"),
               entry("turned", Type="Rotation", Node="bar/last", Axis="{0, 1, 0}", Angle="0.1")),
        listed("Analyses", entry("bend", Type="Static", Steps="10")),
        listed("Output", listed("History", entry("held", Type="Reaction", Node="bar/first"))))


def stays_plastic(folder, _):
    found = abs(last_row(folder)["held My [N m]"])
    weakest = 2.5e8 * 0.1 * 0.1**2 / 4  # full plastic moment of the end
    return "" if weakest < found < 1.06 * weakest else f"the moment is {found}, that of a hinge {weakest}"


TAPERED = [
    Case("a beam that is thinner at one end and yields there", 0, args=RUN, leaves=["out"], deck=tapered("{20, 2}", "0.2", "0.1"),
         check=stays_plastic),
    Case("sections with as many fibres elsewhere", 3, args=RUN, deck=tapered("{2, 20}", "0.1", "0.1"),
         says=["sections along one beam must yield with the same 'Type' and 'Cells'"]),
]

# --- schemes that go from acceleration to acceleration begin with that of what acts from the start

FALLS = [
    Case(f"free fall by {scheme}, in two motions", 0, args=RUN, leaves=["out"],
         deck=deck(listed("Structures", entry("box", Type="Rigid Box", Position="{0, 0, 0}", Size="{1, 1, 1}", Density="1000")),
                   listed("Loads", entry("weight", Type="Gravity", Acceleration="{0, 0, -9.81}")),
                   listed("Analyses", *(entry(name, Type="Dynamic", Scheme=scheme, Step="0.01", End_Time=end)
                                        for name, end in (("one", "0.3"), ("two", "1")))),
                   listed("Output", listed("History", entry("box", Type="Position", Node="box")))),
         check=ends_with("box z [m]", -9.81 / 2, 1e-6))
    for scheme in ("Conserving", "Generalised Alpha", "Trapezoidal")
]

# --- modes at 0 Hz may be combined at will: three translations, two turns, and one that displaces nothing

def has_masses_of_free_beam(folder, _):
    with open(folder / "out/analyses/modes/modes.csv", newline="") as file:
        found = [float(row["modal mass [kg]"]) for row in csv.DictReader(file)][:6]
    wanted = [1, 1, 1, 1 / 3, 1 / 3, 0]
    return "" if all(abs(f - w) < 1e-4 for f, w in zip(found, wanted)) else f"the modal masses are {found}"


# --- a bar that is warmed and cooled stores and gives back what dwarfs all else

def is_kept(folder, text):
    lines = [line for line in text.splitlines() if "energy balance" in line]
    return "" if len(lines) == 1 and lines[0].endswith("kept") else f"the balance of energy: {lines}"


def breathing():
    line = entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0, 0}", Up="{0, 0, 1}", Elements="8")
    return deck(
        listed("Sections", entry("rod", Type="Rectangle", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800", Width="0.02",
                                 Height="0.02", Expansion="1.2e-5")),
        listed("Functions", entry("warm", Type="Sinusoidal", Period="3")),
        listed("Structures", entry("rod", Type="Beam", Section="rod").replace("</ParameterList>", f"{line}</ParameterList>")),
        listed("Constraints", entry("clamp", Type="Rigid Support", Node="rod/first")),
        listed("Loads", entry("heat", Type="Temperature", Structure="rod", Value="50", Function="warm")),
        listed("Analyses", entry("motion", Type="Dynamic", Step="0.05", End_Time="10")))


# --- a strip of 1 m by 0.02 m by 0.01 m, clamped at one end and bent by a tenth of its thickness at the other

SAG = 1e-3  # m

def slender():
    mesh = entry("Mesh", Type="Plane", Side_1="{1, 0, 0}", Side_2="{0, 0.02, 0}", Elements="{20, 1}")
    shell = entry("strip", Type="Shell", Material="soft", Thickness="0.01", Fidelity="Linear")
    force = SAG * 3 * 1e9 * 0.01**3 / 12  # per metre of the edge
    return deck(listed("Materials", entry("soft", Type="Isotropic", Young_Modulus="1e9", Poisson_Ratio="0", Density="1000")),
                listed("Structures", shell.replace("</ParameterList>", f"{mesh}</ParameterList>")),
                listed("Constraints", entry("clamp", Type="Rigid Support", Node="strip/u0")),
                listed("Loads", entry("edge", Type="Line Force", Structure="strip/u1", Force=f"{{0, 0, {force}}}")),
                listed("Analyses", entry("bend", Type="Static", Steps="1")),
                listed("Output", listed("History", entry("end", Type="Displacement", Node="strip/u1 v0"))))


# --- what hangs from a hinge is held by the weight that it carries

ROD_WEIGHT = 7800 * 0.05**2 * 1.0 * 9.81
SIDEWAYS = 0.1 * ROD_WEIGHT  # at the lower end


def hinged(end, *more, sideways="0"):
    """A rod of 1 m from its hinge to a point; without more analyses it only carries its weight."""
    line = entry("Curve", Type="Line", From="{0, 0, 0}", To=f"{{{sideways}, 0, {end}}}", Up="{0, 1, 0}", Elements="4")
    return deck(
        listed("Sections", entry("rod", Type="Rectangle", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800",
                                 Width="0.05", Height="0.05")),
        listed("Functions", entry("later", Type="Table", Times="{0, 1, 2}", Values="{0, 0, 1}"),
               entry("first", Type="Table", Times="{0, 1, 2}", Values="{0, 1, 1}")),
        listed("Structures", entry("rod", Type="Beam", Section="rod").replace("</ParameterList>", f"{line}</ParameterList>")),
        listed("Constraints", entry("hinge", Type="Revolute Support", Node="rod/first", Axis="{0, 1, 0}")),
        listed("Loads", entry("weight", Type="Gravity", Acceleration="{0, 0, -9.81}", Function="first"),
               entry("wind", Type="Force", Node="rod/last", Force=f"{{{SIDEWAYS}, 0, 0}}", Function="later")),
        listed("Analyses", entry("hang", Type="Static", Steps="2"), *more),
        listed("Output", listed("History", entry("tip", Type="Position", Node="rod/last"))),
    )


def hinged_bar(steps):
    """A cantilever along x, and a bar on a hinge at its end that a force at the other end turns by a right angle."""
    def beam(name, first):
        line = entry("Curve", Type="Line", From=f"{{{first}, 0, 0}}", To=f"{{{first + 1}, 0, 0}}", Elements="2")
        return entry(name, Type="Beam", Section="bar").replace("</ParameterList>", f"{line}</ParameterList>")

    bar = entry("bar", Type="Stiffness Values", EA="1e5", GA1="1e5", GA2="1e5", EI1="10", EI2="10", GIp="10")
    return deck(listed("Sections", bar), listed("Structures", beam("held", 0), beam("hung", 1)),
                listed("Constraints", entry("clamp", Type="Rigid Support", Node="held/first"),
                       entry("hinge", Type="Revolute Joint", First="held/last", Second="hung/first", Axis="{0, 1, 0}")),
                listed("Loads", entry("push", Type="Force", Node="hung/last", Force="{0, 0, 1}")),
                listed("Analyses", entry("swing", Type="Static", Steps=steps)),
                listed("Output", listed("History", entry("tip", Type="Position", Node="hung/last"))))


def drawn_away():
    """A body that nothing holds along x but the edge of a sheet to which it is tied softly, so that this is free to widen."""
    sheet = entry("sheet", Type="Shell", Material="film", Thickness="0.02").replace("</ParameterList>", entry(
        "Mesh", Type="Plane", Origin="{1, 0, 0}", Side_1="{0, 0, 0.5}", Side_2="{0, 0.7, 0}", Elements="{1, 1}") + "</ParameterList>")
    return deck(listed("Materials", entry("film", Type="Orthotropic", E1="4e9", E2="1e9", E3="1e9", nu12="0.3", nu13="0.3", nu23="0.2",
                                          G12="5e8", G13="5e8", G23="4e8")),
                listed("Structures", sheet, entry("body", Type="Rigid Body", Position="{1.2, 0.35, 0.5}", Mass="2", Inertia="{0.1, 0.2, 0.3}")),
                listed("Constraints", entry("sides", Type="Symmetry", Node="sheet/v0", Normal="{0, 1, 0}"),
                       entry("tie", Type="Soft Transition", Node="sheet/u1", Master="body"),
                       entry("plane", Type="Planar Support", Node="body", Normal="{0, 1, 0}"),
                       entry("clamp", Type="Rigid Support", Node="sheet/u0")),
                listed("Loads", entry("wind", Type="Surface Force", Structure="sheet", Force="{0.5, 0.25, -2}")),
                entry("Solver", Linear_Solver="MUMPS", Form="Multipliers"), listed("Analyses", entry("s", Type="Static", Steps="1")))


PULLED = entry("pull", Type="Static", Start_Level="1", Final_Level="2", Steps="4")
SWING = math.atan2(SIDEWAYS, ROD_WEIGHT / 2)
SWING_OF_LONG = math.atan2(SIDEWAYS, 1.25 * ROD_WEIGHT / 2)
HANGING = [
    Case("a rod that hangs", 0, args="run deck.xml --output out", leaves=["out"], deck=hinged("-1", PULLED), silent=False,
         prints=["note: nothing resisted some motion before the first step"], check=ends_with("tip x [m]", math.sin(SWING), 1e-5),
         ranks=True),
    Case("a rod that is let go", 0, args=RUN, leaves=["out"], deck=hinged("-1", PULLED, sideways="0.75"),
         check=ends_with("tip z [m]", -1.25 * math.cos(SWING_OF_LONG), 1e-5)),
    Case("a rod that stands on its hinge", 0, args=RUN, leaves=["out"], deck=hinged("1"),
         says=["warning: between the levels 0 and 0.5 the determinant of the stiffness changes its sign"]),
    *(Case(f"a bar on a hinge that is pushed aside swings to where it hangs: {steps} steps", 0, args=RUN, leaves=["out"],
           deck=hinged_bar(steps), never=["determinant"], check=ends_with("tip z [m]", 1.03331624, 1e-6), ranks=True)
      for steps in (1, 2, 5, 20)),
    Case("a body that a load draws away", 4, args=RUN, leaves=["out"], deck=drawn_away(), says=["Likely cause: a mechanism."]),
    Case("a rod without weight", 4, args=RUN, leaves=["out"], deck=hinged("-1").replace("-9.81}", "0}"),
         says=["The equations are singular at level 0, before the first step.\nLikely cause: a mechanism."]),
]

# --- piles of one piece and of pieces that meet at still water, in one crest: the same side force bends both

PIECES = {"whole": (-30, 15), "cut": (-30, -2.5, 0, 2.5, 5, 15)}


def pile_in_pieces(name, y):
    heights = PIECES[name]
    structures, constraints, loads = "", entry(f"{name} foot", Type="Rigid Support", Node=f"{name} 0/first"), ""
    for number, (low, high) in enumerate(zip(heights, heights[1:])):
        line = entry("Curve", Type="Line", From=f"{{0, {y}, {low}}}", To=f"{{0, {y}, {high}}}", Up="{1, 0, 0}",
                     Elements=str(max(1, round((high - low) / 5))))
        structures += entry(f"{name} {number}", Type="Beam", Section="pile").replace("</ParameterList>", f"{line}</ParameterList>")
        loads += entry(f"{name} {number}", Type="Morison", Structure=f"{name} {number}", Flow="sea", Diameter="10",
                       Dry_Ends="{first, last}", Segments="20")
        if number > 0:
            constraints += entry(f"{name} {number}", Type="Rigid Connection", Node=f"{name} {number}/first",
                                 Master=f"{name} {number - 1}/last")
    loads += entry(f"{name} wind", Type="Force", Node=f"{name} {len(heights) - 2}/last", Force="{3e6, 0, 0}")
    return structures, constraints, loads


def has_one_bending(folder, _):
    row = last_row(folder)
    whole, cut = row["whole My [N m]"], row["cut My [N m]"]
    return "" if abs(whole - cut) < 1e-4 * abs(whole) else f"the foot of the whole pile bends by {whole}, of the cut one by {cut}"


AT_STILL_WATER = Case(
    "a pile with a joint at still water", 0, args=RUN, leaves=["out"], check=has_one_bending,
    deck=deck(
        listed("Sections", entry("pile", Type="Tube", Young_Modulus="2e11", Shear_Modulus="7.93e10", Density="7850",
                                 Outer_Radius="5", Wall_Thickness="0.0553")),
        listed("Flows", entry("sea", Type="Regular Waves", Depth="30", Height="8", Period="9.45", Stretching="None")),
        *(listed(title, *parts) for title, parts in zip(
            ("Structures", "Constraints", "Loads"), zip(pile_in_pieces("whole", 0), pile_in_pieces("cut", 100)))),
        listed("Analyses", entry("crest", Type="Static", Steps="2")),
        listed("Output", listed("History", *(entry(name, Type="Reaction", Node=f"{name} 0/first") for name in PIECES)))))

# --- a column that is bent by 1e-3 in its own shape, with a cap on which its load of 0.8 times the critical one acts


def bent_column(*structures, constraints, loaded, root="c/first"):
    values = {"EA": "1e5", "GA1": "1e5", "GA2": "1e5", "EI1": "1", "EI2": "2", "GIp": "1", "rhoA": "1", "rhoI1": "1e-6", "rhoI2": "1e-6"}
    return deck(
        listed("Materials", entry("soft", Type="Isotropic", Young_Modulus="1e6", Poisson_Ratio="0.3")),
        listed("Sections", entry("bar", Type="Stiffness Values", **values)),
        listed("Structures", *structures), listed("Constraints", *constraints), GROWS,
        listed("Loads", entry("P", Type="Force", Node=loaded, Force="{0, 0, -1}", Function="grows")),
        listed("Imperfections", entry("bow", Analysis="buckling", Amplitude="1e-3")),
        listed("Analyses", entry("buckling", Type="Buckling", Modes="1"),
               entry("load", Type="Static", Start_From="Reference", Final_Level="1.97392", Steps="8")),
        listed("Output", listed("History", entry("top", Type="Displacement", Node=loaded), entry("root", Type="Reaction", Node=root))))


COLUMN = entry("c", Type="Beam", Section="bar").replace("</ParameterList>", entry(
    "Curve", Type="Line", From="{0, 0, 0}", To="{0, 0, 1}", Elements="12", Up="{1, 0, 0}") + "</ParameterList>")
TUBE = entry("c", Type="Tube", Model="Shell", From="{0, 0, 0}", To="{0, 0, 1}", Up="{1, 0, 0}", Material="soft",
             Outer_Radius="0.0212", Wall_Thickness="0.0046", Elements="{26, 16}")
FOOT = entry("foot", Type="Rigid Support", Node="c/first")
CAP = entry("cap", Type="Rigid Body", Position="{0, 0, 1}", Mass="1", Inertia="{0.1, 0.1, 0.1}")
CAPPED = entry("cap", Type="Rigid Connection", Node="cap", Master="c/last")


def bends_further(folder, _):
    """By a share of the load over what is left of it, whatever the direction."""
    row = last_row(folder)
    share = 1.97392 / 2.4674011
    sway, expected = math.hypot(row["top ux [m]"], row["top uy [m]"]), 1e-3 * share / (1 - share)
    return "" if abs(sway - expected) < 2e-3 * expected else f"the cap sways by {sway}, not {expected}"


def has_its_lever(folder, _):
    """The moment at the foot is the load by what the end of the tube is beside its axis."""
    row = last_row(folder)
    sway, moment = (math.hypot(row[one], row[other]) for one, other in (("top ux [m]", "top uy [m]"), ("root Mx [N m]", "root My [N m]")))
    return "" if abs(moment - 0.02 * (sway + 1e-3)) < 1e-3 * moment else f"the end sways by {sway}, the moment is {moment}"


BENT = [
    Case("a bent column with a cap", 0, args=RUN, leaves=["out"], check=bends_further,
         deck=bent_column(COLUMN, CAP, constraints=[FOOT, CAPPED], loaded="cap")),
    Case("a bent tube of shells", 0, args=f"{RUN} --set Loads/P/Force={{0,0,-1e-2}}", leaves=["out"], check=has_its_lever,
         deck=bent_column(TUBE, constraints=[FOOT], loaded="c/last").replace("1.97392", "2")),
]

# --- a pole in a current of 2 m/s, half of it above the water

POLE = Case(
    "a strip above the water", 0, args=RUN, leaves=["out"], check=ends_with("foot Fx [N]", -0.5 * 1025 * 2.0**2 * 5, 1.0),
    deck=deck(
        listed("Sections", entry("bar", Type="Rectangle", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800", Width="1", Height="1")),
        listed("Structures", beam("pole", "bar", 0, 0).replace("To\" value=\"{2, 0, 0}", "To\" value=\"{0, 0, 10}").replace(
            "Up\" value=\"{0, 0, 1}", "Up\" value=\"{1, 0, 0}")),
        listed("Constraints", entry("foot", Type="Rigid Support", Node="pole/first")),
        listed("Flows", entry("sea", Type="Still Water", Depth="50", Level="5").replace(
            "</ParameterList>", entry("Current", Type="Uniform", Speed="2") + "</ParameterList>")),
        listed("Loads", entry("drag", Type="Strip Drag", Structure="pole", Flow="sea", Diameter="1", Drag="1", Stations="20")),
        listed("Analyses", entry("stand", Type="Static", Steps="1")),
        listed("Output", listed("History", entry("foot", Type="Reaction", Node="pole/first")))))

# --- a body that has moved, stood and may move again: at rest in still water

CYLINDER = (INPUTS / "water/potential_cylinder.xml").read_text().replace('value="cylinder.1"', f'value="{INPUTS}/water/cylinder.1"')
RESTED = CYLINDER.replace('name="Height" value="1"', 'name="Height" value="0"').replace(
    '<ParameterList name="Analyses">', '<ParameterList name="Analyses">' + entry("before", Type="Dynamic", End_Time="3", Step="step")
    + entry("rest", Type="Static", Steps="1"))
AT_REST = Case("a body at rest after a motion and statics", 0, args=f"{RUN} --set end=1 --set 'Analyses/motion/Start Time=0'", leaves=["out"],
               deck=RESTED, check=ends_with("body ux [m]", 0.0, 1e-12))

# --- a wing that flutters below the first level

def tells_early_flutter(folder, printed):
    table = (folder / "out/analyses/flutter/onset.csv").read_text()
    told = "flutter below the first level" in table and "flutter below the first level, 30" in printed
    return "" if told else f"onset.csv has {table!r}"


EARLY = Case("flutter below the first level", 0, args="run deck.xml --output out --set Analyses/flutter/Levels={30,34}", silent=False,
             leaves=["out"], deck=(INPUTS / "air/flutter.xml").read_text(), check=tells_early_flutter)

# --- the foot of a tube of shells whose ends may widen carries its load; modes that damping makes complex

def carries_the_load(folder, _):
    held = last_row(folder)["root Fz [N]"]
    return "" if abs(held - 0.02) < 1e-6 else f"the foot carries {held} N of 0.02"


SOFT = Case("the foot of a tube with soft ends", 0, args=RUN, leaves=["out"], check=carries_the_load,
            deck=bent_column(TUBE.replace('name="Model"', 'name="Ends" value="Soft"/><Parameter name="Model"'), constraints=[FOOT],
                             loaded="c/last").replace("{0, 0, -1}", "{0, 0, -1e-2}").replace("1.97392", "2"))
NEAR = Case("complex modes next to a frequency", 4, args=RUN, leaves=["out"],
            deck=hinged("1").replace("Revolute Support", "Rigid Support").replace('<Parameter name="Axis" value="{0, 1, 0}"/>', "").replace(
                'name="Section" value="rod"/>', 'name="Section" value="rod"/><Parameter name="Damping" value="1e-4"/>').replace(
                '<ParameterList name="Analyses">', '<ParameterList name="Analyses">' + entry("all", Type="Modal", Near="50", Damping="true")),
            says=["Modes next to a frequency are looked for among undamped ones only."])

# --- a mast at rest beside a partner that answers to its rounding

STANDING_MAST = deck(
    listed("Sections", entry("pole", Type="Stiffness Values", EA="1e7", GA1="4e6", GA2="4e6", EI1="1e5", EI2="1e5", GIp="8e4", rhoA="5",
                             rhoI1="0.05", rhoI2="0.05")),
    listed("Structures", '<ParameterList name="mast"><Parameter name="Type" value="Beam"/><Parameter name="Section" value="pole"/>'
           + entry("Curve", Type="Line", Elements="5", From="{0, 0, 0}", To="{0, 0, 10}") + "</ParameterList>"),
    listed("Constraints", entry("ground", Type="Rigid Support", Node="mast/first")),
    listed("Ports", entry("skin", Type="Stations", Structure="mast", Number="6", Offset="{0.1, 0, 0}")),
    listed("Analyses", entry("calm", Type="Dynamic", Step="0.02", End_Time="0.2")))
COUPLED = [
    Case("a coupled model at rest is in balance", 0, leaves=["out"], deck=STANDING_MAST, never=["out of balance"],
         args="couple deck.xml --partner oscillator --mass 5 --stiffness 100 --output out --quiet"),
]

# --- where a second motion begins nothing has been solved yet: a drive and a damper show no force

def in_two_parts():
    bodies = (entry(name, Type="Rigid Body", Position=place, Mass="1", Inertia="{1, 1, 1}") for name, place in (("wheel", "{0, 0, 0}"), ("cart", "{3, 0, 0}")))
    watched = (entry("drive", Type="Reaction", Node="wheel", Constraint="drive"), entry("brake", Type="Link", Load="brake"),
               entry("spring", Type="Link", Load="spring"))
    along = {"Node": "cart", "Direction": "{1, 0, 0}"}
    return f"""<ParameterList name="culm">{listed("Structures", *bodies)}{listed(
        "Constraints", entry("pin", Type="Revolute Support", Node="wheel", Axis="{0, 0, 1}"),
        *rail("cart"),
        entry("drive", Type="Angular Velocity", Node="wheel", Axis="{0, 0, 1}", Angular_Velocity="2", Function="growth"))}{listed(
        "Functions", entry("growth", Type="Expression", Expression="1+t"))}{listed(
        "Loads", entry("brake", Type="Directed Ground Damper", Damping="2", **along),
        entry("spring", Type="Directed Ground Spring", Stiffness="3", **along))}{listed(
        "Initial Conditions", entry("turn", Type="Velocity", Node="wheel", Angular_Velocity="{0, 0, 2}"),
        entry("push", Type="Velocity", Node="cart", Velocity="{1, 0, 0}"))}{listed(
        "Analyses", entry("one", Type="Dynamic", Step="0.01", End_Time="0.1"), entry("two", Type="Dynamic", Step="0.01", End_Time="0.2"))}
        <ParameterList name="Output">{listed("History", *watched)}</ParameterList></ParameterList>"""


def begins_unsolved(folder, _):
    steps = rows(folder)
    again = next(i for i in range(1, len(steps)) if steps[i]["time"] == steps[i - 1]["time"])
    before, first = steps[again - 1], steps[again]
    found = [(row["drive Mz [N m]"], row["brake F [N]"], row["spring F [N]"]) for row in (before, first)]
    held = 3.0 * first["spring elongation [m]"]
    is_right = abs(found[0][0]) > 1.9 and found[0][1] > 1.0 and found[1][:2] == (0.0, 0.0) and abs(found[1][2] - held) < 1e-9
    return "" if is_right else f"drive, brake and spring before and at the start: {found}"


CASES = [
    Case("a second motion begins without forces of the first one", 0, args=RUN, leaves=["out"], errors=[], deck=in_two_parts(),
         check=begins_unsolved, ranks=True),
    *COUPLED,
    SOFT,
    NEAR,
    AT_REST,
    EARLY,
    POLE,
    *BENT,
    AT_STILL_WATER,
    *TURNING,
    *HANGING,
    *FALLS,
    *TAPERED,
    *CRESTS,
    *CANCELS,
    Case("a rigid shell that is thrown", 0, args=RUN, leaves=["out"], deck=flying("plate"),
         check=ends_with("body z [m]", 0.3, 1e-9), ranks=True),
    Case("one node of it that is thrown", 0, args=RUN, leaves=["out"], deck=flying("plate/u1 v1"),
         says=["warning: initial velocities were made to fit the constraints"]),
    *HEATED,
    Case("a bar that breathes with its temperature keeps its energy", 0, args="run deck.xml --output out", leaves=["out"], errors=[],
         silent=False, deck=breathing(), check=is_kept),
    Case("the frame of a slender strip does not roll", 0, args=RUN, leaves=["out"], errors=[], deck=slender(),
         check=ends_with("end uz [m]", SAG, 2e-3 * SAG)),
    *(Case(f"modal masses of a free beam, {form}", 0, args=f"run deck.xml --output out --quiet --set 'Solver/Form={form}'",
           leaves=["out"], errors=[], deck=(INPUTS / "modes/free_beam.xml").read_text(), check=has_masses_of_free_beam, ranks=True)
      for form in ("Null Space", "Multipliers")),
    Case("the memory that bodies need is predicted", 0, args="check deck.xml --set 'Solver/Linear Solver=KLU2'", silent=False,
         deck=flying("plate").replace(listed("Structures", plate("Rigid")), listed("Structures", plate("Rigid"), HUB)),
         prints=["; factors are those that 'Automatic' would take, 'KLU2' may take more"]),
    *JOINED,
]
