"""Angles by which OpenFOAM describes rotations."""

import numpy as np


def euler_angles(rotation):
    """Angles (phi, theta, psi) with rotation = Z(phi) X(theta) Z(psi) [rad].

    Near the identity phi and psi are undetermined but for their sum; so psi is taken from what is left
    after a turn by phi, whatever it is.

    @param rotation  matrices, shape (n, 3, 3)
    @return shape (n, 3)
    """
    phi = np.arctan2(rotation[:, 0, 2], -rotation[:, 1, 2])
    theta = np.arctan2(np.hypot(rotation[:, 0, 2], rotation[:, 1, 2]), rotation[:, 2, 2])
    cos, sin = np.cos(phi), np.sin(phi)
    first = cos[:, None] * rotation[:, 0] + sin[:, None] * rotation[:, 1]  # of Z(phi)^T rotation
    return np.stack([phi, theta, np.arctan2(-first[:, 1], first[:, 0])], axis=1)
