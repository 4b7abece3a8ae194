"""Types, constants, materials and sections of ANSYS, as commands give them."""

from .ansys_file import is_tag, whole
from .findings import refuse
from .keyword_file import is_integer, number

TABLES = {"BISO", "MISO", "BKIN", "KINH", "MKIN", "NLISO", "CHAB", "HYPE", "ANEL", "PLAS", "CREE", "PRON", "VISC", "AHYPER"}


def read_type(reader, command):
    text = command.text(2).upper()
    digits = "".join(c for c in text if c in "0123456789")
    reader.types[command.integer(1)] = whole(digits, command.place, "the type of elements")
    for i in range(3, 9):
        if is_integer(command.text(i)):
            reader.keys[(command.integer(1), i - 2)] = command.integer(i)


def read_type_block(reader, command):
    for place, cells in command.rows:
        if len(cells) < 2:
            refuse(place, "expected number and type of elements")
        reader.types[whole(cells[0], place, "a number")] = whole(cells[1], place, "the type of elements")


def read_key(reader, command):
    if is_integer(command.text(1)) and is_integer(command.text(3)):
        reader.keys[(command.integer(1), command.integer(2))] = command.integer(3)


def read_constants(reader, command):
    reader.constants[command.integer(1)] = [command.real(i, default=0.0) for i in range(2, len(command.fields) + 1)]


def read_constants_block(reader, command):
    for place, cells in command.rows:
        reader.constants[whole(cells[0], place, "a number")] = [number(cell, place) for cell in cells[2:] if cell]


def read_property(reader, command):
    _add_property(reader, command.text(1), command.integer(2), command.real(3), command)


def read_property_data(reader, command):
    """MPDATA,R5.0,count,label,material,place,value, where new files have UNBL"""
    first = 1 if is_tag(command.text(1)) else 0
    if command.integer(first + 1) > 1 or command.integer(first + 4) > 1:
        reader.findings.assume("of properties by temperature the first stand", command.place)
    if command.integer(first + 4) == 1:
        _add_property(reader, command.text(first + 2), command.integer(first + 3), command.real(first + 5), command)


def delete_property(reader, command):
    """MPDELE,label,material: of one material, or all of it."""
    label, name = command.text(1).upper(), command.text(2).upper()
    if any(command.text(i) for i in range(3, 6)) or not (is_integer(name) or name in ("ALL", "")):
        refuse(command.place, f"MPDELE with '{','.join(command.fields)[:40]}': one material or all are read")
    for material in [int(name)] if is_integer(name) else list(reader.materials):
        for one in [label] if label != "ALL" else list(reader.materials[material]):
            reader.materials[material].pop(one, None)


def _add_property(reader, label, material, value, command):
    reader.materials[material][label.upper()] = value
    reader.material_places.setdefault(material, command.place)


def read_table(reader, command):
    if command.text(1).upper()[:4] in TABLES:
        reader.findings.leave_out(f"TB,{command.text(1).upper()}: materials are linear", command.place)
    elif command.text(1).upper()[:4] in ("ELAS", "DENS"):
        refuse(command.place, f"TB,{command.text(1).upper()} is not read: moduli and densities are, by MP and MPDATA")
    else:
        reader.findings.leave_out(f"TB,{command.text(1).upper()}", command.place)


def read_section_type(reader, command):
    reader.current = command.integer(1)
    reader.sections[reader.current] = (command.text(2).upper(), command.text(3).upper(), [], command.place)


def read_section_data(reader, command):
    if reader.current is None:
        refuse(command.place, "SECDATA without SECTYPE before it")
    reader.sections[reader.current][2].append((command.place, command.fields))


def read_section_block(reader, command):
    if reader.current is None:
        refuse(command.place, "SECBLOCK without SECTYPE before it")
    reader.sections[reader.current][2].extend(command.rows)


def read_section_offset(reader, command):
    if command.text(1).upper() not in ("MID", "CENT", "ORIG", ""):
        reader.findings.leave_out(f"SECOFFSET,{command.text(1).upper()}: the nodes are in the middle", command.place)
