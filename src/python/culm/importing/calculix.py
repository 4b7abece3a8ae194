"""Models of CalculiX: files of the form of Abaqus, in which some words mean something else."""

from .abaqus import FILE, read_dialect

__all__ = ["FILE", "read"]


def read(path, arguments):
    """@return the Model of an input file"""
    del arguments
    return read_dialect(path, "CalculiX")
