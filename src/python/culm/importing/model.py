"""A finite-element model as its file has it: what every reader fills and one writer makes a deck of.

Numbers of nodes and elements are those of the file, or (instance, number). Every record knows its
place, for messages and comments.
"""

import dataclasses
import typing

import numpy

from .findings import Findings, Place, refuse


@dataclasses.dataclass
class Material:
    """@param type    Isotropic or Orthotropic
    @param values  as the deck names them"""

    type: str
    values: dict
    place: Place


@dataclasses.dataclass
class Layer:
    thickness: float
    material: str
    angle: float = 0.0  # about the normal, from the axis of the wall [degrees]


@dataclasses.dataclass
class Wall:
    """Layers of shell elements from the bottom upward, the side the normal points away from."""

    layers: list
    place: Place
    axis: typing.Optional[tuple] = None  # whose projection on the surface is axis 1
    fallback: typing.Optional[tuple] = None  # taken where the axis is normal to the surface


@dataclasses.dataclass
class Section:
    """Of beams.

    @param type    of the deck, as Rectangle
    @param values  as the deck names them
    @param mass    per length [kg/m]"""

    type: str
    values: dict
    mass: float
    place: Place


@dataclasses.dataclass
class ShellElement:
    """3, 4, 6, 8 or 9 nodes: corners in turn, nodes between them in the same order, the middle."""

    number: object
    nodes: tuple
    wall: str
    place: Place
    axis: typing.Optional[tuple] = None  # in place of that of the wall


@dataclasses.dataclass
class BeamElement:
    """Two nodes, or three with the one between last. d1 is the projection of `up` on the section."""

    number: object
    nodes: tuple
    section: str
    up: tuple
    place: Place


@dataclasses.dataclass
class PointMass:
    node: object
    mass: float
    place: Place
    inertia: typing.Optional[tuple] = None  # 11, 22, 33, 23, 13, 12 about its centre, in space
    offset: tuple = (0.0, 0.0, 0.0)  # of the centre from the node, in space


@dataclasses.dataclass
class Support:
    """@param held   degrees of freedom 1 to 6 with their prescribed value
    @param steps  numbers of the steps it holds in; None for all
    @param axes   rows that the degrees of freedom are along; those of space if None"""

    nodes: list
    held: dict
    place: Place
    name: str = "support"
    steps: typing.Optional[set] = None
    axes: typing.Optional[numpy.ndarray] = None


def supports_along(axes, support):
    """The support as several, each along the axes of its nodes. @param axes  rows by node, where they are not those
    of space"""
    groups = {}
    for node in support.nodes:
        own = axes.get(node)
        key = None if own is None else tuple(float(x) + 0.0 for x in numpy.round(own, 9).ravel())
        groups.setdefault(key, (own, []))[1].append(node)
    return [dataclasses.replace(support, nodes=nodes, axes=own) for own, nodes in groups.values()]


def cylinder_axes(origin, along, place_of_node, place):
    """Rows radial, tangential, axial at a node; `along` is the direction of the axis."""
    z = along / numpy.linalg.norm(along)
    arm = place_of_node - origin
    radial = arm - (arm @ z) * z
    if numpy.linalg.norm(radial) <= 1e-9 * max(1.0, float(numpy.linalg.norm(arm))):
        refuse(place, "a node on the axis of a cylindrical system has no directions in it")
    radial = radial / numpy.linalg.norm(radial)
    return numpy.array([radial, numpy.cross(z, radial), z])


@dataclasses.dataclass
class Coupling:
    """Nodes that follow one as parts of a rigid body."""

    reference: object
    followers: list
    place: Place
    name: str = "coupling"


@dataclasses.dataclass
class NodeLoad:
    """@param vector  force and moment, six components in space"""

    nodes: list
    vector: numpy.ndarray
    place: Place
    name: str = "force"
    steps: set = dataclasses.field(default_factory=set)


@dataclasses.dataclass
class ElementLoad:
    """@param kind   pressure (value along the normal of shells), surface (force per area, in space),
    line (force per length of beams in space), gravity (on everything)
    @param value  a number or a vector"""

    kind: str
    elements: list
    value: object
    place: Place
    name: str = "load"
    steps: set = dataclasses.field(default_factory=set)


@dataclasses.dataclass
class Step:
    """@param kind        static, modal or buckling
    @param preloaded   name of the static step whose end it starts from"""

    name: str
    kind: str
    place: Place
    modes: int = 10
    nonlinear: bool = False
    preloaded: typing.Optional[str] = None


@dataclasses.dataclass
class Model:
    title: str
    findings: Findings = dataclasses.field(default_factory=Findings)
    nodes: dict = dataclasses.field(default_factory=dict)  # number -> position
    node_sets: dict = dataclasses.field(default_factory=dict)  # name -> numbers
    materials: dict = dataclasses.field(default_factory=dict)
    walls: dict = dataclasses.field(default_factory=dict)
    sections: dict = dataclasses.field(default_factory=dict)
    shells: list = dataclasses.field(default_factory=list)
    beams: list = dataclasses.field(default_factory=list)
    masses: list = dataclasses.field(default_factory=list)
    supports: list = dataclasses.field(default_factory=list)
    couplings: list = dataclasses.field(default_factory=list)
    node_loads: list = dataclasses.field(default_factory=list)
    element_loads: list = dataclasses.field(default_factory=list)
    # sets of a mesh that the deck keeps for its user
    surface_sets: dict = dataclasses.field(default_factory=dict)  # name -> places in shells
    edge_sets: dict = dataclasses.field(default_factory=dict)  # name -> lines, by two or three nodes
    point_sets: dict = dataclasses.field(default_factory=dict)  # name -> nodes
    watched: list = dataclasses.field(default_factory=list)  # nodes whose displacements are asked for
    steps: list = dataclasses.field(default_factory=list)
