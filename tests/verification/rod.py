"""Static Cosserat rods as boundary value problems: a reference that shares nothing with culm.

Along the arc length s: x' = R (e3 + Gamma), R' = R [K0 + K] with the strains from the 6x6 section
stiffness, n' = -f, m' = -x' x n - l. The integration (Runge-Kutta of order 4, triads by the
exponential map) runs from the free tip to the clamped root. The unknown is the state of the tip;
Newton's method finds the one for which the root stands where it is clamped. With
follower loads alone the tip is known in its own axes, and nothing needs to be solved.
"""

import numpy as np


def skew(a):
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def cross(a, b):
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def exp_rotation(a):
    angle = np.linalg.norm(a)
    if angle < 1e-8:
        return np.eye(3) + skew(a) + 0.5 * skew(a) @ skew(a)
    k = skew(a / angle)
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def log_rotation(r):
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    sine, cosine = 0.5 * np.linalg.norm(axis), 0.5 * (np.trace(r) - 1.0)
    return 0.5 * axis if sine < 1e-12 else axis * np.arctan2(sine, cosine) / (2.0 * sine)


class Rod:
    """A rod clamped at s = 0 with triad `root` (columns d1, d2, d3) at `start`.

    stiffness(s): 6x6 in culm's order (shear 1, shear 2, stretch, curvature 1, curvature 2, twist);
    curvature(s): components of the reference curvature and twist in the triad. Both may jump or kink
    where one step ends and the next begins: steps is their number, or the places of all ends.
    """

    def __init__(self, length, stiffness, root, start=(0.0, 0.0, 0.0), curvature=None, steps=400):
        self.length = length
        self.root = np.array(root, dtype=float)
        self.start = np.array(start, dtype=float)
        self.places = np.linspace(0.0, length, steps + 1) if np.isscalar(steps) else np.array(steps)
        constant = None if callable(stiffness) else np.linalg.inv(np.array(stiffness, dtype=float))
        self.compliance = (
            (lambda s: np.linalg.inv(stiffness(s))) if constant is None else (lambda s: constant)
        )
        self.curvature = curvature or (lambda s: np.zeros(3))

    def _rates(self, s, r, n, m, load):
        strain = self.compliance(s) @ np.concatenate((r.T @ n, r.T @ m))
        tangent = r @ (strain[:3] + np.array([0.0, 0.0, 1.0]))
        force, moment = load(s, r)
        return tangent, r @ (strain[3:] + self.curvature(s)), -force, -cross(tangent, n) - moment

    def _integrate(self, r, n, m, load):
        """From the tip (x = 0) to the root; returns the states at all steps, root first."""
        x = np.zeros(3)
        states = [(x, r, n, m)]
        for end, begin in zip(self.places[:0:-1], self.places[-2::-1]):
            h = begin - end
            s = end + 1e-9 * h  # on this side of a jump, as s + h is
            k1 = self._rates(s, r, n, m, load)
            turn = h * 0.5 * k1[1]
            k2 = self._rates(
                s + 0.5 * h, exp_rotation(turn) @ r, n + 0.5 * h * k1[2], m + 0.5 * h * k1[3], load
            )
            # Runge-Kutta-Munthe-Kaas: rates of the rotation vector, dexp^-1 to second order
            w2 = k2[1] - 0.5 * cross(turn, k2[1]) + cross(turn, cross(turn, k2[1])) / 12.0
            turn = h * 0.5 * w2
            k3 = self._rates(
                s + 0.5 * h, exp_rotation(turn) @ r, n + 0.5 * h * k2[2], m + 0.5 * h * k2[3], load
            )
            w3 = k3[1] - 0.5 * cross(turn, k3[1]) + cross(turn, cross(turn, k3[1])) / 12.0
            turn = h * w3
            k4 = self._rates(begin - 1e-9 * h, exp_rotation(turn) @ r, n + h * k3[2], m + h * k3[3], load)
            w4 = k4[1] - 0.5 * cross(turn, k4[1]) + cross(turn, cross(turn, k4[1])) / 12.0
            r = exp_rotation(h / 6.0 * (k1[1] + 2.0 * w2 + 2.0 * w3 + w4)) @ r
            x = x + h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0])
            n = n + h / 6.0 * (k1[2] + 2.0 * k2[2] + 2.0 * k3[2] + k4[2])
            m = m + h / 6.0 * (k1[3] + 2.0 * k2[3] + 2.0 * k3[3] + k4[3])
            states.append((x, r, n, m))
        return states[::-1]

    def _place(self, states):
        """Moves the rod so that its root is at the start; positions and triads from root to tip."""
        origin = states[0][0]
        return [(self.start + x - origin, r, n, m) for x, r, n, m in states]

    def follow(self, force=(0, 0, 0), moment=(0, 0, 0), load=None):
        """Tip force and moment, and load(s), by components in the triad; no iteration."""
        at = load or (lambda s: (np.zeros(3), np.zeros(3)))

        def in_space(s, r):
            f, l = at(s)
            return r @ np.array(f, dtype=float), r @ np.array(l, dtype=float)

        states = self._integrate(
            np.eye(3), np.array(force, dtype=float), np.array(moment, dtype=float), in_space
        )
        turn = self.root @ states[0][1].T
        return self._place([(turn @ x, turn @ r, turn @ n, turn @ m) for x, r, n, m in states])

    def solve(self, force=(0, 0, 0), moment=(0, 0, 0), load=None, levels=8):
        """Dead tip force and moment, and dead line loads load(s, triad), in `levels` steps."""
        load = load or (lambda s, r: (np.zeros(3), np.zeros(3)))
        force, moment = np.array(force, dtype=float), np.array(moment, dtype=float)
        unloaded = self._integrate(np.eye(3), np.zeros(3), np.zeros(3), lambda s, r: (0.0, 0.0))
        tip = self.root @ unloaded[0][1].T
        for level in range(1, levels + 1):
            part = level / levels

            def scaled(s, r, part=part):
                f, l = load(s, r)
                return part * np.asarray(f), part * np.asarray(l)

            def miss(turn, tip=tip, scaled=scaled, part=part):
                start = exp_rotation(turn) @ tip
                states = self._integrate(start, part * force, part * moment, scaled)
                return log_rotation(states[0][1] @ self.root.T), states

            # those before the last one are starts only
            tip, states = self._newton(miss, tip, 1e-12 if level == levels else 1e-4)
        return self._place(states)

    @staticmethod
    def _newton(miss, tip, tolerance):
        """With slopes by Broyden's updates, which cost no integrations, while the error falls by them."""
        turn, slope, before = np.zeros(3), None, np.inf
        for _ in range(60):
            error, states = miss(turn)
            size = np.linalg.norm(error)
            if size < tolerance:
                return exp_rotation(turn) @ tip, states
            if slope is None or size > 0.2 * before:
                slope = np.column_stack(
                    [(miss(turn + 1e-6 * e)[0] - miss(turn - 1e-6 * e)[0]) / 2e-6 for e in np.eye(3)]
                )
            else:
                slope = slope + np.outer(error, change) / (change @ change)
            before, change = size, -np.linalg.solve(slope, error)
            turn = turn + change
        raise ArithmeticError("the shooting method does not converge: more levels")


def stiffness(EA, GA1, GA2, EI1, EI2, GIp):
    """Diagonal 6x6 in culm's order."""
    return np.diag([GA1, GA2, EA, EI1, EI2, GIp])
