"""What the numbers of the result files are, in words, and their units."""

RESULTANTS = {
    "Beam": {
        "N1": ("shear force", "N"),
        "N2": ("shear force", "N"),
        "N3": ("axial force", "N"),
        "M1": ("bending moment", "N m"),
        "M2": ("bending moment", "N m"),
        "M3": ("torque", "N m"),
    },
    "Shell": {
        "N11": ("membrane force", "N/m"),
        "N22": ("membrane force", "N/m"),
        "N12": ("membrane shear", "N/m"),
        "M11": ("bending moment", "N m/m"),
        "M22": ("bending moment", "N m/m"),
        "M12": ("twisting moment", "N m/m"),
        "Q1": ("transverse shear", "N/m"),
        "Q2": ("transverse shear", "N/m"),
    },
}


def describe(kind, field, column):
    """Name, words and unit of a column of a field, for a structure of this kind."""
    if field == "resultants":
        words, unit = RESULTANTS.get(kind, {}).get(column, ("", ""))
        return column, words, unit
    unit = {"stress": "N/m²", "strain": "1"}.get(field.split(" ")[0], "")
    return f"{field} {column}", "", unit
