"""Models of DeSiO-Structure, written by hand: a cantilever rolled up, and a rotor on a post with springs."""

HEAD = "!!\n!!\n!! {}\n"


def numbers(values):
    return " ".join(f"{value:.15e}".replace("e", "d") for value in values)


def table(title, rows):
    """A count and lines, as the files of constraints and loads have them."""
    return HEAD.format(f"number of {title}") + f"{len(rows)}\n" + HEAD.format(title) + "\n".join(rows) + "\n"


def beam(name, start, step, elements, sections, backwards=False):
    """A straight beam; d1 is y along x, else x; backwards d3 is against the order of the nodes."""
    d3 = [(-1) ** backwards * component / sum(c * c for c in step) ** 0.5 for component in step]
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


def cantilever(backwards=False):
    """1 m long, ten elements, an end moment."""
    internal = [f"internal {i} 0 {NO_VECTORS}" for i in range(2, ELEMENTS + 2)]
    return {
        "simulationinput_structure.txt": simulation("static", "1 0.1 1d-8 50 0"),
        "beaminput.txt": beams([beam("bar", (0, 0, 0), (1.0 / ELEMENTS, 0, 0), ELEMENTS, [1], backwards)], [TUBE]),
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


def shell(start, length, width, elements, across=2):
    """Nodes (place, director) and elements of a flat strip along x, numbered from 1; the director is z."""
    nodes = [
        [start + length * i / elements, width * j / across, 0.0, 0.0, 0.0, 1.0] for i in range(elements + 1) for j in range(across + 1)
    ]
    row = across + 1
    corners = [(i * row + j + 1, (i + 1) * row + j + 1, (i + 1) * row + j + 2, i * row + j + 2) for i in range(elements) for j in range(across)]
    return nodes, corners


def shells(parts, materials, sequences):
    """@param parts  (nodes, corners, sequence) of each shell"""
    text = HEAD.format("number of shells (1), number of material properties (2), number of material sequences (3)")
    text += f"{len(parts)} {len(materials)} {len(sequences)}\n"
    for nodes, corners, sequence in parts:
        text += HEAD.format("shell: number of nodes (1), number of elements (2).") + f"{len(nodes)} {len(corners)}\n"
        text += HEAD.format("shell: nodal phi (1, 2, 3), nodal d (4, 5, 6).") + "".join(numbers(node) + "\n" for node in nodes)
        text += HEAD.format("shell: connectivities (1, 2, 3, 4), material sequence (5).")
        text += "".join(" ".join(map(str, (*four, sequence))) + "\n" for four in corners)
    for constants, density in materials:
        text += HEAD.format("material property: row 1, E1 (1), …") + numbers(constants).replace(" ", ", ") + f"\n{density}\n0.0 0.0\n"
    for layers in sequences:
        text += HEAD.format("material sequence") + f"{len(layers)}\n"
        text += "".join(" ".join(f"{layer[i]}" for layer in layers) + "\n" for i in range(3))
    return text


STEEL = ([E, E, E, E / 2, E / 2, E / 2, 0, 0, 0], RHO)
PLY = ([1.4e11, 1e10, 1e10, 3.5e9, 5e9, 5e9, 0.4, 0.3, 0.3], 1600.0)
STRIP, WALL = (8, 1.0, 0.1), 0.01  # elements, length, width; thickness


def strip():
    """Clamped, of two shells that go on into each other in the middle; its modes."""
    n, length, width = STRIP
    first, second = shell(0.0, length / 2, width, n // 2), shell(length / 2, length / 2, width, n // 2)
    count = len(first[0])
    clamped = [f"revolutesupport {i} 0 {NO_VECTORS}" for i in (1, 2, 3)]
    joined = [f"revolutejoint {count - 2 + i} {count + 1 + i} {NO_VECTORS}" for i in range(3)]
    return {
        "simulationinput_structure.txt": simulation("modal", "4 1d-8 0.0 1d6 0"),
        "shellinput.txt": shells([(*first, 1), (*second, 1)], [STEEL], [[(1, WALL, 0)]]),
        "constraint6input.txt": table("constraints for nodes with 6 coordinates", clamped + joined),
    }


def laminate():
    """A strip of layers, its director against the normal, pulled at its end, on the end of a beam, with a mass and a fold."""
    nodes, corners = shell(1.0, 1.0, 0.2, 4)
    nodes = [[*node[:3], 0.0, 0.0, -1.0] for node in nodes]
    flap = [[2.0, 0.1 * j, -0.5 * i, 1.0, 0.0, 0.0] for i in range(2) for j in range(3)]
    quads = [(4, 5, 2, 1), (5, 6, 3, 2)]
    tie = [f"softtransition 5 {i}" for i in (1, 2, 3)]
    fold = [f"inextensiblerevolutejoint {12 + i} {15 + i} {NO_VECTORS}" for i in (1, 2, 3)]
    held = [f"simplesupport 19 0 {numbers([0.0] * 6)} 0d0 0d0 1d0", f"internal 5 0 {NO_VECTORS}"]
    force = numbers([1.0, 0.0, 0.0, 0.0])
    return {
        "simulationinput_structure.txt": simulation("static", "1 0.5 1d-8 50 0"),
        "beaminput.txt": beams([beam("post", (0, 0.1, 0), (0.25, 0, 0), 4, [1])], [TUBE]),
        "constraint12input.txt": table("constraints for nodes with 12 coordinates", [f"rigidsupport 1 0 {NO_VECTORS}"]),
        "shellinput.txt": shells([(nodes, corners, 1), (flap, quads, 2)], [PLY, STEEL], [[(1, 0.002, 30.0), (1, 0.004, 0.0)], [(2, 0.003, 0.0)]]),
        "constraint6input.txt": table("constraints for nodes with 6 coordinates", fold + held),
        "constraint6to12input.txt": table("constraints 6 to 12", tie),
        "load6input.txt": table("loads for nodes with 6 coordinates", [f"linear 2d0 1d0 21 {force}"]),
        "boundary6input.txt": table("motions of constraints", ["linear 1d-3 1d0 4 nofile"]),
        "pointmass6input.txt": table("point masses", ["14 3.5"]),
    }
