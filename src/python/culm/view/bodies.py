"""Shapes of rigid bodies, as far as their deck tells them."""


def shape_of(deck, name):
    """What to draw of a body, in the directors of its node; None for a structure that is no body."""
    place = f"Structures/{name}/"

    def numbers(parameter):
        return [float(word) for word in deck.parameters[place + parameter].strip("{} ").split(",")]

    kind = deck.parameters.get(place + "Type")
    if kind == "Rigid Box":
        return {"kind": "box", "size": numbers("Size")}
    if kind == "Rigid Sphere":
        return {"kind": "sphere", "radius": numbers("Radius")[0]}
    if kind in ("Rigid Cylinder", "Rigid Cone"):
        size = {"radius": numbers("Radius")[0], "height": numbers("Height")[0]}
        return {"kind": "cone" if kind == "Rigid Cone" else "cylinder", **size}
    if kind == "Rigid Body":
        return {"kind": "marker", "centre": numbers("Centre")}
    return None
