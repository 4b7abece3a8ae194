"""The catalogue of hard cases. To add one, add an entry; doc/guide/hard.md tells how."""

import math

from .case import ROUNDING, Case, IllPosed
from .judge import (
    as_recommended,
    below,
    constraints,
    energy,
    entry_of,
    interface,
    momenta,
    near,
    never_rises,
    scalar,
    uncut,
)


def parameters(path, **values):
    """path/Some Name=value for Some_Name=value."""
    return [f"{path}/{name.replace('_', ' ')}={_text(value)}" for name, value in values.items()]


def _text(value):
    return repr(value) if isinstance(value, float) else str(value)


def in_steps(analysis, number):
    return parameters(f"Analyses/{analysis}", Steps=max(1, round(number)))


def of_length(analysis, step, number):
    """A number of time steps."""
    return parameters(f"Analyses/{analysis}", Step=step, End_Time=step * number)


def sharper(analysis):
    """What the guide advises where forces of stiff parts hide those of soft ones."""
    return parameters(f"Analyses/{analysis}/Newton", Force_Tolerance=1e-12)


def hemisphere(ratio):
    # a load for which displacements do not depend on the thickness
    t = 10.0 / ratio
    return [f"t={t!r}", f"F={0.02 * (t / 0.04) ** 3!r}", "N=16", *in_steps("loading", 1)]


def rolled_up(angle):
    """Displacement of the end of a bar of 10 m that is bent to an angle."""
    turn = math.radians(angle)
    return (10 * (math.sin(turn) / turn - 1), 0, -10 * (1 - math.cos(turn)) / turn)


def heavy_tip(ratio):
    # first root of a cantilever with a heavy tip, with Rayleigh's share of its own mass
    b = (3.0 / (ratio + 33.0 / 140.0)) ** 0.25
    return [f"mu={ratio!r}", f"b={b!r}", "Analyses/motion/End Time=T/4"]


def heavy_middle(ratio):
    third = f"{{{ratio / 10!r}, {ratio / 10!r}, {ratio / 10!r}}}"
    return parameters("Structures/middle", Mass=ratio, Inertia=third)


def light_nodes(ratio):
    light = 1e6 / ratio
    return [
        *parameters("Masses/light", Mass=light),
        *parameters("Sections/bar", rhoA=light, rhoI1=0.01 * light, rhoI2=0.01 * light),
    ]


def faulty_partner(fault, **more):
    """A third partner, at a port of its own, that fails from window 9 on."""
    return [
        *parameters("Ports/third", Type="Points", Points="{mast@0.75}"),
        *parameters("Coupling/Partners/third", Type="Faulty", Port="third", Window=9, Fault=fault, **more),
    ]


def flat_loops():
    """The four-bar loops with all their bars along one line."""
    settings = []
    for i in range(3):
        settings += parameters(f"Structures/link {i}", Position=f"{{{i + 0.5}, 0, 0}}")
        settings += parameters(f"Constraints/foot {i}", Offset="{-0.5, 0, 0}")
    for i in range(2):
        settings += parameters(f"Structures/bar {i}", Position=f"{{{i + 1.5}, 0, 0}}")
        settings += parameters(f"Constraints/hinge {i} left", Position=f"{{{i + 1}, 0, 0}}")
        settings += parameters(f"Constraints/hinge {i} right", Position=f"{{{i + 2}, 0, 0}}")
    return settings


def stiff_bar(ratio):
    stiff = {"EA": 1e3, "GA1": 4e2, "GA2": 4e2, "EI1": 10.0, "EI2": 10.0, "GIp": 8.0}
    return parameters("Sections/bar", **{name: value * ratio for name, value in stiff.items()})


def thin_panel(ratio):
    # a load that makes the panel snap: bending stiffness per area
    t = 5.0 / ratio
    return [f"t={t!r}", f"Loads/push/Force={{0, {-6e7 * (t / 0.137) ** 2.5!r}, 0}}"]


def more_hinges(number):
    settings = []
    for i in range(int(number)):
        settings += parameters(
            f"Constraints/hinge {i}",
            Type="Revolute Joint",
            First="frame",
            Second="door",
            Axis="{0, 0, 1}",
            Position=f"{{0.5, 0, {1 / (i + 2)!r}}}",
        )
    return settings


def more_loops(number):
    """Four-bar loops beside the two of the deck, each with three more redundant equations."""
    settings = [*parameters("Analyses/motion", Step=5e-3), "Output/Every=1000"]
    for i in range(3, int(number) + 1):
        along_x, along_y = "{1e-3, 1/12, 1/12}", "{1/12, 1e-3, 1/12}"
        settings += parameters(
            f"Structures/link {i}",
            Type="Rigid Body", Position=f"{{{i}, 0.5, 0}}", Mass=1, Inertia=along_y,
        )  # fmt: skip
        settings += parameters(
            f"Structures/bar {i - 1}",
            Type="Rigid Body", Position=f"{{{i - 0.5}, 1, 0}}", Mass=1, Inertia=along_x,
        )  # fmt: skip
        settings += parameters(
            f"Constraints/foot {i}",
            Type="Revolute Support", Node=f"link {i}", Axis="{0, 0, 1}", Offset="{0, -0.5, 0}",
        )  # fmt: skip
        for side, link in (("left", i - 1), ("right", i)):
            settings += parameters(
                f"Constraints/hinge {i - 1} {side}",
                Type="Revolute Joint", First=f"link {link}", Second=f"bar {i - 1}",
                Position=f"{{{link}, 1, 0}}", Axis="{0, 0, 1}",
            )  # fmt: skip
        settings += parameters(
            f"Initial Conditions/link {i}",
            Type="Velocity", Node=f"link {i}",
            Angular_Velocity="{0, 0, -1}", About=f"{{{i}, 0, 0}}",
        )  # fmt: skip
        settings += parameters(
            f"Initial Conditions/bar {i - 1}",
            Type="Velocity", Node=f"bar {i - 1}", Velocity="{1, 0, 0}",
        )  # fmt: skip
    return settings


CASES = [
    # locking
    Case(
        "roll-up on few elements", "LK LR", "beam/roll_up.xml",
        "rotation per element [deg]", 11.25,
        lambda x: [f"Structures/beam/Curve/Elements={round(360 / x)}", "Structures/beam/Order=2"],
        [near("tip", (-10, 0, 0), 0.02)],
        limit=32, growth=1.5,
    ),
    Case(
        "slender bend", "LK ST", "beam/bend_45.xml",
        "radius over thickness", 100,
        lambda x: [f"size={100 / x!r}", f"load={600 * (100 / x) ** 4!r}"],
        [near("tip", (-23.560, -13.605, 53.475), 0.005)],
        resolution=ROUNDING,
    ),
    Case(
        "thin hemisphere", "LK", "shell/pinched_hemisphere.xml",
        "radius over thickness", 250,
        hemisphere,
        [near("outward ux [m]", 0.5 * 0.02 * 0.093, 0.1)],
        resolution=ROUNDING,
    ),
    Case(
        "thin hypar", "LK", "shell/hypar.xml",
        "side over thickness", 1e3,
        lambda x: [
            f"t={1 / x!r}", f"p={8e5 * x**-3!r}", "N=16", "Output/History/tip/Node=shell/152",
        ],
        [as_recommended("tip uz [m]", 0.5)],
        resolution=ROUNDING,
    ),
    Case(
        "thin clamped plate", "LK", "shell/clamped_plate.xml",
        "side over thickness", 100,
        lambda x: [f"t={1 / x!r}", f"p={1e3 * x**-4!r}"],
        [near("centre uz [m]", lambda x: -1.26532e-3 * 1e3 / (1e7 * x / 10.92), 0.05)],
        resolution=ROUNDING,
    ),
    Case(
        "thin twisted strip", "LK", "shell/twisted_beam.xml",
        "width over thickness", 1.1 / 0.32,
        lambda x: [f"t={1.1 / x!r}", "N=24", "M=4", f"Fz={1e-3 * x**-3!r}"],
        [as_recommended("energy [J]", 0.5, lambda x: x**3)],
        resolution=ROUNDING,
    ),
    # large rotations
    Case(
        "roll-up, moment at once", "LR", "beam/roll_up.xml",
        "rotation per step [deg]", 36,
        lambda x: [
            "Structures/beam/Curve/Elements=64", "Structures/beam/Order=2",
            f"Loads/end moment/Moment={{0, {x / 360!r}*2*pi*EI/L, 0}}", *in_steps("roll up", 1),
        ],
        [uncut(), near("tip", rolled_up, 0.02)],
        limit=1e3, growth=2,
    ),
    Case(
        "elastica, load at once", "LR", "beam/elastica.xml",
        "load per step over EI/L²", 0.5,
        lambda x: [
            "Structures/beam/Order=2", "Analyses/bending/Final Level=50",
            "Analyses/bending/Levels={50}", *in_steps("bending", 50 / x),
        ],
        [uncut(), as_recommended("tip", 1e-6)],
        limit=100, growth=2,
    ),
    Case(
        "follower loads at once", "LR", "beam/follower_loads.xml",
        "times the load of the deck", 0.2,
        lambda x: [
            f"Loads/force/Force={{{8 * x!r}, {12 * x!r}, {-6 * x!r}}}",
            f"Loads/moment/Moment={{{4 * x!r}, {-6 * x!r}, {5 * x!r}}}", *in_steps("loading", 1),
        ],
        [uncut()],
        limit=1e3, growth=2,
    ),
    Case(
        "rolled strip, moment at once", "LR", "shell/strip_rolled_up.xml",
        "rotation per step [deg]", 9,
        lambda x: in_steps("bending", 360 / x),
        [uncut(), as_recommended("tip", 1e-6)],
        limit=40, growth=2,
    ),
    Case(
        "pinched hemisphere, load at once", "LR LK", "shell/pinched_hemisphere.xml",
        "load per step [N]", 20,
        lambda x: [f"F={x!r}", *in_steps("loading", 1)],
        [uncut()],
        limit=1e3, growth=2,
    ),
    Case(
        "quick spin", "LR HF", "hard/quick_spin.xml",
        "spin times step", 0.2,
        lambda x: [*of_length("motion", x / 82.842712474619, 100), *sharper("motion")],
        [uncut(), energy(1e-7), momenta(1e-8)],
        limit=1e3, growth=2,
    ),
    Case(
        "heavy top", "LR LD", "body/heavy_top.xml",
        "spin times step", 0.15,
        lambda x: of_length("motion", x / 150, 200),
        [uncut(), energy(), constraints()],
        limit=1e3, growth=2,
    ),
    # paths
    Case(
        "Lee's frame, long arcs", "SN", "beam/lee_frame_path.xml",
        "arc length over the first one", 5,
        lambda x: parameters("Analyses/loading", Largest_Length=x),
        [
            scalar("limit point 1, level", 1.85538, 1e-3),
            scalar("limit point 2, level", -0.940672, 1e-3),
        ],
        limit=100, growth=1.5,
    ),
    Case(
        "thin roof, long arcs", "SN", "shell/hinged_roof_path.xml",
        "arc length over the first one", 4,
        lambda x: ["t=6.35", *parameters("Analyses/snap", Largest_Length=x)],
        [as_recommended("centre", 1e-6), scalar("limit point 2, level", -0.129, 0.1)],
        limit=100, growth=1.5,
    ),
    Case(
        "folding ring, long arcs", "SN LR", "beam/foldable_ring.xml",
        "first increment over a full turn", 0.01,
        lambda x: parameters("Analyses/folding", First_Increment=x, Largest_Length=1),
        [near("B ux [m]", -0.16, 0.01)],
        limit=100, growth=1.5,
    ),
    Case(
        "Lee's frame, displacement at once", "SN", "beam/lee_frame_displacement.xml",
        "displacement per step [m]", 1,
        lambda x: in_steps("pushing", 60 / x),
        [uncut(), as_recommended("push", 1e-6)],
        limit=60, growth=1.5,
    ),
    # bifurcation
    Case(
        "frame buckling, faint skew", "BI", "beam/right_angle_frame.xml",
        "force over the force across", 1e3,
        lambda x: [f"skew={1 / x!r}", "Analyses/loading/Bifurcation=Report"],
        [near("tip uz [m]", 0.06, 1e-3)],
        limit=1e9,
    ),
    Case(
        "frame buckling, faint branch", "BI", "beam/right_angle_frame.xml",
        "1 over branch amplitude [1/m]", 1e3,
        lambda x: parameters("Analyses/loading", Branch_Amplitude=1 / x),
        [near("tip uz [m]", 0.06, 1e-3)],
        limit=1e9,
    ),
    Case(
        "slender column", "BI ST", "buckling/column.xml",
        "axial over bending stiffness [1/m²]", 1e5,
        lambda x: parameters("Sections/bar", EA=x, GA1=x, GA2=x),
        [entry_of("buckling: buckling", 0, "factor", math.pi**2 / 4, 1e-3)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "slender cantilever, modes", "ST", "modes/cantilever.xml",
        "axial over bending stiffness [1/m²]", 1e8,
        lambda x: parameters("Sections/bar", EA=x, GA1=x, GA2=x),
        [entry_of("modes: modes", 0, "frequency [Hz]", 1.87510407**2 / (2 * math.pi), 1e-3)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    # masses
    Case(
        "heavy body between light ones", "MR", "hard/mass_ratio.xml",
        "mass ratio", 1e3,
        heavy_middle,
        [uncut(), energy(), constraints(), as_recommended("middle", 5e-3)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "heavy and light nodes", "MR", "beam/alternate_masses.xml",
        "mass ratio", 1e3,
        light_nodes,
        [uncut(), energy()],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "heavy tip", "MR", "beam/tip_mass.xml",
        "mass ratio", 1e2,
        heavy_tip,
        [uncut(), near("tip uy [m]", 1e-3, 0.01)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    # partners
    Case(
        "heavy partner", "MR", "coupling/partners.xml",
        "mass of the partner [kg]", 1e3,
        lambda mass: parameters("Coupling/Partners/water", Mass=mass),
        [uncut(), energy(), interface("water")],
        limit=1e9, growth=100, resolution=ROUNDING,
    ),
    Case(
        "loose coupling", "MR", "coupling/partners.xml",
        "mass of the partner [kg]", 1e-3,
        lambda mass: [
            *parameters("Coupling", Scheme="Explicit", Window=5e-3),
            *parameters("Coupling/Partners/water", Mass=mass),
            *parameters("Coupling/Partners/damper", Mass=1e-3, Stiffness=1.0),
        ],
        [uncut()],
        limit=1e6, growth=4,
    ),
    # constraints
    Case(
        "hinges on one axis", "NS", "hard/two_hinges.xml",
        "redundant hinges", 1,
        more_hinges,
        [uncut(), energy(), momenta(), constraints(), as_recommended("door", 1e-6)],
        limit=100, growth=4, whole=True,
    ),
    Case(
        "hinges a little out of line", "NS", "hard/two_hinges.xml",
        "1 over the angle", 1e2,
        lambda x: [f"Constraints/lower/Axis={{{1 / x!r}, 0, 1}}"],
        [uncut(), energy(), momenta(), constraints(), as_recommended("door", 0.1)],
        limit=1e12, growth=10, resolution=ROUNDING,
    ),
    Case(
        "four-bar loops", "NS", "joint/four_bar_2.xml",
        "loops", 2,
        more_loops,
        [uncut(), energy(), constraints()],
        limit=40, growth=4, whole=True,
    ),
    Case(
        "four-bar, singular positions", "NS LD", "joint/four_bar_2.xml",
        "step [s]", 1e-3,
        lambda x: [*of_length("motion", x, 500), *sharper("motion")],
        [uncut(), energy(), constraints()],
        limit=1e4, growth=2,
    ),
    Case(
        "driven bars, large steps", "NS LR", "joint/driven_bars.xml",
        "step [s]", 0.01,
        lambda x: of_length("motion", x, 400),
        [uncut(), energy(), constraints()],
        limit=1e3, growth=2,
    ),
    Case(
        "driven bars, small steps", "ST LD", "joint/driven_bars.xml",
        "steps per second", 50,
        lambda x: of_length("motion", 1 / x, 400),
        [uncut(), energy(), constraints()],
        growth=4, resolution=ROUNDING,
    ),
    # stiffness
    Case(
        "stiff bar, soft cord", "ST", "hard/stiffness_ratio.xml",
        "stiffness ratio", 1e4,
        lambda x: [*stiff_bar(x), *sharper("motion")],
        [uncut(), energy(), as_recommended("end", 0.01)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "stiff pendulum", "ST", "beam/stiff_pendulum.xml",
        "Young's modulus [N/m²]", 2.1e10,
        lambda x: [f"E={x!r}", *sharper("motion")],
        [uncut(), energy(), as_recommended("tip", 0.01)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "stiff spring", "ST HF", "hard/stiff_spring.xml",
        "stiffness [N/m]", 1e4,
        lambda x: [f"k={x!r}", *sharper("motion")],
        [uncut(), energy(), as_recommended("bob", 0.05)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "stiff ground", "ST HF", "contact/dropped_beam.xml",
        "pressure per depth [Pa/m]", 1e7,
        lambda x: parameters("Loads/ground", Stiffness=x),
        [uncut(), energy()],
        limit=1e8, growth=100, resolution=ROUNDING,
    ),
    Case(
        "few steps in an impact", "HF", "contact/dropped_beam.xml",
        "step [s]", 5e-4,
        lambda x: parameters("Analyses/motion", Step=x),
        [uncut(), energy()],
        limit=200, growth=2,
    ),
    Case(
        "stiff blow", "ST HF", "contact/struck_beam.xml",
        "pressure per depth [Pa/m]", 1e8,
        lambda x: parameters("Loads/blow", Stiffness=x),
        [uncut(), energy(), momenta()],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "stiff beams that meet", "ST HF", "contact/falling_rod.xml",
        "force per length at the depth [N/m]", 1e6,
        lambda x: parameters("Loads/impact", Line_Force=x),
        [uncut(), energy(), momenta()],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "thin skin of beams", "HF", "contact/falling_rod.xml",
        "1 over depth [1/m]", 2e3,
        lambda x: parameters("Loads/impact", Depth=1 / x),
        [uncut(), energy(), momenta()],
        limit=10, growth=4,
    ),
    Case(
        "sharp friction", "ST", "contact/sliding_ball.xml",
        "1 over slip speed [s/m]", 1e2,
        lambda x: parameters("Loads/ground", Slip_Speed=1 / x),
        [energy(), near("ball vx [m/s]", 5 / 7, 0.01)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "stiff rough ground", "ST", "contact/dragged_bar.xml",
        "pressure per depth [Pa/m]", 1e9,
        lambda x: [f"k={x!r}"],
        [near("end ux [m]", 9e-4, 0.01)],
        limit=1e16, growth=100, resolution=ROUNDING,
    ),
    Case(
        "faint load", "ST", "hard/faint_load.xml",
        "1 over load [1/N]", 1e2,
        lambda x: [f"Loads/touch/Force={{0, 0, {1 / x!r}}}"],
        [near("tip uz [m]", lambda x: 1 / (3 * x), 0.01)],
        limit=1e12, growth=100, resolution=ROUNDING,
    ),
    Case(
        "quick drive", "ST LR", "beam/spin_up.xml",
        "speed [rad/s]", 6,
        lambda x: [f"W={x!r}", "T=5", *of_length("motion", 0.01, 600)],
        [uncut(), energy(1e-8), constraints()],
        limit=1e3, growth=2,
    ),
    # unresolved vibration, long times
    Case(
        "flying spaghetti, large steps", "HF LR", "flight/spaghetti_3d.xml",
        "step [s]", 0.02,
        lambda x: of_length("motion", x, 500),
        [uncut(), energy(), momenta()],
        limit=1e3, growth=2,
    ),
    Case(
        "kicked beam", "HF", "flight/beam.xml",
        "speed of the kicked end [m/s]", 0.05,
        lambda x: [f"Initial Conditions/kick/Velocity={{0, {x!r}, {x!r}}}"],
        [uncut(), energy(), momenta()],
        limit=1e6, growth=4,
    ),
    Case(
        "rotor, large steps", "HF", "flight/rotor.xml",
        "step [s]", 2e-3,
        lambda x: of_length("motion", x, 200),
        [uncut(), energy(), momenta()],
        limit=1e3, growth=2,
    ),
    Case(
        "rotor with dissipation, large steps", "HF", "flight/rotor_damped.xml",
        "step [s]", 2e-3,
        lambda x: of_length("motion", x, 200),
        [uncut(), energy(), momenta(), never_rises("energy total [J]")],
        limit=1e3, growth=2,
    ),
    Case(
        "rotor by the trapezoidal rule", "HF", "flight/rotor.xml",
        "step [s]", 2e-3,
        lambda x: [*of_length("motion", x, 200), "Analyses/motion/Scheme=Trapezoidal"],
        [uncut(), energy(0.1)],
        limit=1e3, growth=2,
    ),
    Case(
        "rotor by generalised alpha", "HF", "flight/rotor.xml",
        "step [s]", 2e-3,
        lambda x: [*of_length("motion", x, 200), "Analyses/motion/Scheme=Generalised Alpha"],
        [uncut(), energy(0.1)],
        limit=1e3, growth=2,
    ),
    Case(
        "stiff cantilever, huge steps", "HF ST", "hard/large_step.xml",
        "step over longest period", 1,
        lambda x: of_length("motion", 5.65e-3 * x, 60),
        [uncut(), near("end z [m]", -1.22747625e-5, 0.01)],
        limit=1e9, growth=100,
    ),
    Case(
        "tumbling cylinder, large steps", "HF LR", "shell/tumbling_cylinder.xml",
        "step [s]", 0.05,
        lambda x: of_length("fly", x, 60),
        [uncut(), energy(1e-8), momenta()],
        limit=1e3, growth=2,
    ),
    Case(
        "three plates, large steps", "HF LR", "shell/three_plates.xml",
        "step [s]", 0.02,
        lambda x: of_length("fly", x, 60),
        [uncut(), energy(), momenta()],
        limit=1e3, growth=2,
    ),
    Case(
        "assembly, large steps", "HF", "hybrid/assembly.xml",
        "step [s]", 2e-3,
        lambda x: of_length("flight", x, 30),
        [uncut(), energy(), momenta(), constraints()],
        limit=1e3, growth=2,
    ),
    Case(
        "snapping panel, large steps", "SN HF", "hybrid/snapping_panel.xml",
        "step [s]", 1e-3,
        lambda x: of_length("snap", x, 0.14 / x),
        [uncut(), energy(), as_recommended("middle uy [m]", 0.1)],
        limit=100, growth=2,
    ),
    Case(
        "thin panel snaps", "SN LK", "hybrid/snapping_panel.xml",
        "radius over thickness", 36.5,
        thin_panel,
        [energy()],
        limit=1e6, growth=4,
    ),
    Case(
        "torque-free body, many steps", "LD", "body/torque_free.xml",
        "steps", 1e3,
        lambda x: [*of_length("motion", 2e-3, round(x)), "Output/Every=1000"],
        [uncut(), energy(), momenta()],
        limit=100, whole=True,
    ),
    Case(
        "flying chain, many steps", "LD", "flight/chain.xml",
        "steps", 1e3,
        lambda x: [*of_length("motion", 2e-3, round(x)), "Output/Every=1000"],
        [uncut(), energy(), momenta(1e-11), constraints()],
        limit=20, whole=True,
    ),
    # air
    Case(
        "stall flutter, strong wind", "LR HF", "air/stall_flutter.xml",
        "wind [m/s]", 20,
        lambda x: [f"V={x!r}"],
        [uncut(), energy()],
        limit=1e6, growth=4,
    ),
    Case(
        "stall flutter, large steps", "HF", "air/stall_flutter.xml",
        "step [s]", 0.02,
        lambda x: [f"h={x!r}", f"end={100 * x!r}"],
        [uncut(), energy()],
        limit=1e4, growth=2,
    ),
    Case(
        "rotor in wind from behind", "LR", "turbine/nrel5mw/rotor.xml",
        "wind from behind [m/s]", 8,
        lambda x: [f"V={-x!r}", "turn=pi/9"],
        [uncut(), energy(), constraints()],
        limit=1e4, growth=4,
    ),
    Case(
        "parked rotor", "NS", "turbine/nrel5mw/rotor.xml",
        "wind over the speed of the tips", 12,
        lambda x: [f"W={8 / (63 * x) * 30 / math.pi!r}", "turn=pi/9"],
        [uncut(), energy(), constraints(), as_recommended("rotor thrust [N]", 0.02)],
        limit=1e9, growth=100, resolution=ROUNDING,
    ),
    Case(
        "rotor in faint wind", "NS", "turbine/nrel5mw/rotor.xml",
        "speed of the tips over the wind", 7.5,
        lambda x: [f"V={60.4 / x!r}", "turn=pi/9"],
        [uncut(), energy(), constraints()],
        limit=1e9, growth=100, resolution=ROUNDING,
    ),
    # materials
    Case(
        "crushed Neo-Hooke sheet", "LR", "hard/crushed_sheet.xml",
        "stress over Young's modulus", 0.1,
        lambda x: [f"P={x!r}"],
        [below("shortening", "corner ux [m]", -1, 1)],
        resolution=ROUNDING,
    ),
    Case(
        "stretched Neo-Hooke sheet", "LR", "hard/crushed_sheet.xml",
        "stress over Young's modulus", 0.1,
        lambda x: [f"P={-x!r}"],
        [below("shortening", "corner ux [m]", -1, 0)],
        resolution=ROUNDING,
    ),
]

ILL_POSED = [
    IllPosed(
        "a mechanism in statics", "beam/roll_up.xml",
        ["Constraints/clamp/Type=Spherical Support"],
        4, "a mechanism",
    ),
    IllPosed(
        "contradictory constraints", "beam/roll_up.xml",
        parameters(
            "Constraints/extra", Type="Rotation", Angle=0.1, Node="beam/first", Axis="{1, 0, 0}",
        ),
        3, "held already",
    ),
    IllPosed(
        "weight without mass", "beam/pendulum.xml",
        parameters("Sections/bar", rhoA=0, rhoI1=0, rhoI2=0),
        3, "no structure has mass",
    ),
    IllPosed(
        "a cord without mass", "hard/stiffness_ratio.xml",
        parameters("Sections/cord", rhoA=0, rhoI1=0, rhoI2=0),
        4, "this motion has no inertia",
    ),
    IllPosed(
        "a body without mass", "hard/mass_ratio.xml",
        parameters("Structures/end", Mass=0),
        3, "Mass",
    ),
    IllPosed(
        "a beam without length", "beam/elastica.xml",
        ["Structures/beam/Curve/To={0, 0, 0}"],
        3, "must differ from 'From'",
    ),
    IllPosed(
        "a shell without area", "shell/clamped_plate.xml",
        ["Structures/shell/Mesh/Side 2={2, 0, 0}"],
        3, "is not positive",
    ),
    IllPosed(
        "a shell element turned inside out", "shell/uniaxial_stress.xml",
        [
            "Structures/shell/Mesh/Points={0, 0, 0, 1, 0, 0, 0.75, 0.3, 0, 0.3, 0.25, 0,"
            " 1, 1, 0, 0.2, 0.1, 0, 0, 1, 0, 0.2, 0.7, 0}",
        ],
        3, "out of order",
    ),
    IllPosed(
        "a wall thicker than its radius", "shell/falling_tube.xml",
        ["Structures/tube/Thickness=2.5"],
        3, "is not positive",
    ),
    IllPosed(
        "a function that stops being a number", "beam/spin_up.xml",
        ["Functions/theta/Expression=(t-0.1)*sqrt(0.2-t)"],
        3, "must be finite",
    ),
    IllPosed(
        "a load beyond all numbers", "beam/elastica.xml",
        ["Loads/tip load/Force={0, 1e307, 0}"],
        5, "beyond the range",
    ),
    IllPosed(
        "a stiffness beyond all numbers", "beam/elastica.xml",
        ["stiff=1e308"],
        5, "beyond the range",
    ),
    IllPosed(
        "a load beyond the limit", "beam/lee_frame.xml",
        ["Analyses/loading/Final Level=2"],
        4, "a limit point",
    ),
    IllPosed(
        "a sheet crushed beyond its limit", "shell/uniaxial_stress.xml",
        ["P=-0.3"],
        4, "a limit point",
    ),
    IllPosed(
        "a coarse mesh crumpled by a point load", "shell/pinched_cylinder.xml",
        ["t=0.02", "F=1200*t^2"],
        4, "a local loss of stiffness",
    ),
    IllPosed(
        "a negative stiffness", "beam/elastica.xml",
        ["stiff=-1"],
        3, "must be >= 0",
    ),
    IllPosed(
        "a loop in line at its start", "joint/four_bar_2.xml",
        flat_loops(),
        3, "singular position",
    ),
    IllPosed(
        "a shell that nothing holds", "shell/plate_under_weight.xml",
        [
            *parameters("Constraints/far x", Direction="{1, 0, 0}"),
            *parameters("Constraints/far y", Direction="{0, 1, 0}"),
        ],
        4, "a mechanism",
    ),
    IllPosed(
        "a free body in statics", "beam/princeton_beam.xml",
        ["Constraints/clamp/Type=Spherical Support"],
        4, "a mechanism",
    ),
    IllPosed(
        "a path with nothing that grows", "beam/lee_frame_path.xml",
        ["Loads/P/Function=Constant"],
        4, "no path to follow",
    ),
    IllPosed(
        "a partner that dies", "coupling/partners.xml",
        faulty_partner("Death"),
        9, "failed in window 9",
    ),
    IllPosed(
        "a partner that answers nonsense", "coupling/partners.xml",
        faulty_partner("No Number"),
        9, "it answered nan",
    ),
    IllPosed(
        "a partner that lies about its energy", "coupling/partners.xml",
        faulty_partner("Wrong Energy"),
        8, "the partner 'third' books 1 J",
    ),
    IllPosed(
        "a partner whose energy has no end", "coupling/partners.xml",
        faulty_partner("Infinite Energy"),
        9, "its energy is inf J",
    ),
    IllPosed(
        "a partner that answers for another number of points", "coupling/partners.xml",
        faulty_partner("Wrong Count"),
        9, "it answered 0 numbers; six for each of 1 points are 6",
    ),
    IllPosed(
        "a partner that answers half of its forces", "coupling/partners.xml",
        faulty_partner("Scaled", Mass=5),
        8, "the interface 'third'",
    ),
    IllPosed(
        "a partner that answers against its forces", "coupling/partners.xml",
        faulty_partner("Turned", Mass=5),
        8, "the interface 'third'",
    ),
    IllPosed(
        "a partner that answers forces of long ago", "coupling/partners.xml",
        faulty_partner("Old", Mass=5),
        8, "the interface 'third'",
    ),
    IllPosed(
        "steps of many turns", "hard/quick_spin.xml",
        [*of_length("motion", 100.0, 10)],
        4, "a sudden change of load",
    ),
]
