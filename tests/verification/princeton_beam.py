#!/usr/bin/python3
"""SB-10: Princeton beam, both parameter sets. Page: doc/verification/princeton_beam.md."""

import math

from verify import figure, main, save

DECK = "beam/princeton_beam.xml"
LARGEST = 13.345
ANGLES = (0, 15, 30, 45, 60, 75, 90)
# exact rod: load, angle: -uy, uz
SET_A = {
    8.896: dict(zip(ANGLES, [
        (0.0107128, 0.0), (0.0106436, 0.0421924), (0.0102076, 0.0795474), (0.0089792, 0.1091131),
        (0.0067420, 0.1299579), (0.0036220, 0.1422182), (0.0, 0.1462524)])),
    13.345: dict(zip(ANGLES, [
        (0.0160612, 0.0), (0.0165777, 0.0647342), (0.0169898, 0.1181795), (0.0156211, 0.1567746),
        (0.0119635, 0.1820038), (0.0064703, 0.1961387), (0.0, 0.2006840)])),
}
# the same, ANSYS beam, as printed by EXUDYN
ANSYS = {
    8.896: dict(zip(ANGLES, [
        (0.01071418, 0.0), (0.01061329, 0.04208232), (0.01011170, 0.07939483), (0.00883723, 0.10898794),
        (0.00660467, 0.12988762), (0.00353889, 0.14219437), (0.0, 0.14624598)])),
    13.345: dict(zip(ANGLES, [
        (0.01606424, 0.0), (0.01645826, 0.06435813), (0.01665873, 0.11773599), (0.01518618, 0.15646724),
        (0.01157838, 0.18186163), (0.00624897, 0.19609713), (0.0, 0.20067771)])),
}
# exact rod: load, angle: (ux, uy, uz), twist in degrees
SET_B = {
    4.448: dict(zip(ANGLES, [
        ((-0.0000339, -0.0053595, 0.0), 0.0), ((-0.0005438, -0.0052102, 0.0208014), 0.2227),
        ((-0.0019168, -0.0047511, 0.0399500), 0.3822), ((-0.0037470, -0.0039652, 0.0560560), 0.4360),
        ((-0.0055272, -0.0028622, 0.0681301), 0.3730), ((-0.0068003, -0.0015030, 0.0755726), 0.2135),
        ((-0.0072601, 0.0, 0.0780830), 0.0)])),
    8.896: dict(zip(ANGLES, [
        ((-0.0001356, -0.0107154, 0.0), 0.0), ((-0.0022409, -0.0106258, 0.0421258), 0.9058),
        ((-0.0076610, -0.0101473, 0.0794572), 1.5115), ((-0.0143897, -0.0088889, 0.1090431), 1.6650),
        ((-0.0204736, -0.0066544, 0.1299253), 1.3809), ((-0.0245844, -0.0035689, 0.1422163), 0.7739),
        ((-0.0260248, 0.0, 0.1462619), 0.0)])),
    13.345: dict(zip(ANGLES, [
        ((-0.0003048, -0.0160651, 0.0), 0.0), ((-0.0052985, -0.0165029, 0.0644973), 2.0937),
        ((-0.0171638, -0.0167781, 0.1179039), 3.3292), ((-0.0303618, -0.0153423, 0.1565899), 3.4847),
        ((-0.0412072, -0.0117165, 0.1819234), 2.7766), ((-0.0480756, -0.0063285, 0.1961271), 1.5187),
        ((-0.0504067, 0.0, 0.2006953), 0.0)])),
}


def run(culm, section, angle):
    """One run per angle: the smaller loads are levels on the way to the largest."""
    levels = ", ".join(f"{load}/{LARGEST}" for load in sorted(SET_B)[:-1])
    settings = [
        f"angle={angle}",
        f"load={LARGEST}",
        f"Structures/beam/Section={section}",
        f"Analyses/bending/Levels={{{levels}}}",
    ]
    return culm.history(DECK, settings)


def twist(history, load):
    """The angle of the strong axis d1, first along y, out of the x-y plane, in degrees."""
    matrix = exp_rotation(history.vector("tip rotation", load / LARGEST))
    return math.degrees(math.asin(matrix[2][1]))


def exp_rotation(r):
    angle = math.hypot(*r) or 1e-300
    x, y, z = (v / angle for v in r)
    s, c = math.sin(angle), 1.0 - math.cos(angle)
    return [
        [1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y],
        [c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x],
        [c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y)],
    ]


def verify(culm, report):
    report.title("Section A: (-uy, uz), 0.3 %")
    for angle in ANGLES:
        history = run(culm, "A", angle)
        for load, rows in SET_A.items():
            _, uy, uz = history.vector("tip", load / LARGEST)
            report.relative(f"{load} N, {angle} degrees", [-uy, uz], rows[angle], 3e-3)
            for name, found, wanted in zip(("-uy", "uz"), (-uy, uz), rows[angle]):
                if wanted:
                    report.relative(f"{load} N, {angle} degrees, {name}", found, wanted, 3e-3)
    report.title("Section B: (ux, uy, uz) and the twist, 0.3 %")
    for angle in ANGLES:
        history = run(culm, "B", angle)
        for load, rows in SET_B.items():
            u, turn = rows[angle]
            found = history.vector("tip", load / LARGEST)
            report.relative(f"{load} N, {angle} degrees", found, u, 3e-3)
            if turn:
                found = twist(history, load)
                report.relative(f"{load} N, {angle} degrees, twist", found, turn, 3e-3)


def plot(culm, path):
    fig, (flap_axes, edge_axes) = figure(2)
    for i, load in enumerate(SET_A):
        points = {angle: run(culm, "A", angle).vector("tip", load / LARGEST) for angle in ANGLES}
        pairs = [(edge_axes, lambda u: -u[1], 0), (flap_axes, lambda u: u[2], 1)]
        for axes, pick, k in pairs:
            axes.plot(ANGLES, [pick(points[a]) for a in ANGLES], f"C{i}-", label=f"culm, {load} N")
            axes.plot(ANGLES, [SET_A[load][a][k] for a in ANGLES], "o", color=f"C{i}", mfc="none")
            axes.plot(ANGLES, [ANSYS[load][a][k] for a in ANGLES], "x", color=f"C{i}")
    for axes, name in [(flap_axes, "flapwise uz"), (edge_axes, "edgewise -uy")]:
        axes.plot([], [], "ko", mfc="none", label="exact rod")
        axes.plot([], [], "kx", label="ANSYS beam")
        axes.set(xlabel="loading angle [degree]", ylabel=f"{name} of the tip [m]")
        axes.set_title("Section A, 32 elements of order 1")
        axes.legend(fontsize=7)
    save(fig, path)


if __name__ == "__main__":
    main(verify, plot)
