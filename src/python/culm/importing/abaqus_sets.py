"""Sets of nodes and elements of Abaqus and CalculiX."""

from .findings import refuse
from .keyword_file import integer


def add_to_set(sets, reader, name, numbers):
    """What is in it already, or given twice, is there once."""
    if name:
        members = sets.setdefault(reader.prefix + name, [])
        known = set(members)
        members += [one for one in dict.fromkeys(numbers) if one not in known]


def _node_set(reader, block):
    _set(reader, block, block.required("NSET"), reader.model.node_sets, reader.find_nodes, reader.model.nodes)


def _element_set(reader, block):
    _set(reader, block, block.required("ELSET"), reader.element_sets, reader.find_elements, reader.elements)


def _set(reader, block, name, sets, find, existing):
    instance = block.get("INSTANCE")
    before, prefix = reader.prefix, (f"{instance}." if instance else reader.prefix)
    found = []
    reader.prefix = prefix
    for place, cells in block.lines:
        cells = [cell for cell in cells if cell]
        if block.has("GENERATE"):
            values = [integer(cell, place) for cell in cells]
            if len(values) not in (2, 3) or (len(values) == 3 and values[2] <= 0):
                refuse(place, "expected first, last and step of the numbers")
            step = values[2] if len(values) == 3 else 1
            if (values[1] - values[0]) // step > 10**7:
                refuse(place, "more than 1e7 numbers")
            keys = [reader.key(i) for i in range(values[0], values[1] + 1, step)]
            found += [key for key in keys if key in existing]
        else:
            for cell in cells:
                found += find(cell, place)
    if block.keyword == "NSET" and block.get("ELSET"):
        members = reader.find_elements(block.get("ELSET"), block.place)
        found += [node for key in members for node in reader.elements[key][1]]
    reader.prefix = before  # a set of an instance that the assembly names is one of the assembly
    add_to_set(sets, reader, name, found)
    if not found:
        reader.findings.assume(f"the set {name} is empty", block.place)


BLOCKS = {
    "NSET": _node_set,
    "ELSET": _element_set,
}
