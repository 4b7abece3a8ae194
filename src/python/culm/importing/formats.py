"""The formats of `culm import` that are read in Python: each is a module of this name.

A module has `read(path, arguments)`, which returns a Model (model.py) or a ready deck
(ready_deck.py), and may have `declare(parser)` for options of its own, and FILE, which says what
file is meant.
"""

import importlib

FORMATS = {
    "abaqus": "A model of Abaqus or CalculiX, .inp",
    "calculix": "A model of CalculiX, .inp: like abaqus, with the sections of CalculiX",
    "ansys": "A model of ANSYS, archive of CDWRITE, .cdb",
    "nastran": "A model of Nastran, .bdf: SOL 101, 103, 105, 106",
    "gmsh": "A mesh of Gmsh, .msh 2.2 or 4.1, text or binary, first or second order",
    "windio": "A turbine in windIO, .yaml: blade, or tower with monopile",
    "hawc2": "A body of HAWC2: sections of a st file, along the axis of a .htc",
    "csv": "Sections of a beam from a table",
    "desio": "A model of DeSiO-Structure, a folder of text files",
}


# the word is that of a module of Python's own
MODULES = {"csv": "section_csv"}


def module_of(name):
    return importlib.import_module(f".{MODULES.get(name, name)}", __package__)
