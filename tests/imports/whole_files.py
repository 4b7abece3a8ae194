"""Small files of all formats, of our own, that tests damage: name -> (format, {file name: text})."""

import ansys_samples
import desio_samples
import gmsh_samples
import nastran_samples
import samples
import turbine_samples

WHOLE_FILES = {
    "plate.inp": ("abaqus", {"plate.inp": samples.plate(2)}),
    "panel.inp": ("abaqus", {"panel.inp": samples.panel(2)}),
    "parts.inp": ("abaqus", {"parts.inp": samples.parts()}),
    "plate.cdb": ("ansys", {"plate.cdb": ansys_samples.model()}),
    "plate in blocks": ("ansys", {"plate.cdb": ansys_samples.model_in_blocks()}),
    "panel.bdf": ("nastran", {"panel.bdf": nastran_samples.panel()}),
    "frame.bdf": ("nastran", {"frame.bdf": nastran_samples.frame()}),
    "turbine of windIO": ("windio", {"turbine.yaml": turbine_samples.windio()}),
    "turbine of windIO 2": ("windio", {"turbine.yaml": turbine_samples.windio_2()}),
    "blade of HAWC2": ("hawc2", turbine_samples.hawc2()),
    "table of sections": ("csv", {"bar.csv": turbine_samples.table()}),
    "cantilever of DeSiO": ("desio", desio_samples.cantilever()),
    "rotor of DeSiO": ("desio", desio_samples.rotor()),
    "strip of DeSiO": ("desio", desio_samples.strip()),
    "laminate of DeSiO": ("desio", desio_samples.laminate()),
    "corner.inp": ("abaqus", {"corner.inp": samples.corner(2)}),
    "plane.inp": ("abaqus", {"plane.inp": samples.plane()}),
    "frame.inp": ("abaqus", {"frame.inp": samples.frame(2)}),
    **{
        name: ("gmsh", {"sheet.msh": data})
        for name, data, kind, order in gmsh_samples.all_forms()
        if (kind, order) in ((gmsh_samples.QUAD, 1), (gmsh_samples.TRIANGLE, 2))
    },
}
