#!/usr/bin/env python3
"""What acts in which step of Abaqus and CalculiX: loads and supports that go on, end or are given anew, beams in a plane,
axes at nodes, sections and names of parameters in other forms. Expected are the rules of their manuals; where the two
programs differ, CalculiX 2.20 was run."""

import sys

import numpy
from habits import INP, STEP, node_force, one, pressures
from reading import made_of_text, not_refused
from culm.errors import CulmError

BOTH = ("abaqus", "calculix")
# a bar of four elements along x, in the plane
BAR = """*node
1,0,0
2,1,0
3,2,0
*element,type=b21,elset=e
1,1,2
2,2,3
*material,name=m
*elastic
2e11,0.3
*density
1000.
*beam section,elset=e,material=m,section=rect
0.1,0.2
0,0,-1
*boundary
1,encastre
"""


def steps(*blocks, base=INP, format="abaqus"):
    """@param blocks  what stands between *STEP and *END STEP, with the procedure"""
    return made_of_text(format, base + "".join(f"*step\n{block}*end step\n" for block in blocks))


def held(made, node, step):
    """Degrees of freedom that are held at a node in a step, with their values."""
    return {
        i: value
        for support in made.made.supports
        if node in support.nodes and (support.steps is None or step in support.steps)
        for i, value in support.held.items()
    }


def names():
    """A set that is called as a load: what acts in a step is told by names, of supports and loads alike."""
    made = steps(
        "*static\n*boundary\nforce,2\nforce,3\n*cload\n2,2,1000\n",
        "*static\n*boundary,op=new\n1,1,6\n*cload,op=new\n3,2,1000\n2,3,1\n",
        base=BAR.replace("*material", "*nset,nset=force\n3\n*material", 1).replace("b21", "b31"),
    )
    lists = {one.name: one.lists() for one in made.deck.root.lists()}
    constraints = {one.name for one in lists["Constraints"]}
    loads = {one.name for one in lists["Loads"]}
    idle = [dict(item[:2] for item in one.items if isinstance(item, tuple))["Inactive"] for one in lists["Analyses"]]
    idle = [{name.strip() for name in text.strip("{}").split(",")} for text in idle]
    yield "supports and loads have names of their own", not constraints & loads
    yield "supports hold in their step", idle[1] & constraints == {"force 1", "force 2"} and not idle[0] & constraints
    yield "loads act in theirs", len(idle[0] & loads) == 2 and len(idle[1] & loads) == 1


def goes_on():
    for format in BOTH:
        anew = steps("*static\n*cload\n3,1,7\n", "*static\n*cload,op=new\n3,1,1\n*cload,op=new\n3,2,2\n", format=format)
        yield f"{format}: the first OP=NEW of a step ends loads, others add to it", numpy.allclose(node_force(anew, 1), [1, 2, 0, 0, 0, 0])
        freed = steps("*static\n*boundary\n3,1,2\n", "*static\n*boundary,op=new\n1,1,6\n*boundary,op=new\n4,3\n", format=format)
        yield f"{format}: OP=NEW ends supports of steps before", held(freed, 3, 0) == {1: 0, 2: 0} and held(freed, 3, 1) == {}
        yield f"{format}: what is given anew holds", held(freed, 4, 1) == {3: 0} and len(held(freed, 1, 1)) == 6
        loose = steps("*static\n", "*static\n*boundary,op=new\n4,3\n", format=format)
        yield f"{format}: and those of the model", len(held(loose, 1, 0)) == 6 and held(loose, 1, 1) == {}
        same = steps("*static\n*boundary,op=new\n1,1,6\n", "*static\n*boundary,op=new\n1,1,6\n", format=format)
        yield f"{format}: supports that each step repeats are one", len(same.made.supports) == 1 and same.made.supports[0].steps is None
        late = steps("*dynamic\n1e-3,1\n*boundary\n3,1,2\n", "*static\n*cload\n4,1,1\n", format=format)
        yield f"{format}: supports of a step that is left out go on after it", held(late, 3, 0) == {1: 0, 2: 0}
        never = steps("*dynamic\n1e-3,1\n*boundary\n3,1,2\n", format=format)
        yield f"{format}: also where no step is read", held(never, 3, 0) == {1: 0, 2: 0}
    faces = "*surface,name=top\ne,spos\n"
    both = steps("*static\n*dload,op=new\ne,p,5\n*dsload,op=new\ntop,p,3\n", base=INP + faces)
    yield "OP=NEW of pressures on elements and on surfaces are each their own", sorted(pressures(both)) == [-3, 5]


def perturbs():
    """Of Abaqus; in CalculiX loads go on after modes and buckling."""
    static, buckle = "*static\n*cload\n3,1,10\n", "*buckle\n2\n*boundary\n4,3\n*cload\n3,2,5\n"
    ours, theirs = (steps(static, buckle, "*static\n", format=format) for format in BOTH)
    yield "buckling is under the loads of its step", numpy.allclose(node_force(ours, 1), [0, 5, 0, 0, 0, 0])
    yield "which end with it", numpy.allclose(node_force(ours, 2), [10, 0, 0, 0, 0, 0]) and held(ours, 4, 2) == {}
    yield "as do its supports", held(ours, 4, 1) == {3: 0} and held(ours, 4, 0) == {}
    yield "in CalculiX both go on", numpy.allclose(node_force(theirs, 2), [10, 5, 0, 0, 0, 0]) and held(theirs, 4, 2) == {3: 0}
    moved = steps("*static\n*boundary\n3,3,3,0.1\n", "*buckle\n2\n*cload\n3,2,5\n", "*static\n")
    yield "what is moved before is held in buckling", [held(moved, 3, step) for step in (0, 1, 2)] == [{3: 0.1}, {3: 0}, {3: 0.1}]
    added = made_of_text("abaqus", INP + STEP.format("*cload\n3,1,10\n") + STEP.replace("*step", "*step,perturbation").format("*cload\n3,1,4\n"))
    yield "a perturbation comes on top", numpy.allclose(node_force(added, 1), [14, 0, 0, 0, 0, 0])
    cases = steps("*buckle\n2\n*boundary,op=new,load case=1\n1,1,6\n*boundary,op=new,load case=2\n3,1,3\n*cload\n3,2,5\n")
    yield "supports of modes alone are told", any("LOAD CASE=2" in x for x in cases.findings.left_out) and held(cases, 3, 0) == {}
    for program, of_linear in zip(BOTH, (None, "step 1")):
        for geometry, of_nonlinear in (("", of_linear), (",nlgeom", "step 1"), (",nlgeom=no", of_linear)):
            text = INP + f"*step{geometry}\n*static\n*cload\n3,1,10\n*end step\n*step,perturbation\n*frequency\n5\n*end step\n"
            found = [x.preloaded for x in made_of_text(program, text).made.steps]
            yield f"{program}: modes after a step with '{geometry}'", found == [None, of_nonlinear]
    other = made_of_text("abaqus", INP + "*step,nlgeom\n*static\n*end step\n*step\n*frequency\n5\n*boundary\n3,1\n*end step\n")
    yield "supports of modes alone are told where these start from a loaded state", any("other supports" in x for x in other.findings.left_out)
    lasting = made_of_text("abaqus", INP + "*step,nlgeom\n*static\n*end step\n*step\n*static\n*end step\n*step,nlgeom=no\n*static\n*end step\n")
    yield "steps stay nonlinear", [x.nonlinear for x in lasting.made.steps] == [True, True, False]
    short = made_of_text("abaqus", INP + "*step,nlgeo=yes\n*static\n*end step\n*step\n*frequency\n5\n*end step\n")
    yield "the beginning of a parameter is the parameter", [x.preloaded for x in short.made.steps] == [None, "step 1"] and not short.findings.left_out


def stays_in_plane():
    bent = steps("*static\n*cload\n3,2,5\n*dload\ne,py,4\n", base=BAR)
    yield "nodes of B21 stay in their plane", held(bent, 3, 0) == {3: 0, 4: 0, 5: 0} and len(held(bent, 1, 0)) == 6
    yield "and that is said", any("stay in the plane" in text for text in bent.findings.assumed)
    yield "their mass", abs(bent.mass - 1000 * 0.02 * 2) < 1e-9
    section = next(iter(bent.made.sections.values())).values
    up = bent.made.beams[0].up
    yield "their first axis is normal to it", up == (0, 0, -1) and (section["Width"], section["Height"]) == (0.1, 0.2)
    yield "three nodes", len(steps("*static\n", base=BAR.replace("b21", "b22").replace("1,1,2\n2,2,3\n", "1,1,2,3\n")).made.beams[0].nodes) == 3


def has_axes():
    about = "9,0.5,0.5,0\n*mpc\nbeam,all,9\n*transform,nset=all,type=c\n0.5,0.5,-1,0.5,0.5,1\n"
    base = INP.replace("9,5,5,5\n", "").replace("*boundary\n1,1,6\n", "")
    base = base.replace("4,0,1,0\n", "4,0,1,0\n9,0.5,0.5,0\n") + about.replace("9,0.5,0.5,0\n", "")
    middle = steps("*static\n*boundary\n9,1,2\n9,6\n*cload\n9,3,5\n", base=base)
    yield "a node on the axis may be held all around", held(middle, 9, 0) == {1: 0, 2: 0, 6: 0}
    yield "and pulled along it", numpy.allclose(node_force(middle), [0, 0, 5, 0, 0, 0])
    for name, block in {"held": "*boundary\n9,1\n", "moved": "*boundary\n9,1,2,0.1\n", "pulled": "*cload\n9,2,1\n"}.items():
        try:
            steps(f"*static\n{block}", base=base)
            yield f"a node on the axis that is {name} across in one direction is refused", False
        except CulmError as error:
            yield f"a node on the axis that is {name} across is refused", "has no directions in it" in str(error)


def counts_once():
    """Sets of the assembly with the names of those of its parts, as Abaqus/CAE numbers them; sets that list twice."""
    part = "*part,name=p\n" + INP[INP.index("*node") : INP.index("*material")] + "*elset,elset=set-1\n1\n*nset,nset=set-1\n1,2\n"
    part += "*shell section,elset=set-1,material=m\n0.01,5\n*end part\n*assembly,name=a\n*instance,name=i,part=p\n*end instance\n"
    part += "*elset,elset=set-1,instance=i\n1\n*nset,nset=set-1,instance=i\n3,4\n*end assembly\n"
    text = part + INP[INP.index("*material") : INP.index("*shell")] + "*step\n*static\n*boundary\nset-1,1,3\ni.set-1,3\n*end step\n"
    made = made_of_text("abaqus", text)
    yield "an element of a set that the assembly names alike is there once", len(made.made.shells) == 1 and made.mass == 10
    nodes = {tuple(sorted(n for _, n in x.nodes)): set(x.held) for x in made.made.supports}
    yield "both sets are their own", nodes == {(3, 4): {1, 2, 3}, (1, 2): {3}}
    twice = steps("*static\n*cload\nn,1,5\n*dload\nf,p,7\n", base=INP + "*nset,nset=n\n3,3\n*elset,elset=f\n1,1\n")
    yield "a member that is listed twice is loaded once", node_force(twice)[0] == 5 and one(twice, "pressure").elements == [0]
    by_elements = steps("*static\n*cload\nn,1,5\n", base=INP + "*nset,nset=n,elset=e\n")
    yield "a set of the nodes of elements", node_force(by_elements)[0] == 20
    again = made_of_text("abaqus", INP + "*shell section,elset=e,material=m\n0.03\n")
    yield "of two sections the last one holds, and that is said", again.mass == 30 and any("two sections" in x for x in again.findings.assumed)


def holds_between():
    """Triangles become quadrilaterals, with nodes between those of the file: what holds both ends of a side holds these,
    whether the file names the ends together or one by one."""
    base = INP[: INP.index("*boundary")].replace("s4r", "s3").replace("1,1,2,3,4\n", "1,1,2,3\n2,1,3,4\n")
    held_by = {
        "together": "*nset,nset=f\n1,4\n*boundary\nf,1,6\n",
        "one by one": "*boundary\n1,1,6\n4,1,6\n",
        "one more than the other": "*boundary\n1,1,6\n4,1,3\n",
    }
    made = {name: steps("*static\n", base=base + text) for name, text in held_by.items()}
    together, alone, less = ([x for x in one.root.lists() if x.name == "Constraints"][0].lists() for one in made.values())
    yield "together", [x.items[0][1] for x in together] == ["Rigid Support"]
    yield "one by one", [x.items[0][1] for x in alone].count("Rigid Support") == 3
    yield "what both have", [x.items[0][1] for x in less].count("Spherical Support") == 2
    yield "by node and name", any(x.name == "between 1" for x in alone)
    words = "nodes that were added between supported ones are free"
    yield "of which nothing is told", not any(words in x for one in made.values() for x in one.findings.assumed)
    around = "*nset,nset=f\n1,4\n*transform,nset=f,type=c\n-1,0,0,-1,0,1\n*boundary\n1,1\n4,1\n"
    yield "those along other axes are free, which is told", any(words in x for x in steps("*static\n", base=base + around).findings.assumed)
    led = steps("*static\n*boundary\n9,1,6\n", base=base + "*mpc\nbeam,1,9\nbeam,4,9\n")
    rigid = [x.items[0][1] for x in [x for x in led.root.lists() if x.name == "Constraints"][0].lists()]
    yield "nodes that one leads are one coupling", rigid.count("Rigid Connection") == 1


def loads_both():
    """Loads of a set of shells and beams, of which each kind acts on one of them."""
    mixed = INP.replace("*material", "*element,type=b31,elset=b\n7,3,9\n*elset,elset=all\ne,b\n*material", 1)
    mixed = mixed.replace("*boundary", "*beam section,elset=b,material=m,section=rect\n0.1,0.1\n0,0,-1\n*boundary")
    for label, on in (("p", "beams"), ("py", "shells")):
        told = steps(f"*static\n*dload\nall,{label},5\n", base=mixed).findings.left_out
        yield f"a load {label} on {on} is told", any(f"on {on}" in text for text in told)


def makes_nodes():
    """A part of a cylinder as the verification manual of Abaqus makes one: corners by angles, arcs, rows between them."""
    text = "*node,system=c,nset=corner\n1,300.\n5,300.,,300.\n401,300.,40.\n405,300.,40.,300.\n*ngen,line=c,nset=wall\n1,401,100\n"
    text += "*ngen,line=c,nset=free\n5,405,100,,,,300.\n*nfill,nset=all\nwall,free,4,1\n*element,type=s4r,elset=roof\n1,1,101,102,2\n"
    text += "*elgen,elset=roof\n1,4,100,10,4,1,1\n*material,name=m\n*elastic\n3e6,0\n*density\n1.\n*shell section,elset=roof,material=m\n3.\n"
    made = made_of_text("abaqus", text + "*boundary\nwall,1,6\n").made
    places = {n: (300 * numpy.cos(t), 300 * numpy.sin(t), 75.0 * j) for i in range(5) for j in range(5) for n, t in [(100 * i + j + 1, numpy.radians(10 * i))]}
    yield "nodes", made.nodes.keys() == places.keys() and numpy.allclose([made.nodes[n] for n in places], list(places.values()))
    yield "elements, sets", len(made.shells) == 16 and made.supports[0].nodes == [1, 401, 101, 201, 301]
    ball = made_of_text("abaqus", INP.replace("9,5,5,5\n", "*node,system=s\n9,2,90,30\n")).made
    yield "a place on a sphere", numpy.allclose(ball.nodes[9], [0, 3**0.5, 1])


def leaves_out():
    """A cell without a number is 0 where it stands."""
    empty = made_of_text("abaqus", INP.replace("9,5,5,5", "9,,,5")).made
    yield "a coordinate", numpy.allclose(empty.nodes[9], [0, 0, 5])
    yield "a direction of gravity", numpy.allclose(one(steps("*static\n*dload\ne,grav,9.81,,,-1\n"), "gravity").value, [0, 0, -9.81])
    bar = BAR.replace("0,0,-1", ",1,").replace("2e11,0.3", "2e11,")
    bent = steps("*static\n", base=bar.replace("b21", "b31")).made
    yield "a direction of a section", bent.beams[0].up == (0, 1, 0)
    yield "a ratio of Poisson", next(iter(bent.materials.values())).values["Poisson Ratio"] == 0
    general = BAR.replace("*beam section,elset=e,material=m,section=rect\n0.1,0.2\n0,0,-1", "*beam general section,elset=e,section=general\n1,2,,3,4\n0,0,-1\n1,1")
    values = next(iter(steps("*static\n", base=general).made.sections.values())).values
    yield "a value of a section", (values["EI1"], values["EI12"], values["EI2"], values["GIp"]) == (2, 0, 3, 4)
    rows = INP.replace("9,5,5,5\n", "5,0,2,0\n6,1,2,0\n").replace("*material", "*elgen,elset=e\n1,1,,,2,2,10\n*material", 1)
    yield "numbers of *ELGEN", made_of_text("abaqus", rows).mass == 20


def has_sections():
    general = INP.replace("*shell section,elset=e,material=m\n0.01,5", "*shell general section,elset=e,material=m\n0.01")
    yield "a general section of a material is a wall of it", made_of_text("abaqus", general).mass == 10
    layers = INP.replace("*shell section,elset=e,material=m\n0.01,5", "*shell general section,elset=e,composite\n0.01,,m,0\n0.02,,m,90")
    yield "of layers, too", abs(made_of_text("abaqus", layers).mass - 30) < 1e-12
    yield "the axes of space again are nothing", made_of_text("abaqus", INP + "*system\n").mass == 10
    weight = steps("*static\n*dload\n,grav,9.81,0,0,-1\n", base=general)
    yield "they weigh", numpy.allclose(one(weight, "gravity").value, [0, 0, -9.81])


REFUSED = {
    "stiffnesses of a wall": (INP.replace("*shell section,elset=e,material=m\n0.01,5", "*shell general section,elset=e\n1,2,3\n"), "by stiffnesses"),
    "axes element by element": (
        INP.replace("*shell section", "*orientation,name=o\nlist\n3,0\n*shell section"),
        "*ORIENTATION by the distribution list",
    ),
    "beams beside their plane": (BAR.replace("3,2,0\n", "3,2,0,1\n"), "lie in the plane z = 0"),
    "arcs beyond half a turn": (INP + "*ngen,line=c\n1,2,1,,0.5,0.5,0,0,0,1\n", "with a normal"),
    "arcs about another centre": (INP + "*ngen,line=c\n2,4,1,,5,5\n*ngen,line=c\n2,9,1\n", "at one distance"),
    "rows of other lengths": (INP + "*nset,nset=a\n1,2\n*nset,nset=b\n3\n*nfill\na,b,2,10\n", "cannot be joined"),
    "a system of nodes": (INP + "*system\n1,0,0\n", "*SYSTEM is not read"),
}


def main():
    complaints = []
    for facts in (goes_on, names, perturbs, stays_in_plane, has_axes, counts_once, holds_between, loads_both, makes_nodes, leaves_out, has_sections):
        complaints += [f"{facts.__name__}: {name}: does not hold" for name, holds in facts() if not holds]
    complaints += not_refused(REFUSED)
    sys.exit("\n".join(complaints) or 0)


if __name__ == "__main__":
    main()
