"""Models of ANSYS, archives of CDWRITE (.cdb): shells, beams, point masses, supports and loads."""

import collections

import numpy

from .ansys_analysis import read_count, read_kind, read_large, read_prestress, read_solution, read_title
from .ansys_elements import make_elements
from .ansys_file import read_commands
from .ansys_loads import make_loads, read_force, read_gravity, read_pressure, read_support
from .ansys_nodes import (
    modify_element,
    read_active,
    read_component,
    read_element,
    read_elements,
    read_node,
    read_nodes,
    read_system,
    select_component,
    select_nodes,
    select_others,
)
from .ansys_properties import make_materials
from .ansys_tables import (
    delete_property,
    read_constants,
    read_constants_block,
    read_key,
    read_property,
    read_property_data,
    read_section_block,
    read_section_data,
    read_section_offset,
    read_section_type,
    read_table,
    read_type,
    read_type_block,
)
from .model import Model

FILE = "archive, .cdb"
# What says nothing about the model: output, numbers of the solution, names, views, parameters.
SILENT = {
    "*DIM", "*ELSE", "*ENDIF", "*GET", "*IF", "*PREAD", "*SET", "END PREAD", "/BATCH", "/COM", "/CONFIG", "/EOF", "/GO", "/GOLIST",
    "/GOPR", "/GST", "/NOLIST", "/NOPR", "/POST1", "/PREP7", "/SOLU", "/UNITS", "/WB", "/XML", "/NERR", "/VIEW", "/ANG", "/CLEAR",
    "AUTOTS", "CDWRITE", "CEWRITE", "CM", "CNTR", "CNVTOL", "DMPOPT", "DMPOPTION", "DOF", "EMUNIT", "EQSL", "EQSLV", "ERESX",
    "ETCON", "EXTOPT", "FINI", "FINISH", "KBC", "KUSE", "LUMPM", "MAT", "MODCONTROL", "MPTEMP", "MXPAND", "NCNV", "NEQIT",
    "NLDIAG", "NSUB", "NSUBST", "NUMOFF", "OUTRES", "QRDOPT", "REAL", "RESCONTROL", "SECNUM", "SHPP", "STEF",
    "TBDATA", "TBTEMP", "THOPT", "TIME", "TIMINT", "TINTP", "TOFFST", "TREF", "TSHAPE", "TYPE", "XMLO", "TBDELE",
    "RESUME", "SAVE", "ESYS", "LSCLEAR", "PRED", "ARCLEN", "MPAMOD", "CHECK", "WAVES", "NLIST",
    "CRPLIM", "TRNOPT", "RATE", "UIMP", "BUCOPT",
}  # fmt: skip
# What does nothing with zeros; and words that stand beside them, where Workbench calls a very small number _TINY.
ZERO = {
    "OMEGA", "DOMEGA", "CGLOC", "CGOMEGA", "CGOMG", "DCGOMG", "ALPHAD", "BETAD", "DMPRAT", "DMPSTR", "SECCONTROL", "SECCONTROLS",
    "STABILIZE", "IRLF", "BFUNIF",
}  # fmt: skip
NO_NUMBERS = ("ALL", "NONE", "TEMP", "_TINY")
ACTIONS = {
    "NBLOCK": read_nodes, "N": read_node, "EBLOCK": read_elements, "EN": read_element, "ET": read_type, "ETBLOCK": read_type_block,
    "KEYOPT": read_key, "KEYOP": read_key, "KEYO": read_key, "R": read_constants, "RLBLOCK": read_constants_block, "MP": read_property,
    "MPDATA": read_property_data, "MPDELE": delete_property, "SECTYPE": read_section_type, "SECDATA": read_section_data,
    "SECBLOCK": read_section_block, "SECOFFSET": read_section_offset, "SECOFF": read_section_offset,
    "LOCAL": read_system, "CSYS": read_active, "D": read_support, "F": read_force, "SFE": read_pressure, "ACEL": read_gravity,
    "ANTYPE": read_kind, "NLGEOM": read_large, "PSTRES": read_prestress, "MODOPT": read_count, "BUCOPT": read_count,
    "/TITLE": read_title, "TB": read_table, "CMBLOCK": read_component, "CMSEL": select_component,
    "SOLVE": read_solution, "LSWRITE": read_solution,
    "NSEL": select_nodes, "ALLSEL": select_nodes, **dict.fromkeys(("NSLE", "NSLK", "NSLL", "NSLA", "NSLV"), select_others),
    "EMOD": modify_element, "EMODIF": modify_element,
}  # fmt: skip
# Commands whose values are told if they are not read.
BY_VALUE = {"MP", "ET", "SECOFFSET", "SECOFF", "ANTYPE"}


def read(path, arguments):
    """@return the Model of an archive"""
    del arguments
    return Reader(path).read()


class Reader:
    def __init__(self, path):
        self.path = path
        self.model = Model(title=path.stem)
        self.findings = self.model.findings
        self.commands, is_closed = read_commands(path)
        if not is_closed:
            self.findings.assume("the file has no FINISH: it is taken as whole")
            self.findings.look_at_end(path)
        self.types, self.keys = {}, {}
        self.constants = {}
        self.materials = collections.defaultdict(dict)
        self.material_places = {}
        self.sections = {}
        self.systems = {0: numpy.eye(3)}
        self.curved = set()  # systems that are not Cartesian
        self.active = "0"  # the system in which N counts
        self.axes = {}  # rows of the systems of nodes that are turned
        self.current = None  # the section that SECDATA adds to
        self.components = {}  # name -> nodes or elements
        self.selected = None  # nodes that ALL means; None for all, the command where they are not known
        self.beam_places = {}  # number of a beam element -> its place in the model
        self.elements = []  # [number, material, type, real, section, system, nodes, place]
        self.supports = collections.defaultdict(dict)
        self.forces = collections.defaultdict(lambda: numpy.zeros(6))
        self.places = {}
        self.pressures = {}  # (element, face) -> the command that stands
        self.gravity = numpy.zeros(3)
        self.kind, self.modes, self.nonlinear = None, 10, False
        self.prestress = None  # the command PSTRES,ON
        self.solutions = 0  # SOLVE, or LSWRITE
        self.kind_place = self.commands[0].place if self.commands else None

    def read(self):
        for command in self.commands:
            if command.name in ACTIONS:
                ACTIONS[command.name](self, command)
                self._tell_unread(command)
            elif not self._is_silent(command):
                self.findings.leave_out(f"the command {command.name[:20]}", command.place)
        make_materials(self)
        make_elements(self)
        make_loads(self)
        return self.model

    def _tell_unread(self, command):
        """Values that nobody asked for, of commands that are read value by value."""
        if command.name in BY_VALUE:
            for i in command.unread():
                if command.text(i).strip("0.+-"):
                    self.findings.leave_out(f"field {i} of {command.name}", command.place)

    def _is_silent(self, command):
        """Whether a command says nothing about the model, or nothing but zeros."""
        if command.name in ZERO or command.name == "ESEL":
            # of a shell's SECCONTROL, shear stiffnesses and mass; then factors against hourglasses, which culm's elements do not have
            cells = command.fields[:4] if command.name.startswith("SECCONTROL") else command.fields
            return not any(cell.strip("0.+- ") for cell in cells if cell.upper() not in NO_NUMBERS)
        return command.name in SILENT or "=" in command.name
