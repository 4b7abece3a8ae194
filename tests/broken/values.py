"""Values that are no value of their kind."""

from broken.pieces import EI1, FORCE, LOADS, list_of, parameters, shell, whole, wrong
from driver import Case


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


CASES = [
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
            "model needs about 1.9 TB (elements 1.44 TB, factors 461 GB) of memory and 16 GB are allowed: take fewer elements, or "
            "allow more with --max-memory"
        ],
    ),
    Case(
        "more elements than the option allows",
        3,
        args="check deck.xml --max-memory 20kB",
        change=[('<ParameterList name="Curve">', '@@<ParameterList name="Curve">')],
        errors=[
            "deck.xml:{line}: Structures / beam / Curve: asks for 4 elements, with which the model "
            "needs about 0.0248 MB (elements 0.0188 MB, factors 0.006 MB) of memory and 0.02 MB are allowed: take fewer elements, or allow "
            "more with --max-memory"
        ],
    ),
    whole(
        "shell of 65536 x 65536 elements",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{65536, 65536}")),
        "deck.xml:{line}: Structures / wall / Mesh: asks for 4294967296 elements, with which the "
        "model needs about 86.3 TB (elements 55.8 TB, factors 30.5 TB) of memory and 8 GB are allowed: "
        "take fewer elements, or allow more with --max-memory",
        args="run deck.xml --output out --max-memory 8GB",
    ),
    whole(
        "elements fit, but not their factors",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{500, 500}")),
        "deck.xml:{line}: Structures / wall / Mesh: asks for 250000 elements, with which the "
        "model needs about 10.4 GB (elements 3.25 GB, factors 7.16 GB) of memory and 6 GB are allowed: "
        "take fewer elements, or allow more with --max-memory",
        args="run deck.xml --output out --max-memory 6GB --set 'Solver/Linear Solver=MUMPS'",
    ),
    whole(
        "layers repeated without end",
        shell(("Type", "Plane"), ("Side 1", "{1, 0, 0}"), ("Side 2", "{0, 1, 0}"), ("Elements", "{1, 1}"),
              wall='<Parameter name="Symmetric" value="All Layers"/>\n@@<Parameter name="Repeat" value="2147483647"/>'),
        "deck.xml:{line}: Structures / wall / Repeat: makes 4294967294 layers, at most 100000 are possible",
    ),
]
