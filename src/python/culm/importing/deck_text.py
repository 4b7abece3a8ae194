"""The text of a deck: lists and parameters with comments, in the order they are given."""

import re
from xml.sax.saxutils import escape

import numpy

WIDTH = 110  # columns, where arrays are broken


class List:
    """A list of a deck."""

    def __init__(self, name, comment=None):
        self.name = name
        self.comment = comment
        self.items = []

    def add(self, name, value, unit=None, comment=None):
        """A parameter: a text, a flag, a number, or a sequence of numbers or texts."""
        self.items.append((name, value_text(value), unit, comment))
        return self

    def list(self, name, comment=None, type=None):
        """A list in this one."""
        child = List(name, comment)
        if type is not None:
            child.add("Type", type)
        self.items.append(child)
        return child

    def lists(self):
        return [item for item in self.items if isinstance(item, List)]

    def render(self, depth=0):
        pad = "  " * depth
        lines = []
        if self.comment:
            lines += [f"{pad}<!-- {line} -->" for line in _comment(self.comment).splitlines()]
        lines.append(f"{pad}<ParameterList name={_quoted(self.name)}>")
        for item in self.items:
            if isinstance(item, List):
                if item.items:
                    lines += item.render(depth + 1)
            else:
                lines.append(_parameter(pad + "  ", *item))
        lines.append(f"{pad}</ParameterList>")
        return lines


def render(root):
    """The deck, whose root is a list 'culm'."""
    return "\n".join(root.render()) + "\n"


def value_text(value):
    """How a value stands in a deck; numbers so that they read back the same."""
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)):
        return number_text(value)
    return "{" + ", ".join(_item_text(item) for item in value) + "}"


def number_text(value):
    """The shortest text that reads back as the number."""
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def safe_name(text):
    """A name of a file as a name of a deck: without the characters that mean something there."""
    clean = re.sub(r"[/@,{}\"'<>&\\\s]+", " ", str(text)).strip()
    return clean or "unnamed"


def unique_name(text, taken):
    """A safe name that is not taken, by adding a number."""
    name = safe_name(text)
    taken = {other.lower() for other in taken}
    number = 2
    while name.lower() in taken:
        name = f"{safe_name(text)} {number}"
        number += 1
    return name


def _item_text(item):
    if isinstance(item, str) and (re.search(r"[,{}]", item) or item != item.strip()):
        return f'"{item}"'
    return value_text(item)


def _quoted(text):
    return '"' + escape(text, {'"': "&quot;"}) + '"'


def _comment(text):
    """A comment may not hold two hyphens, nor end with one."""
    printable = "".join(c if c.isprintable() or c == "\n" else "?" for c in str(text))
    return re.sub(r"--+", lambda found: "–" * len(found[0]), printable).rstrip("-")


def _parameter(pad, name, text, unit, comment):
    unit_text = f" unit={_quoted(unit)}" if unit else ""
    line = f"{pad}<Parameter name={_quoted(name)} value={_quoted(_wrapped(text, pad))}{unit_text}/>"
    return f"{line}  <!-- {_comment(comment)} -->" if comment else line


def _wrapped(text, pad):
    """Long arrays go over several lines."""
    if len(text) <= WIDTH or not text.startswith("{"):
        return text
    lines, current = [], ""
    for word in re.findall(r'(?:"[^"]*"|[^,])+,?\s*', text):
        if len(current) + len(word) > WIDTH:
            lines.append(current.rstrip())
            current = pad + "    "
        current += word
    return "\n".join([*lines, current])
