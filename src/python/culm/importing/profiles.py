"""Section values of profiles made of rectangles."""

import numpy


def i_section(origin, height, bottom, top, t_bottom, t_top, t_web, solid):
    """An I about its own axes: web along d2, flanges along d1.

    @param origin  from the lower face to the axis of the beam
    @param solid   Young Modulus, Poisson Ratio or Shear Modulus, Density
    @return values of a section 'Stiffness Values'"""
    E = solid["Young Modulus"]
    G = solid.get("Shear Modulus", E / (2.0 * (1.0 + solid.get("Poisson Ratio", 0.0))))
    web = height - t_bottom - t_top
    # width along d1, height along d2, height of the centre above the lower face
    walls = numpy.array(
        [(bottom, t_bottom, t_bottom / 2), (t_web, web, t_bottom + web / 2), (top, t_top, height - t_top / 2)]
    )
    width, tall, centre = walls.T
    area = width * tall
    A, from_axis = area.sum(), centre - origin
    I1 = (width * tall**3 / 12 + area * from_axis**2).sum()
    I2 = (tall * width**3 / 12).sum()
    S1 = (area * from_axis).sum()
    J = (numpy.maximum(width, tall) * numpy.minimum(width, tall) ** 3 / 3).sum()
    density = solid["Density"]
    values = {
        "EA": E * A, "GA1": G * 5 / 6 * (area[0] + area[2]), "GA2": G * area[1], "EI1": E * I1, "EI2": E * I2,
        "GIp": G * J, "ES1": E * S1, "rhoA": density * A, "rhoI1": density * I1, "rhoI2": density * I2,
        "rhoS1": density * S1,
    }  # fmt: skip
    return {key: float(value) for key, value in values.items()}
