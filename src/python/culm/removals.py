"""What can be taken out of a deck: effects by their names, and the settings that switch each off.

A finder looks at a resolved deck and yields removals. To add an effect, write a finder and name it in
FINDERS.
"""

from . import removals_in_media
from .removal import LIGHT, Removal, array, inactive, of_types, parameters, same, words


def find(deck):
    """All removals of a resolved deck, in the order of FINDERS."""
    return [removal for finder in FINDERS for removal in finder(deck)]


def fidelities(deck):
    """Shear and extension, large rotations, all flexibility; beams that are alike go together."""
    fidelity = {
        "shear and extension": ("Kirchhoff", lambda beam: beam["Element"] == "Director"),
        "large rotations": ("Linear", lambda beam: beam["Element"] == "Director"),
        "flexibility": ("Rigid", lambda beam: True),
    }
    for names in _alike(deck):
        beam = parameters(deck, f"Structures/{names[0]}")
        for effect, (word, fits) in fidelity.items():
            if beam["Fidelity"] == "Full" and fits(beam):
                settings = [f"Structures/{name}/Fidelity={word}" for name in names]
                yield Removal(effect, ", ".join(names), settings)


def fidelities_of_shells(deck):
    """Large rotations, where materials are linear; all flexibility."""
    for name in of_types(deck, "Structures", "Shell"):
        if deck.parameters[f"Structures/{name}/Fidelity"] != "Full":
            continue
        if not _stretches_far(deck, name):
            yield Removal("large rotations", name, [f"Structures/{name}/Fidelity=Linear"])
        yield Removal("flexibility", name, [f"Structures/{name}/Fidelity=Rigid"])


def torsion(deck):
    """Twist, held by constraints as shear and extension are."""
    for names in _alike(deck):
        beam = parameters(deck, f"Structures/{names[0]}")
        if beam["Element"] == "Director" and beam["Fidelity"] in ("Full", "Kirchhoff") and beam["Torsion"] == "true":
            yield Removal("torsion", ", ".join(names), [f"Structures/{name}/Torsion=false" for name in names])


def rotary_inertia(deck):
    """Inertia of sections against turning about their own centres of mass, where something moves."""
    if not of_types(deck, "Analyses", "Dynamic", "Modal", "Campbell", "Flutter"):
        return
    for names in _alike(deck):
        beam = parameters(deck, f"Structures/{names[0]}")
        sections = [beam["Section"]] if beam.get("Section") else words(beam.get("Sections") or "{}")
        factor = float(beam["Rotary Inertia"])
        if factor > LIGHT and any(_weighs(parameters(deck, f"Sections/{name}")) for name in sections):
            settings = [f"Structures/{name}/Rotary Inertia={LIGHT * factor!r}" for name in names]
            yield Removal("rotary inertia", ", ".join(names), settings, f"times {LIGHT:g}")


def enhanced_strains(deck):
    for name in of_types(deck, "Structures", "Shell"):
        shell = parameters(deck, f"Structures/{name}")
        for key, effect in (("Enhanced Membrane", "membrane"), ("Enhanced Thickness", "thickness")):
            if shell[key] != "None":
                yield Removal(f"enhanced {effect} strain", name, [f"Structures/{name}/{key}=None"])
        if shell["Assumed Strains"] == "true":
            yield Removal("assumed strains", name, [f"Structures/{name}/Assumed Strains=false"])


def thickness_stretch(deck):
    for name in of_types(deck, "Structures", "Shell"):
        entry = f"Constraints/{name} keeps its thickness"
        settings = [f"{entry}/Type=Inextensible Director", f"{entry}/Node={name}"]
        yield Removal("thickness stretch", name, settings)


def loads(deck):
    """Each load by itself: weight, frames, springs, dampers, forces."""
    for name in deck.names_in("Loads"):
        if removals_in_media.is_ground(deck, name):
            continue
        kind = deck.parameters[f"Loads/{name}/Type"].lower()
        settings = [
            f"Analyses/{analysis}/Inactive={array(inactive(deck, analysis) + [name])}"
            for analysis in deck.names_in("Analyses")
            if name not in inactive(deck, analysis)
        ]
        if settings:
            yield Removal(kind, name, settings)


def following(deck):
    """The turning of forces and moments with the directors, and with it the stiffness of that."""
    for name in deck.names_in("Loads"):
        if deck.parameters.get(f"Loads/{name}/Turning") == "true":
            yield Removal("turning of the load", name, [f"Loads/{name}/Turning=false"])


def masses(deck):
    for name in deck.names_in("Masses"):
        value = float(deck.parameters[f"Masses/{name}/Mass"])
        yield Removal("point mass", name, [f"Masses/{name}/Mass={LIGHT * value!r}"], f"times {LIGHT:g}")


def dissipation(deck):
    """Numerical dissipation and physical damping."""
    off = {"Dissipation": "0", "Velocity Dissipation": "0", "Damping": "0", "Strain Damping": "{0, 0, 0, 0, 0, 0}"}
    for key, none in off.items():
        groups = [[f"Structures/{name}" for name in names] for names in _alike(deck)]
        groups += [[f"Materials/{name}"] for name in deck.names_in("Materials")]
        for group in groups:
            paths = [f"{place}/{key}" for place in group]
            if any(float(number) > 0.0 for number in words(deck.parameters.get(paths[0]) or "0")):
                where = ", ".join(place.split("/")[1] for place in group)
                yield Removal(key.lower(), where, [f"{path}={none}" for path in paths])


def two_way_coupling(deck):
    """What the motion of the structure does to the loads of its partners."""
    if deck.parameters.get("Coupling/Scheme", "One Way") != "One Way":
        names = ", ".join(deck.names_in("Coupling/Partners"))
        yield Removal("two-way coupling", names, ["Coupling/Scheme=One Way"])


def prestress(deck):
    """Modes and buckling about a loaded state, where nothing follows that would need it."""
    names = deck.names_in("Analyses")
    if len(names) < 2:
        return
    for name in of_types(deck, "Analyses", "Modal"):
        if name == names[-1] and not deck.parameters.get(f"Analyses/{name}/Start From"):
            yield Removal("geometric stiffness", name, [f"Analyses/{name}/Start From=Reference"])


FINDERS = [
    fidelities,
    fidelities_of_shells,
    torsion,
    rotary_inertia,
    enhanced_strains,
    thickness_stretch,
    loads,
    following,
    masses,
    dissipation,
    two_way_coupling,
    prestress,
    *removals_in_media.FINDERS,
]


def _alike(deck):
    """Beams whose lists differ in their curves only, as lists of names."""
    return same(deck, "Structures", "Beam")


def _weighs(section):
    """Whether it has mass: per volume, per length, or first in the rows of a matrix."""
    masses = (section.get("Density"), section.get("rhoA"), *words(section.get("Mass") or "{}")[:1])
    return any(float(mass or 0.0) > 0.0 for mass in masses)


def _stretches_far(deck, shell):
    """Whether a layer of a shell is of a material for large strains."""
    entry = parameters(deck, f"Structures/{shell}")
    names = [entry["Material"]] if entry.get("Material") else words(entry.get("Materials") or "{}")
    return any(deck.parameters.get(f"Materials/{name}/Type") == "Neo-Hooke" for name in names)
