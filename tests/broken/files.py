"""Files, variables and functions of decks."""

import os

from broken.pieces import LOADS, SECTION, STEPS, function_file, included, list_of, parameters, shell, whole
from driver import BASE, Case


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

CASES = [
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
