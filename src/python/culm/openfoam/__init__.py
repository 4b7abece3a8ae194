"""Couples a deck with a flow program of OpenFOAM that moves a wall by its boundary condition
lumpedPointDisplacement: python3 -m culm.openfoam DECK CASE. See doc/guide/coupling.md."""
