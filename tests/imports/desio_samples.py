"""Models of DeSiO-Structure, written by hand: a cantilever rolled up, and a rotor on a post with springs."""

HEAD = "!!\n!!\n!! {}\n"


def numbers(values):
    return " ".join(f"{value:.15e}".replace("e", "d") for value in values)


def table(title, rows):
    """A count and lines, as the files of constraints and loads have them."""
    return HEAD.format(f"number of {title}") + f"{len(rows)}\n" + HEAD.format(title) + "\n".join(rows) + "\n"


def beam(name, start, step, elements, sections):
    """A straight beam; d1 is y along x, else x."""
    d3 = [component / sum(c * c for c in step) ** 0.5 for component in step]
    d1 = [0.0, 1.0, 0.0] if abs(d3[0]) > 0.5 else [1.0, 0.0, 0.0]
    d2 = [d3[1] * d1[2] - d3[2] * d1[1], d3[2] * d1[0] - d3[0] * d1[2], d3[0] * d1[1] - d3[1] * d1[0]]
    text = HEAD.format(f"beam {name}: number of nodes (1), number of elements (2):") + f"{elements + 1} {elements}\n"
    text += HEAD.format(f"beam {name}: nodal phi (1, 2, 3), nodal d1 (4, 5, 6), nodal d2 (7, 8, 9), nodal d3 (10, 11, 12):")
    for i in range(elements + 1):
        text += numbers([*(s + i * h for s, h in zip(start, step)), *d1, *d2, *d3]) + "\n"
    text += HEAD.format(f"beam {name}: connectivities (1, 2), cross-section property (3):")
    return text + "".join(f"{i + 1} {i + 2} {sections[i % len(sections)]}\n" for i in range(elements))


def beams(bodies, sections, flag=0):
    """@param sections  stiffness, mass and dissipation of each"""
    text = HEAD.format("number of beams (1), number of cross-section properties (2), flag for property input type (3):")
    text += f"{len(bodies)} {len(sections)} {flag}\n" + "".join(bodies)
    for i, section in enumerate(sections, 1):
        text += f"!! cross-section property {i} (bar):\n!! row1\n!! row2\n"
        text += "".join(numbers(row) + "\n" for row in section)
    return text


def simulation(kind, settings, gravity=(0, 0, 0)):
    text = HEAD.format("filename") + "solution none\n" + HEAD.format("number of simulations:") + "1\n"
    text += f"!! settings\n!! row 1\n!! row 2\n{kind}\n{settings}\n0\n"
    return text + HEAD.format("gravity vector (1, 2, 3):") + numbers(gravity) + "\n"


NO_VECTORS = numbers([0.0] * 9)
# tube of 0.08 and 0.06 m: A, I
AREA, INERTIA = 8.796459430051421e-03, 2.199114857512855e-05
E, G, RHO = 2.1e11, 8.0e10, 7850.0
TUBE = (
    [E * AREA, 0.5 * G * AREA, 0.5 * G * AREA, E * INERTIA, E * INERTIA, 2 * G * INERTIA, 0, 0, 0, 0, 0],
    [RHO * AREA, RHO * INERTIA, RHO * INERTIA, 0, 0, 0],
    [0, 0],
)
ELEMENTS, MOMENT = 10, 2.3e7


def cantilever():
    """1 m long, ten elements, an end moment."""
    internal = [f"internal {i} 0 {NO_VECTORS}" for i in range(2, ELEMENTS + 2)]
    return {
        "simulationinput_structure.txt": simulation("static", "1 0.1 1d-8 50 0"),
        "beaminput.txt": beams([beam("bar", (0, 0, 0), (1.0 / ELEMENTS, 0, 0), ELEMENTS, [1])], [TUBE]),
        "constraint12input.txt": table("constraints", [f"rigidsupport 1 0 {NO_VECTORS}", *internal]),
        "load12input.txt": table(
            "loads", [f"linear {MOMENT:.6e} 1.0 {ELEMENTS + 1} {numbers([0, 0, 0, 0, -1, 0] + [0] * 6)}"]
        ),
    }


def voigt(values, mass, dissipation):
    """The same section in the order of the 21 values."""
    EA, GA1, GA2, EI1, EI2, GIp, ES1, ES2, GS1, GS2, EI12 = values
    rhoA, rhoI1, rhoI2, rhoS1, rhoS2, rhoI12 = mass
    stiffness = [GA1, GA2, EA, EI1, EI2, GIp, 0, 0, 0, GS2, -GS1, 0, 0, 0, 0, 0, ES1, -EI12, -ES2, 0, 0]
    return stiffness, [rhoA, rhoI2, rhoI1, rhoI12, rhoS1, rhoS2], dissipation


SOFT = ([E * AREA, G * AREA / 2, G * AREA / 2, E * INERTIA / 4, E * INERTIA, G * INERTIA, 1e6, 2e6, 3e5, 4e5, 5e4],
        [50.0, 0.2, 0.3, 1.0, 2.0, 0.05], [0.1, 0.0])  # fmt: skip


def rotor():
    """A post, a hub on it that turns about x, two blades, springs at the foot, a drive by its speed."""
    body = HEAD.format("number of rigid bodies (1), number of body properties (2):") + "1 1\n"
    body += HEAD.format("rigid body 1, hub phi(1:3), d1(4:6) d2(7:9), d3(10:12)")
    body += numbers([1, 0, 10, 0, 1, 0, -1, 0, 0, 0, 0, 1]) + "\n" + HEAD.format("rigid body 1, hub property") + "1\n"
    body += HEAD.format("rigid body 1 property, hub mass(1), J11(2), J22(3), J33(4), J23(5), J13(6), S3, S2, S1, J12")
    body += numbers([200, 30, 20, 25, 1, -2, 20, 0, 10, 3]) + "\n"
    post = beam("post", (0, 0, 0), (0, 0, 2.5), 4, [1])
    blades = [
        beam("blade 1", (1, 0, 10.5), (0, 0, 1.0), 4, [1, 2]),
        beam("blade 2", (1, 0.5, 10), (0, 1.0, 0), 4, [2]),
    ]
    x_in_hub = numbers([0, 0, 0] + [0, 0, 0] + [0, -1, 0])
    return {
        "simulationinput_structure.txt": simulation("dynamic", "0.05 0.01 1d-8 50 1", (0, 0, -9.81)),
        "rigidbodyinput.txt": body,
        "beaminput.txt": beams([post, *blades], [voigt(*TUBE), voigt(*SOFT)], 1),
        "pointmass12input.txt": HEAD.format("number of point masses") + "1\n" + HEAD.format("node, mass") + "6 30d0\n",
        "constraint12input.txt": table(
            "constraints",
            [
                f"sphericalsupport 2 0 {NO_VECTORS}",
                f"rotation_global 2 0 {numbers([0] * 6 + [0, 0, 1])}",
                f"revolutejoint 1 6 {x_in_hub}",
                f"rigidconnection 1 7 {NO_VECTORS}",
                f"rigidconnection 1 12 {NO_VECTORS}",
                f"internal 1 0 {NO_VECTORS}",
            ],
        ),
        "boundary12input.txt": table("inhomogeneous constraints", ["linearC 0.1 0.05 2 none"]),
        "spring12input.txt": HEAD.format("springs, curves") + "2 1\n" + HEAD.format("springs")
        + "translatory_global 4 1 1d0 0d0 0d0\ntranslatory_inplane 4 1 0d0 0d0 1d0\n"
        + HEAD.format("curve") + "3\n-1d0 -1d5\n0d0 0d0\n1d0 1d5\n",
        "damping12input.txt": HEAD.format("dampers, curves") + "1 1\n" + HEAD.format("dampers")
        + "angularvelocity_local 1 1 0d0 1d0 0d0\n" + HEAD.format("curve") + "3\n-1d0 -5d1\n0d0 0d0\n1d0 5d1\n",
        "load12input.txt": table(
            "loads", [f"triangle 100.0 0.04 16 {numbers([1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0.5])}"]
        ),
    }  # fmt: skip
