"""Decks that are no deck: XML, lists, what they lack."""

from broken.pieces import CLAMP, FORCE, LOADS, SECTION, STEPS, list_of, missing, wrong
from driver import Case

CASES = [
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
