"""Names that a deck must not have, or has not."""

from broken.pieces import (
    ANALYSIS,
    FORCE,
    LOADS,
    TIP,
    TIP_LOAD,
    WATCH,
    WATCH_ELEMENT,
    line_load,
    parameters,
    wrong,
)
from driver import Case

CASES = [
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
        "Node Sets / beam/last: a name must not contain '/', which stands between the names of a path",
        ranks=True,
    ),
    wrong(
        "element set named like a point of a beam",
        LOADS,
        '<ParameterList name="Element Sets">\n'
        + parameters("@@beam@0.5", ("Structure", "beam"), ("Range", "{0, 1}"))
        + "</ParameterList>\n"
        + LOADS,
        "Element Sets / beam@0.5: names that begin with 'beam@' stand for parts of the structure "
        "'beam'",
    ),
    wrong(
        "structure with a slash in its name",
        '<ParameterList name="beam">',
        '@@<ParameterList name="be/am">',
        "Structures / be/am: a name must not contain '/', which stands between the names of a path",
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
