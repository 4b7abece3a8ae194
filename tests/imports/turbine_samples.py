"""A blade in the forms of windIO and HAWC2 and a bar as a table, written by hand."""

import numpy
import yaml

UPPER = numpy.triu_indices(6)
GRID = [0.0, 0.3, 1.0]
# stiffness and mass at the stations, in the order shear x, shear y, stretch, bending x, bending y, twist
STIFF = [
    numpy.diag([4e8, 3e8, 6e9, 2e9, 1e9, 5e8]) * scale + numpy.array(
        [[0, 0, 0, 0, 0, 1e7], [0, 0, 0, 0, 0, 2e7], [0, 0, 0, 8e7, -6e7, 0], [0, 0, 8e7, 0, 3e7, 0],
         [0, 0, -6e7, 3e7, 0, 0], [1e7, 2e7, 0, 0, 0, 0]]) * scale
    for scale in (1.0, 0.5, 0.05)
]  # fmt: skip
MASSES = [300.0, 150.0, 20.0]


def mass_matrix(m, x=0.1, y=-0.05):
    """Of a plane section with its centre at (x, y)."""
    inertia_x, inertia_y = 0.4 * m, 0.2 * m
    found = numpy.diag([m, m, m, inertia_x, inertia_y, inertia_x + inertia_y])
    for i, j, value in ((0, 5, -m * y), (1, 5, m * x), (2, 3, m * y), (2, 4, -m * x), (3, 4, 0.01 * m)):
        found[i, j] = found[j, i] = value
    return found


def row(values):
    return "[" + ", ".join(f"{value:.10g}" for value in values) + "]"


def windio():
    """A bent, twisted blade, a tower on a monopile."""

    def table(pad, grid, values):
        return f"{pad}grid: {row(grid)}\n{pad}values: {row(values)}\n"

    axis = {"x": [0.0, 0.1, -1.0], "y": [0.0, 0.0, 0.0], "z": [0.0, 12.0, 40.0]}
    text = "name: small turbine\nassembly:\n    number_of_blades: 3\ncomponents:\n  blade:\n    elastic_properties_mb:\n      six_x_six:\n"
    text += "        reference_axis:\n" + "".join(f"          {k}:\n" + table(" " * 12, GRID, v) for k, v in axis.items())
    text += "        twist:\n" + table(" " * 10, GRID, [0.25, 0.1, -0.02])
    for name, matrices in (("stiff_matrix", STIFF), ("inertia_matrix", [mass_matrix(m) for m in MASSES])):
        text += f"        {name}:\n          grid: {row(GRID)}\n          values:\n"
        text += "".join(f"            - {row(matrix[UPPER])}\n" for matrix in matrices)
    for name, ends, diameters in (("monopile", (-20.0, 5.0), (6.0, 6.0)), ("tower", (5.0, 60.0), (6.0, 4.0))):
        text += f"  {name}:\n" + ("    transition_piece_mass: 5000.0\n" if name == "monopile" else "")
        text += "    outer_shape_bem:\n      reference_axis:\n"
        for k, v in (("x", (0.0, 0.0)), ("y", (0.0, 0.0)), ("z", ends)):
            text += f"        {k}:\n" + table(" " * 10, [0.0, 1.0], v)
        text += "      outer_diameter:\n" + table(" " * 8, [0.0, 1.0], diameters)
        text += "    internal_structure_2d_fem:\n      outfitting_factor: 1.1\n      layers:\n        - name: wall\n"
        text += "          material: steel\n          thickness:\n" + table(" " * 12, [0.0, 1.0], [0.05, 0.03])
    return text + "materials:\n  - name: steel\n    orth: 0\n    rho: 7800\n    E: 200.e+9\n    nu: 0.3\n    G: 79.3e+9\n"


def windio_2():
    """The same in the second form of the ontology."""
    root = yaml.safe_load(windio())
    parts = root["components"]
    six = parts["blade"].pop("elastic_properties_mb")["six_x_six"]
    parts["blade"]["reference_axis"] = six["reference_axis"]
    parts["blade"]["outer_shape"] = {"twist": {"grid": GRID, "values": numpy.degrees(six["twist"]["values"]).tolist()}}
    columns = {f"K{i + 1}{j + 1}": [float(matrix[i, j]) for matrix in STIFF] for i, j in zip(*UPPER)}
    mass = {"mass": MASSES, "cm_x": [0.1] * 3, "cm_y": [-0.05] * 3}
    mass |= {name: [factor * m for m in MASSES] for name, factor in (("i_edge", 0.4), ("i_flap", 0.2), ("i_plr", 0.6), ("i_cp", -0.01))}
    elastic = {"stiffness_matrix": {"grid": GRID, **columns}, "inertia_matrix": {"grid": GRID, **mass}}
    parts["blade"]["structure"] = {"elastic_properties": elastic}
    for name in ("monopile", "tower"):
        shape = parts[name].pop("outer_shape_bem")
        parts[name]["reference_axis"] = shape.pop("reference_axis")
        parts[name]["outer_shape"] = shape
        parts[name]["structure"] = parts[name].pop("internal_structure_2d_fem")
    return yaml.safe_dump({"windIO_version": "2.0", **root}, sort_keys=False)


# r, m, x_cg, y_cg, ri_x, ri_y, x_sh, y_sh, E, G, I_x, I_y, I_p, k_x, k_y, A, pitch, x_e, y_e
CLASSIC = [0.0, 300.0, 0.02, 0.01, 0.4, 0.7, -0.1, 0.03, 2e10, 8e9, 0.02, 0.06, 0.03, 0.6, 0.5, 0.3, 12.0, 0.05, -0.02]


def hawc2():
    """A htc file with one body, and its st file with both kinds of sections."""
    names = "r m x_cg y_cg ri_x ri_y x_sh y_sh E G I_x I_y I_p k_x k_y A pitch x_e y_e"
    rows = [[r, *(value * scale if name in ("m", "A") else value for name, value in zip(names.split()[1:], CLASSIC[1:]))]
            for r, scale in ((0.0, 1.0), (10.0, 0.8), (30.0, 0.3))]  # fmt: skip
    st = "1 ; number of sets\n#1 a blade\n" + names.replace(" ", "\t") + "\n$1 3 classic\n"
    st += "".join("\t".join(f"{value:.10e}" for value in one) + "\n" for one in rows)
    st += "$2 2 full\n"
    for r in (0.0, 30.0):
        values = [r, 300.0, 0.02, 0.01, 0.4, 0.7, 12.0, 0.05, -0.02, *numpy.diag([4e8, 3e8, 6e9, 2e9, 1e9, 5e8])[UPPER]]
        st += " ".join(f"{value:.10e}" for value in values) + "\n"
    htc = "begin new_htc_structure;\n  begin main_body; the blade\n    name blade1 ;\n    type timoschenko ;\n"
    htc += "    begin timoschenko_input ;\n      filename ./blade.st ;\n      set 1 1 ;\n    end timoschenko_input;\n"
    htc += "    begin c2_def;\n      nsec 3 ;\n      sec 1 0.0 0.0 0.0 -14.0 ; x y z twist\n      sec 2 -0.1 0.2 10.0 -6.0 ;\n"
    htc += "      sec 3 0.0 -0.5 30.0 1.0 ;\n    end c2_def ;\n  end main_body;\nend new_htc_structure;\n"
    return {"blade.htc": htc, "blade.st": st}


# a bar of steel, 0.2 m by 0.1 m, 4 m long
BAR = {"EA": 4.2e9, "GA1": 1.3e9, "GA2": 1.3e9, "EI1": 3.5e6, "EI2": 1.4e7, "GIp": 3.7e6, "rhoA": 157.0}
LENGTH = 4.0


def table():
    """The bar by three stations."""
    text = "# a bar of steel\nposition," + ",".join(BAR) + "\n"
    return text + "".join(f"{z}," + ",".join(f"{value:.10g}" for value in BAR.values()) + "\n" for z in (0.0, 1.0, LENGTH))
