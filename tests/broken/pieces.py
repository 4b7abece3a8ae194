"""Pieces of base.xml, what to put in their place, and kinds of cases."""

import re

from driver import BASE, Case


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
EI1 = 'name="EI1" value="3e3"'
CURVE = list_of("Curve")
INCLUDE = '<xi:include href="loads.xml"/>'
LOADS = list_of("Loads")


def function_file(name):
    return (
        '<ParameterList name="Functions">'
        + parameters("gust", ("Type", "File"), ("@@File Name", name))
        + "</ParameterList>\n"
    )


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
