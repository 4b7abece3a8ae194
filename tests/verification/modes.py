#!/usr/bin/python3
"""MO-6, MO-5: natural frequencies of beams, rotating beams and plates. Page: doc/verification/modes.md."""

import math

from verify import figure, main, mesh_axis, richardson, save

BEAM = "modes/cantilever.xml"
ROTATING = "modes/rotating_beam.xml"
CURVE = "Structures/beam/Curve/Elements"
# beta L of uniform beams: roots of cos x cosh x = -1, of cos x cosh x = 1, multiples of pi
CLAMPED_FREE = (1.87510407, 4.69409113, 7.85475744, 10.9955407, 14.1371684)
FREE_FREE = (4.73004074, 7.85320462, 10.9956078, 14.1371655)
# first flapping frequency over the speed: Wright, Smith, Thresher, Wang, J. Appl. Mech. 49 (1982)
FLAPPING = {1: 3.6816, 2: 4.1373, 3: 4.7973, 4: 5.5850, 6: 7.3604, 8: 9.2568, 10: 11.2023, 12: 13.1702}
# NAFEMS FV52: simply supported, thickness 1; FV12: free, thickness 0.05 [Hz]
FV52 = (45.897, 109.44, 109.44, 167.89)
FV12 = (1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668)
# omega a^2 / h sqrt(rho / E2) of [45/-45] n times, over a/h
REDDY_PHAN = {1: {10: 13.044, 20: 14.179, 50: 14.561, 100: 14.618}, 4: {10: 19.289, 100: 25.176}}


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


def rotating(culm, speed, settings=()):
    """Edgewise and flapping frequencies of the first pair: those that displace along y and z."""
    table = culm.table("modes/modes", ROTATING, [f"Loads/rotation/Speed={speed}", *settings])
    flap = table.column("effective mass z [kg]")
    omega = omegas(table.column("frequency [Hz]"))
    flapping = [w for w, mass in zip(omega, flap) if mass > 1e-6]
    edgewise = [w for w, mass in zip(omega, flap) if mass <= 1e-6]
    return edgewise[0], flapping[0]


def verify_rotating(culm, report):
    report.title("MO-6: beam that turns about its root")
    for speed, reference in FLAPPING.items():
        edgewise, flapping = rotating(culm, speed)
        report.relative(f"speed {speed}, flapping", flapping, reference, 3e-4)
        # the stretch that the speed causes, speed^2 / (3 EA), and Coriolis forces are small
        softened = math.sqrt(reference**2 - speed**2)
        report.relative(f"speed {speed}, edgewise", edgewise, softened, 2e-3)


def plate(culm, deck, elements):
    return frequencies(culm, deck, [f"Structures/plate/Mesh/Elements={{{elements}, {elements}}}"])


def verify_plates(culm, report):
    for name, deck, references in (
        ("FV52, simply supported", "modes/plate.xml", FV52),
        ("FV12, free", "modes/free_plate.xml", FV12),
    ):
        report.title(f"MO-5: NAFEMS {name}, 32 x 32, and the limit of 16 and 32")
        rows = [[f for f in plate(culm, deck, n) if f > 0.0] for n in (16, 32)]
        for coarse, fine, reference in zip(*rows, references):
            report.relative("frequency [Hz]", fine, reference, 0.02)
            report.relative("extrapolated", richardson(coarse, fine), reference, 0.01)
    found = frequencies(culm, "modes/free_plate.xml")
    report.check("free: modes at 0 Hz", sum(f == 0.0 for f in found), 6, 0)


def verify_laminates(culm, report):
    report.title("MO-5: angle-ply plates [45/-45], Reddy and Phan 1985, limit of 8 and 16")
    for repeat, references in REDDY_PHAN.items():
        for ratio, reference in references.items():
            values = []
            for n in (8, 16):
                settings = [
                    f"Structures/shell/Mesh/Elements={{{n}, {n}}}",
                    f"Structures/shell/Thickness={1.0 / (2 * repeat * ratio)}",
                    f"Structures/shell/Repeat={repeat}",
                ]
                omega = omegas(frequencies(culm, "modes/angle_ply.xml", settings))[0]
                values.append(omega * ratio)
            what = f"{2 * repeat} plies, a/h = {ratio}"
            report.relative(what, richardson(*values), reference, 0.01)


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
    flapping = omegas(max(pairs, key=lambda column: column[-1]))
    for level, omega in zip(table.column("level"), flapping):
        speed = round(12 * level)
        report.relative(f"speed {speed}, flapping", omega, FLAPPING.get(speed, 3.5160), 3e-4)


def verify(culm, report):
    verify_cantilever(culm, report)
    verify_solvers(culm, report)
    verify_free(culm, report)
    verify_rotating(culm, report)
    verify_plates(culm, report)
    verify_laminates(culm, report)
    verify_damping(culm, report)
    verify_matrices(culm, report)
    verify_campbell(culm, report)
    verify_rounding(culm, report)


def plot(culm, path):
    fig, (left, right) = figure(columns=2)
    counts = (8, 16, 32, 64)
    for order, mark in ((1, "o-"), (2, "s-"), (3, "^-")):
        errors = [bending(culm, n, order, 3)[2] / CLAMPED_FREE[2] ** 2 - 1 for n in counts]
        left.loglog(counts, [abs(e) for e in errors], mark, ms=4, label=f"order {order}")
    left.set_xlabel("elements")
    left.set_ylabel("relative error of the third bending mode")
    mesh_axis(left, counts)
    left.legend()
    speeds = [0.01, *FLAPPING]
    pairs = [rotating(culm, s) for s in speeds]
    right.plot(speeds, [p[1] for p in pairs], label="flapping, culm")
    right.plot(speeds, [p[0] for p in pairs], label="edgewise, culm")
    right.plot([0, *FLAPPING], [3.5160, *FLAPPING.values()], "k.", label="Wright et al. 1982")
    right.plot(speeds, speeds, ":", color="0.5", label="once per turn")
    right.set_xlabel(r"speed $\Omega\sqrt{\rho A L^4/EI}$")
    right.set_ylabel(r"$\omega\sqrt{\rho A L^4/EI}$")
    right.legend()
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
