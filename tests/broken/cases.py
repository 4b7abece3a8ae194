"""Decks and command lines that are wrong, each with the exit code and the text it must give.

One mistake gives one line that names file, line, deck path, rule and value found. errors= is all
of stderr, so a follow-up message fails the case as well as a missing one.
"""

import fcntl
import os
import re

from driver import BASE, Case

# --- pieces of base.xml and their replacements


def list_of(name):
    """The text of a list of base.xml, from its opening to its closing tag."""
    start = BASE.index(f'<ParameterList name="{name}">')
    depth = 0
    for tag in re.finditer(r"<(/?)ParameterList", BASE[start:]):
        depth += -1 if tag[1] else 1
        if depth == 0:
            return BASE[start : start + tag.end() + 1]
    raise ValueError(name)


def parameters(name, *pairs):
    """A list of parameters, each a pair of name and value."""
    lines = "".join(f'\n      <Parameter name="{key}" value="{value}"/>' for key, value in pairs)
    return f'<ParameterList name="{name}">{lines}\n    </ParameterList>'


def support(name, kind, *pairs, node="beam/first"):
    return parameters(name, ("Type", kind), ("Node", node), *pairs)


def link(name, master, node):
    return parameters(name, ("Type", "Rigid Connection"), ("Master", master), ("Node", node))


def stiffness(**entries):
    """The section by 36 values, some off the diagonal: e12 for row 1, column 2."""
    diagonal = [1e6, 1e6, 2e6, 3e3, 4e3, 2e3]
    rows = [[diagonal[i] if i == j else 0 for j in range(6)] for i in range(6)]
    for name, value in entries.items():
        rows[int(name[1]) - 1][int(name[2]) - 1] = value
    numbers = ", ".join(f"{value:g}" for row in rows for value in row)
    return parameters("bar", ("Type", "Stiffness Matrix"), ("@@Stiffness", "{" + numbers + "}"))


def line_load(*pairs):
    """In place of the force at the tip, a load along the beam."""
    return parameters("wind", ("Type", "Line Load"), ("Structure", "beam"), *pairs)


def two_nodes(first, second, positions="{0, 0, 0, L, 0, 0}"):
    """The axis by its two end nodes with these triads."""
    triads = "{" + first + ", " + second + "}"
    return parameters("Curve", ("Type", "Nodes"), ("Positions", positions), ("@@Directors", triads))


TRIAD = "0, 0, 1, 0, -1, 0, 1, 0, 0"  # sound, for an axis along x
SECTION = '<Parameter name="Section" value="bar"/>'
POSITIONS = '<Parameter name="Section Positions" value="{%s}"/>'
SECTIONS = '<Parameter name="Sections" value="{bar, bar}"/>'
STEPS = '<Parameter name="Steps" value="2"/>'
CLAMP = list_of("clamp")
FORCE = '"{0, 0, 100}"'
TIP_FORCE = 'value="Force"/>\n      <Parameter name="Node" value="beam/last"/>'
INNER_FORCE = TIP_FORCE.replace("last", "2")
ANALYSIS = list_of("bend")
WATCH = 'value="Position"/>\n        <Parameter name="Node" value="beam/last"/>'
TIP = '<ParameterList name="tip">\n        <Parameter name="Type" '
WATCH_ELEMENT = (
    'value="Stress Resultants"/>\n        <Parameter name="%s" value="%s"/>'
    '\n        <Parameter name="%s" value="%s"/>'
)
TIP_LOAD = list_of("tip force")
INCLUDE = '<xi:include href="loads.xml"/>'
LOADS = list_of("Loads")

# --- kinds of cases


def wrong(name, old, new, *errors, **more):
    """One place of the deck is changed; the messages name its line, or that of the mark @@."""
    lines = ["deck.xml:{line}: " + error for error in errors]
    return Case(name, 3, change=[(old, new)], errors=lines, **more)


def missing(name, what, place, error):
    """Something is left out; the message names the line of the list that lacks it."""
    return Case(
        name,
        3,
        change=[(what, ""), (place, "@@" + place)],
        errors=["deck.xml:{line}: " + error],
    )


def whole(name, deck, error, **more):
    """A deck that is nothing like the base."""
    return Case(name, 3, deck=deck, errors=[error], **more)


def included(name, error, old=LOADS, new=INCLUDE, **files):
    """Part of the deck comes from other files."""
    texts = {f"{file}.xml": text for file, text in files.items()}
    return Case(name, 3, change=[(old, new)], files=texts, errors=[error])


def unsolvable(name, code, *change, says=(), form=None, last_level=0.0, **more):
    """A sound deck whose equations are not. What was found until then is in the results."""
    change = list(change) + ([("Null Space", form)] if form else [])
    return Case(
        name,
        code,
        change=change,
        says=list(says),
        never=["internal error", "NOX", "terminate"],
        results="out",
        last_level=last_level,
        silent=False,
        **more,
    )


def usage(name, args, *says, **more):
    return Case(name, 2, args=args, says=list(says), **more)


def unwritable(name, reason, args="run deck.xml --output out", **more):
    more.setdefault("says", [reason])
    return Case(name, 6, args=args, **more)


def shell(*mesh, wall=""):
    """A deck of one wall with this mesh."""
    return f"""<ParameterList name="culm">
  <ParameterList name="Materials">
    {parameters("steel", ("Type", "Isotropic"), ("Young Modulus", "2e11"), ("Poisson Ratio", "0.3"))}
  </ParameterList>
  <ParameterList name="Structures">
    <ParameterList name="wall">
      <Parameter name="Type" value="Shell"/>
      <Parameter name="Material" value="steel"/>
      <Parameter name="Thickness" value="0.01"/>
      {wall}
      {"" if wall else "@@"}{parameters("Mesh", *mesh)}
    </ParameterList>
  </ParameterList>
  <ParameterList name="Analyses">
    {parameters("bend", ("Type", "Static"))}
  </ParameterList>
</ParameterList>
"""


NAMES = [
    wrong(
        "misspelt parameter",
        '"EI2" value',
        '"EI_2" value',
        "Sections / bar: unknown name 'EI_2' – did you mean 'EI2'?",
        ranks=True,
    ),
    wrong(
        "a misspelt name stands for one that is missing",
        '"EI2" value',
        '"EI3" value',
        "Sections / bar: unknown name 'EI3' – did you mean 'EI2'?",
    ),
    wrong(
        "misspelt list at the top",
        '<ParameterList name="Loads">',
        '<ParameterList name="Load">',
        "culm: unknown list 'Load' – did you mean 'Loads'?",
    ),
    wrong(
        "misspelt required list at the top",
        '<ParameterList name="Analyses">',
        '<ParameterList name="Analysis">',
        "culm: unknown list 'Analysis' – did you mean 'Analyses'?",
    ),
    wrong(
        "misspelt list further down",
        '<ParameterList name="Curve">',
        '<ParameterList name="Curv">',
        "Structures / beam: unknown list 'Curv' – did you mean 'Curve'?",
    ),
    wrong(
        "misspelt root",
        '<ParameterList name="culm">',
        '<ParameterList name="clum">',
        "clum: the root list must be named 'culm', got 'clum'",
    ),
    wrong(
        "misspelt element",
        '<Parameter name="Elements"',
        '<Paramter name="Elements"',
        "Structures / beam / Curve: unknown element <Paramter> – did you mean 'Parameter'?",
    ),
    wrong(
        "misspelt attribute",
        'name="Elements" value=',
        'name="Elements" val=',
        "Structures / beam / Curve / Elements: unknown attribute 'val' of <Parameter> (allowed: "
        "name, value, type, unit, isDefault)",
    ),
    wrong(
        "misspelt type of a constraint",
        'value="Rigid Support"',
        'value="Rigid Suport"',
        "Constraints / clamp / Type: unknown type 'Rigid Suport' – did you mean 'Rigid Support'?",
    ),
    wrong(
        "misspelt type of a section",
        'value="Stiffness Values"',
        'value="Stiffness"',
        "Sections / bar / Type: unknown type 'Stiffness' (allowed: Box, ...",
    ),
    wrong(
        "misspelt type of an analysis",
        'value="Static"',
        'value="Statics"',
        "Analyses / bend / Type: unknown type 'Statics' – did you mean 'Static'?",
    ),
    wrong(
        "misspelt type of a quantity",
        'value="Position"',
        'value="Positions"',
        "Output / History / tip / Type: unknown type 'Positions' – did you mean 'Position'?",
    ),
    wrong(
        "misspelt choice",
        'value="Null Space"',
        'value="Nullspace"',
        "Solver / Form: unknown choice 'Nullspace' – did you mean 'Null Space'?",
    ),
    wrong(
        "misspelt linear solver",
        '<Parameter name="Form" value="Null Space"/>',
        '<Parameter name="Linear Solver" value="MUMS"/>',
        "Solver / Linear Solver: unknown choice 'MUMS' – did you mean 'MUMPS'?",
    ),
    wrong(
        "unknown section",
        'value="bar"',
        'value="bra"',
        "Structures / beam / Section: unknown section 'bra' – did you mean 'bar'?",
    ),
    wrong(
        "unknown node",
        'value="beam/last"/>\n      <Parameter name="Force"',
        'value="beam/lst"/>\n      <Parameter name="Force"',
        "Loads / tip force / Node: unknown node 'beam/lst' – did you mean 'beam/last'?",
        ranks=True,
    ),
    wrong(
        "several nodes where a name belongs",
        'value="beam/first"',
        'value="{beam/first, beam/last}"',
        "Constraints / clamp / Node: must be one name, got '{beam/first, beam/last}'; an entry of "
        "'Node Sets' joins several",
    ),
    wrong(
        "node number too large",
        'value="beam/first"',
        'value="beam/5"',
        "Constraints / clamp / Node: no node 'beam/5': 'beam' has 5 nodes, numbered from 0",
    ),
    wrong(
        "unknown structure",
        WATCH,
        WATCH_ELEMENT % ("@@Structure", "baem", "Element", 0),
        "Output / History / tip / Structure: unknown structure 'baem' – did you mean 'beam'?",
    ),
    wrong(
        "element number too large",
        WATCH,
        WATCH_ELEMENT % ("Structure", "beam", "@@Element", 4),
        "Output / History / tip / Element: structure 'beam' has elements 0 to 3, got 4",
    ),
    wrong(
        "position of a load beyond its line",
        TIP_LOAD,
        line_load(("@@Positions", "{0, 3}"), ("Forces", "{0, 0, 1, 0, 0, 1}")),
        "Loads / wind / Positions: positions must lie between 0 and 1, as fractions of the length of "
        "the line, got 3; 'Position Measure' Metres takes lengths",
        ranks=True,
    ),
    wrong(
        "load by table without values",
        TIP_LOAD,
        line_load(("Positions", "{0, 1}")),
        "Loads / wind: 'Positions' needs 'Forces' or 'Moments', or both",
    ),
    Case(
        "file of a load that descends",
        3,
        change=[(TIP_LOAD, line_load(("File Name", "wind.csv")))],
        files={"wind.csv": "# r, F\n0, 0, 0, 1\n0.6, 0, 0, 1\n0.5, 0, 0, 1\n"},
        errors=["wind.csv:4: positions must not descend, got 0.5 after 0.6"],
    ),
    wrong(
        "stress at no point",
        TIP + WATCH,
        "@@" + TIP + 'value="Section Stress"/>\n        <Parameter name="Structure" value="beam"/>'
        '\n        <Parameter name="Element" value="0"/>',
        "Output / History / tip: needs 'Position', 'Normal', 'Shear 1' or 'Shear 2'",
    ),
    wrong(
        "layer of a beam",
        WATCH,
        'value="Layer Stress"/>\n        <Parameter name="@@Structure" value="beam"/>'
        '\n        <Parameter name="Element" value="0"/>',
        "Output / History / tip / Structure: structure 'beam' is no shell and has no layers",
    ),
    wrong(
        "layers that no shell has",
        '<ParameterList name="Output">',
        '<ParameterList name="Output">\n    <ParameterList name="Shell">\n'
        '      <Parameter name="Stresses" value="true"/>\n'
        '      @@<Parameter name="Layers" value="{0}"/>\n    </ParameterList>',
        "Output / Shell / Layers: no shell has more than 0 layers, numbered from 0, got 0",
    ),
    wrong(
        "unknown function",
        f"{FORCE}/>",
        f'{FORCE}/>\n      <Parameter name="@@Function" value="Rampe"/>',
        "Loads / tip force / Function: unknown function 'Rampe' – did you mean 'Ramp'?",
    ),
    wrong(
        "several nodes where one is watched",
        WATCH,
        WATCH.replace("beam/last", "@@beam"),
        "Output / History / tip / Node: names 5 nodes, but one is watched",
    ),
    wrong(
        "node set named as a structure",
        '<ParameterList name="Loads">',
        '<ParameterList name="Node Sets">\n    @@<ParameterList name="beam">\n'
        '      <Parameter name="Nodes" value="{beam/0}"/>\n    </ParameterList>\n'
        '  </ParameterList>\n  <ParameterList name="Loads">',
        "Node Sets / beam: there is a structure of this name",
    ),
    wrong(
        "node set named like the end of a beam",
        LOADS,
        '<ParameterList name="Node Sets">\n'
        + parameters("@@beam/last", ("Nodes", "{beam/2}"))
        + "</ParameterList>\n"
        + LOADS,
        "Node Sets / beam/last: names that begin with 'beam/' stand for parts of the structure 'beam'",
        ranks=True,
    ),
    wrong(
        "element set named like an end of a beam",
        LOADS,
        '<ParameterList name="Element Sets">\n'
        + parameters("@@beam/first", ("Structure", "beam"), ("Range", "{0, 1}"))
        + "</ParameterList>\n"
        + LOADS,
        "Element Sets / beam/first: names that begin with 'beam/' stand for parts of the structure "
        "'beam'",
    ),
    wrong(
        "structure with a slash in its name",
        '<ParameterList name="beam">',
        '@@<ParameterList name="be/am">',
        "Structures / be/am: the name of a structure must not contain '/' or '@', which stand before "
        "its nodes and points",
    ),
    wrong(
        "function that every deck has",
        LOADS,
        '<ParameterList name="Functions">\n'
        + parameters("@@Ramp", ("Type", "Constant"))
        + "</ParameterList>\n"
        + LOADS,
        "Functions / Ramp: is the name of a function that every deck has; take another one",
    ),
    wrong(
        "analyses that share a folder",
        ANALYSIS,
        ANALYSIS + parameters("@@Bend", ("Type", "Static")),
        "Analyses / Bend: would share the folder 'analyses/bend' with 'bend'; take another name",
        ranks=True,
    ),
    wrong(
        "analysis with a name too long for a folder",
        ANALYSIS,
        ANALYSIS + parameters("@@" + 201 * "b", ("Type", "Static")),
        "Analyses / " + 201 * "b" + ": is part of the name of a file, which may have 200 bytes of it, and has 201",
    ),
    wrong(
        "ports that share a picture",
        LOADS,
        '<ParameterList name="Ports">\n'
        + parameters("skin 1", ("Type", "Points"), ("Points", "{beam/2}"))
        + parameters("@@skin_1", ("Type", "Points"), ("Points", "{beam/3}"))
        + "</ParameterList>\n"
        + LOADS,
        "Ports / skin_1: would share the picture 'port_skin_1.vtu' with 'skin 1'; take another name",
        ranks=True,
    ),
    wrong(
        "partners that share a record",
        LOADS,
        '<ParameterList name="Ports">\n'
        + parameters("skin", ("Type", "Points"), ("Points", "{beam/2}"))
        + "</ParameterList>\n"
        + '<ParameterList name="Coupling">\n<ParameterList name="Partners">\n'
        + parameters("Wind", ("Type", "Dashpot"), ("Damping", "1"))
        + parameters("@@wind", ("Type", "Dashpot"), ("Damping", "2"))
        + "</ParameterList>\n</ParameterList>\n"
        + LOADS,
        "Coupling / Partners / wind: would share the record 'coupling_wind.record' with 'Wind'; take another name",
    ),
    wrong(
        "node set named like a point of a beam",
        LOADS,
        '<ParameterList name="Node Sets">\n'
        + parameters("@@beam@0.5", ("Nodes", "{beam/2}"))
        + "</ParameterList>\n"
        + LOADS,
        "Node Sets / beam@0.5: names that begin with 'beam@' stand for parts of the structure 'beam'",
    ),
    wrong(
        "analysis named like the reference state",
        ANALYSIS,
        ANALYSIS + parameters("@@Reference", ("Type", "Static")),
        "Analyses / Reference: is the name of the state at the beginning; take another one",
    ),
]

EI1 = 'name="EI1" value="3e3"'


def wrong_number(name, value, error):
    return wrong(name, EI1, f'name="EI1" value="{value}"', "Sections / bar / EI1: " + error)


def wrong_integer(name, value, error):
    return wrong(
        name,
        'name="Elements" value="4"',
        f'name="Elements" value="{value}"',
        "Structures / beam / Curve / Elements: " + error,
    )


def wrong_force(name, value, error):
    return wrong(name, FORCE, f'"{value}"', "Loads / tip force / Force: " + error)


def wrong_steps(name, attributes, error):
    return wrong(name, 'name="Steps" value="2"', attributes, "Analyses / bend" + error)


VALUES = [
    wrong(
        "spectral radius of a scheme that has none",
        list_of("bend"),
        parameters("bend", ("Type", "Dynamic"), ("End Time", 1), ("Step", 0.5), ("@@Spectral Radius", 0.5)),
        "Analyses / bend / Spectral Radius: 'Scheme' = Conserving has none; only Generalised Alpha damps by it",
    ),
    wrong_number("text for a number", "stiff", "must be a number, got 'stiff'"),
    wrong_number(
        "number with a unit in it",
        "3e3 N",
        "must be a number, got '3e3 N' – a unit stands in its own attribute: unit=\"N\"",
    ),
    wrong_number("decimal comma", "3,5", "must be one number, got '3,5'"),
    wrong_number("nan", "nan", "must be a finite number, got 'nan'"),
    wrong_number("inf", "-inf", "must be a finite number, got '-inf'"),
    wrong_number("division by zero", "1/0", "must be finite, got '1/0'"),
    wrong_number(
        "beyond double precision",
        "1e999",
        "must be within the range of double precision, got '1e999'",
    ),
    wrong(
        "beyond double precision in its unit",
        EI1,
        'name="EI1" value="1e306" unit="kN m^2"',
        "Sections / bar / EI1: must be from 2.23e-308 to 1.8e+308 in size when it is in SI units, got "
        "'1e306' in kN m^2",
    ),
    wrong(
        "variable too small for its unit",
        '<Variable name="L" value="2"/>',
        '<Variable name="L" value="2e-306" unit="mm"/>',
        "L: must be from 2.23e-308 to 1.8e+308 in size when it is in SI units, got '2e-306' in mm",
    ),
    wrong_number("negative stiffness", "-3e3", "must be >= 0 N m^2, got -3000"),
    wrong_integer("4.7 for an integer", "4.7", "must be an integer, got '4.7'"),
    wrong_integer(
        "integer beyond its range",
        "3e9",
        "must be an integer of at most 2147483647 in size, got '3e9'",
    ),
    wrong_integer("too small", "0", "must be between 1 and 100000, got 0"),
    wrong_integer("too large", "2e9", "must be between 1 and 100000, got 2000000000"),
    wrong(
        "yes for a flag",
        '<ParameterList name="Output">',
        '<ParameterList name="Output">\n    <Parameter name="@@Pictures" value="yes"/>',
        "Output / Pictures: must be true or false, got 'yes'",
    ),
    wrong(
        "wrong dimension of a unit",
        'unit="kN"',
        'unit="kN m"',
        "Sections / bar / EA: must be in units of 'N', got 'kN m'",
    ),
    wrong(
        "unknown unit",
        'unit="kN"',
        'unit="kn"',
        "Sections / bar / EA: unknown unit 'kn' – did you mean 'kN'?",
    ),
    wrong(
        "unit of a text",
        'value="Null Space"',
        'value="Null Space" unit="m"',
        "Solver / Form: takes no unit, got 'm'",
    ),
    wrong_force(
        "unknown variable",
        "{0, 0, 10*F}",
        "item 3: must be a number, got '10*F': unknown variable 'F' (allowed: L, e, pi)",
    ),
    wrong_force(
        "unknown function in an expression",
        "{0, 0, sine(1)}",
        "item 3: must be a number, got 'sine(1)': unknown function 'sine' – did you mean 'sin'?",
    ),
    wrong_force("array too short", "{0, 100}", "must have 3 items, got 2"),
    wrong_force("number for an array", "100", "must be an array such as {1, 2, 3}, got '100'"),
    wrong_force("one wrong item", "{0, x1, 100}", "item 2: must be a number, got 'x1'"),
    wrong(
        "wrong variable",
        'name="L" value="2"',
        'name="L" value="two"',
        "L: must be a number, got 'two'",
    ),
    wrong(
        "variable with a taken name",
        '<Variable name="L" value="2"/>',
        '<Variable name="L" value="2"/>\n@@<Variable name="pi" value="3"/>',
        "pi: the name 'pi' is taken",
    ),
    wrong_steps(
        "wrong type=",
        'name="Steps" type="double" value="2"',
        ' / Steps: must have type="int", got type="double"',
    ),
    wrong_steps(
        "unknown type=",
        'name="Steps" type="integer" value="2"',
        ' / Steps: unknown type="integer" (allowed: double, int, bool, string, Array(double), '
        "Array(int), Array(string))",
    ),
    wrong_steps("no value", 'name="Steps"', " / Steps: has no attribute 'value'"),
    wrong_steps("empty value", 'name="Steps" value=""', " / Steps: must be an integer, got ''"),
    wrong_steps("no name", 'value="2"', ": <Parameter> has no attribute 'name'"),
    wrong(
        "unknown variable in a function",
        LOADS,
        '<Variable name="omega" value="3"/>\n<ParameterList name="Functions">'
        + parameters("swing", ("Type", "Expression"), ("@@Expression", "omega + omga*t"))
        + "</ParameterList>\n"
        + LOADS,
        "Functions / swing / Expression: must be a formula in t, got '(3) + omga*t': mistake at "
        "character 7, 'omga' (Unexpected token \"omga\" found at position 6.)",
    ),
    wrong(
        "assignment in a function",
        LOADS,
        '<ParameterList name="Functions">'
        + parameters("jump", ("Type", "Expression"), ("@@Expression", "t=0.5 ? 1 : 0"))
        + "</ParameterList>\n"
        + LOADS,
        "Functions / jump / Expression: must be a formula in t, got 't=0.5 ? 1 : 0': mistake at "
        "character 2, '=' ('=' does not compare, '==' does)",
        ranks=True,
    ),
    wrong(
        "variable with a name of 101 characters",
        '<Variable name="L" value="2"/>',
        f'<Variable name="L" value="2"/>\n  @@<Variable name="{"v" * 101}" value="2"/>',
        f"{'v' * 101}: the name of a variable must have at most 100 characters, got '{'v' * 60}…'",
        ranks=True,
    ),
    wrong(
        "range of elements without end",
        LOADS,
        '<ParameterList name="Element Sets">\n'
        + parameters("all", ("Structure", "beam"), ("@@Range", "{0, 2147483647}"))
        + "</ParameterList>\n"
        + LOADS,
        "Element Sets / all / Range: structure 'beam' has elements 0 to 3",
        ranks=True,
    ),
    Case(
        "more elements than memory holds",
        3,
        args="run deck.xml --output out --set Structures/beam/Curve/Elements=100000 "
        "--set Refinement=1024 --set Structures/beam/Order=3 --max-memory '16 GB'",
        change=[('<ParameterList name="Curve">', '@@<ParameterList name="Curve">')],
        errors=[
            "deck.xml:{line}: Structures / beam / Curve: asks for 102400000 elements, with which the "
            "model needs about 2.46 TB (elements 2 TB, factors 461 GB) of memory and 16 GB are allowed: take fewer elements, or "
            "allow more with --max-memory"
        ],
        ranks=True,
    ),
    Case(
        "more elements than the option allows",
        3,
        args="check deck.xml --max-memory 20kB",
        change=[('<ParameterList name="Curve">', '@@<ParameterList name="Curve">')],
        errors=[
            "deck.xml:{line}: Structures / beam / Curve: asks for 4 elements, with which the model "
            "needs about 0.032 MB (elements 0.026 MB, factors 0.006 MB) of memory and 0.02 MB are allowed: take fewer elements, or allow "
            "more with --max-memory"
        ],
    ),
    whole(
        "shell of 65536 x 65536 elements",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{65536, 65536}")),
        "deck.xml:{line}: Structures / wall / Mesh: asks for 4294967296 elements, with which the "
        "model needs about 326 TB (elements 68.7 TB, factors 257 TB) of memory and 8 GB are allowed: "
        "take fewer elements, or allow more with --max-memory",
        args="run deck.xml --output out --max-memory 8GB",
        ranks=True,
    ),
    whole(
        "elements fit, but not their factors",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{500, 500}")),
        "deck.xml:{line}: Structures / wall / Mesh: asks for 250000 elements, with which the "
        "model needs about 11.2 GB (elements 4 GB, factors 7.16 GB) of memory and 5 GB are allowed: "
        "take fewer elements, or allow more with --max-memory",
        args="run deck.xml --output out --max-memory 5GB",
    ),
    whole(
        "layers repeated without end",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{1, 1}"),
              wall='<Parameter name="Symmetric" value="All Layers"/>\n@@<Parameter name="Repeat" value="2147483647"/>'),
        "deck.xml:{line}: Structures / wall / Repeat: makes 4294967294 layers, at most 100000 are possible",
    ),
]

STRUCTURE = [
    missing(
        "missing parameter",
        '<Parameter name="EI2" value="4e3"/>',
        '<ParameterList name="bar">',
        "Sections / bar: missing 'EI2' (number >= 0 N m^2)",
    ),
    missing(
        "missing sections",
        list_of("Sections"),
        SECTION,
        "Structures / beam / Section: unknown section 'bar'",
    ),
    missing(
        "missing structures",
        list_of("Structures"),
        '<ParameterList name="culm">',
        "culm: missing list 'Structures'",
    ),
    missing(
        "missing analyses",
        list_of("Analyses"),
        '<ParameterList name="culm">',
        "culm: missing list 'Analyses'",
    ),
    wrong(
        "empty structures",
        list_of("Structures"),
        '<ParameterList name="Structures"/>',
        "Structures: must hold at least one structure",
    ),
    wrong(
        "empty analyses",
        list_of("Analyses"),
        '<ParameterList name="Analyses"/>',
        "Analyses: must hold at least one analysis",
    ),
    missing(
        "missing curve",
        list_of("Curve"),
        '<ParameterList name="beam">',
        "Structures / beam: missing list 'Curve'",
    ),
    missing(
        "missing type",
        '<Parameter name="Type" value="Stiffness Values"/>',
        '<ParameterList name="bar">',
        "Sections / bar: missing 'Type' (allowed: Box, ...",
    ),
    wrong(
        "duplicate parameter",
        '<Parameter name="EI2" value="4e3"/>',
        '<Parameter name="EI2" value="4e3"/>\n@@<Parameter name="EI2" value="5e3"/>',
        "Sections / bar / EI2: duplicate name, first used in line 12",
    ),
    wrong(
        "duplicate list",
        CLAMP,
        CLAMP + "\n@@" + CLAMP,
        "Constraints / clamp: duplicate name, first used in line 29",
    ),
    wrong(
        "duplicate variable",
        '<Variable name="L" value="2"/>',
        '<Variable name="L" value="2"/>\n@@<Variable name="L" value="3"/>',
        "L: duplicate name, first used in line 3",
    ),
    wrong(
        "parameter where a list belongs",
        LOADS,
        '<Parameter name="Loads" value="1"/>',
        "Loads: must be a <ParameterList>, found a <Parameter>",
    ),
    wrong(
        "list where a parameter belongs",
        '<Parameter name="Elements" value="4"/>',
        '<ParameterList name="Elements"/>',
        "Structures / beam / Curve / Elements: must be a <Parameter>, found a <ParameterList>",
    ),
    wrong(
        "text between elements",
        '<ParameterList name="Loads">',
        '<ParameterList name="Loads">100 N',
        "Loads: text between elements is not allowed: '100 N'",
    ),
    Case(
        "four mistakes at once, in the order of the file",
        3,
        change=[
            ('unit="kN"', 'unit="kn"'),
            (f'"Force" value={FORCE}', f'"Forc" value={FORCE}'),
            (STEPS, '<Parameter name="Steps" value="0"/>'),
            ('"Position"', '"Positon"'),
        ],
        errors=[
            "deck.xml:7: Sections / bar / EA: unknown unit 'kn' – did you mean 'kN'?",
            "deck.xml:38: Loads / tip force: unknown name 'Forc' – did you mean 'Force'?",
            "deck.xml:47: Analyses / bend / Steps: must be >= 1, got 0",
            "deck.xml:53: Output / History / tip / Type: unknown type 'Positon' – did you mean "
            "'Position'?",
        ],
        ranks=True,
    ),
    Case(
        "a mistake of --set",
        3,
        args="run deck.xml --output out --set Analyses/bend/Stepps=3",
        errors=["command line: Analyses / bend: unknown name 'Stepps' – did you mean 'Steps'?"],
    ),
]

CURVE = list_of("Curve")
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


MECHANICS = [
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



def function_file(name):
    return (
        '<ParameterList name="Functions">'
        + parameters("gust", ("Type", "File"), ("@@File Name", name))
        + "</ParameterList>\n"
    )


def imperfection(run):
    return (
        '<ParameterList name="Imperfections">'
        + parameters("bow", ("@@Run", run), ("Analysis", "modes"), ("Amplitude", "0.1"))
        + "</ParameterList>\n"
    )


def many_variables(count):
    """As many variables as lists, each of which has one more of its own and uses the first."""
    variables = "\n".join(f'<Variable name="v{i}" value="{i}"/>' for i in range(count))
    point = '<Variable name="x" value="v1"/>' + parameters_of_mass("2*v1 + x")
    masses = "\n".join(
        f'<ParameterList name="m{i}">{point}</ParameterList>' for i in range(count)
    )
    return (
        f'<ParameterList name="culm">\n{variables}\n'
        f'<ParameterList name="Masses">{masses}</ParameterList>\n</ParameterList>\n'
    )


def parameters_of_mass(mass):
    pairs = (("Type", "Point Mass"), ("Node", "beam/0"), ("Mass", mass))
    return "".join(f'<Parameter name="{key}" value="{value}"/>' for key, value in pairs)


DOCTYPE = "a DOCTYPE is not allowed in a deck"

FILES = [
    Case("empty file", 6, deck="", errors=["deck.xml: the file is empty"]),
    Case("blank file", 6, deck=" \n \n", errors=["deck.xml: the file is empty"]),
    Case("missing deck", 6, deck=None, errors=["deck.xml: there is no such file"], ranks=True),
    Case(
        "folder for a deck",
        6,
        args="run . --output out",
        errors=[".: is a folder"],
    ),
    Case(
        "pipe for a deck",
        6,
        deck=None,
        prepare=lambda folder: os.mkfifo(folder / "deck.xml"),
        errors=["deck.xml: is a pipe, not a file"],
        ranks=True,
    ),
    Case(
        "link for a deck that leads to itself",
        6,
        deck=None,
        prepare=lambda folder: (folder / "deck.xml").symlink_to("deck.xml"),
        errors=["deck.xml: cannot be read: Too many levels of symbolic links"],
    ),
    Case(
        "device for an include",
        3,
        change=[(LOADS, '<xi:include href="/dev/zero"/>')],
        errors=[
            "deck.xml:{line}: cannot read the included file '/dev/zero': is a device, not a file"
        ],
        ranks=True,
    ),
    Case(
        "device for a table",
        6,
        change=[(LOADS, function_file("/dev/zero") + LOADS)],
        errors=[
            "/dev/zero: is a device, not a file; deck.xml:{line}: Functions / gust / File Name asks "
            "for it"
        ],
        ranks=True,
    ),
    Case(
        "folder for a mesh",
        6,
        deck=shell(("Type", "Gmsh"), ("File Name", ".")).replace(
            '<Parameter name="File Name"', '@@<Parameter name="File Name"'
        ).replace("@@<ParameterList", "<ParameterList"),
        errors=[".: is a folder; deck.xml:{line}: Structures / wall / Mesh / File Name asks for it"],
        ranks=True,
    ),
    Case(
        "pipe for a file of OpenFAST",
        6,
        deck=None,
        args="import openfast blade.inp",
        prepare=lambda folder: os.mkfifo(folder / "blade.inp"),
        errors=["blade.inp: is a pipe, not a file"],
    ),
    Case(
        "shape of a run with a name too long for files",
        6,
        change=[(LOADS, imperfection("a" * 300) + LOADS)],
        errors=[
            "a" * 200 + "… (100 more bytes): cannot be read: File name too long; "
            "deck.xml:{line}: Imperfections / bow / Run asks for the shapes of this run"
        ],
        ranks=True,
    ),
    Case(
        "pipe for the results of a run",
        6,
        change=[(LOADS, imperfection("run.h5") + LOADS)],
        prepare=lambda folder: os.mkfifo(folder / "run.h5"),
        errors=["run.h5: is a pipe, not a file"],
    ),
    Case(
        "1e5 wrong names",
        3,
        change=[(STEPS, "\n".join(f'<Parameter name="wrong {i}" value="1"/>' for i in range(10**5)))],
        says=["\nand 99900 more mistakes\n"],
    ),
    Case(
        "1e4 variables in 1e4 lists",
        3,
        deck=many_variables(10**4),
        errors=["deck.xml:1: culm: missing list 'Structures'", "deck.xml:1: culm: missing list 'Analyses'"],
    ),
    whole(
        "binary file",
        bytes(range(256)) * 8,
        "deck.xml:1: not a text file: there is a zero byte in it",
    ),
    whole(
        "binary file without zero bytes",
        bytes(range(128, 256)) * 8,
        "deck.xml:1: not well-formed XML: Start tag expected, '<' not found",
    ),
    whole(
        "truncated file",
        BASE[: BASE.index(SECTION)],
        "deck.xml:18: not well-formed XML: Premature end of data in tag ParameterList line 16",
    ),
    whole(
        "no XML",
        "Title = A beam\n",
        "deck.xml:1: not well-formed XML: Start tag expected, '<' not found",
    ),
    whole(
        "nesting of 20 000 lists",
        '<ParameterList name="culm">\n' * 20000 + "</ParameterList>\n" * 20000,
        "deck.xml:65: lists are nested deeper than 64 levels",
    ),
    whole(
        "DOCTYPE with an external entity",
        '<?xml version="1.0"?>\n<!DOCTYPE culm [<!ENTITY f SYSTEM "/etc/passwd">]>\n'
        '<ParameterList name="culm">&f;</ParameterList>\n',
        "deck.xml:2: " + DOCTYPE,
    ),
    whole(
        "entities that multiply",
        '<!DOCTYPE culm [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]>\n'
        '<ParameterList name="&b;"/>\n',
        "deck.xml:1: " + DOCTYPE,
    ),
    whole(
        "unknown entity",
        '<ParameterList name="culm">\n  <Parameter name="Title" value="&nbsp;"/>\n'
        "</ParameterList>\n",
        "deck.xml:2: not well-formed XML: Entity 'nbsp' not defined",
    ),
    included(
        "missing include",
        "deck.xml:34: cannot read the included file 'loads.xml': there is no such file",
    ),
    included(
        "missing include that holds something required",
        "deck.xml:44: cannot read the included file 'analyses.xml': there is no such file",
        old=list_of("Analyses"),
        new='<xi:include href="analyses.xml"/>',
    ),
    included(
        "cyclic include",
        "again.xml:2: Loads: 'loads.xml' includes itself: deck.xml → loads.xml → again.xml → "
        "loads.xml",
        loads='<ParameterList name="Loads">\n  <xi:include href="again.xml"/>\n</ParameterList>',
        again='<ParameterList name="Loads">\n  <xi:include href="loads.xml"/>\n</ParameterList>',
    ),
    included(
        "mistake in an included file",
        "loads.xml:4: Loads / tip force / Node: unknown node 'beam/lst' – did you mean "
        "'beam/last'?",
        loads=LOADS.replace("beam/last", "beam/lst"),
    ),
    included(
        "truncated include",
        "loads.xml:2: not well-formed XML: Premature end of data in tag ParameterList line 2",
        loads='<ParameterList name="Loads">\n  <ParameterList name="tip force">',
    ),
]

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
EQUATIONS = [
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
    EQUATIONS += [
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
EQUATIONS += [
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
EQUATIONS += [
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
    EQUATIONS += [
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


EQUATIONS.append(
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

COMMANDS = [
    usage("no verb", "", "A subcommand is required"),
    usage("unknown verb", "chekc deck.xml", "unknown command 'chekc' – did you mean 'check'?"),
    usage("no deck named", "run", "deck is required"),
    usage("unknown option", "run deck.xml --frob", "unknown option '--frob' (allowed: --help, --set"),
    wrong(
        "distance to nothing",
        TIP + WATCH,
        "@@" + TIP + 'value="Distance"/>\n        <Parameter name="Node" value="beam/last"/>',
        "Output / History / tip: needs either 'To' or 'Structure'",
    ),
    wrong(
        "section loads beyond the end",
        WATCH,
        'value="Section Loads"/>\n        <Parameter name="Structure" value="beam"/>'
        '\n        @@<Parameter name="Station" value="1.5"/>',
        "Output / History / tip / Station: must be between 0 and 1, got 1.5",
    ),
    usage("empty name of a folder", "run deck.xml --output ''", "--output: needs a path, got ''"),
    usage("empty name of a file", "check deck.xml --resolved ''", "--resolved: needs a path, got ''"),
    usage("misspelt option", "run deck.xml --stirct", "unknown option '--stirct' – did you mean '--strict'?"),
    usage(
        "misspelt option with a value, and no deck",
        "run --outptu=here",
        "unknown option '--outptu' – did you mean '--output'?",
    ),
    usage(
        "misspelt option of a verb in Python",
        "report out --quite",
        "unknown option '--quite' – did you mean '--quiet'?",
    ),
    usage("a word too many for a verb in Python", "report out more", "'more' is one word too many"),
    usage("two decks", "run deck.xml deck2.xml", "deck2.xml"),
    usage("--output without a folder", "run deck.xml --output", "--output"),
    usage(
        "--set without a value",
        "run deck.xml --output out --set Title",
        "--set needs 'List/Parameter=value', got 'Title'",
        ranks=True,
    ),
    usage(
        "--set with an empty name",
        "run deck.xml --output out --set Analyses//Steps=3",
        "--set has an empty name in 'Analyses//Steps=3'",
    ),
    usage(
        "reference of an unknown name",
        "reference Tub",
        "the input reference has no 'Tub' – did you mean 'Tube'?",
    ),
    usage(
        "title that is no UTF-8",
        "run deck.xml --output out --set 'Title=a\udcff'",
        "--set is no valid UTF-8 in 'Title=a\\xff'\n",
        ranks=True,
    ),
    usage(
        "memory without a unit",
        "run deck.xml --output out --max-memory 16",
        "--max-memory needs a size such as '500 MB' or '16 GB', got '16'\n",
    ),
    usage("unknown verb on several processes", "chekc", "unknown command 'chekc'", ranks=True),
]


def keeps_what_it_had(folder, _):
    """The steps until the disk was full are in the index, and their pictures are there."""
    steps = re.findall(r'file="(.*?)"', (folder / "out/run.pvd").read_text())
    lost = [name for name in steps if not (folder / "out" / name).is_file()]
    if lost or len(steps) < 10:
        return f"{len(steps)} steps, without picture: {lost}"
    return "" if (folder / "out/run.h5").stat().st_size > 100_000 else "run.h5 is too small"


LOCKS = []  # files that stay open, and locked, as long as this program runs


def lock(folder):
    """Somebody else owns the folder `out`."""
    (folder / "out").mkdir()
    LOCKS.append(open(folder / "out/run.lock", "w"))
    fcntl.flock(LOCKS[-1], fcntl.LOCK_EX)
    LOCKS[-1].write("process 4711 on elsewhere\n")
    LOCKS[-1].flush()


def is_as_it_was(folder, _):
    same = (folder / "deck.xml").read_text() == BASE
    return "" if same else "the deck was written over"


OWNED = "another run writes here: process 4711 on elsewhere; wait for its end, or take another folder"


def overwritten(name, args, error, **more):
    return Case(name, 6, args=args, errors=[error], check=is_as_it_was, **more)


WRITING = [
    Case(
        "folder that another run writes into",
        6,
        prepare=lock,
        errors=["out: " + OWNED],
        args="run deck.xml --output out --report",
        ranks=True,
    ),
    overwritten(
        "resolved deck over the deck",
        "check deck.xml --resolved deck.xml",
        "deck.xml: is read by the deck and would be overwritten; write elsewhere",
        ranks=True,
    ),
    overwritten(
        "resolved deck over the deck by a link",
        "check deck.xml --resolved link.xml",
        "link.xml: is read by the deck, as deck.xml, and would be overwritten; write elsewhere",
        prepare=lambda folder: (folder / "link.xml").symlink_to("deck.xml"),
    ),
    overwritten(
        "resolved deck over the deck by another name",
        "check deck.xml --resolved other.xml",
        "other.xml: is read by the deck, as deck.xml, and would be overwritten; write elsewhere",
        prepare=lambda folder: (folder / "other.xml").hardlink_to(folder / "deck.xml"),
    ),
    Case(
        "resolved deck over an include",
        6,
        change=[(LOADS, INCLUDE)],
        files={"loads.xml": LOADS},
        args="check deck.xml --resolved ./loads.xml",
        errors=[
            "./loads.xml: is read by the deck, as loads.xml, and would be overwritten; write elsewhere"
        ],
    ),
    Case(
        "resolved deck where a file of an include is another one",
        6,
        change=[(LOADS, INCLUDE.replace("loads.xml", "parts/functions.xml") + LOADS)],
        files={
            "parts/functions.xml": function_file("rise.csv").replace("@@", ""),
            "parts/rise.csv": "0, 0\n1, 1\n",
            "rise.csv": "0, 0\n1, 2\n",
        },
        args="check deck.xml --resolved resolved.xml",
        errors=["rise.csv: would be read in place of parts/rise.csv, which parts/functions.xml:..."],
    ),
    Case(
        "results over a table",
        6,
        change=[(LOADS, function_file("history.csv") + LOADS)],
        files={"history.csv": "0, 0\n1, 1\n"},
        args="run deck.xml --output .",
        errors=[
            "./history.csv: is read by the deck, as history.csv, and would be overwritten; "
            "write elsewhere"
        ],
        ranks=True,
    ),
    unwritable(
        "output folder with a name too long for files",
        "a: File name too long",
        "run deck.xml --output " + "a" * 300,
    ),
    unwritable(
        "output folder below a file",
        "deck.xml/out: Not a directory",
        "run deck.xml --output deck.xml/out",
        ranks=True,
    ),
    unwritable("output folder is a file", "deck.xml: ", "run deck.xml --output deck.xml"),
    unwritable(
        "folder in the place of run.h5",
        "out/run.h5: cannot replace: Is a directory",
        prepare=lambda folder: (folder / "out/run.h5").mkdir(parents=True),
        ranks=True,
    ),
    unwritable(
        "no space at the start",
        "out/run.h5.part: cannot write file: write: File too large\n",
        file_size=4096,
        leaves=["out"],
    ),
    unwritable(
        "no space in the middle",
        "out/run.h5: cannot write file: write: File too large\n",
        "run deck.xml --output out --set Analyses/bend/Steps=100 --quiet",
        file_size=200_000,
        leaves=["out"],
        never=["warning", "internal error"],
        check=keeps_what_it_had,
    ),
]

CASES = NAMES + VALUES + STRUCTURE + MECHANICS + FILES + EQUATIONS + COMMANDS + WRITING
