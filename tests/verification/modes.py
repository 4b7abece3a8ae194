#!/usr/bin/python3
"""MO-6, MO-5: natural frequencies of beams, rotating beams and plates. Page: doc/verification/modes.md."""

import math

import numpy as np
from laminate import Laminate, Ply, frequency
from scipy.linalg import expm
from scipy.optimize import brentq
from verify import figure, main, mesh_axis, richardson, save

BEAM = "modes/cantilever.xml"
ROTATING = "modes/rotating_beam.xml"
RELAXING = "modes/relaxing_blade.xml"
CURVE = "Structures/beam/Curve/Elements"
# beta L of uniform beams: roots of cos x cosh x = -1, of cos x cosh x = 1, multiples of pi
CLAMPED_FREE = (1.87510407, 4.69409113, 7.85475744, 10.9955407, 14.1371684)
FREE_FREE = (4.73004074, 7.85320462, 10.9956078, 14.1371655)
# first flapping frequency over the speed: Wright, Smith, Thresher, Wang, J. Appl. Mech. 49 (1982)
FLAPPING = {1: 3.6816, 2: 4.1373, 3: 4.7973, 4: 5.5850, 6: 7.3604, 8: 9.2568, 10: 11.2023, 12: 13.1702}
# NAFEMS FV52: simply supported, thickness 1; FV12: free, thickness 0.05 [Hz]
FV52 = (45.897, 109.44, 109.44, 167.89)
FV12 = (1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668)
# omega a^2 / h sqrt(rho / E2) of n plies [angle/-angle/...]: (angle, n, a/h, two sides free)
KHDEIR = {
    (30, 2, 10, False): 12.68, (30, 4, 10, False): 17.63, (30, 10, 10, False): 18.51,
    (45, 2, 10, False): 13.04, (45, 4, 10, False): 18.46, (45, 10, 10, False): 19.38,
    (30, 2, 10, True): 6.95, (30, 4, 10, True): 9.61, (30, 10, 10, True): 10.11,
    (45, 2, 10, True): 4.76, (45, 4, 10, True): 6.26, (45, 10, 10, True): 6.57,
}
REDDY_PHAN = {
    (45, 2, 5, False): 10.335, (45, 2, 10, False): 13.044, (45, 2, 20, False): 14.179,
    (45, 2, 50, False): 14.561, (45, 2, 100, False): 14.618,
    (45, 8, 5, False): 12.892, (45, 8, 10, False): 19.289, (45, 8, 20, False): 23.259,
    (45, 8, 50, False): 24.909, (45, 8, 100, False): 25.176,
}
PLY = Ply(E1=40.0, E2=1.0, nu12=0.25, G12=0.6, G13=0.6, G23=0.5)


def frequencies(culm, deck, settings=()):
    return culm.table("modes/modes", deck, settings).column("frequency [Hz]")


def omegas(values):
    """With EI = rhoA = L = 1: (beta L)^2."""
    return [2.0 * math.pi * f for f in values]


def bending(culm, elements, order, count=5, settings=()):
    """Bending about the weaker axis; the other stiffness is four times as large."""
    table = culm.table(
        "modes/modes",
        BEAM,
        [
            f"{CURVE}={elements}",
            f"Structures/beam/Order={order}",
            "Analyses/modes/Modes=14",
            *settings,
        ],
    )
    rows = zip(table.column("frequency [Hz]"), table.column("effective mass z [kg]"))
    return omegas([f for f, mass in rows if mass > 1e-6])[:count]


def verify_cantilever(culm, report):
    report.title("MO-6: cantilever, order 3, 16 elements")
    found = bending(culm, 16, 3)
    for beta, omega in zip(CLAMPED_FREE, found):
        report.relative(f"beta L = {beta:g}", omega, beta**2, 1e-4)
    report.title("MO-6: cantilever, order 1: convergence from above, order 2")
    errors = {n: [o / b**2 - 1 for o, b in zip(bending(culm, n, 1, 3), CLAMPED_FREE)] for n in (32, 64)}
    for i in range(3):
        report.check(f"order of mode {i + 1}", math.log2(errors[32][i] / errors[64][i]), 2.0, 0.05)
        report.holds(f"mode {i + 1} from above, 64 elements", -errors[64][i], 0.0)


def verify_solvers(culm, report):
    report.title("One answer from all methods and forms")
    reference = frequencies(culm, BEAM)
    for settings in (
        ["Analyses/modes/Solver=Spectra"],
        ["Analyses/modes/Solver=Dense"],
        ["Solver/Form=Multipliers"],
        ["Solver/Form=Multipliers", "Analyses/modes/Solver=Spectra"],
        ["Solver/Linear Solver=MUMPS", "Analyses/modes/Solver=Spectra"],
    ):
        report.relative(", ".join(settings), frequencies(culm, BEAM, settings), reference, 1e-7)


def verify_free(culm, report):
    report.title("MO-6: free beam: six zeros, no spurious modes")
    for form in ("Null Space", "Multipliers"):
        found = frequencies(
            culm, "modes/free_beam.xml", [f"Solver/Form={form}", "Analyses/modes/Modes=12"]
        )
        report.check(f"{form}: modes at 0 Hz", sum(f == 0.0 for f in found), 6, 0)
        weak = [beta**2 for beta in FREE_FREE]
        wanted = sorted(weak + [2.0 * w for w in weak])[:6]
        for omega, reference in zip(omegas(found[6:]), wanted):
            report.relative(f"{form}: omega", omega, reference, 2e-3)


def constraint(name, kind, node, key, direction):
    entry = f"Constraints/{name}"
    return [f"{entry}/Type={kind}", f"{entry}/Node=beam/{node}", f"{entry}/{key}={direction}"]


HINGE = ["Constraints/clamp/Type=Spherical Support", *constraint("twist", "Rotation", "first", "Axis", "{1, 0, 0}")]
PROP = [*constraint("y", "Simple Support", "last", "Direction", "{0, 1, 0}"),
        *constraint("z", "Simple Support", "last", "Direction", "{0, 0, 1}")]
CLAMP = ["Constraints/other/Type=Rigid Support", "Constraints/other/Node=beam/last"]


def verify_supports(culm, report):
    report.title("MO-6: other supports, order 3, 16 elements: the first eight of both directions, nothing between")
    cases = (
        ("hinged at both ends, beta L = n pi", [*HINGE, *PROP], [n * math.pi for n in range(1, 9)]),
        ("clamped and hinged, tan x = tanh x", PROP, [3.92660231, 7.06858275, 10.2101761, 13.3517688, 16.4933614]),
        ("clamped at both ends, cos x cosh x = 1", CLAMP, [*FREE_FREE, 17.2787597]),
    )
    for name, settings, roots in cases:
        weak = [beta**2 for beta in roots]
        wanted = sorted(weak + [2.0 * w for w in weak])[:7]
        more = [f"{CURVE}=16", "Structures/beam/Order=3", "Analyses/modes/Modes=7"]
        found = omegas(frequencies(culm, BEAM, [*settings, *more]))
        for omega, reference in zip(found, wanted, strict=True):
            report.relative(f"{name}: omega", omega, reference, 1e-4)


def verify_linkage(culm, report):
    report.title("MO-6: free linkage of four bars: seven zeros, no spurious modes, whatever form and method")
    deck = "modes/linkage.xml"
    reference = frequencies(culm, deck, ["Solver/Form=Multipliers", "Analyses/modes/Solver=Spectra"])[7:]
    rigid = [f"Structures/{bar}/Fidelity=Rigid" for bar in ("lower", "right", "upper", "left")]
    for form in ("Null Space", "Multipliers"):
        for solver in ("Dense", "Spectra"):
            settings = [f"Solver/Form={form}", f"Analyses/modes/Solver={solver}"]
            found = frequencies(culm, deck, settings)
            report.check(f"{form}, {solver}: modes at 0 Hz", sum(f == 0.0 for f in found), 7, 0)
            report.relative("    the others", found[7:], reference, 1e-9)
        found = frequencies(culm, deck, [*rigid, f"Solver/Form={form}", "Analyses/modes/Solver=Dense"])
        report.check(f"{form}, rigid bars: as many modes at 0 Hz", sum(f == 0.0 for f in found), 7, 0)
        report.check("    and no others", len(found), 7, 0)
        # a Krylov space holds but one vector of a value, and here all are zero: whole matrices serve
        found = frequencies(culm, deck, [*rigid, f"Solver/Form={form}", "Analyses/modes/Solver=Spectra"])
        report.check(f"{form}, rigid bars, Spectra: as many modes at 0 Hz", sum(f == 0.0 for f in found), 7, 0)


def l_frame_exact(rotary, shear=5.0 / 6.0):
    """Frequencies of the L-frame out of its plane [Hz]: transfer matrices of (w, slope, twist, V, M, T) along the legs
    of Timoshenko beams; rotary inertia of bending [kg m] and shear factor as given."""
    width, height, length, E, G, density = 3e-3, 30e-3, 0.24, 71240e6, 71240e6 / 2.62, 5000.0
    area, bending = width * height, height * width**3 / 12.0
    polar = bending + width * height**3 / 12.0

    def free_end(frequency):
        square = (2.0 * math.pi * frequency) ** 2
        A = np.zeros((6, 6))
        A[0, 1], A[0, 3] = 1.0, 1.0 / (shear * G * area)
        A[1, 4], A[2, 5] = 1.0 / (E * bending), 1.0 / (G * 0.312e-12 * 30.0 * 27.0)
        A[3, 0], A[4, 3], A[4, 1], A[5, 2] = -density * area * square, -1.0, -rotary * square, -density * polar * square
        leg = expm(A * length)
        corner = np.eye(6)  # slope and twist change places, and so do their moments
        for i in (1, 4):
            corner[i : i + 2, i : i + 2] = [[0.0, 1.0], [-1.0, 0.0]]
        return np.linalg.det((leg @ corner @ leg)[3:, 3:])

    samples = np.arange(5.0, 300.0, 1.0)
    signs = [free_end(f) for f in samples]
    return [brentq(free_end, f, f + 1.0, xtol=1e-12) for f, a, b in zip(samples, signs, signs[1:]) if a * b < 0.0]


def verify_l_frame(culm, report):
    report.title("MO-5: L-frame, 2 x 16 elements of order 2, out of its plane")
    section, density = "Sections/strip", 5000.0
    inertia = {"weak": density * 30e-3 * 3e-3**3 / 12.0, "strong": density * 3e-3 * 30e-3**3 / 12.0}
    table = culm.table("modes/modes", "modes/l_frame.xml", ["Structures/frame/Curve/Elements={16, 16}"])
    rows = zip(table.column("frequency [Hz]"), table.column("effective mass y [kg]"))
    found = [f for f, mass in rows if mass > 1e-9]
    for f, exact in zip(found, l_frame_exact(inertia["weak"])):
        report.relative("frequency [Hz], transfer matrices", f, exact, 1e-4)
    for f, printed in zip(l_frame_exact(inertia["strong"], math.inf), (11.2732, 30.5269)):
        report.relative("transfer matrices, no shear, rotary inertias exchanged; printed", f, printed, 1e-5)
    for f, printed in zip(found, (11.2732, 30.5269)):
        report.relative("frequency [Hz], printed", f, printed, 0.01)


def verify_cylinder(culm, report):
    report.title("MO-5: clamped cylinder, limit of 48 x 16 and 96 x 32")
    tables = [culm.table("modes/modes", "modes/clamped_cylinder.xml", [f"N={n}"]) for n in (16, 32)]
    pairs = [table.column("frequency [Hz]") for table in tables]
    report.relative("two waves around, one half wave along", richardson(pairs[0][0], pairs[1][0]), 1701.0, 0.01)
    shares = tables[1].column("effective inertia z [kg m^2]")
    torsion = max(range(len(shares)), key=lambda i: shares[i])
    report.check("number of the torsional mode", torsion + 1, 13, 0)
    exact = math.sqrt(200e9 / 2.6 / 7800.0) / 0.8
    report.relative("torsion, sqrt(G/rho)/(2 L)", richardson(pairs[0][12], pairs[1][12]), exact, 1e-3)


def rotating(culm, speed, settings=()):
    """Edgewise and flapping frequencies of the first pair: those that displace along y and z."""
    table = culm.table("modes/modes", ROTATING, [f"Loads/rotation/Speed={speed}", *settings])
    flap = table.column("effective mass z [kg]")
    omega = omegas(table.column("frequency [Hz]"))
    flapping = [w for w, mass in zip(omega, flap) if mass > 1e-6]
    edgewise = [w for w, mass in zip(omega, flap) if mass <= 1e-6]
    return edgewise[0], flapping[0]


def verify_speed(report, speed, edgewise, flapping):
    reference = FLAPPING.get(speed, 3.5160)
    report.relative(f"speed {speed}, flapping", flapping, reference, 3e-4)
    # the stretch that the speed causes, speed^2 / (3 EA), and Coriolis forces are small
    softened = math.sqrt(reference**2 - speed**2)
    report.relative(f"speed {speed}, edgewise", edgewise, softened, 2e-3)


def verify_rotating(culm, report, speeds=(1, 3, 12)):
    report.title("MO-6: beam that turns about its root")
    for speed in speeds:  # all of them: verify_campbell
        verify_speed(report, speed, *rotating(culm, speed))


def plate(culm, deck, elements):
    return frequencies(culm, deck, [f"Structures/plate/Mesh/Elements={{{elements}, {elements}}}"])


def verify_plates(culm, report):
    for name, deck, references in (
        ("FV52, simply supported", "modes/plate.xml", FV52),
        ("FV12, free", "modes/free_plate.xml", FV12),
    ):
        report.title(f"MO-5: NAFEMS {name}, 32 x 32, and the limit of 16 and 32")
        found = [plate(culm, deck, n) for n in (16, 32)]
        rows = [[f for f in one if f > 0.0] for one in found]
        zeros = sum(f == 0.0 for f in found[0])
        for coarse, fine, reference in zip(*rows, references):
            report.relative("frequency [Hz]", fine, reference, 0.02)
            report.relative("extrapolated", richardson(coarse, fine), reference, 0.01)
    report.check("free: modes at 0 Hz", zeros, 6, 0)


def angle_ply(culm, case, elements):
    """omega a^2 / h sqrt(rho / E2)."""
    angle, plies, ratio, free = case
    settings = [
        f"N={elements}",
        f"Structures/shell/Thickness={1.0 / (plies * ratio)}",
        f"Structures/shell/Angles={{{angle}*pi/180, -{angle}*pi/180}}",
        f"Structures/shell/Repeat={plies // 2}",
    ]
    if free:
        settings += ["Node Sets/rim/Nodes={shell/u0, shell/u1}",
                     "Analyses/modes/Inactive={across y, tilt along x}"]
    found = frequencies(culm, "modes/angle_ply.xml", settings)
    return omegas([f for f in found if f > 0.0])[0] * ratio


def verify_laminates(culm, report, is_whole=False):
    for name, table in (("Khdeir 1988", KHDEIR), ("Reddy and Phan 1985", REDDY_PHAN)):
        report.title(f"MO-5: angle-ply plates, {name}, limit of 8 x 8 and 16 x 16")
        for case, printed in table.items():
            angle, plies, ratio, free = case
            # between others of the same column, or in the other table
            if not is_whole and (plies == 4 or table is REDDY_PHAN and ratio in (10, 50)):
                continue
            what = f"[{angle}/-{angle}], {plies} plies, a/h = {ratio}{', two sides free' if free else ''}"
            limit = richardson(*(angle_ply(culm, case, n) for n in (8, 16)))
            laminate = Laminate(PLY, [angle, -angle] * (plies // 2), 1.0 / ratio)
            report.relative(what, limit, printed, 0.01)
            report.relative("    own solution of the theory", limit, frequency(laminate, 1.0, 1.0, free) * ratio, 1e-3)


def verify_damping(culm, report):
    report.title("Viscous material: damping ratio eta omega / 2")
    for form in ("Null Space", "Multipliers"):
        for solver in ("Dense", "Spectra"):
            run = culm.succeed(
                "modes/damped_frame.xml",
                [f"Solver/Form={form}", f"Analyses/modes/Solver={solver}"],
            )
            omega = omegas(run.tables["undamped/modes"].column("frequency [Hz]"))
            damped = run.tables["modes/modes"]
            ratio = [0.5e-3 * w for w in omega]
            what = f"{form}, {solver}"
            report.relative(f"{what}: damping ratio", damped.column("damping ratio"), ratio, 1e-6)
            lower = [w * math.sqrt(1.0 - z * z) for w, z in zip(omega, ratio)]
            found = omegas(damped.column("frequency [Hz]"))
            report.relative(f"{what}: damped frequency", found, lower, 1e-7)


def relaxing(omega, branches):
    """The root that vibrates of lambda^2 + omega^2 (1 + sum g lambda T / (1 + lambda T)) = 0, of branches (T, g)."""
    ones = [np.poly1d([time, 1.0]) for time, _ in branches]
    equation = np.poly1d([1.0, 0.0, omega**2]) * math.prod(ones, start=np.poly1d([1.0]))
    for k, (time, ratio) in enumerate(branches):
        others = math.prod(ones[:k] + ones[k + 1 :], start=np.poly1d([1.0]))
        equation = equation + omega**2 * ratio * np.poly1d([time, 0.0]) * others
    return max(equation.roots, key=lambda root: root.imag)


def loss_factor(omega, branches):
    stored = 1.0 + sum(g * (omega * t) ** 2 / (1.0 + (omega * t) ** 2) for t, g in branches)
    return sum(g * omega * t / (1.0 + (omega * t) ** 2) for t, g in branches) / stored


def eigenvalues(table):
    parts = [table.column(f"eigenvalue {part} [1/s]") for part in ("real", "imaginary")]
    return [complex(real, imaginary) for real, imaginary in zip(*parts)]


def relaxation(branches):
    settings = []
    for name, (time, ratio) in zip(("resin", "slow", "fast"), branches):
        entry = f"Structures/blade/Relaxation/{name}"
        settings += [f"{entry}/Time={time}", f"{entry}/Ratios={{{ratio}}}"]
    return settings


def verify_relaxation(culm, report):
    report.title("Branches of Maxwell: lambda^2 + omega^2 (1 + sum g lambda T / (1 + lambda T)) = 0")
    branches = [(0.02, 0.3), (0.5, 1.0), (0.002, 0.2)]
    lasting = ["Analyses/modes/Damping=false"]
    for form in ("Null Space", "Multipliers"):
        for solver in ("Dense", "Spectra"):
            what = f"{form}, {solver}"
            # shear is soft enough for its rounding to be less than what is allowed
            settings = [*relaxation(branches), "Sections/bar/GA1=1e6", "Sections/bar/GA2=1e6",
                        "Structures/blade/Curve/Elements=6", f"Solver/Form={form}", f"Analyses/modes/Solver={solver}"]
            run = culm.succeed(RELAXING, [*settings, *lasting])
            report.check(f"{what}: warnings without 'Damping'", run.errors.count("lasting stiffness"), 1, 0)
            omega = omegas(run.tables["modes/modes"].column("frequency [Hz]"))
            found = eigenvalues(culm.table("modes/modes", RELAXING, settings))
            wanted = [relaxing(w, branches) for w in omega]
            apart = max(abs(f - w) / abs(w) for f, w in zip(found, wanted, strict=True))
            report.holds(f"{what}: beam, rod and shaft, relative,", apart, 1e-8)
    weak = [(0.02, 0.002), (0.5, 0.003)]
    table = culm.table("modes/modes", RELAXING, relaxation(weak))
    loss = [loss_factor(omega, weak) for omega in omegas(table.column("frequency [Hz]"))]
    twice = [2.0 * ratio for ratio in table.column("damping ratio")]
    first_order = sum(ratio for _, ratio in weak)
    report.relative("small ratios: twice the damping ratio is the loss factor", twice, loss, first_order)
    one = ["Analyses/motion/End Time=0.002", "Analyses/modes/Type=Modal", "Analyses/modes/Start From=Reference",
           "Analyses/modes/Damping=true", "Analyses/modes/Modes=6"]
    found = eigenvalues(culm.table("modes/modes", "beam/relaxing_rod.xml", one))
    wanted = relaxing(1.0, [(1.0, 0.5)])
    report.holds("a mass on a massless rod, relative,", min(abs(f - wanted) for f in found) / abs(wanted), 1e-8)


def verify_matrices(culm, report):
    import io

    from scipy import linalg
    from scipy.io import mmread
    from scipy.sparse.linalg import eigsh

    report.title("Matrices, read by SciPy")
    for form in ("Null Space", "Multipliers"):
        run = culm.succeed("modes/damped_frame.xml", [f"Solver/Form={form}"])
        read = {
            name: mmread(io.BytesIO(text.encode())).tocsr() for name, text in run.matrices.items()
        }
        K, M, C = read["stiffness"], read["mass"], read["damping"]
        for name in ("stiffness", "mass", "damping"):
            skew = abs(read[name] - read[name].T).max() / abs(read[name]).max()
            report.holds(f"{form}: {name} symmetric,", skew, 1e-12)
        Z = linalg.null_space(read["constraint_jacobian"].toarray())
        # eigsh wants a definite matrix to invert: the stiffness of a frame that is held
        inverse = eigsh(Z.T @ M @ Z, 6, Z.T @ K @ Z, which="LM", return_eigenvectors=False)
        found = sorted(1.0 / math.sqrt(nu) for nu in inverse)
        omega = omegas(run.tables["undamped/modes"].column("frequency [Hz]"))
        report.relative(f"{form}: omega by SciPy", found, omega, 1e-7)
        report.holds(f"{form}: C = eta K,", abs(C - 1e-3 * K).max() / abs(C).max(), 1e-9)
        P = read["null_space_basis"]
        report.check(f"{form}: motions", P.shape[1], K.shape[0], 0)


def verify_rounding(culm, report):
    report.title("Stiffness ratios beyond rounding: told by a warning")
    exact = CLAMPED_FREE[0] ** 2 / (2.0 * math.pi)
    for ratio, told in ((1e10, False), (1e12, True), (1e15, True)):
        stiff = [f"Sections/bar/{name}={ratio}" for name in ("EA", "GA1", "GA2")]
        run = culm.run("modes/cantilever.xml", stiff)
        error = run.tables["modes/modes"].at(1, "frequency [Hz]") / exact - 1.0
        report.check(f"EA/EI = {ratio:.0e}: off by {error:.1e}, warnings",
                     run.errors.count("rounding hides frequencies"), int(told), 0)


def verify_campbell(culm, report):
    report.title("Campbell diagram: one analysis for all speeds")
    table = culm.table("diagram/campbell", "modes/campbell.xml")
    pairs = [table.column(f"frequency {i} [Hz]") for i in (1, 2)]
    flapping, edgewise = (omegas(column) for column in sorted(pairs, key=lambda column: -column[-1]))
    for level, *found in zip(table.column("level"), edgewise, flapping):
        verify_speed(report, round(12 * level), *found)


def verify(culm, report):
    verify_cantilever(culm, report)
    verify_solvers(culm, report)
    verify_free(culm, report)
    verify_supports(culm, report)
    verify_linkage(culm, report)
    verify_rotating(culm, report)
    verify_plates(culm, report)
    verify_laminates(culm, report)
    verify_cylinder(culm, report)
    verify_l_frame(culm, report)
    verify_damping(culm, report)
    verify_relaxation(culm, report)
    verify_matrices(culm, report)
    verify_campbell(culm, report)
    verify_rounding(culm, report)


def fine(culm, report):
    verify_laminates(culm, report, is_whole=True)
    verify_rotating(culm, report, FLAPPING)


def plot_orders(culm, axes):
    counts = (8, 16, 32, 64)
    for order, mark in ((1, "o-"), (2, "s-"), (3, "^-")):
        errors = [bending(culm, n, order, 3)[2] / CLAMPED_FREE[2] ** 2 - 1 for n in counts]
        axes.loglog(counts, [abs(e) for e in errors], mark, ms=4, label=f"order {order}")
    axes.set_xlabel("elements")
    axes.set_ylabel("relative error of the third bending mode")
    mesh_axis(axes, counts)
    axes.legend()


def plot_rotating(culm, axes):
    speeds = [0.01, *FLAPPING]
    pairs = [rotating(culm, s) for s in speeds]
    axes.plot(speeds, [p[1] for p in pairs], label="flapping, culm")
    axes.plot(speeds, [p[0] for p in pairs], label="edgewise, culm")
    axes.plot([0, *FLAPPING], [3.5160, *FLAPPING.values()], "k.", label="Wright et al. 1982")
    axes.plot(speeds, speeds, ":", color="0.5", label="once per turn")
    axes.set_xlabel(r"speed $\Omega\sqrt{\rho A L^4/EI}$")
    axes.set_ylabel(r"$\omega\sqrt{\rho A L^4/EI}$")
    axes.legend()


LAMINATE_AXIS = r"$\omega a^2/h\,\sqrt{\rho/E_2}$"


def plot_slenderness(culm, axes):
    ratios = (4, 5, 7, 10, 20, 50, 100)
    for plies in (2, 8):
        values = [angle_ply(culm, (45, plies, ratio, False), 16) for ratio in ratios]
        axes.semilogx(ratios, values, label=f"{plies} plies, culm, 16 x 16")
        points = {ratio: value for (_, n, ratio, _), value in REDDY_PHAN.items() if n == plies}
        axes.plot(points.keys(), points.values(), "k.", label="Reddy and Phan 1985" if plies == 8 else None)
    mesh_axis(axes, ratios)
    axes.set_xlabel("a/h")
    axes.set_ylabel(f"[45/-45 ...]: {LAMINATE_AXIS}")
    axes.legend()


def plot_plies(culm, axes):
    plies = (2, 4, 6, 10)
    for free in (False, True):
        for angle in (30, 45):
            values = [angle_ply(culm, (angle, n, 10, free), 16) for n in plies]
            axes.plot(plies, values, label=f"[{angle}/-{angle}], {'two sides free' if free else 'supported'}")
    axes.plot([case[1] for case in KHDEIR], KHDEIR.values(), "k.", label="Khdeir 1988")
    axes.set_xticks(plies)
    axes.set_xlabel("plies, a/h = 10")
    axes.set_ylabel(LAMINATE_AXIS)
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.61), fontsize=7)


def plot(culm, path):
    fig, panels = figure(2, 7.0, rows=2)
    for draw, axes in zip((plot_orders, plot_rotating, plot_slenderness, plot_plies), panels.ravel()):
        draw(culm, axes)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot, fine)
