"""What can be taken out of water, air, ground, contact, heat and plasticity, and by which settings."""

import numpy as np

from .removal import LIGHT, Removal, array, inactive, of_types, parameters, same, words

SMOOTH = 1e-300  # height at which a wind by the logarithm vanishes [m]
HIGH = 1e6  # factor on a yield stress that is never reached


def waves(deck):
    """The waves of a sea; its current and the still water stay."""
    for name in deck.names_in("Flows"):
        flow = parameters(deck, f"Flows/{name}")
        keys = {"Regular Waves": "Height", "Irregular Waves": "Height", "Wave Components": "Heights"}
        key = keys.get(flow.get("Type"))
        if key:
            low = _times(flow[key], LIGHT)
            yield Removal("waves", name, [f"Flows/{name}/{key}={low}"], f"times {LIGHT:g}")
        if flow.get("Stretching", "None") != "None":
            yield Removal("stretching of the waves", name, [f"Flows/{name}/Stretching=None"])
        current = parameters(deck, f"Flows/{name}/Current")
        for key in ("Speed", "Speeds"):
            if any(float(speed) for speed in words(current.get(key) or "")):
                yield Removal("current", name, [f"Flows/{name}/Current/{key}={_times(current[key], 0)}"])


def shear_of_the_wind(deck):
    """The growth of a wind with the height."""
    for name in deck.names_in("Flows"):
        flow = parameters(deck, f"Flows/{name}")
        for key in ("Exponent", "Horizontal Shear", "Vertical Shear"):
            if float(flow.get(key) or 0.0) != 0.0:
                yield Removal("shear of the wind", name, [f"Flows/{name}/{key}=0"], key)
        if flow.get("Type") == "Log Law":
            # over so smooth a ground the logarithm hardly grows with the height any more
            yield Removal("shear of the wind", name, [f"Flows/{name}/Roughness={SMOOTH:g}"], f"Roughness {SMOOTH:g} m")


def influence_of_towers(deck):
    """What a tower does to the wind in front of it and behind."""
    for name in deck.names_in("Flows"):
        path = f"Flows/{name}/Tower Influence"
        influence = parameters(deck, path)
        for key, effect in (("Upstream", "wind in front of the tower"), ("Downstream", "wake of the tower")):
            if influence.get(key, "None") != "None":
                yield Removal(effect, name, [f"{path}/{key}=None"])


def members_in_water(deck):
    """Pressure, drag, added mass and growth of members, each by itself."""
    for name in of_types(deck, "Loads", "Morison"):
        load = parameters(deck, f"Loads/{name}")
        if load["Buoyancy"] == "true":
            yield Removal("buoyancy", name, [f"Loads/{name}/Buoyancy=false"])
        for effect, keys in (
            ("drag of the water", ("Drag", "Axial Drag", "End Drag")),
            ("added mass", ("Added Mass", "Axial Added Mass", "End Added Mass")),
            ("growth", ("Growth",)),
        ):
            settings = []
            for key in keys:
                plural = {"Drag": "Drags", "Growth": "Growths"}.get(key, key.replace("Mass", "Masses").replace("Drag", "Drags"))
                taken = plural if load.get(plural) else key
                if any(float(value) for value in words(load.get(taken) or "")):
                    settings.append(f"Loads/{name}/{taken}={_times(load[taken], 0)}")
            if settings:
                yield Removal(effect, name, settings)


def air_of_sections(deck):
    """Memory and inertia of the air on sections; strips that differ in where they are only, go together."""
    ways = {
        "lag of the circulation": ("Lag", ("Jones", "Airfoil"), "None"),
        "dynamic stall": ("Lag", ("Oye",), "None"),
        "pressure and separation": ("Lag", ("Four States",), "Airfoil"),
        "apparent mass": ("Apparent Mass", ("true",), "false"),
    }
    for names in same(deck, "Loads", "Strip", {"Structure", "Node"}):
        strip = parameters(deck, f"Loads/{names[0]}")
        for effect, (key, present, off) in ways.items():
            if strip.get(key) in present:
                yield Removal(effect, ", ".join(names), [f"Loads/{name}/{key}={off}" for name in names])


def induction(deck):
    """What a rotor does to its wind: all of it, its lag, losses at the ends of blades, skewed wakes."""
    for name in of_types(deck, "Loads", "Rotor"):
        rotor = parameters(deck, f"Loads/{name}")
        if rotor["Induction"] != "None":
            yield Removal("induction", name, [f"Loads/{name}/Induction=None"])
        if rotor["Induction"] == "Dynamic":
            yield Removal("dynamic inflow", name, [f"Loads/{name}/Induction=Steady"])
        losses = words(rotor["Losses"])
        for loss in losses:
            rest = [one for one in losses if one != loss]
            yield Removal(f"{loss.lower()} losses", name, [f"Loads/{name}/Losses={array(rest)}"])
        if rotor["Yaw"] != "None":
            yield Removal("skewed wake", name, [f"Loads/{name}/Yaw=None"])


def free_wakes(deck):
    """The rolling up of wakes."""
    for name in of_types(deck, "Loads", "Vortex Lattice"):
        if deck.parameters.get(f"Loads/{name}/Wake/Motion") == "Free":
            yield Removal("free wake", name, [f"Loads/{name}/Wake/Motion=Prescribed"])


def is_ground(deck, name):
    """Whether a load holds a structure that would fall without it, and `ground` knows what stands for it."""
    return deck.parameters.get(f"Loads/{name}/Type") == "Soil" and bool(_buried_nodes(deck, name))


def ground(deck):
    """Soil that gives way: without it the nodes of the pile in the ground are held."""
    for name in of_types(deck, "Loads", "Soil"):
        nodes = _buried_nodes(deck, name)
        if not nodes:
            continue
        entry = f"rigid ground of {name}"
        settings = [
            f"Node Sets/{entry}/Nodes={array(nodes)}",
            f"Constraints/{entry}/Type=Rigid Support",
            f"Constraints/{entry}/Node={entry}",
        ]
        settings += [
            f"Analyses/{analysis}/Inactive={array(inactive(deck, analysis) + [name])}"
            for analysis in deck.names_in("Analyses")
        ]
        yield Removal("flexibility of the soil", name, settings, "rigid")


def contacts(deck):
    """Friction, and the loss of what is pressed."""
    for name in of_types(deck, "Loads", "Plane Contact", "Cylinder Contact", "Beam Contact"):
        for key, effect in (("Friction", "friction"), ("Damping", "damping of the contact")):
            if float(deck.parameters.get(f"Loads/{name}/{key}") or 0.0) > 0.0:
                yield Removal(effect, name, [f"Loads/{name}/{key}=0"])


def heat(deck):
    """Differences of temperature through sections and layers."""
    for name in of_types(deck, "Loads", "Temperature"):
        gradient = deck.parameters.get(f"Loads/{name}/Gradient") or "{}"
        if any(float(value) for value in words(gradient)):
            yield Removal("gradient of temperature", name, [f"Loads/{name}/Gradient={_times(gradient, 0)}"])


def plasticity(deck):
    """Yielding of sections and materials."""
    for kind in ("Sections", "Materials"):
        for name in deck.names_in(kind):
            path = f"{kind}/{name}/Plasticity/Yield Stress"
            if path in deck.parameters:
                settings = [f"{path}={_times(deck.parameters[path], HIGH)}"]
                yield Removal("yielding", name, settings, f"yield stress times {HIGH:g}")


FINDERS = [
    waves,
    shear_of_the_wind,
    influence_of_towers,
    members_in_water,
    air_of_sections,
    induction,
    free_wakes,
    ground,
    contacts,
    heat,
    plasticity,
]


def _times(text, factor):
    """A number or an array times a factor, as text."""
    if not text.strip().startswith("{"):
        return repr(factor * float(text))
    return "{" + ", ".join(repr(factor * float(value)) for value in words(text)) + "}"


def _buried_nodes(deck, name):
    """Nodes of a straight pile at or below the surface of the ground; none where the deck does not tell their places."""
    load = parameters(deck, f"Loads/{name}")
    path = f"Structures/{load['Structure']}"
    places = _nodes_of_a_line(parameters(deck, path), parameters(deck, f"{path}/Curve"))
    down = np.array(words(load["Down"]), float)
    depths = (places - np.array(words(load["Ground"]), float)) @ down / np.linalg.norm(down)
    reach = 1e-9 * np.ptp(depths) if len(depths) else 0.0
    return [f"{load['Structure']}/{i}" for i in np.flatnonzero(depths >= -reach)]


def _nodes_of_a_line(beam, curve):
    """Places of the nodes of a beam without kinks; an empty array for curves of other kinds."""
    if curve.get("Type") == "Line":
        points = np.array([words(curve["From"]), words(curve["To"])], float)
    elif curve.get("Type") == "Polyline":
        points = np.array(words(curve["Points"]), float).reshape(-1, 3)
    else:
        return np.empty((0, 3))
    steps = np.diff(points, axis=0)
    straight = steps / np.linalg.norm(steps, axis=1, keepdims=True)
    if not np.allclose(straight, straight[0], atol=1e-9):
        return np.empty((0, 3))
    counts = [int(count) for count in words(curve["Elements"])]
    counts = counts * len(steps) if len(counts) == 1 else counts
    order = int(beam.get("Order") or 1)
    pieces = [start + np.outer(np.arange(order * n) / (order * n), step) for start, step, n in zip(points, steps, counts)]
    return np.vstack([*pieces, points[-1:]])
