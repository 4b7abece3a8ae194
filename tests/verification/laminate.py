"""Laminated plates by first-order shear theory, exact along x and by polynomials along y; shares nothing with culm.

The sides x = 0, a are simply supported and slide along themselves, so that sines and cosines are exact: u, w, Y ~
sin(m pi x / a) and v, X ~ cos(m pi x / a), where X, Y are the displacements of a director along x, y. The sides y = 0, b are
supported in the same way or free. This fits symmetric cross-ply and antisymmetric angle-ply laminates, which do not
couple other pairs. Supported on all sides the lowest value is that of Navier's solution.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh


class Ply(NamedTuple):
    E1: float
    E2: float
    nu12: float
    G12: float
    G13: float
    G23: float


def ply_stiffness(ply, angle):
    """Plane-stress stiffness (11, 22, 12) and shear stiffness (13, 23) in the axes of the plate; degrees."""
    nu21 = ply.nu12 * ply.E2 / ply.E1
    e1, e2 = (E / (1.0 - ply.nu12 * nu21) for E in (ply.E1, ply.E2))
    Q = np.array([[e1, nu21 * e1, 0.0], [nu21 * e1, e2, 0.0], [0.0, 0.0, ply.G12]])
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    T = np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2.0 * c * s, 2.0 * c * s, c * c - s * s]])
    R = np.array([[c, s], [-s, c]])
    return T.T @ Q @ T, R.T @ np.diag([ply.G13, ply.G23]) @ R


class Laminate:
    """A, B, D in `law`, shear stiffness with its correction, and stresses under a unit force per length along x."""

    def __init__(self, ply, angles, thickness, correction=5.0 / 6.0):
        self.thickness = thickness
        edges = thickness * (np.arange(len(angles) + 1) / len(angles) - 0.5)
        layers = [(*ply_stiffness(ply, angle), z) for angle, z in zip(angles, zip(edges, edges[1:]))]

        def moment(k, power):
            n = power + 1
            return sum(layer[k] * (layer[2][1] ** n - layer[2][0] ** n) / n for layer in layers)

        A, B, D = (moment(0, power) for power in range(3))
        self.law = np.block([[A, B], [B, D]])
        self.shear = correction * moment(1, 0)
        strains = np.linalg.solve(self.law, np.eye(6)[0])
        # stresses 11, 22 times z^0 and z^2, over the thickness
        self.stress = [(moment(0, n) @ strains[:3] + moment(0, n + 1) @ strains[3:])[:2] for n in (0, 2)]
        self.shear_moments = [correction * moment(1, n) for n in (0, 2)]

    def short_wave_force(self):
        """The smallest force per length along x under which waves much shorter than the thickness are unstable, in
        which the wall deflects, z^0, or changes its thickness, z^1, and nothing but shear resists. Of symmetric walls."""
        return min(shear[0, 0] / stress[0] for shear, stress in zip(self.shear_moments, self.stress))


class Plate:
    """Quadratic forms, over the length a/2, in the coefficients of u, v, w, X, Y."""

    def __init__(self, laminate, a, b, m=1, free=False, degree=14):
        self.laminate, self.alpha = laminate, m * np.pi / a
        y, weights = legendre.leggauss(degree + 4)
        self.weights = 0.5 * b * weights
        values = np.array([legendre.legval(y, row) for row in np.eye(degree)])
        slopes = np.array([legendre.legval(y, legendre.legder(row)) for row in np.eye(degree)])
        if free:
            held = (values, slopes)
        else:
            held = ((1.0 - y**2) * values, (1.0 - y**2) * slopes - 2.0 * y * values)
        self.field, self.slope = np.zeros((2, 5, 5 * degree, len(y)))
        for k, (value, slope) in enumerate(((values, slopes), held, held, held, (values, slopes))):
            rows = slice(k * degree, (k + 1) * degree)
            self.field[k, rows], self.slope[k, rows] = value, 2.0 / b * slope

    def form(self, matrix, rows):
        return np.einsum("kl,kip,p,ljp->ij", matrix, rows, self.weights, rows, optimize=True)

    def stiffness(self):
        (u, v, w, X, Y), (du, dv, dw, dX, dY), alpha = self.field, self.slope, self.alpha
        none = np.zeros_like(u)
        cosines = [alpha * u, dv, none, none, none, dX + alpha * Y]
        sines = [none, none, du - alpha * v, -alpha * X, dY, none]
        return (self.form(self.laminate.law, np.array(cosines)) + self.form(self.laminate.law, np.array(sines))
                + self.form(self.laminate.shear, np.array([alpha * w + X, dw + Y])))

    def mass(self):
        """Of the density 1."""
        h = self.laminate.thickness
        return self.form(np.diag([h, h, h, h**3 / 12.0, h**3 / 12.0]), self.field)

    def geometric(self, solid=False):
        """Of a unit force per length along x: N w_x^2, as in von Karman's plates. In a solid the stresses act on the
        gradients of all displacements, those of the director too: + sum over i = u, v of
        integral of (S11 i_x^2 + S22 i_y^2), and of z^2 (S11 X_x^2 + S22 X_y^2 + S11 Y_x^2 + S22 Y_y^2)."""
        pulls, moments = self.laminate.stress
        along = np.diag([pulls[0] * solid, pulls[0] * solid, pulls[0], moments[0] * solid, moments[0] * solid])
        across = np.diag([pulls[1], pulls[1], 0.0, moments[1], moments[1]]) * solid
        return self.form(self.alpha**2 * along, self.field) + self.form(across, self.slope)


def frequency(laminate, a, b, free=False):
    """The lowest circular frequency; the free motion along y of a plate with free sides is left out."""
    plate = Plate(laminate, a, b, free=free)
    squares = eigh(plate.stiffness(), plate.mass(), eigvals_only=True)
    return np.sqrt(squares[squares > 1e-9 * squares[-1]][0])


def buckling_force(laminate, a, b, solid=False, waves=3):
    """The smallest force per length that presses along x, with up to so many half waves along x."""
    plates = [Plate(laminate, a, b, m) for m in range(1, waves + 1)]
    return min(1.0 / eigh(p.geometric(solid), p.stiffness(), eigvals_only=True)[-1] for p in plates)
