#!/usr/bin/python3
"""Beams without shear and extension, torsion or rotary inertia. Page: doc/verification/effects.md."""

import pathlib
import tempfile

import numpy as np
from scipy.linalg import block_diag, expm
from scipy.optimize import brentq
from verify import main

LENGTH = 8.0
# A thin-walled profile by what it does at its centres: shear centre, tension centre, centre of mass
# (xi1, xi2) [m]; stiffnesses there [N, N m^2], mass [kg/m] and its moments about its centre [kg m].
SHEAR, TENSION, MASS = np.array([-0.35, 0.2]), np.array([0.3, -0.1]), np.array([0.22, 0.12])
GA1, GA2, EA, GJ = 6e7, 4e7, 3e8, 5e5
EI = np.array([[4e6, 8e5], [8e5, 9e6]])
RHO = 40.0
INERTIA = np.array([[1.1, 0.25], [0.25, 1.9]])  # int rho xi xi^T about the centre
# A laminate that couples all strains: the lower triangle of its root, in the same units.
ROOT = np.array([
    [7e3, 0, 0, 0, 0, 0], [9e2, 6e3, 0, 0, 0, 0], [2e3, -1e3, 1.7e4, 0, 0, 0],
    [8e2, -3e2, 9e2, 2e3, 0, 0], [-2e2, 7e2, -1e3, 3e2, 3e3, 0], [2e2, 3e2, 2e2, 3e2, -3e2, 6e2]])

BEAM = "Structures/beam"
NAMES = ["whole", "without shear and extension", "without torsion", "without both", "without rotary inertia"]
SETTINGS = {
    "whole": [],
    "without shear and extension": [f"{BEAM}/Fidelity=Kirchhoff"],
    "without torsion": [f"{BEAM}/Torsion=false"],
    "without both": [f"{BEAM}/Fidelity=Kirchhoff", f"{BEAM}/Torsion=false"],
    "without rotary inertia": [f"{BEAM}/Rotary Inertia=0"],
}

DECK = """<ParameterList name="culm">
  <ParameterList name="Sections"><ParameterList name="section">
    <Parameter name="Type" value="Stiffness Matrix"/>
    <Parameter name="Stiffness" value="{stiffness}"/>{mass}
  </ParameterList></ParameterList>
  <ParameterList name="Structures"><ParameterList name="beam">
    <Parameter name="Type" value="Beam"/>
    <Parameter name="Section" value="section"/>
    <Parameter name="Order" value="3"/>
    <ParameterList name="Curve">
      <Parameter name="Type" value="Line"/>
      <Parameter name="From" value="{{0, 0, 0}}"/>
      <Parameter name="To" value="{{0, 0, {length}}}"/>
      <Parameter name="Up" value="{{1, 0, 0}}"/>
      <Parameter name="Elements" value="16"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Constraints"><ParameterList name="clamp">
    <Parameter name="Type" value="Rigid Support"/>
    <Parameter name="Node" value="beam/first"/>
  </ParameterList></ParameterList>
  {rest}
</ParameterList>
"""

MODES = """<ParameterList name="Analyses"><ParameterList name="modes">
    <Parameter name="Type" value="Modal"/>
    <Parameter name="Modes" value="6"/>
  </ParameterList></ParameterList>"""
MOTION = """<ParameterList name="Loads"><ParameterList name="kick">
    <Parameter name="Type" value="Force"/>
    <Parameter name="Node" value="beam/last"/>
    <Parameter name="Force" value="{{100, 60, 0}}"/>
    <Parameter name="Function" value="swing"/>
  </ParameterList></ParameterList>
  <ParameterList name="Functions"><ParameterList name="swing">
    <Parameter name="Type" value="Expression"/>
    <Parameter name="Expression" value="(1 - cos(2*pi*t/({end})))^2"/>
  </ParameterList></ParameterList>
  <ParameterList name="Analyses"><ParameterList name="motion">
    <Parameter name="Type" value="Dynamic"/>
    <Parameter name="End Time" value="{end}"/>
    <Parameter name="Step" value="{step}"/>
  </ParameterList></ParameterList>
  <ParameterList name="Output"><ParameterList name="History">
    <ParameterList name="tip">
      <Parameter name="Type" value="Rotation"/>
      <Parameter name="Node" value="beam/last"/>
    </ParameterList>
    <ParameterList name="root">
      <Parameter name="Type" value="Reaction"/>
      <Parameter name="Node" value="beam/first"/>
    </ParameterList>
  </ParameterList></ParameterList>"""


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def arm(centre):
    return np.append(centre, 0.0)


def profile_compliance(shear=1.0, stretch=1.0, torsion=1.0):
    """Of the strains at the axis by the forces there: each flexibility at its own centre, times a factor."""
    lever = np.zeros((3, 3))  # Gamma at the axis = Gamma at the centres - K x centre
    lever[:2], lever[2] = skew(arm(SHEAR))[:2], skew(arm(TENSION))[2]
    bending = block_diag(np.linalg.inv([[EI[1, 1], -EI[0, 1]], [-EI[0, 1], EI[0, 0]]]), torsion / GJ)
    own = block_diag(np.diag([shear / GA1, shear / GA2, stretch / EA]), bending)
    to_axis = np.block([[np.eye(3), lever], [np.zeros((3, 3)), np.eye(3)]])
    return to_axis @ own @ to_axis.T


def mass_entries(rotary):
    """m, first moments and moments of second order about the axis."""
    return RHO, RHO * MASS, RHO * np.outer(MASS, MASS) + rotary * INERTIA


def full_mass(rotary):
    """Of velocity and angular velocity at the axis, 6 x 6."""
    m, first, second = mass_entries(rotary)
    offset = skew(arm(first))
    euler = block_diag(second, 0.0)
    return np.block([[m * np.eye(3), -offset], [offset, np.trace(euler) * np.eye(3) - euler]])


def compliances(name, stiffness):
    """Compliance without what an effect stands for."""
    whole = np.linalg.inv(stiffness)
    if name == "without shear and extension":  # what is left with the curvatures held goes
        return whole - block_diag(np.linalg.inv(stiffness[:3, :3]), np.zeros((3, 3)))
    if name in ("without torsion", "without both"):
        free = stiffness[:5, :5]
        left = np.linalg.inv(free)
        if name == "without both":
            left = left - block_diag(np.linalg.inv(free[:3, :3]), np.zeros((2, 2)))
        return block_diag(left, 0.0)
    return whole


def frequencies(compliance, rotary, count=6):
    """Of a clamped beam [Hz], by integration of u, phi, N, M along its axis: no mesh."""
    momentum = full_mass(rotary)
    axis = skew([0.0, 0.0, 1.0])
    scale = np.array([1.0] * 6 + [1e6] * 6)

    def determinant(frequency):
        A = np.zeros((12, 12))
        A[:6, 6:] = compliance
        A[:3, 3:6] = -axis  # u' = Gamma + phi x e3
        A[9:, 6:9] = -axis  # M' = -e3 x N - ...
        A[6:, :6] = -((2.0 * np.pi * frequency) ** 2) * momentum
        whole = expm(LENGTH * (A * scale[None, :] / scale[:, None]))
        return np.linalg.det(whole[6:, 6:])

    found, low = [], 0.5
    previous = determinant(low)
    while len(found) < count:
        high = 1.004 * low
        value = determinant(high)
        if previous * value < 0.0:
            found.append(brentq(determinant, low, high, xtol=1e-10))
        low, previous = high, value
    return found


def sawtooth(values):
    """Share of what changes its sign from step to step in a history; fourth differences let nothing else through."""
    v = np.asarray(values)
    fourth = (v[:-4] - 4.0 * v[1:-3] + 6.0 * v[2:-2] - 4.0 * v[3:-1] + v[4:]) / 16.0
    return np.sqrt(np.mean(fourth**2) / np.mean((v - v.mean()) ** 2))


def text(values):
    return "{" + ", ".join(repr(float(v)) for v in np.ravel(values)) + "}"


def parameters(values):
    return "".join(f'<Parameter name="{key}" value="{value}"/>' for key, value in values.items())


def mass_values():
    m, first, second = mass_entries(1.0)
    return parameters({"rhoA": m, "rhoS2": first[0], "rhoS1": first[1], "rhoI2": second[0, 0],
                       "rhoI1": second[1, 1], "rhoI12": second[0, 1]})


def mass_matrix():
    return parameters({"Mass": text(full_mass(1.0))})


class Decks:
    """A deck for a stiffness, in a folder that vanishes."""

    def __init__(self, culm, mass=mass_values):
        self.culm = culm
        self.mass = mass()
        self.folder = tempfile.TemporaryDirectory(prefix="culm")

    def modes(self, stiffness, settings=()):
        path = self.write(stiffness, MODES)
        return self.culm.table("modes/modes", path, settings).column("frequency [Hz]")

    def write(self, stiffness, rest):
        path = pathlib.Path(self.folder.name) / "beam.xml"
        symmetric = 0.5 * (stiffness + stiffness.T)
        path.write_text(DECK.format(stiffness=text(symmetric), mass=self.mass, length=LENGTH, rest=rest))
        return path


def verify_exact(decks, report, title, stiffness):
    report.title(f"{title}: six frequencies [Hz] against integration along the axis")
    whole = None
    for name in NAMES:
        wanted = frequencies(compliances(name, stiffness), 0.0 if name.endswith("inertia") else 1.0)
        found = decks.modes(stiffness, SETTINGS[name])
        whole = whole or wanted
        report.relative(name, found, wanted, 2e-6)
        report.note(f"  largest change by it {max(abs(a / b - 1.0) for a, b in zip(wanted, whole)):.2e}")


def verify_limits(decks, report):
    """Flexibilities at their centres a hundredth, a thousandth, a ten thousandth of what they are."""
    report.title("Profile: stiffnesses at its centres times 1e2, 1e3, 1e4, and the effect taken away")
    for name, softened in (("without shear and extension", ("shear", "stretch")), ("without torsion", ("torsion",))):
        held = decks.modes(np.linalg.inv(profile_compliance()), SETTINGS[name])
        errors = []
        for factor in (1e2, 1e3, 1e4):
            stiff = np.linalg.inv(profile_compliance(**{one: 1.0 / factor for one in softened}))
            stiffer = decks.modes(stiff)
            errors.append(max(abs(a / b - 1.0) for a, b in zip(stiffer, held)))
        report.note(f"{name}: differences " + ", ".join(f"{e:.2e}" for e in errors))
        for coarse, fine in zip(errors, errors[1:]):
            report.check(f"{name}: differences fall by", coarse / fine, 10.0, 0.5)


def verify_motion(decks, report):
    """A load that swells and goes; steps are 1/40 of the first period, far too long for torsion of 1e4 times the stiffness."""
    report.title("Profile, loaded at its end: what changes its sign from step to step, over the whole")
    whole = np.linalg.inv(profile_compliance())
    stiff = np.linalg.inv(profile_compliance(torsion=1e-4))
    period = 1.0 / frequencies(profile_compliance(), 1.0)[0]
    rest = MOTION.format(end=5.0 * period, step=period / 40.0)
    columns = ("tip rz [rad]", "root Mz [N m]")
    shares, moments = {}, {}
    for name, stiffness, settings in (("whole", whole, []), ("without torsion", whole, SETTINGS["without torsion"]),
                                      ("torsion times 1e4", stiff, [])):
        history = decks.culm.run(decks.write(stiffness, rest), settings).history
        shares[name] = max(sawtooth(history.column(column)) for column in columns)
        moments[name] = np.array(history.column("root Mz [N m]"))
        report.note(f"{name}: {shares[name]:.1e}")
    report.holds("without torsion, over that of the whole", shares["without torsion"] / shares["whole"], 1.1)
    held, limit = moments["without torsion"], moments["torsion times 1e4"]
    away = np.linalg.norm(held - limit) / np.linalg.norm(held)
    report.holds("moment at the root without torsion and with 1e4 times the stiffness", away, 1e-3)
    changes = np.linalg.norm(moments["whole"] - held) / np.linalg.norm(held)
    report.note(f"largest change by it {changes:.2e}")


def verify(culm, report):
    decks = Decks(culm)
    verify_exact(decks, report, "Profile with its centres apart", np.linalg.inv(profile_compliance()))
    verify_exact(Decks(culm, mass_matrix), report, "Laminate that couples all strains, mass by its matrix", ROOT @ ROOT.T)
    verify_limits(decks, report)
    verify_motion(decks, report)


if __name__ == "__main__":
    main(verify)
