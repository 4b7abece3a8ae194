"""Sections, axes, walls and models that make no sense."""

from broken.pieces import (
    CLAMP,
    CURVE,
    LOADS,
    POSITIONS,
    SECTION,
    SECTIONS,
    STEPS,
    TRIAD,
    WATCH,
    link,
    list_of,
    missing,
    parameters,
    stiffness,
    support,
    two_nodes,
    wrong,
)
from driver import Case

BAR = list_of("bar")
BEAM = "Structures / beam"

SHEET = parameters(
    "sheet",
    ("Type", "Shell"),
    ("Material", "steel"),
    ("Thicknesses", "{0.01, 0.02}"),
    ("@@Angles", "{0, 0.5, 1}"),
).replace(
    "</ParameterList>",
    parameters(
        "Mesh",
        ("Type", "Plane"),
        ("Side 1", "{1, 0, 0}"),
        ("Side 2", "{0, 1, 0}"),
        ("Elements", "{1, 1}"),
    )
    + "</ParameterList>",
)



def bow(analysis, *pairs):
    entries = parameters("bow", *pairs, ("@@Analysis", analysis), ("Amplitude", 0.01))
    if pairs:
        entries = entries.replace("@@Analysis", "Analysis")
    return f'<ParameterList name="Imperfections">{entries}</ParameterList>'


CASES = [
    Case(
        "reaction at a node that a connection takes away",
        3,
        change=[
            (CLAMP, CLAMP + link("bolt", "beam/3", "beam/last")),
            (WATCH, 'value="Reaction"/>\n        @@<Parameter name="Node" value="beam/last"/>'),
        ],
        errors=[
            "deck.xml:{line}: Output / History / tip / Node: 'beam/4' follows 'beam/3' by Rigid Connection "
            "'bolt', which takes its unknowns away, so the force that it carries is not known; watch "
            "'beam/3' for what holds both, take a Weld instead of the connection, or Solver / Form = "
            "Multipliers"
        ],
        ranks=True,
    ),
    wrong(
        "imperfection that a static analysis finds",
        LOADS,
        LOADS + bow("bend"),
        "Imperfections / bow / Analysis: must be of type Buckling or Modal, 'bend' is of type Static",
        "Imperfections / bow / Analysis: no analysis comes after 'bend', whose geometry the shape "
        "could bend",
    ),
    Case(
        "imperfection of a run that is not there",
        6,
        change=[(LOADS, LOADS + bow("bend", ("@@Run", "nowhere")))],
        errors=[
            "nowhere: is not there; deck.xml:{line}: Imperfections / bow / Run asks for the shapes "
            "of this run"
        ],
    ),
    wrong(
        "angles of more layers than there are",
        '<ParameterList name="Structures">',
        '<ParameterList name="Structures">' + SHEET,
        "Structures / sheet / Angles: must have one item per layer, 2 as stated by the list "
        "before, got 3",
    ),
    wrong(
        "6x6 stiffness not positive definite",
        BAR,
        stiffness(e45=5e3, e54=5e3),
        "Sections / bar / Stiffness: the stiffness is not positive semidefinite: its smallest "
        "eigenvalue, with the diagonal scaled to one, is -0.443",
    ),
    wrong(
        "6x6 mass of no plane section",
        BAR,
        stiffness().replace(
            "\n    </",
            '\n      @@<Parameter name="Mass" value="{3, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0.1, 0, '
            '0, 0.2, 0, 0.5}"/>\n    </',
        ).replace("@@Stiffness", "Stiffness"),
        "Sections / bar / Mass: the mass is not that of a plane section, which moves with the "
        "directors of its plane: entry (6, 6) is 0.5, by the others it must be 0.3",
    ),
    wrong(
        "6x6 stiffness not symmetric",
        BAR,
        stiffness(e45=1e3, e54=1.1e3),
        "Sections / bar / Stiffness: the stiffness is not symmetric: entry (5, 4) is 1100 but "
        "(4, 5) is 1000",
    ),
    wrong(
        "6x6 stiffness of 25 values",
        BAR,
        parameters(
            "bar", ("Type", "Stiffness Matrix"), ("@@Stiffness", "{" + "1, " * 24 + "1}")
        ),
        "Sections / bar / Stiffness: must have 36 values (rows) or 21 values (upper triangle by "
        "rows), got 25",
    ),
    wrong(
        "triad not orthonormal",
        CURVE,
        two_nodes(TRIAD, "0, 0, 1.01, 0, -1, 0, 1, 0, 0"),
        BEAM + " / Curve / Directors: node 1: directors are not orthonormal, |D^T D - 1| is 0.02 "
        "and must be <= 1e-06",
    ),
    wrong(
        "left-handed triad",
        CURVE,
        two_nodes(TRIAD, "0, 0, 1, 0, 1, 0, 1, 0, 0"),
        BEAM + " / Curve / Directors: node 1: directors are left-handed",
    ),
    wrong(
        "triads against the axis",
        CURVE,
        two_nodes(TRIAD, TRIAD, "{L, 0, 0, 0, 0, 0}"),
        BEAM + " / Curve / Directors: between nodes 0 and 1 d3 points against the axis",
    ),
    wrong(
        "Up parallel to the axis",
        '"{0, 0, 1}"',
        '"{-1, 0, 0}"',
        BEAM + " / Curve / Up: must not be parallel to the axis, but is at 0 of its length",
    ),
    wrong(
        "Up of zero length", '"{0, 0, 1}"', '"{0, 0, 0}"', BEAM + " / Curve / Up: must not be zero"
    ),
    wrong(
        "curve of zero length",
        '"{L, 0, 0}"',
        '"{0, 0, 0}"',
        BEAM + " / Curve / To: must differ from 'From'",
    ),
    Case(
        "curve beyond the range of numbers",
        3,
        change=[
            ('name="L" value="2"', 'name="L" value="1e300"'),
            ('<ParameterList name="Curve">', '@@<ParameterList name="Curve">'),
        ],
        errors=[
            "deck.xml:{line}: Structures / beam / Curve: the length of the axis is beyond the "
            "range of numbers"
        ],
    ),
    Case(
        "Section and Sections",
        3,
        change=[
            (SECTION, "\n".join([SECTION, SECTIONS, POSITIONS % "0, 1"])),
            ('<ParameterList name="beam">', '@@<ParameterList name="beam">'),
        ],
        errors=["deck.xml:{line}: Structures / beam: give one of 'Section' and 'Sections'"],
    ),
    missing(
        "neither Section nor Sections",
        SECTION,
        '<ParameterList name="beam">',
        BEAM + ": give one of 'Section' and 'Sections'",
    ),
    Case(
        "Sections without positions",
        3,
        change=[
            (SECTION, SECTIONS),
            ('<ParameterList name="beam">', '@@<ParameterList name="beam">'),
        ],
        errors=[
            "deck.xml:{line}: Structures / beam: 'Sections' and 'Section Positions' need each other"
        ],
    ),
    wrong(
        "section positions descend",
        SECTION,
        SECTIONS + "\n@@" + POSITIONS % "1, 0",
        BEAM + " / Section Positions: must not descend",
    ),
    wrong(
        "pre-twist that jumps",
        '<Parameter name="Elements" value="4"/>',
        '<Parameter name="Elements" value="4"/>\n<Parameter name="Pre-Twist" value="{0, 0.1, 1.1, 1.2}"/>\n'
        '@@<Parameter name="Pre-Twist Positions" value="{0, 0.5, 0.5, 1}"/>',
        BEAM + " / Curve / Pre-Twist Positions: 'Pre-Twist' jumps at 0.5, and a beam does not; where its sections do, they have "
        "an 'Angle'",
    ),
    wrong(
        "load levels do not rise",
        STEPS,
        '<Parameter name="Levels" value="{0.5, 0.25}"/>',
        "Analyses / bend / Levels: levels must rise from above the first level to at most the final level 1, "
        "got 0.25 after 0.5",
    ),
    wrong(
        "load level beyond the last",
        STEPS,
        '<Parameter name="Levels" value="{0.5, 1.25}"/>',
        "Analyses / bend / Levels: levels must rise from above the first level to at most the final level 1, "
        "got 1.25 after 0.5",
    ),
    wrong(
        "direction of zero length",
        CLAMP,
        support("clamp", "Simple Support", ("@@Direction", "{0, 0, 0}")),
        "Constraints / clamp / Direction: must not be zero",
    ),
    wrong(
        "node that follows itself",
        CLAMP,
        link("clamp", "beam/0", "@@beam/first"),
        "Constraints / clamp / Node: node 'beam/0' cannot follow itself",
    ),
]
