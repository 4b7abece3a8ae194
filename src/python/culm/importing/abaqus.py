"""Models of Abaqus and CalculiX: flat files, and parts with instances."""

from .abaqus_elements import hold_in_plane
from .abaqus_mesh import read_mesh_block
from .abaqus_properties import read_property_block, resolve_sections
from .abaqus_steps import finish_steps, read_step_block
from .findings import did_you_mean, refuse
from .keyword_file import is_integer, read_blocks
from .model import Model

FILE = "input file, .inp"

# What says nothing about the mechanics: output, names, numbers of the solution.
SILENT = {
    "HEADING", "PREPRINT", "PRE PRINT", "PRINT", "RESTART", "OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT",
    "ENERGY OUTPUT", "NODE PRINT", "EL PRINT", "NODE FILE", "EL FILE", "FILE FORMAT", "MONITOR",
    "END PART", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY", "CONTROLS", "SECTION PRINT", "SECTION FILE",
    "MODAL FILE", "PHYSICAL CONSTANTS", "USER MATERIAL OUTPUT", "PARAMETER", "CONTACT FILE", "CONTACT PRINT",
    "ENERGY PRINT", "ENERGY FILE", "MODEL CHANGE OUTPUT", "FILTER", "TIME POINTS", "HOURGLASS STIFFNESS",
    "DEPVAR", "EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "SOLUTION TECHNIQUE", "DIAGNOSTICS",
    "INTEGRATED OUTPUT", "INTEGRATED OUTPUT SECTION", "OUTPUT VARIABLE", "SECTION CONTROLS",
}  # fmt: skip
WITHOUT_DATA = {"END STEP", "MATERIAL", "ASSEMBLY", "END ASSEMBLY", "COUPLING"}
# What makes the mesh, or loads that exclude each other, in a way that is not read: without it the deck would be another model.
MESHING = {
    "NCOPY", "NMAP", "ELCOPY", "SYSTEM", "SUBSTRUCTURE PROPERTY", "UEL PROPERTY", "USER ELEMENT",
    "SOLID SECTION", "MEMBRANE SECTION", "SPRING", "DASHPOT", "CONNECTOR SECTION",
    "TRUSS SECTION", "NODAL THICKNESS", "SUBMODEL", "RELEASE", "PRE-TENSION SECTION", "GAP", "EQUATION", "TIE", "EMBEDDED ELEMENT",
    "LOAD CASE", "KINEMATIC COUPLING", "DISTRIBUTING COUPLING", "SHELL TO SOLID COUPLING", "CYCLIC SYMMETRY MODEL", "IMPORT",
}  # fmt: skip

FILES = {"INPUT", "FILE"}
# Parameters that say how a program computes or names, not what.
HARMLESS = {
    "NAME", "INC", "AMPLITUDE", "UNSYMM", "EXTRAPOLATION", "SOLVER", "CONVERT SDI", "DIRECT", "EIGENSOLVER", "NORMALIZATION",
    "STORAGE", "GLOBAL", "ACOUSTIC COUPLING", "ACCURACY", "POISSON", "TEMPERATURE", "SECTION INTEGRATION", "STACK DIRECTION",
    "CONTROLS", "LAYUP", "SYMMETRIC", "INTERNAL", "UNSORTED", "REGION TYPE", "CONSTRAINT NAME", "FREQUENCY", "TOTALS",
    "DEPENDENCIES", "RESIDUAL MODES", "SIM", "PROPERTY EVALUATION", "NSET", "ELSET", "TRIM", "TIME RESET", "TOTAL TIME AT START",
    "SUMMARY", "GENERATE", "ISOTHERMAL", "ALLSDI", "REBAR", "COMBINE", "INFLUENCE",
}  # fmt: skip


def read(path, arguments):
    """@return the Model of an input file"""
    del arguments
    return read_dialect(path, "Abaqus")


def read_dialect(path, program):
    """@param program  whose file it is, Abaqus or CalculiX, where one word means two things"""
    reader = Reader(path, program)
    reader.read(read_blocks(path))
    return reader.model


class Reader:
    """What is known while blocks are read, one after the other.

    @param prefix  of names and numbers in the instance that is read; empty outside"""

    def __init__(self, path, program):
        self.path = path
        self.program = program
        self.model = Model(title=path.stem)
        self.findings = self.model.findings
        self.prefix = ""
        self.transform = None
        self.element_sets = {}  # upper-case name -> numbers
        self.elements = {}  # number -> its type and nodes
        self.direction_nodes = {}  # beam element -> the node that its first axis points to
        self.surfaces = {}
        self.orientations = {}
        self.axes = {}  # node -> rows of *TRANSFORM
        self.undirected = {}  # node on the axis of its cylindrical system -> place of that
        self.assignments = []  # sections of elements, resolved at the end
        self.material = None  # the one whose properties are read
        self.coupling = None
        self.step = None
        self.step_count = 0  # of the whole file
        self.known = []  # blocks that were understood

    def read(self, blocks):
        parts, part = {}, None
        self.step_count = sum(block.keyword == "STEP" for block in blocks)
        for block in blocks:
            if block.keyword == "PART":
                part = parts.setdefault(block.required("NAME"), [])
            elif block.keyword == "END PART":
                part = None
            elif part is not None:
                part.append(block)
            elif block.keyword == "INSTANCE":
                self._instance(block, parts)
            elif block.keyword == "END INSTANCE":
                self._end_instance()
            else:
                self._block(block)
        if not self.elements:
            refuse(blocks[0].place if blocks else self.path, "the file has no elements")
        resolve_sections(self)
        hold_in_plane(self)
        finish_steps(self)
        self._tell_unread()

    def _instance(self, block, parts):
        name = block.required("NAME")
        part = block.required("PART")
        if part not in parts:
            refuse(block.place, f"there is no part '{part}'{did_you_mean(part, parts)}")
        self.prefix = f"{name}."
        self.transform = [[cell for cell in cells] for _, cells in block.lines], block.place
        for one in parts[part]:
            self._block(one)

    def _end_instance(self):
        self.prefix, self.transform = "", None

    def _block(self, block):
        if block.keyword in WITHOUT_DATA and block.lines:
            place, cells = block.lines[0]
            refuse(place, f"*{block.keyword} has no data, but here is '{', '.join(cells)[:40]}'")
        if block.keyword == "HEADING" and block.lines:
            self.model.title = ", ".join(block.lines[0][1]).strip() or self.model.title
        if read_mesh_block(self, block) or read_property_block(self, block) or read_step_block(self, block):
            self.known.append(block)
            return
        if block.keyword == "SYSTEM" and not block.lines:  # back to the axes of space, where nodes are anyway
            return
        if block.keyword == "RESTART" and block.has("READ"):
            refuse(block.place, "*RESTART with READ goes on from another job, which is not read")
        if block.keyword in MESHING:
            refuse(block.place, f"*{block.keyword} is not read, and without it the model would be another one")
        if block.keyword not in SILENT:
            self.findings.leave_out(f"*{block.keyword}", block.place)

    def _tell_unread(self):
        """Parameters that nobody asked for, of blocks that were read."""
        for block in self.known:
            for name in block.unread():
                if name in FILES:
                    refuse(block.place, f"*{block.keyword} with {name}: data in a file of its own are not read; *INCLUDE is")
                if name not in HARMLESS:
                    self.findings.leave_out(f"{name} of *{block.keyword}", block.place)

    # names of the file

    def key(self, number):
        """Of a node or element in the instance that is read."""
        return (self.prefix[:-1], number) if self.prefix else number

    def find(self, text, numbers, sets, place, what):
        """Numbers that a cell names: one by its number, or those of a set, which alone may stand in quotes."""
        is_quoted = text.strip().startswith('"')
        name = text.strip().strip('"').upper()
        for candidate in (self.prefix + name, name):
            instance, _, last = candidate.rpartition(".")
            if is_integer(last) and not is_quoted:
                key = (instance, int(last)) if instance else int(last)
                if key in numbers:
                    return [key]
            if candidate in sets:
                return sets[candidate]
        known = list(sets) or list(numbers)[:100]
        refuse(place, f"there is no {what} '{text.strip()[:40]}'{did_you_mean(name, known)}")

    def find_nodes(self, text, place):
        return self.find(text, self.model.nodes, self.model.node_sets, place, "node or node set")

    def find_elements(self, text, place):
        return self.find(text, self.elements, self.element_sets, place, "element or element set")
