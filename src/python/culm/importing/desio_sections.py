"""Sections of beams of DeSiO-Structure."""

import numpy

# Entries of the 6x6 stiffness in the order of the 21 values.
VOIGT = "11 22 33 44 55 66 56 46 36 26 16 15 14 13 12 23 34 45 35 25 24".split()
VALUES = ("EA", "GA1", "GA2", "EI1", "EI2", "GIp", "ES1", "ES2", "GS1", "GS2", "EI12")
MASSES = ("rhoA", "rhoI1", "rhoI2", "rhoS1", "rhoS2", "rhoI12")
VOIGT_MASSES = ("rhoA", "rhoI2", "rhoI1", "rhoI12", "rhoS1", "rhoS2")


def voigt_section(entry, stiffness, mass):
    """Adds a section by 21 stiffnesses and 6 masses to its list of the deck."""
    matrix = numpy.zeros((6, 6))
    for key, value in zip(VOIGT, stiffness):
        i, j = int(key[0]) - 1, int(key[1]) - 1
        matrix[i, j] = matrix[j, i] = value
    entry.add("Type", "Stiffness Matrix").add("Stiffness", matrix[numpy.triu_indices(6)])
    for key, value in zip(VOIGT_MASSES, mass):
        entry.add(key, value)


def value_section(entry, stiffness, mass):
    """Adds a section by 11 stiffnesses and 6 masses to its list of the deck."""
    entry.add("Type", "Stiffness Values")
    for key, value in (*zip(VALUES, stiffness), *zip(MASSES, mass)):
        entry.add(key, value)


def section_steps(properties, lengths):
    """Names and positions of sections that are constant within elements."""
    ends = numpy.concatenate([[0.0], numpy.cumsum(lengths)]) / lengths.sum()
    names, places = [], []
    start = 0
    for i in range(1, len(properties) + 1):
        if i == len(properties) or properties[i] != properties[start]:
            names += [f"section {properties[start] + 1}"] * 2
            places += [ends[start], ends[i]]
            start = i
    places[-1] = 1.0
    return names, places
