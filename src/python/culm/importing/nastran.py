"""Models of Nastran: bulk data with case control, SOL 101, 103, 105 and 106."""

import collections

from .findings import did_you_mean, refuse
from .model import Model
from .nastran_elements import SHELLS, read_beams, read_couplings, read_masses, read_shells
from .nastran_file import read_deck
from .nastran_nodes import read_nodes, read_systems
from .nastran_properties import read_materials, read_properties
from .nastran_steps import read_steps

FILE = "input file, .bdf, .dat or .nas"
SILENT = {
    "PARAM", "EIGR", "EIGRL", "EIGB", "NLPARM", "TSTEPNL", "SET1", "ASET1", "ECHOON", "ECHOOFF", "DEBUG", "OMIT1",
    "CORD2R", "CORD2C", "CORD2S", "LOAD", "SPCADD", "MDLPRM",
}  # fmt: skip
# Without these the deck would be another structure.
STRUCTURE = {
    "CROD", "CONROD", "CTUBE", "CBEND", "CHEXA", "CPENTA", "CTETRA", "CPYRAM", "CSHEAR", "CBUSH", "CELAS1", "CELAS2",
    "CELAS3", "CELAS4", "RBAR", "RBE1", "MPC", "CQUADX", "CTRIAX", "CTRIAX6", "CBAR3", "CBEAM3", "CQUAD", "CGAP",
    "CBUSH1D", "CORD1R", "CORD1C", "CORD1S", "MAT2", "MAT9", "PCOMPG", "SPOINT", "CWELD", "CFAST",
}  # fmt: skip
# Fields that say nothing about the mechanics: names, points for stresses, temperatures, strengths.
HARMLESS = {
    "GRID": (8,),
    "GRDSET": (8,),
    "MAT1": range(6, 13),
    "MAT8": range(9, 20),
    "PBAR": range(9, 17),
    "PBARL": (3,),
    "PBEAML": (3,),
    "PBEAM": range(9, 17),
    "PSHELL": (9, 10),
    "PCOMP": (4, 5, 6, 7, *range(12, 1000, 4)),
}
READ = {
    "GRID", "GRDSET", "MAT1", "MAT8", "PSHELL", "PCOMP", "PBAR", "PBARL", "PBEAML", "PBEAM", "CBAR", "CBEAM", "CONM2", "RBE2", "RBE3",
    "SPC", "SPC1", "FORCE", "MOMENT", "PLOAD4", "PLOAD2", "PLOAD1", "GRAV", *SHELLS,
}  # fmt: skip


def read(path, arguments):
    """@return the Model of an input file"""
    del arguments
    return Reader(path).read()


class Reader:
    def __init__(self, path):
        self.path = path
        self.model = Model(title=path.stem)
        self.findings = self.model.findings
        self.deck = read_deck(path)
        if not self.deck.is_closed:
            self.findings.assume("the file has no ENDDATA: it is taken as whole")
            self.findings.look_at_end(path)
        self.by_name = collections.defaultdict(list)
        for card in self.deck.cards:
            self.by_name[card.name].append(card)
        self.masses_by = 1.0  # PARAM WTMASS
        self.offset_nodes = {}  # (node, offset) -> the end of a beam beside it

    def read(self):
        for name in self.by_name:
            if name in STRUCTURE:
                refuse(self.by_name[name][0].place, f"{name} is not read, and without it the model would be another one")
        self._parameters()
        read_systems(self)
        read_nodes(self)
        read_materials(self)
        read_properties(self)
        read_shells(self)
        read_beams(self)
        read_masses(self)
        read_couplings(self)
        if not self.model.shells and not self.model.beams:
            refuse(self.deck.cards[0].place if self.deck.cards else self.path, "the file has no shells and no beams")
        read_steps(self)
        for name in set(self.by_name) - READ - SILENT:
            for card in self.by_name[name]:
                self.findings.leave_out(name, card.place)
        self._tell_unread()
        return self.model

    def _tell_unread(self):
        """Fields that hold something and that nobody asked for, of cards that were read beyond their number."""
        for name in READ:
            harmless = HARMLESS.get(name, ())
            for card in self.by_name[name]:
                for i in card.unread() if card.asked - {1} else ():
                    if i != 1 and i not in harmless:
                        self.findings.leave_out(f"field {i} of {name}", card.place)

    def cards(self, *names):
        for name in names:
            if self.by_name[name]:
                self.findings.count(name, len(self.by_name[name]))
            yield from self.by_name[name]

    def unique(self, table, card, what):
        number = card.integer(1, f"the number of {what}")
        if number in table:
            refuse(card.place, f"{what} {number} is there twice")
        return number

    def find(self, table, number, card, what):
        if number not in table:
            refuse(card.place, f"there is no {what} {number}{did_you_mean(number, table)}")
        return table[number]

    def node(self, card, i):
        number = card.integer(i, "the number of a node")
        self.find(self.model.nodes, number, card, "node")
        return number

    def _parameters(self):
        for card in [*self.deck.parameters, *self.by_name["PARAM"]]:
            if card.text(1).upper() == "WTMASS":
                self.masses_by = card.real(2, "a factor")
                self.findings.assume(f"masses are those of the file times WTMASS = {self.masses_by:g}", card.place)
            if card.text(1).upper() == "INREL" and card.text(2).strip("0"):
                self.findings.leave_out("PARAM INREL: forces of inertia that balance the loads", card.place)
