"""Where run.h5 keeps the numbers of a structure in each state: rows of tables that all structures share."""


def read_field(step, structure, field):
    """Rows of a field of a structure in a state; None if it has no such field.

    step       group of the state, such as file["steps/000005"]
    structure  group of the structure, such as file["mesh/mast"]
    """
    fields = [_text(name) for name in structure.attrs["fields"]]
    if field not in fields:
        return None
    at = fields.index(field)
    first, end = structure["field_rows"][2 * at : 2 * at + 2]
    return step[_text(structure.attrs["tables"][at])][first:end]


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
