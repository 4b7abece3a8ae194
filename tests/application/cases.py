"""Sound decks and command lines: what culm prints and leaves behind."""

import pathlib
import re

from driver import BASE, Case


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


def is_version(_, stdout):
    return "" if re.fullmatch(r"\d+\.\d+\.\d+\n", stdout) else f"'{stdout}' is no version"


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
        prints=["deck TEXT REQUIRED", "--set TEXT", "--quiet", "--output TEXT"],
    ),
    Case(
        "check counts and leaves nothing",
        0,
        args="check deck.xml",
        prints=[
            "\nbeam                          5        4            0\n",
            "\nRigid Support 'clamp'                    by elimination               beam/0\n",
            "\nunknowns: 24 (0 multipliers)\ndegrees of freedom: 24\nmatrix entries: ",
            "\nlinear solver: KLU2, automatic: fronts of ",
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
        errors=["driver.inp: cannot read: No such file or directory"],
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
        prints=["\nFor changes below 1 % this scene needs flexibility of "],
        leaves=["out"],
        check=is_page("out/effects.html", ["What it contains", "What happens without"]),
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
        or ("" if "\n0,3,0,0\n" in (folder / "out/history.csv").read_text() else "L is not 3"),
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
        says=["warning: deck.xml:{line}: Structures / beam: the ends of an element are turned by "],
        results="out",
        last_level=1.0,
        ranks=True,
    ),
]
