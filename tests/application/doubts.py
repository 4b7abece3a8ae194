"""What shells, tubes, bodies and friction leave out or cannot do is said: meshes that do not fit, small displacements that
are large, surfaces that lie upon themselves, walls that are too light, loads at folds, turns that nobody counts."""

import math

from deck_text import ends_with, entry, listed
from driver import Case

RUN = "run deck.xml --output out --quiet"
STEEL = listed("Materials", entry("steel", Type="Isotropic", Young_Modulus="1e9", Poisson_Ratio="0", Density="1000"))
STATIC = listed("Analyses", entry("bend", Type="Static", Steps="4"))


def deck(*lists):
    return f'<ParameterList name="culm">{"".join(lists)}</ParameterList>'


def shell(name, mesh, **values):
    lists = entry(name, Type="Shell", Material="steel", **values)
    return lists.replace("</ParameterList>", f"{mesh}</ParameterList>")


def strip(name, origin, elements):
    return shell(name, entry("Mesh", Type="Plane", Origin=origin, Side_1="{1, 0, 0}", Side_2="{0, 0.1, 0}", Elements=elements),
                 Thickness="0.01")


def clamp(*nodes):
    return "".join(entry(f"clamp {node.replace('/', ' ')}", Type="Rigid Support", Node=node) for node in nodes)


# --- connections of meshes that do not fit

def seam(kind, fine, coarse, first="fine/u1", second="coarse/u0"):
    return deck(STEEL, listed("Structures", strip("fine", "{0, 0, 0}", fine), strip("coarse", "{1, 0, 0}", coarse)),
                listed("Constraints", clamp("fine/u0"), entry("seam", Type=kind, First=first, Second=second)),
                listed("Loads", entry("pull", Type="Line Force", Structure="coarse/u1", Force="{0, 0, 0.1}")), STATIC)


SEAMS = [
    Case(f"a {kind} leaves nodes of the finer side free", 3, args=RUN, deck=seam(kind, "{4, 2}", "{4, 1}"),
         says=["1 of 3 nodes, 'fine/9' the first of them, lie between nodes of Second"])
    for kind in ("Smooth Connection", "Fold Connection", "Hinge Connection")
] + [
    Case("sides that fit", 0, args=RUN, deck=seam("Smooth Connection", "{4, 2}", "{4, 2}"), leaves=["out"]),
    Case("an edge on a whole shell", 0, args=RUN, deck=seam("Smooth Connection", "{4, 2}", "{4, 2}", first="fine"), leaves=["out"]),
]


# --- small displacements that are large

def bent(force, fidelity="Linear"):
    plate = strip("plate", "{0, 0, 0}", "{10, 1}").replace('value="Shell"/>', f'value="Shell"/><Parameter name="Fidelity" value="{fidelity}"/>')
    return deck(STEEL, listed("Structures", plate), listed("Constraints", clamp("plate/u0")),
                listed("Loads", entry("tip", Type="Line Force", Structure="plate/u1", Force=f"{{0, 0, {force}}}")), STATIC)


STIFFNESS = 3 * 1e9 * 0.01**3 / 12  # force per width and deflection of the tip
BENT = [
    Case("a linear shell bent by five times its thickness", 0, args=RUN, deck=bent(0.05 * STIFFNESS), leaves=["out"], ranks=True,
         says=["warning: shell 'plate', of fidelity 'Linear', is bent by "]),
    Case("a linear shell bent by a tenth of its thickness", 0, args=RUN, deck=bent(0.001 * STIFFNESS), leaves=["out"], never=["warning"]),
    Case("a full shell bent by five times its thickness", 0, args=RUN, deck=bent(0.05 * STIFFNESS, "Full"), leaves=["out"], never=["warning"]),
]


# --- surfaces of revolution

def pipe(elements, **values):
    mesh = entry("Mesh", Type="Cylinder", Radius="0.5", Length="1", Elements=elements, **values)
    return deck(STEEL, listed("Structures", shell("pipe", mesh, Thickness="0.01")), listed("Constraints", clamp("pipe/v0")),
                listed("Loads", entry("weight", Type="Gravity", Acceleration="{0, 0, -9.81}")), STATIC)


SWEPT = [
    Case("a surface of more than a turn", 3, args=RUN, deck=pipe("{32, 2}", To="7"),
         says=["the surface sweeps 7 rad from 'From' = 0 and lies upon itself"]),
    Case("a pipe of 16 elements around", 0, args=RUN, deck=pipe("{16, 2}"), leaves=["out"],
         says=["leave the wall about 2.6 % less volume than it has", "take 1.6 times as many elements"]),
    Case("a pipe of 32 elements around", 0, args=RUN, deck=pipe("{32, 2}"), leaves=["out"], never=["less volume"]),
    Case("a turn from a quarter on", 0, args=RUN, deck=pipe("{32, 2}", From=math.pi / 2, To=math.pi / 2 + 2 * math.pi), leaves=["out"]),
]


# --- loads at folds: of three walls that meet each has its node

def i_bar(load):
    mesh = entry("Mesh", Type="I Section", Length="1", Height="0.2", Top_Width="0.1", Bottom_Width="0.1", Elements="{1, 2, 4}")
    wall = entry("wall", Type="Rigid Box", Position="{0, 0, 0}", Size="{0.1, 0.1, 0.1}", Density="1")
    return deck(STEEL, listed("Structures", shell("bar", mesh, Thickness="0.01"), wall),
                listed("Constraints", clamp("wall"), entry("root", Type="Rigid Connection", Node="bar/start", Master="wall")),
                listed("Loads", load), STATIC, listed("Output", listed("History", entry("held", Type="Reaction", Node="wall"))))


FOLDS = [
    Case("forces on an edge with folds", 0, args=RUN, deck=i_bar(entry("push", Type="Force", Node="bar/end", Force="{0, 0, 1}")),
         leaves=["out"], check=ends_with("held Fz [N]", -7.0, 1e-6), ranks=True),
]


# --- tubes

def tube(fidelity, model="Shell"):
    return deck(STEEL, listed("Structures", entry("tube", Type="Tube", Model=model, Fidelity=fidelity, From="{0, 0, 0}", To="{0, 0, 2}",
                                                  Up="{1, 0, 0}", Material="steel", Outer_Radius="0.1", Wall_Thickness="0.01",
                                                  Elements="{32, 10}")),
                listed("Constraints", clamp("tube/first")),
                listed("Loads", entry("tip", Type="Force", Node="tube/last", Force="{10, 0, 0}")), STATIC,
                listed("Output", listed("History", entry("tip", Type="Displacement", Node="tube/last"))))


INERTIA = math.pi / 4 * (0.1**4 - 0.09**4)
DEFLECTION = 10 * 2**3 / (3 * 1e9 * INERTIA)
TUBES = [
    Case(f"a tube of shells that is {fidelity}", 3, args=RUN, deck=tube(fidelity), says=[f"'{fidelity}' is one of beams"])
    for fidelity in ("Rigid", "Kirchhoff")
] + [
    Case(f"a tube of {model}s that is Linear", 0, args=RUN, deck=tube("Linear", model), leaves=["out"],
         check=ends_with("tip ux [m]", DEFLECTION, 0.05 * DEFLECTION))
    for model in ("Beam", "Shell")
]


# --- bodies and friction in statics

BODY = entry("body", Type="Rigid Box", Position="{0, 0, -1}", Size="{0.2, 0.2, 0.2}", Density="1000")


def hanging(held):
    return deck(listed("Structures", BODY), listed("Constraints", held),
                listed("Loads", entry("weight", Type="Gravity", Acceleration="{0, 0, -10}")), STATIC,
                listed("Output", listed("History", entry("held", Type="Reaction", Node="body"))))


BODIES = [
    Case("a body that hangs from a hinge", 0, args=RUN,
         deck=hanging(entry("hinge", Type="Revolute Support", Node="body", Axis="{0, 1, 0}", Offset="{0, 0, 1}")),
         says=["warning: Gravity 'weight' moves nothing"], leaves=["out"], check=ends_with("held Fz [N]", 80.0, 1e-9)),
    Case("a body that is clamped", 8, args=RUN, deck=hanging(clamp("body")), says=["warning: Gravity 'weight' moves nothing"],
         leaves=["out"]),
]

BAR = listed("Sections", entry("bar", Type="Stiffness Values", EA="1e6", GA1="1e6", GA2="1e6", EI1="100", EI2="100", GIp="10",
                               rhoA="10", rhoI1="1e-6", rhoI2="1e-6"))
BEAM = entry("beam", Type="Beam", Section="bar").replace(
    "</ParameterList>", entry("Curve", Type="Line", From="{0, 0, 0}", To="{1, 0, 0}", Up="{0, 0, 1}", Elements="10") + "</ParameterList>")
PULLED = deck(
    BAR, listed("Structures", BEAM), listed("Constraints", entry("straight", Type="Rotation", Node="beam/first", Axis="{1, 0, 0}")),
    listed("Loads", entry("floor", Type="Plane Contact", Structure="beam", Width="0.1", Stiffness="1e5", Friction="0.3"),
           entry("press", Type="Line Force", Structure="beam", Force="{0, 0, -100}", Function="Constant"),
           entry("pull", Type="Force", Node="beam/last", Force="{40, 0, 0}")), STATIC)
FRICTION = [
    Case("a beam that is pulled off its friction", 4, args=RUN, deck=PULLED, leaves=["out"],
         says=["Likely cause: the friction of Plane Contact 'floor' is at its limit"]),
]


# --- turns

def twisted(steps):
    return deck(BAR, listed("Structures", BEAM), listed("Constraints", clamp("beam/first")),
                listed("Loads", entry("twist", Type="Follower Moment", Node="beam/last", Moment=f"{{0, 0, {20 * math.pi}}}")),
                listed("Analyses", entry("twist", Type="Static", Steps=steps)),
                listed("Output", listed("History", entry("tip", Type="Joint Angle", First="beam/first", Second="beam/last", Axis="{1, 0, 0}"))))


TURNS = [
    Case("a turn in eight steps", 0, args=RUN, deck=twisted(8), leaves=["out"], never=["whole turns are lost"],
         check=ends_with("tip [rad]", 2 * math.pi, 0.05)),
    Case("a turn in two steps", 0, args=RUN, deck=twisted(2), leaves=["out"],
         says=["warning: 'tip' changes by more than a quarter of a turn from one step to the next"]),
]

# --- a column whose middle carries an arm without load: its stresses are rounding, and no forces that follow the structure

SLIM = BAR.replace('name="GIp" value="10"', 'name="GIp" value="1"').replace('"EI1" value="100"', '"EI1" value="1"').replace(
    '"EI2" value="100"', '"EI2" value="2"')


def member(name, start, end, up):
    curve = entry("Curve", Type="Line", From=start, To=end, Up=up, Elements="6")
    return entry(name, Type="Beam", Section="bar").replace("</ParameterList>", f"{curve}</ParameterList>")


def column(kind="Force"):
    return deck(
        SLIM, listed("Structures", member("low", "{0, 0, 0}", "{0, 0, 1}", "{1, 0, 0}"), member("high", "{0, 0, 1}", "{0, 0, 2}", "{1, 0, 0}"),
                     member("arm", "{0, 0, 1}", "{0.5, 0, 1}", "{0, 1, 0}")),
        listed("Constraints", clamp("low/first"), entry("middle", Type="Weld", First="low/last", Second="high/first"),
               entry("arm", Type="Rigid Connection", Node="arm/first", Master="low/last")),
        listed("Loads", entry("press", Type=kind, Node="high/last", Force="{0, 0, -1}")),
        listed("Analyses", entry("buckle", Type="Buckling", Modes="3")))


COLUMNS = [
    Case("a column with an arm that carries nothing", 0, args=RUN, deck=column(), leaves=["out"], never=["not symmetric"], ranks=True),
    Case("a force that follows a column", 0, args=RUN, deck=column("Follower Force"), leaves=["out"],
         says=["warning: the tangent is not symmetric"]),
]

CASES = SEAMS + BENT + SWEPT + FOLDS + TUBES + BODIES + FRICTION + TURNS + COLUMNS
