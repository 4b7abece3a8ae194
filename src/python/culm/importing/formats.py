"""The formats of `culm import` that are read in Python: each is a module of this name.

A module has `read(path, arguments)`, which returns a Model (model.py) or a ready deck
(ready_deck.py), and may have `declare(parser)` for options of its own, and FILE, which says what
file is meant.
"""

import importlib

FORMATS = {
    "abaqus": "A model of Abaqus or CalculiX, .inp",
    "nastran": "A model of Nastran, .bdf: SOL 101, 103, 105, 106",
    "gmsh": "A mesh of Gmsh, .msh 2.2 or 4.1, text or binary, first or second order",
    "desio": "A model of DeSiO-Structure, a folder of text files",
}


def module_of(name):
    return importlib.import_module(f".{name}", __package__)
