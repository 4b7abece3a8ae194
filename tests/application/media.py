"""Water, ground, wind and heat: what acts twice, what never acts, and what a load leaves out of its medium."""

import csv
import math
import pathlib

from deck_text import entry, listed
from driver import Case

WATER = pathlib.Path(__file__).resolve().parents[2] / "inputs/water"
RUN = "run deck.xml --output out --quiet"


def deck(*lists):
    return f'<ParameterList name="culm">{"".join(lists)}</ParameterList>'


def first_mode(frequency, tolerance=1e-6):
    """A check of the first frequency of the analysis 'modes' [Hz]."""
    def check(folder, _):
        with open(folder / "out/analyses/modes/modes.csv", newline="") as file:
            found = float(next(csv.DictReader(file))["frequency [Hz]"])
        return "" if abs(found - frequency) <= tolerance * frequency else f"the first mode has {found} Hz, not {frequency}"

    return check


# --- a body on a spring in water, by Morison's formula or by files of potential flow

def pile_in_waves():
    """Clamped 20 m under water: residuals fall by a constant factor, as the gradient of the waves is not in the tangent."""
    line = entry("Curve", Type="Line", From="{0, 0, -20}", To="{0, 0, 10}", Up="{1, 0, 0}", Elements="6")
    pile = entry("pile", Type="Beam", Section="tube").replace("</ParameterList>", f"{line}</ParameterList>")
    tube = entry("tube", Type="Tube", Outer_Radius="0.3", Wall_Thickness="0.02", Young_Modulus="2e11", Poisson_Ratio="0.3", Density="7800")
    return Case("a pile in waves keeps its balance of energy", 0, args=RUN, leaves=["out"], errors=[], deck=deck(
        listed("Sections", tube), listed("Structures", pile),
        listed("Constraints", entry("foot", Type="Rigid Support", Node="pile/first")),
        listed("Flows", entry("sea", Type="Regular Waves", Depth="20", Height="4", Period="9")),
        listed("Loads", entry("water", Type="Morison", Structure="pile", Flow="sea", Diameter="0.6", Dry_Ends="{first}")),
        listed("Analyses", entry("motion", Type="Dynamic", End_Time="120", Step="0.1"))))


ALONG_X = (entry("plane", Type="Planar Support", Node="body", Normal="{0, 0, 1}")
           + entry("y", Type="Simple Support", Node="body", Direction="{0, 1, 0}")
           + entry("turn", Type="Rotation", Node="body", Axis="{0, 0, 1}"))
SPRING = entry("spring", Type="Directed Ground Spring", Node="body", Direction="{1, 0, 0}", Stiffness="8e3")
ADDED = 1025 * math.pi * 0.16 * 8


def in_water(loads, sea=None, analysis=None, height="-10", functions=""):
    sea = sea or entry("sea", Type="Still Water", Depth="60")
    return deck(
        listed("Structures", entry("body", Type="Rigid Body", Position=f"{{0, 0, {height}}}", Mass="2000", Inertia="{1e5, 1e5, 1e5}")),
        listed("Constraints", ALONG_X), listed("Functions", functions), listed("Flows", sea), listed("Loads", SPRING, loads),
        listed("Analyses", analysis or entry("modes", Type="Modal", Modes="1")))


def member(**more):
    return entry("member", Type="Morison", Node="body", From="{0, 0, -4}", To="{0, 0, 4}", Flow="sea", Diameter="0.8", **more)


def scaled(share):
    return Case(f"the share {share} of Morison's formula has this share of the added mass", 0, args=RUN, leaves=["out"],
                deck=in_water(member(Drag="0", Function="share"), functions=entry("share", Type="Expression", Expression=share)),
                check=first_mode(math.sqrt(8e3 / (2000 + float(share) * ADDED)) / (2 * math.pi)))


FILES = {name: (WATER / name).read_text() for name in ("cylinder.1", "cylinder.3", "cylinder.hst")}
HULL = entry("hull", Type="Potential Flow", Node="body", Flow="sea", File_Name="cylinder.1", Volume="0")
TOLD = {"Buoyancy": "false", "Pull": "false", "Added_Mass": "0"}


STANDING = entry("rest", Type="Static", Steps="1")


def with_files(name, code=0, *, loads, sea, height="0", **more):
    return Case(name, code, args=RUN, leaves=[] if code else ["out"], files=FILES, deck=in_water(loads, sea, STANDING, height), **more)


def sea_with(current=None, **more):
    text = entry("sea", Type="Still Water", Depth="20", **more)
    return text if current is None else text.replace("</ParameterList>", current + "</ParameterList>")


CURRENT = entry("Current", Type="Uniform", Speed="1.5")
LOST_CURRENT = "Potential Flow 'hull': the current of its sea, 1.5 m/s, does not act on the body"
LOST_LEVEL = "Potential Flow 'hull': 'Level' of its sea, 3 m, neither lifts nor lowers the body"

POTENTIAL = [
    with_files("a member beside potential flow must say what it has", 3, loads=HULL + member(), sea=sea_with(),
               says=["Potential Flow 'hull' acts on the body that carries this member: say 'Buoyancy', 'Pull', 'Added Mass'; "
                     "false and 0 where its files know the member, whose water would act twice"]),
    with_files("the order of both does not matter", 3, loads=member(Buoyancy="true") + HULL, sea=sea_with(),
               says=["say 'Added Mass'; false and 0"]),
    with_files("a member beside potential flow that says it", loads=HULL + member(**TOLD), sea=sea_with(),
               never=["acts on the body"]),
    with_files("potential flow leaves out a current", loads=HULL, sea=sea_with(CURRENT), says=[LOST_CURRENT]),
    with_files("a member brings the current", loads=HULL + member(**TOLD), sea=sea_with(CURRENT),
               never=["the current of its sea"]),
    with_files("potential flow leaves out a level", loads=HULL, sea=sea_with(Level="3"), says=[LOST_LEVEL]),
    with_files("a body at the level", loads=HULL, sea=sea_with(Level="3"), height="3", never=["'Level'"]),
]

# --- waves that add up: 6 of 6 m and 9 s, each less than the 12.4 m at which it breaks in 20 m of water

MOTION = entry("motion", Type="Dynamic", Step="0.1", End_Time="1")


def waves(count):
    heights = ", ".join(["6"] * count)
    periods = ", ".join(["9"] * count)
    return entry("sea", Type="Wave Components", Depth="20", Heights=f"{{{heights}}}", Periods=f"{{{periods}}}")


HIGH = [
    Case("waves that add up to more than waves can be", 0, args=RUN, leaves=["out"], ranks=True,
         deck=in_water(member(Drag="0"), waves(6), MOTION),
         says=["the waves of the sea of Morison 'member' add up to 17.96 m above still water at 0.1 s, but even the longest of them breaks above a height of 12.43 m"]),
    Case("waves that add up to less", 0, args=RUN, leaves=["out"], deck=in_water(member(Drag="0"), waves(1), MOTION),
         never=["add up"]),
]

# --- a pile in the ground

PILE = (listed("Sections", entry("s", Type="Stiffness Values", EA="1e12", GA1="1e12", GA2="1e12", EI1="1e13", EI2="1e13",
                                 GIp="1e13", rhoA="5000", rhoI1="100", rhoI2="100"))
        + listed("Structures", '<ParameterList name="pile"><Parameter name="Type" value="Beam"/>'
                 '<Parameter name="Section" value="s"/>'
                 + entry("Curve", Type="Line", From="{0, 0, 0}", To="{0, 0, -10}", Up="{1, 0, 0}", Elements="2") + "</ParameterList>"))
GUIDED = (entry("ax", Type="Simple Support", Node="pile/first", Direction="{0, 0, 1}")
          + entry("y", Type="Planar Support", Node="pile/first", Normal="{0, 1, 0}"))


def soil(name, layers, **more):
    text = entry(name, Type="Soil", Structure="pile", Diameter="2", Stations="20", **more)
    return text.replace("</ParameterList>", listed("Layers", layers) + "</ParameterList>")


SAND = entry("sand", Type="Sand", Top="0", Friction_Angle="0.6", Unit_Weight="1e4", Initial_Modulus="2e7")


def pushed(way):
    pushes = "".join(entry(f"push {end}", Type="Simple Support", Node=f"pile/{end}", Direction="{1, 0, 0}", Translation=way)
                     for end in ("first", "last"))
    return deck(PILE, listed("Constraints", GUIDED + pushes), listed("Loads", soil("ground", SAND, Hysteresis="true")),
                listed("Analyses", entry("push", Type="Static", Steps="7"),
                       entry("modes", Type="Modal", Modes="1", Inactive="{push first, push last}")))


GROUND = [
    Case("two loads of soil on one pile", 3, args=RUN,
         deck=deck(PILE, listed("Constraints", GUIDED), listed("Loads", soil("one", SAND), soil("two", SAND)),
                   listed("Analyses", entry("modes", Type="Modal", Modes="1"))),
         says=["Soil 'one' holds the same pile across as well, at a depth of 0.25 m and elsewhere: two loads would be twice "
               "the ground"]),
    *(Case(f"modes in sand after a push of {way} m are those of soil that turns back", 0, args=RUN, leaves=["out"],
           deck=pushed(way), says=["the state is no equilibrium"], check=first_mode(14.620305, 1e-5)) for way in ("0.3", "3")),
]

# --- heat that does nothing

BAR = (listed("Sections", entry("s", Type="Stiffness Values", EA="2e6", GA1="1e6", GA2="1e6", EI1="3e3", EI2="4e3", GIp="2e3",
                                Expansion="1e-5"))
       + listed("Structures", '<ParameterList name="bar"><Parameter name="Type" value="Beam"/><Parameter name="Section" value="s"/>'
                + entry("Curve", Type="Line", From="{0, 0, 0}", To="{2, 0, 0}", Up="{0, 0, 1}", Elements="4") + "</ParameterList>"))


def heated(fields="", **more):
    return deck(BAR, listed("Constraints", entry("clamp", Type="Rigid Support", Node="bar/first")), listed("Fields", fields),
                listed("Functions", entry("later", Type="Expression", Expression="t > 5 ? 1 : 0")),
                listed("Loads", entry("sun", Type="Temperature", Structure="bar", **more)),
                listed("Analyses", entry("warm", Type="Static", Steps="2")))


IDLE = "Temperature 'sun' never acts: it is zero in all steps"
HEAT = [
    Case("a temperature whose function is zero", 0, args=RUN, leaves=["out"], deck=heated(Value="20", Function="later"), says=[IDLE],
         ranks=True),
    Case("a temperature whose field is zero on the structure", 0, args=RUN, leaves=["out"], says=[IDLE],
         deck=heated(entry("far", Type="Formula", X="x > 5 ? 20 : 0"), Field="far")),
    Case("a temperature between supports acts", 0, args=RUN, leaves=["out"], deck=heated(Value="20"), never=["never acts", "moves nothing"]),
]

# --- a wing

GOLAND = (WATER.parent / "air/goland.xml").read_text()
AIR = '<ParameterList name="Loads">'
STRIPS = entry("strips", Type="Strip", Structure="wing", Flow="air", Chord="c", Airfoil="thin", Stations="8")
WING = [
    Case("a wing by strips and by a vortex lattice", 0, leaves=["out"],
         args=f"{RUN} --set 'Analyses/motion/End Time=0.002'",
         deck=GOLAND.replace(AIR, listed("Airfoils", entry("thin", Type="Thin")) + AIR + STRIPS),
         says=["Strip 'strips' and Vortex Lattice 'flow about the wing' lift the same nodes: where they are one wing, the air acts "
               "on it twice"]),
    Case("a wing by strips that drag and by a vortex lattice", 0, leaves=["out"],
         args=f"{RUN} --set 'Analyses/motion/End Time=0.002'", never=["lift the same nodes"],
         deck=GOLAND.replace(AIR, AIR + entry("strips", Type="Strip Drag", Structure="wing", Flow="air", Diameter="0.1", Drag="1"))),
]

CASES = [pile_in_waves(), *map(scaled, ("1", "0.5", "0")), *POTENTIAL, *HIGH, *GROUND, *HEAT, *WING]
