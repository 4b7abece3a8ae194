"""Frequencies of a frame by textbook beam elements, independent of culm: Timoshenko stiffness, consistent mass."""

import numpy
import scipy.linalg


def element(start, end, up, EA, GA1, GA2, EI1, EI2, GJ, mass, polar):
    """Stiffness and mass [12 x 12] in space. d1 is the part of `up` across the axis, d2 = d3 x d1; EI1 bends
    along d2, EI2 along d1."""
    axis = end - start
    L = numpy.linalg.norm(axis)
    x = axis / L
    y = up - (up @ x) * x
    y = y / numpy.linalg.norm(y)
    R = numpy.array([x, y, numpy.cross(x, y)])
    K, M = numpy.zeros((12, 12)), numpy.zeros((12, 12))
    K[numpy.ix_([0, 6], [0, 6])] = EA / L * numpy.array([[1, -1], [-1, 1]])
    K[numpy.ix_([3, 9], [3, 9])] = GJ / L * numpy.array([[1, -1], [-1, 1]])
    M[numpy.ix_([0, 6], [0, 6])] = mass * L / 6 * numpy.array([[2, 1], [1, 2]])
    M[numpy.ix_([3, 9], [3, 9])] = polar * L / 6 * numpy.array([[2, 1], [1, 2]])
    # deflection along y turns about +z, along z about -y
    for freedoms, EI, GA, sign in (([1, 5, 7, 11], EI2, GA1, 1.0), ([2, 4, 8, 10], EI1, GA2, -1.0)):
        phi = 12.0 * EI / (GA * L**2)
        k = EI / (L**3 * (1.0 + phi)) * numpy.array(
            [
                [12, 6 * L, -12, 6 * L],
                [6 * L, (4 + phi) * L**2, -6 * L, (2 - phi) * L**2],
                [-12, -6 * L, 12, -6 * L],
                [6 * L, (2 - phi) * L**2, -6 * L, (4 + phi) * L**2],
            ]
        )
        m = mass * L / 420 * numpy.array(
            [
                [156, 22 * L, 54, -13 * L],
                [22 * L, 4 * L**2, 13 * L, -3 * L**2],
                [54, 13 * L, 156, -22 * L],
                [-13 * L, -3 * L**2, -22 * L, 4 * L**2],
            ]
        )
        turn = numpy.diag([1.0, sign, 1.0, sign])
        K[numpy.ix_(freedoms, freedoms)] = turn @ k @ turn
        M[numpy.ix_(freedoms, freedoms)] = turn @ m @ turn
    T = numpy.kron(numpy.eye(4), R)
    return T.T @ K @ T, T.T @ M @ T


def frequencies(points, members, clamped, pieces=4, count=4):
    """@param members  (first, last, up, values of `element` after it) of straight members
    @return the lowest frequencies [Hz]"""
    nodes = [numpy.array(p, float) for p in points]
    rows = []
    for first, last, up, values in members:
        chain = [first]
        for i in range(1, pieces):
            nodes.append(nodes[first] + (nodes[last] - nodes[first]) * i / pieces)
            chain.append(len(nodes) - 1)
        chain.append(last)
        rows += [(a, b, up, values) for a, b in zip(chain, chain[1:])]
    K, M = (numpy.zeros((6 * len(nodes), 6 * len(nodes))) for _ in range(2))
    for a, b, up, values in rows:
        k, m = element(nodes[a], nodes[b], numpy.array(up, float), *values)
        at = [*range(6 * a, 6 * a + 6), *range(6 * b, 6 * b + 6)]
        K[numpy.ix_(at, at)] += k
        M[numpy.ix_(at, at)] += m
    free = [i for i in range(6 * len(nodes)) if i // 6 not in clamped]
    values = scipy.linalg.eigh(K[numpy.ix_(free, free)], M[numpy.ix_(free, free)], eigvals_only=True)
    return numpy.sqrt(values[:count]) / (2.0 * numpy.pi)
