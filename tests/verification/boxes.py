#!/usr/bin/python3
"""One turbulence in the formats of TurbSim, Bladed and HAWC2 on one turbine. Page: doc/verification/rotor.md."""

import pathlib
import struct
import tempfile

import numpy as np
from verify import INPUTS, main

DECK = INPUTS / "turbine/nrel5mw/turbine_turbulence.xml"
BOX = INPUTS / "turbine/nrel5mw/include/turbulence.bts"
SHORT = ["end=4", "Output/Every=1000"]
GIVEN = """      <Parameter name="Type" value="TurbSim Box"/>
      <Parameter name="File Name" value="include/turbulence.bts"/>
"""


def read_turbsim(path):
    """Header and velocities (times, upwards, across from the right, 3) of a .bts file."""
    data = path.read_bytes()
    kind, nz, ny, tower, nt, dz, dy, dt, speed, _, _, *scales, length = struct.unpack_from("<h4i6f6fi", data)
    values = np.frombuffer(data, "<i2", offset=struct.calcsize("<h4i6f6fi") + length).reshape(nt, 3 * (nz * ny + tower))
    grid = values[:, : 3 * nz * ny].reshape(nt, nz, ny, 3).astype(float)
    return (kind, nz, ny, nt, dz, dy, dt, speed), (grid - scales[1::2]) / scales[::2]


def write_bladed(path, header, fluctuations, kind):
    """A .wnd file of fluctuations beside the mean speed, as TurbSim writes it (4) or Bladed's Kaimal (7)."""
    _, nz, ny, nt, dz, dy, dt, speed = header
    intensities = fluctuations.std(axis=(0, 1, 2)) / speed
    numbers = np.rint(1000.0 * fluctuations / (intensities * speed))
    if kind == 4:
        data = struct.pack("<2hi6f", -99, 4, 3, 0.0, 0.03, 90.0, *(100.0 * intensities))
    else:
        numbers[..., 1] *= -1.0
        data = struct.pack("<2h2i", -99, 7, 92, 3)
    data += struct.pack("<3fi4f4i6f", dz, dy, dt * speed, nt // 2, speed, 0, 0, 0, 0, 1, nz, ny, *(6 * [0.0]))
    if kind == 7:
        data += struct.pack("<2f", 12.0, 340.0)
        assert len(data) == 92
    path.write_bytes(data + numbers.astype("<i2").tobytes())
    return {"Type": "Bladed Box", "File Name": path.name}, intensities


def array(values):
    return "{" + ", ".join(str(value) for value in values) + "}"


def thrust(culm, folder, wind):
    """Of the turbine in a wind with other parameters, whose files are in the folder."""
    lines = "".join(f'      <Parameter name="{name}" value="{value}"/>\n' for name, value in wind.items())
    text = DECK.read_text().replace(GIVEN, lines).replace('href="', f'href="{DECK.parent}/')
    (folder / "deck.xml").write_text(text)
    return np.array(culm.history(folder / "deck.xml", SHORT).column("rotor thrust [N]")[1:])


def compare(report, what, found, wanted, tolerance):
    report.holds(f"{what}: thrust, root of the mean square over its standard deviation",
                 float(np.sqrt(np.mean((found - wanted) ** 2)) / wanted.std()), tolerance)


def verify(culm, report):
    report.title("NREL 5 MW in 4 s of one turbulence, against the file of TurbSim")
    header, grid = read_turbsim(BOX)
    kind, nz, ny, nt, dz, dy, dt, speed = header
    mean = grid[..., 0].mean()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wanted = thrust(culm, folder, {"Type": "TurbSim Box", "File Name": BOX})
        box, _ = write_bladed(folder / "turbsim.wnd", header, grid - [speed, 0.0, 0.0], 4)
        sides = {"Components Across": "Left", "Periodic": "true" if kind == 8 else "false"}
        compare(report, "TurbSim's .wnd", thrust(culm, folder, {**box, **sides}), wanted, 1e-3)
        # the others hold fluctuations only: a mean wind of one speed is added
        law = {"Speed": mean, "Height": 90, "Exponent": 0, "Delay": 0.5 * (ny - 1) * dy / speed}
        box, intensities = write_bladed(folder / "bladed.wnd", header, grid - [mean, 0.0, 0.0], 7)
        bladed = thrust(culm, folder, {**box, **law, "Intensities": array(intensities * speed / mean)})
        names = [f"mann_{letter}.bin" for letter in "uvw"]
        for component, one in enumerate(names):
            # upwards fastest, then across from the left, then planes
            values = (grid - [mean, 0.0, 0.0])[:, :, ::-1, component].transpose(0, 2, 1)
            values.astype("<f4").tofile(folder / one)
        mann = thrust(culm, folder, {"Type": "Mann Box", "File Names": array(names), "Points": array((nt, ny, nz)),
                                     "Spacing": array((dt * speed, dy, dz)), **law})
        for what, found in (("Bladed's .wnd and a mean wind", bladed), ("HAWC2's files and a mean wind", mann)):
            compare(report, what, found, wanted, 1e-3)


if __name__ == "__main__":
    main(verify)
