"""Models without a solution, or with more than one."""

from broken.pieces import (
    ANALYSIS,
    CLAMP,
    CURVE,
    EI1,
    FORCE,
    INNER_FORCE,
    LOADS,
    STEPS,
    TIP_FORCE,
    link,
    list_of,
    parameters,
    support,
    unsolvable,
    wrong,
)
from driver import Case

MECHANISM = "Likely cause: a mechanism. Nothing resists this motion:\n"
SINGULAR = "The equations are singular at level 0, before the first step.\n"
NO_FACTORS = "The tangent at level 0 is singular: factors would be made of rounding.\n"
BUCKLING = parameters("bend", ("Type", "Buckling"))
AXIS_X = ("Axis", "{1, 0, 0}")
OFFSET = ("Offset", "{0, 0, 0.1}")
TWO_MASTERS = CLAMP + link("first", "beam/1", "beam/3") + link("second", "beam/2", "beam/3")
LOOP = (
    CLAMP
    + link("first", "beam/1", "beam/2")
    + link("second", "beam/2", "beam/3")
    + link("third", "beam/3", "beam/1")
)
# holds y and z of the last node
ROLLERS = support(
    "roller y", "Simple Support", ("Direction", "{0, 1, 0}"), node="beam/last"
) + support("roller z", "Simple Support", ("Direction", "{0, 0, 1}"), node="beam/last")
TWO_PINS = (
    support("one", "Spherical Support", OFFSET)
    + support("two", "Spherical Support", OFFSET)
    + support("turn", "Rotation", AXIS_X)
    + ROLLERS
)
HINGE_Y = support("hinge", "Revolute Support", ("Axis", "{0, 1, 0}"), OFFSET) + support(
    "roller", "Simple Support", ("Direction", "{0, 0, 1}"), node="beam/last"
)


def left_out(name, constraints, note, form="Null Space", **more):
    """Equations that follow from others are left out, with a note that names the constraints."""
    return Case(
        f"{name}, {form}",
        0,
        # the last node is held in some of them, and a load there would move nothing
        change=[(CLAMP, constraints), ('"Null Space"', f'"{form}"'), (TIP_FORCE, INNER_FORCE)],
        prints=[f"note: {note}", "; the reactions of these constraints are not unique\n"],
        results="out",
        last_level=1.0,
        **more,
    )


def contradictory(name, constraints, error, form="Null Space", **more):
    """A prescribed motion that others hold already."""
    return Case(
        f"{name}, {form}",
        3,
        change=[('"Null Space"', f'"{form}"'), (CLAMP, constraints)],
        errors=["deck.xml:{line}: " + error],
        **more,
    )


DRIVEN = support("@@turn", "Rotation", AXIS_X, ("Angle", 0.1)).replace(
    '<ParameterList name="@@turn">', '@@<ParameterList name="turn">'
)
HELD = "Constraints / turn: prescribes a motion of 'beam' that is held already, by "
TWICE = " hold motions of 'beam' more than once: "
CASES = [
    left_out(
        "Rigid Support and Spherical Support",
        CLAMP + support("pin", "Spherical Support", OFFSET),
        f"Spherical Support 'pin' and Rigid Support 'clamp'{TWICE}3 equations follow",
        ranks=True,
    ),
    left_out(
        "Rigid Support twice",
        CLAMP + support("clamp 2", "Rigid Support"),
        "Rigid Support 'clamp' and Rigid Support 'clamp 2' hold motions of 'beam/0' more than once: "
        "x, y, z, rotation x, rotation y, rotation z",
        ranks=True,
    ),
    left_out(
        "Rigid Support and Simple Support",
        CLAMP + support("roller", "Simple Support", ("Direction", "{0, 0, 1}")),
        "Rigid Support 'clamp' and Simple Support 'roller' hold motions of 'beam/0' more than once: z;",
    ),
    left_out(
        "loop of rigid links",
        LOOP,
        "Rigid Connection 'third', Rigid Connection 'first' and Rigid Connection 'second'"
        f"{TWICE}12 equations follow",
    ),
    left_out(
        "node with two masters",
        TWO_MASTERS,
        f"Rigid Connection 'second' and Rigid Connection 'first'{TWICE}6 equations follow",
    ),
]
for form in ("Null Space", "Multipliers"):
    CASES += [
        left_out(
            "Rotation and Revolute Support",
            HINGE_Y + support("turn", "Rotation", AXIS_X),
            f"Revolute Support 'hinge' and Rotation 'turn'{TWICE}1 equation follows from the",
            form,
        ),
        left_out(
            "Spherical Support twice",
            TWO_PINS,
            f"Spherical Support 'one' and Spherical Support 'two'{TWICE}3 equations follow",
            form,
        ),
        contradictory(
            "driven Rotation and Revolute Support",
            HINGE_Y + DRIVEN,
            HELD + "Revolute Support 'hinge'",
            form,
            ranks=True,
        ),
        contradictory(
            "Rigid Support and a driven support",
            CLAMP + DRIVEN,
            HELD + "Rigid Support 'clamp'",
            form,
        ),
    ]
CASES += [
    left_out(
        "Rigid Support and Spherical Support",
        CLAMP + support("pin", "Spherical Support", OFFSET),
        f"Rigid Support 'clamp' and Spherical Support 'pin'{TWICE}3 equations follow",
        "Multipliers",
    ),
    left_out(
        "loop of rigid links",
        LOOP,
        "Rigid Connection 'first', Rigid Connection 'second' and Rigid Connection 'third'"
        f"{TWICE}12 equations follow",
        "Multipliers",
    ),
    left_out(
        "node with two masters",
        TWO_MASTERS,
        f"Rigid Connection 'first' and Rigid Connection 'second'{TWICE}6 equations follow",
        "Multipliers",
    ),
]
# masses at the nodes leave their rotations without inertia
LEAD = parameters("lead", ("Type", "Point Mass"), ("Node", "beam"), ("Mass", 1))
POINT_MASSES = f'<ParameterList name="Masses">\n    {LEAD}\n  </ParameterList>\n'
MODAL = parameters("modes", ("Type", "Modal"), ("Modes", 3))
HEAVY = "".join(f'<Parameter name="{one}" value="1"/>' for one in ("rhoA", "rhoI1", "rhoI2"))
DYNAMIC = [
    ('"Static"/>', '"Dynamic"/>\n      <Parameter name="End Time" value="1"/>'),
    (STEPS, '<Parameter name="Step" value="0.5"/>'),
]
CASES += [
    unsolvable(
        "motion without mass",
        4,
        *DYNAMIC,
        says=["The mass matrix is singular: nothing has mass.\n", "\nTry: give every structure"],
    ),
    unsolvable(
        "modes without mass",
        4,
        (list_of("bend"), MODAL),
        says=["There are no vibrations: nothing that can move has mass.\nTry: give structures"],
        ranks=True,
    ),
    unsolvable(
        "modes where nothing moves",
        4,
        (list_of("bend"), MODAL),
        ('<Parameter name="Node" value="beam/first"/>', '<Parameter name="Node" value="beam"/>'),
        ('<Parameter name="GIp" value="2e3"/>', '<Parameter name="GIp" value="2e3"/>' + HEAVY),
        says=["There are no vibrations: nothing that can move has mass.\n"],
        ranks=True,
    ),
    unsolvable(
        "rotations without mass",
        4,
        *DYNAMIC,
        (LOADS, LOADS + POINT_MASSES),
        says=[
            "The mass matrix is singular: this motion has no inertia.\n  beam/",
            "\nTry: give every structure a density or mass, and rotary inertia to its nodes.\n",
        ],
        ranks=True,
    ),
    wrong(
        "a displacement that leaves a support",
        '<ParameterList name="Analyses">',
        '<ParameterList name="Initial Conditions">\n    @@'
        + parameters(
            "swung", ("Type", "Displacement"), ("Node", "beam"), ("Translation", "{0, 0.5, 0}")
        )
        + '\n  </ParameterList>\n  <ParameterList name="Analyses">',
        "Initial Conditions / swung: takes 'beam/0' out of Rigid Support 'clamp' by 0.5",
    ),
    wrong(
        "a point beyond the end of a beam",
        CLAMP,
        CLAMP
        + support(
            "roller", "Simple Support", ("Direction", "{0, 0, 1}"), node="beam@1.5"
        ).replace('<Parameter name="Node"', '@@<Parameter name="Node"'),
        "Constraints / roller / Node: needs a fraction between 0 and 1 behind '@', got 'beam@1.5'",
    ),
]
for form in ("Null Space", "Multipliers"):
    null_space = form == "Null Space"
    of_form = {} if null_space else {"form": form}
    CASES += [
        unsolvable(
            f"no support, {form}",
            4,
            (CLAMP, ""),
            says=[SINGULAR + MECHANISM, "\n  beam/0, z ", "\n'beam' ", "; nothing holds it\n"],
            ranks=null_space,
            **of_form,
        ),
        Case(
            f"check finds what nothing holds, {form}",
            4,
            change=[(CLAMP, ""), ('"Null Space"', f'"{form}"')],
            args="check deck.xml",
            says=[SINGULAR + MECHANISM, "\n  beam/0, z ", "\n'beam' ", "; nothing holds it\n"],
            silent=False,
            ranks=null_space,
        ),
        unsolvable(
            f"nothing holds the rotation about the axis, {form}",
            4,
            (CLAMP, support("pin", "Spherical Support") + ROLLERS),
            says=[SINGULAR + MECHANISM]
            + [f"\n  beam/{node}, rotation x " for node in range(5)]
            + [
                "\n'beam' turns about the axis (1, 0, 0) through (0, 0, 0); held by "
                "Spherical Support 'pin', Simple Support 'roller y', Simple Support 'roller z'\n",
                "\nTry: add a support",
            ],
            **of_form,
        ),
        *(
            Case(
                f"{verb}, buckling of what may turn, {form}",
                4,
                change=[
                    (CLAMP, support("pin", "Spherical Support") + ROLLERS),
                    (ANALYSIS, BUCKLING),
                    ('"Null Space"', f'"{form}"'),
                ],
                args=args,
                says=[NO_FACTORS + MECHANISM, "\n'beam' turns about the axis (1, 0, 0)"],
                silent=False,
                leaves=["out"],
                ranks=null_space,
            )
            for verb, args in (
                ("check", "check deck.xml"),
                ("run", "run deck.xml --output out"),
            )
        ),
        unsolvable(
            f"load of 1e308, {form}",
            5,
            (FORCE, '"{0, 0, 1e308}"'),
            says=[
                "No equilibrium beyond level 0 of 1: a force became infinite or not a number.\n",
                "\n  beam/4, z ",
                "beyond the range of numbers",
            ],
            ranks=null_space,
            **of_form,
        ),
        unsolvable(
            f"stiffness of 1e308, {form}",
            5,
            (EI1, 'name="EI1" value="1e308"'),
            says=[
                "The stiffness is not finite at level 0, before the first step.\n",
                "beyond the range of numbers",
            ],
            ranks=null_space,
            **of_form,
        ),
    ]

ARCH = parameters(
    "Curve",
    ("Type", "Arc Through Points"),
    ("From", "{0, 0, 0}"),
    ("Through", "{1, 0, 0.3}"),
    ("To", "{L, 0, 0}"),
    ("Elements", 8),
)


def ends_at_limit_point(folder, _):
    """The history ends with the last level that was reached, shortly below the limit."""
    last = (folder / "out/history.csv").read_text().splitlines()[-1]
    level = float(last.split(",")[0])
    return "" if 0.66 < level < 0.67 else f"the last level is {level}"


CASES.append(
    unsolvable(
        "limit point of an arch under a load at its crown",
        4,
        (CURVE, ARCH),
        (CLAMP, CLAMP + support("other end", "Rigid Support", node="beam/last")),
        (
            f'beam/last"/>\n      <Parameter name="Force" value={FORCE}',
            'beam/middle"/>\n      <Parameter name="Force" value="{0, 0, -2e4}"',
        ),
        (EI1, 'name="EI1" value="1e3"'),
        ('name="EI2" value="4e3"', 'name="EI2" value="1e3"'),
        (STEPS, STEPS.replace('"2"', '"5"')),
        says=[
            "No equilibrium beyond level 0.66",
            "\nLast steps:\n  level 0.66",
            "\nLargest residuals of the last attempt:\n  beam/",
            "\nLikely cause: a limit point. At level 0.66",
            "\nTry: an analysis of type 'Path', which goes on beyond, or end below this level.\n",
        ],
        last_level=None,
        check=ends_at_limit_point,
        ranks=True,
    )
)
