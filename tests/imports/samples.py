"""Input files that CalculiX and culm both read: a plate, a layered cylinder panel, a frame, two
plates at a corner.

usage: samples.py FOLDER      (writes plate.inp, panel.inp, frame.inp, corner.inp)
"""

import math
import pathlib
import sys

STEPS = """*STEP
*STATIC
*{kind}
{static}
*NODE PRINT, NSET=WATCHED
U
*END STEP
*STEP
*FREQUENCY
4
*END STEP
*STEP
*BUCKLE
3
*CLOAD
{buckling}
*END STEP
"""


def grid(columns, rows, place):
    """Nodes and eight-node elements over a grid: numbers 1000 j + i + 1 at (2 columns, 2 rows)."""
    nodes = {
        1000 * j + i + 1: place(i / (2 * columns), j / (2 * rows))
        for j in range(2 * rows + 1)
        for i in range(2 * columns + 1)
        if i % 2 == 0 or j % 2 == 0
    }
    elements = {}
    for j in range(rows):
        for i in range(columns):
            a = 2000 * j + 2 * i + 1
            corners = [a, a + 2, a + 2002, a + 2000]
            elements[columns * j + i + 1] = corners + [a + 1, a + 1002, a + 2001, a + 1000]
    return nodes, elements


def lines(numbers):
    """A set, sixteen numbers to a line."""
    numbers = list(numbers)
    return "\n".join(", ".join(map(str, numbers[i : i + 16])) for i in range(0, len(numbers), 16))


def mesh(nodes, elements, type, name):
    text = "*NODE, NSET=ALL\n"
    text += "\n".join(f"{n}, " + ", ".join(f"{x:.12g}" for x in place) for n, place in nodes.items())
    text += f"\n*ELEMENT, TYPE={type}, ELSET={name}\n"
    return text + "\n".join(f"{e}, " + ", ".join(map(str, row)) for e, row in elements.items()) + "\n"


def edge_forces(numbers, total, direction):
    """Nodal forces of a load that is even along a row of quadratic elements."""
    share = total / ((len(numbers) - 1) // 2) / 6.0
    weights = {n: 0.0 for n in numbers}
    for i in range(0, len(numbers) - 2, 2):
        for n, w in zip(numbers[i : i + 3], (1, 4, 1)):
            weights[n] += w * share
    return "\n".join(f"{n}, {direction}, {w:.12g}" for n, w in weights.items())


def plate(n=8):
    """Simply supported, under pressure; pressed along x in the step of buckling."""
    nodes, elements = grid(n, n, lambda u, v: (u, v, 0.0))
    edge = lambda test: [k for k, p in nodes.items() if test(*p[:2])]  # noqa: E731
    left, right = edge(lambda x, y: x == 0), edge(lambda x, y: x == 1)
    rim = edge(lambda x, y: x in (0, 1) or y in (0, 1))
    middle = 1000 * n + n + 1
    return (
        "*HEADING\nSquare plate, simply supported\n"
        + mesh(nodes, elements, "S8R", "PLATE")
        + f"*NSET, NSET=RIM\n{lines(rim)}\n*NSET, NSET=LEFT\n{lines(left)}\n*NSET, NSET=WATCHED\n{middle}\n"
        + "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n"
        + "*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL\n0.01\n"
        + f"*BOUNDARY\nRIM, 3, 3\nLEFT, 1, 1\n1, 2, 2\n{2 * n + 1}, 2, 2\n"
        + STEPS.format(kind="DLOAD", static="PLATE, P, 100.", buckling=edge_forces(right, -1e4, 1))
    )


def panel(n=8, radius=1.0, angle=1.0, length=1.0):
    """A part of a cylinder about z with layers along the axis and around, [0/90/0]; clamped below,
    pushed at the middle, and pressed from above in the step of buckling. Each column of elements has
    a section of its own, so that the directions of the layers follow the surface."""
    half = 0.5 * angle

    def place(u, v):
        phi = angle * u - half
        return radius * math.cos(phi), radius * math.sin(phi), length * v

    nodes, elements = grid(n, n, place)
    bottom = [i + 1 for i in range(2 * n + 1)]
    top = [2000 * n + i + 1 for i in range(2 * n + 1)]
    middle = 1000 * n + n + 1
    text = "*HEADING\nCylinder panel of three layers\n" + mesh(nodes, elements, "S8R", "PANEL")
    text += f"*NSET, NSET=BOTTOM\n{lines(bottom)}\n*NSET, NSET=TOP\n{lines(top)}\n*NSET, NSET=WATCHED\n{middle}\n"
    text += "*MATERIAL, NAME=PLY\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
    text += "1.4E11, 1.0E10, 1.0E10, 0.3, 0.3, 0.4, 5.0E9, 5.0E9\n3.5E9\n*DENSITY\n1600.\n"
    for i in range(n):
        phi = angle * (i + 0.5) / n - half
        around = f"{-math.sin(phi):.12g}, {math.cos(phi):.12g}, 0."
        text += f"*ELSET, ELSET=COLUMN{i + 1}\n{lines(range(i + 1, n * n + 1, n))}\n"
        text += f"*ORIENTATION, NAME=AXIAL{i + 1}\n0., 0., 1., {around}\n"
        text += f"*ORIENTATION, NAME=AROUND{i + 1}\n{around}, 0., 0., 1.\n"
        text += f"*SHELL SECTION, ELSET=COLUMN{i + 1}, COMPOSITE\n"
        for layer in ("AXIAL", "AROUND", "AXIAL"):
            text += f"0.004, , PLY, {layer}{i + 1}\n"
    text += "*BOUNDARY\nBOTTOM, 1, 6\nTOP, 1, 2\n"
    return text + STEPS.format(kind="CLOAD", static=f"{middle}, 1, -100.", buckling=edge_forces(top, -1e4, 3))


def frame(n=6, height=3.0, width=4.0):
    """A portal of three members; pushed sideways at a corner, pressed on both in the step of buckling."""
    path = [(0.0, 0.0, height * i / (2 * n)) for i in range(2 * n + 1)]
    path += [(width * i / (2 * n), 0.0, height) for i in range(1, 2 * n + 1)]
    path += [(width, 0.0, height * (1 - i / (2 * n))) for i in range(1, 2 * n + 1)]
    nodes = {i + 1: p for i, p in enumerate(path)}
    elements = {e + 1: [2 * e + 1, 2 * e + 2, 2 * e + 3] for e in range(3 * n)}
    columns = [*range(1, n + 1), *range(2 * n + 1, 3 * n + 1)]
    first, second = 2 * n + 1, 4 * n + 1
    return (
        "*HEADING\nPortal frame\n"
        + mesh(nodes, elements, "B32R", "FRAME")
        + f"*ELSET, ELSET=COLUMNS\n{lines(columns)}\n*ELSET, ELSET=GIRDER\n{lines(range(n + 1, 2 * n + 1))}\n"
        + f"*NSET, NSET=FEET\n1, {6 * n + 1}\n*NSET, NSET=WATCHED\n{first}\n"
        + "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n"
        + "*BEAM SECTION, ELSET=COLUMNS, MATERIAL=STEEL, SECTION=RECT\n0.1, 0.15\n0., 1., 0.\n"
        + "*BEAM SECTION, ELSET=GIRDER, MATERIAL=STEEL, SECTION=RECT\n0.1, 0.2\n0., 1., 0.\n"
        + "*BOUNDARY\nFEET, 1, 6\n"
        + STEPS.format(kind="CLOAD", static=f"{first}, 1, 1000.", buckling=f"{first}, 3, -1e5\n{second}, 3, -1e5")
    )


def corner(n=12):
    """Two plates of 1 m that meet at a right angle, each a section of its own, clamped at one end; pushed at the far corner
    and on the fold, pressed on the upper edge in the step of buckling."""
    nodes, elements = {}, {}
    for i in range(2 * n + 1):
        for j in range(n + 1):
            nodes[100 * i + j + 1] = (min(i / n, 1.0), j / n, max(i / n - 1.0, 0.0))
    for i in range(2 * n):
        for j in range(n):
            a = 100 * i + j + 1
            elements[n * i + j + 1] = [a, a + 100, a + 101, a + 1]
    tip, fold = 200 * n + 1, 100 * n + n + 1
    top = [200 * n + j + 1 for j in range(n + 1)]
    shares = [0.5 if node in (top[0], top[-1]) else 1.0 for node in top]
    text = "*HEADING\nTwo plates at a corner\n" + mesh(nodes, elements, "S4", "PLATES")
    text += f"*ELSET, ELSET=FLOOR, GENERATE\n1, {n * n}, 1\n*ELSET, ELSET=WALL, GENERATE\n{n * n + 1}, {2 * n * n}, 1\n"
    text += f"*NSET, NSET=ROOT\n{lines(range(1, n + 2))}\n*NSET, NSET=WATCHED\n{tip}\n"
    text += "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n"
    for name in ("FLOOR", "WALL"):
        text += f"*SHELL SECTION, ELSET={name}, MATERIAL=STEEL\n0.02\n"
    pressed = "\n".join(f"{node}, 3, {-1e3 * share / n:.12g}" for node, share in zip(top, shares))
    text += "*BOUNDARY\nROOT, 1, 6\n"
    return text + STEPS.format(kind="CLOAD", static=f"{tip}, 1, 100.\n{fold}, 3, -200.", buckling=pressed)


def parts():
    """Abaqus alone: a strip of two elements as two instances, the second turned up by 90 degrees about y at the end of
    the first, their edges coupled to a point with a mass, which is pushed."""
    strip = "*Part, name=Strip\n*Node\n"
    strip += "".join(f"{i + 1 + 3 * j}, {i:g}., {j:g}., 0.\n" for j in (0, 1) for i in (0, 1, 2))
    strip += "*Element, type=S4R\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n*Nset, nset=Near\n1, 4\n*Nset, nset=Far\n3, 6\n"
    strip += "*Elset, elset=All, generate\n1, 2, 1\n*Shell Section, elset=All, material=Steel\n0.1, 5\n*End Part\n"
    text = "*Heading\nTwo strips at a corner\n" + strip + "*Assembly, name=Assembly\n"
    text += "*Instance, name=Flat, part=Strip\n*End Instance\n"
    text += "*Instance, name=Up, part=Strip\n2.5, 0., 0.\n2.5, 0., 0., 2.5, 1., 0., -90.\n*End Instance\n"
    text += "*Node, nset=Corner\n1, 2.5, 0.5, 0.\n*Element, type=MASS, elset=Weight\n1, 1\n*Mass, elset=Weight\n50.,\n"
    text += "*Nset, nset=Rim, instance=Flat\n3, 6\n*Nset, nset=Rim, instance=Up\n1, 4\n"
    text += "*Surface, type=NODE, name=Rim_surface\nRim, 1.\n*Elset, elset=Wall, instance=Up\n1, 2\n"
    text += "*Surface, type=ELEMENT, name=Outside\nWall, SPOS\n"
    text += "*Coupling, constraint name=Joint, ref node=Corner, surface=Rim_surface\n*Kinematic\n*End Assembly\n"
    text += "*Material, name=Steel\n*Density\n7850.,\n*Elastic\n2.1e11, 0.3\n*Boundary\nFlat.Near, ENCASTRE\n"
    text += "*Step, name=Push, nlgeom=YES\n*Static\n0.1, 1.\n*Cload\nCorner, 2, 300.\nUp.Far, 3, -20.\n"
    return text + "*Dsload\nOutside, P, 1000.\n*End Step\n*Step, name=Vibrate\n*Frequency\n5,\n*End Step\n"


def plane():
    """Abaqus alone: a portal of B21 in the plane of x and y, whose loads and supports are given anew, end and go on."""
    points = [(0, 0), (0, 1.5), (0, 3), (2, 3), (4, 3), (4, 1.5), (4, 0)]
    text = "*Heading\nPortal in a plane\n*Node\n" + "".join(f"{i}, {x:g}., {y:g}\n" for i, (x, y) in enumerate(points, 1))
    text += "*Element, type=B21, elset=All\n" + "".join(f"{i}, {i}, {i + 1}\n" for i in range(1, 7))
    text += "*Nset, nset=Feet\n1, 7\n*Beam Section, elset=All, material=Steel, section=PIPE\n0.1, 0.01\n0., 0., -1.\n"
    text += "*System\n*Material, name=Steel\n*Density\n7850.,\n*Elastic\n2.1e11, 0.3\n*Boundary\nFeet, ENCASTRE\n"
    text += "*Step, name=Wind, nlgeom=NO\n*Static\n1., 1.\n*Cload\n3, 1, 500.\n*Dload\nAll, PX, 20.\n*End Step\n"
    text += "*Step, name=Settle, nlgeo=YES\n*Static\n1., 1.\n*Boundary, op=NEW\n1, 1, 6\n*Boundary, op=NEW\n7, 1\n7, 2, 2, -0.01\n"
    text += "*Cload, op=NEW\n3, 2, -800.\n*Cload, op=NEW\n5, 2, -600.\n*End Step\n"
    text += "*Step, name=Buckle, perturbation\n*Buckle\n2, , 10, 30\n*Cload\n3, 2, -1000.\n*End Step\n"
    return text + "*Step, name=Vibrate, perturbation\n*Frequency\n4,\n*End Step\n"


SAMPLES = {"plate": plate, "panel": panel, "frame": frame, "corner": corner}

if __name__ == "__main__":
    for name, make in SAMPLES.items():
        (pathlib.Path(sys.argv[1]) / f"{name}.inp").write_text(make())
