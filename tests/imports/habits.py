#!/usr/bin/env python3
"""What files of users have: marks and line ends of other systems, systems of nodes, loads given twice, masses that are not
structural, offsets, lines that go on. Beside numbers counted here; what is not read is told by name or refused."""

import sys

import numpy
from reading import made_of_text, not_refused

INP = """*Heading
 a plate, one element
*node, nset=all
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
9,5,5,5
*element,type=s4r,elset=e
1,1,2,3,4
*material,name=m
*elastic
2e11,0.3
*density
1000.,
*shell section,elset=e,material=m
0.01,5
*boundary
1,1,6
"""
STEP = "*step\n*static\n{}*end step\n"
BDF = "SOL 101\nCEND\nSPC=1\nLOAD=2\nBEGIN BULK\nMAT1,1,2.+11,,.3,1000.\nSPC1,1,123456,1\n{}ENDDATA\n"
SQUARE = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nCQUAD4,1,1,1,2,3,4\nFORCE,2,3,,1.,1.,0.,0.\n"
BARS = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nCBAR,1,1,1,2,0.,0.,1.\nCBAR,2,1,2,3,0.,0.,1.{}\nFORCE,2,3,,1.,1.,0.,0.\n"
CDB = """/PREP7
ET,1,181
ET,2,188
NBLOCK,6,SOLID,5,5
(3i9,6e21.13e3)
        1        0        0
        2        0        0 1.0000000000000E+000
        3        0        0 1.0000000000000E+000 1.0000000000000E+000 0.0000000000000E+000 90.
        4        0        0 0.0000000000000E+000 1.0000000000000E+000
        5        0        0 3.0000000000000E+000 1.0000000000000E+000
N,R5.3,LOC,       -1,
EBLOCK,19,SOLID,2,2
(19i9)
        1        1        1        1        0        0        0        0        4        0        1        1        2        3        4
        1        2        1        2        0        0        0        0        2        0        2        3        5
       -1
MP,EX,1,2e11
MP,PRXY,1,0.3
MP,DENS,1,1000
SECTYPE,1,SHELL
SECDATA,0.01,1
SECTYPE,2,BEAM,RECT
SECDATA,0.1,0.2
/SOLU
ANTYPE,0
D,1,ALL,0
"""

CONSTANTS = CDB.replace("ET,1,181", "ET,1,{}").replace("SECTYPE,1,SHELL\nSECDATA,0.01,1\n", "R,1,{}\n")


def inp(*blocks, base=INP):
    return made_of_text("abaqus", base + "".join(STEP.format(block) for block in blocks))


def bdf(cards):
    return made_of_text("nastran", BDF.format(cards), "model.bdf")


def cdb(lines):
    return made_of_text("ansys", CDB + lines + "SOLVE\nFINISH\n", "model.cdb")


def case_control(solution, cases, cards):
    text = BDF.format("PSHELL,1,1,.1,1,,1\n" + SQUARE + cards)
    return made_of_text("nastran", text.replace("SOL 101", f"SOL {solution}").replace("LOAD=2\n", cases), "model.bdf")


def node_force(made, step=0):
    return sum(len(load.nodes) * load.vector for load in made.made.node_loads if step in load.steps)


def pressures(made, step=0):
    return [load.value for load in made.made.element_loads if load.kind == "pressure" and step in load.steps]


def one(made, kind):
    (found,) = [load for load in made.made.element_loads if load.kind == kind]
    return found


def directions(made):
    """Along which supports hold, but for full clamps."""
    turned = [support for support in made.made.supports if support.axes is not None and set(support.held) <= {1, 2, 3}]
    return [support.axes[[i - 1 for i in sorted(support.held)]] for support in turned]


def of_abaqus():
    """Sums as CalculiX 2.20 has them: loads of one step add up, those of later steps replace, element by element."""
    twice = inp("*cload\n3,1,10\n*cload\n3,1,10\n*dload\ne,p,5\ne,p,5\n", "*cload\n3,1,4\n*dload\n1,p,3\n")
    other_system = made_of_text(
        "abaqus", ("\ufeff" + INP + STEP.format("*cload\n3,1,10\n")).replace("\n", "\r\n").replace(",0,0", ",\t0,0")
    )
    turned = inp("*cload\n3,1,10\n", base=INP + "*transform,nset=all,type=c\n0.5,0.5,-1,0.5,0.5,1\n*boundary\n2,2\n")
    pulled = inp("*dload\n1,grav,9.81,0,0,-2\n,grav,5,1,0,0\n")
    moved = inp("*boundary\n3,3,3,0.01\n", "*boundary\n3,3,3,0.02\n")
    at_3 = {step: [s.held[3] for s in moved.made.supports if s.nodes == [3] and step in s.steps] for step in (0, 1)}
    upright = "5,1,0,1\n6,1,1,1\n*element,type=s4r,elset=f\n2,2,3,6,5\n*shell section,elset=f,material=m\n0.02,5\n"
    corner = made_of_text("abaqus", INP.replace("9,5,5,5\n", upright) + "*boundary\n2,1,6\n")
    flat = made_of_text("abaqus", INP.replace("9,5,5,5\n", upright.replace("1,0,1", "2,0,0").replace("1,1,1", "2,1,0").replace("2,2,3,6,5", "2,2,5,6,3")) + "*boundary\n2,1,6\n")
    yield "a clamp at a fold holds the directors of both shells", corner.text.count('value="Director Support"') == 2
    yield "of shells that go on into each other it holds one", flat.text.count('value="Director Support"') == 0
    yield "forces of one step add up", numpy.allclose(node_force(twice), [20, 0, 0, 0, 0, 0])
    yield "a force of a later step replaces", numpy.allclose(node_force(twice, 1), [4, 0, 0, 0, 0, 0])
    yield "pressures of one step add up, of a later one replace", pressures(twice) == [5, 5] and pressures(twice, 1) == [3]
    yield "marks and line ends of Windows, tabs", other_system.mass == 10 and node_force(other_system)[0] == 10
    yield "forces along a cylinder", numpy.allclose(node_force(turned), numpy.array([1, 1, 0, 0, 0, 0]) * 10 / 2**0.5)
    yield "supports along a cylinder", any(numpy.allclose(x, [[0.5**0.5, 0.5**0.5, 0]]) for x in directions(turned))
    yield "gravities add up, by direction", numpy.allclose(one(pulled, "gravity").value, [5, 0, -9.81])
    yield "what is moved anew is moved once", at_3 == {0: [0.01], 1: [0.02]}
    again = made_of_text("abaqus", INP + STEP.format("*cload\n3,1,10\n") + STEP.format("*cload\n3,2,4\n").replace("*step", "*step,perturbation"))
    yield "a static perturbation is told", any("PERTURBATION" in text for text in again.findings.assumed)
    quoted = inp('*cload\n"3",1,10\n', base=INP + '*nset,nset="3"\n1,2\n')
    yield "a number in quotes is the name of a set", [load.nodes for load in quoted.made.node_loads] == [[1, 2]]
    normal = inp("", base=INP.replace("9,5,5,5", "9,5,5,5,0,1,0"))
    yield "a normal of a node is told", any("normals of *NODE" in x for x in normal.findings.left_out)
    warm = inp("", base=INP.replace("1000.,", "1000.,20\n900.,500"))
    yield "a density by temperature is told", warm.mass == 10 and any("by temperature" in text for text in warm.findings.assumed)
    yield "a density of a section is told", "DENSITY of *SHELL SECTION" in inp(
        "", base=INP.replace("e,material", "e,density=3,material")
    ).findings.left_out


def of_beams():
    """What Abaqus and CalculiX have in common, and what not (CalculiX 2.20: section4.inp of its tests stretches like a bar
    of this diameter)."""
    bars = INP.replace("type=s4r", "type=b31").replace("1,1,2,3,4\n", "1,1,2,9\n2,2,3\n").replace("1000.,", "1000.")
    bars = bars.replace("*shell section", "*beam section,section={}").replace("0.01,5", "{}\n0,0,-1")
    round_ = {format: made_of_text(format, bars.format("circ", "0.02")) for format in ("abaqus", "calculix")}
    ups = [beam.up for beam in round_["abaqus"].made.beams]
    yield "the number of CIRC is a radius in Abaqus", numpy.isclose(round_["abaqus"].mass, 2000 * numpy.pi * 0.02**2)
    yield "and that is said", any("calculix" in text for text in round_["abaqus"].findings.assumed)
    yield "a diameter in CalculiX", numpy.isclose(round_["calculix"].mass, 2000 * numpy.pi * 0.01**2)
    across = bars.format("rect", "0.1,0.2") + STEP.format("*dload\n2,p1,5\n2,p2,7\n")
    forces = [[x.value for x in made_of_text(format, across).made.element_loads] for format in ("abaqus", "calculix")]
    yield "P1 and P2 are forces per length in Abaqus", numpy.allclose(forces[0], [[0, 0, -5], [-7, 0, 0]])
    yield "and pressures on a face in CalculiX", numpy.allclose(forces[1], [[0, 0, -1], [-0.7, 0, 0]])
    told = made_of_text("calculix", bars.format("circ", "0.02") + STEP.format("*dload\n2,p1,5\n")).findings.left_out
    yield "which are told on other sections", any("no rectangle" in x for x in told)
    pair = made_of_text("calculix", bars.format("circ", "0.02,0.02"))
    yield "of which there may be two", numpy.isclose(pair.mass, round_["calculix"].mass)
    yield "a node beyond its own is the direction of an element", ups == [(5.0, 5.0, 5.0), (0.0, 0.0, -1.0)]


def of_instances():
    """Directions that a part gives turn with its instance, here by 90 degrees about x."""
    part = "*part,name=p\n*node\n1,0,0,0\n2,1,0,0\n*element,type=b31,elset=e\n1,1,2\n*element,type=rotaryi,elset=r\n5,2\n"
    part += "*rotary inertia,elset=r\n1,2,3,0,0,0.5\n*beam section,elset=e,material=m,section=rect\n0.1,0.2\n{}*end part\n"
    part += "*assembly,name=a\n*instance,name=i,part=p\n0,5,0\n0,5,0,1,5,0,90\n*end instance\n*end assembly\n"
    part += INP[INP.index("*material") : INP.index("*shell")]
    made = made_of_text("abaqus", part.format("0,1,0\n"))
    yield "the direction of a beam section", made.made.beams[0].up == (0, 0, 1)
    yield "a rotary inertia", numpy.allclose(made.made.masses[0].inertia, [1, 3, 2, -0.5, 0, 0])
    told = made_of_text("abaqus", part.format("")).findings.assumed
    yield "one that is not given is told", any("direction of a beam section that the file does not give" in x for x in told)


def of_nastran():
    shell = "PSHELL,1,1,.01,1,,1,,2.5\n"
    cylinder = bdf(shell + SQUARE.replace("0.,1.,0.\n", "0.,1.,0.,5\n") + "CORD2C,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nSPC1,1,1,4\n")
    loaded = bdf("PCOMP,1,,4.\n,1,.01,0.,YES,1,.02,90.\n" + SQUARE)
    rod = bdf("PBARL,1,1,,ROD\n,.1,3.\n" + BARS.format("\n,,,0.,0.,.2,0.,0.,.2") + "PLOAD1,2,2,FYE,FR,0.,5.,1.,5.\n")
    beams = BARS.replace("CBAR", "CBEAM").format("")
    shearing = bdf("PBEAM,1,1,.01,1.-5,2.-5,,3.-5\n,,,,,,,,\n,.5,.6\n" + beams)
    membrane = bdf("PSHELL,1,1,.01\n" + SQUARE.replace("3,4\n", "3,4\n,,.01,.01,.02,.02\n"))
    varied = bdf(shell + SQUARE + "PLOAD4,2,1,1.,2.\n")
    stiff = bdf("PBAR,1,1,.01,1.-5,2.-5,3.-5\n,,,,,,,,\n,0.,.5\n" + BARS.format(""))
    values = next(iter(stiff.made.sections.values())).values
    yield "no area of shear is no shear", numpy.allclose([values["GA1"], values["GA2"]], [1e3 * 0.01 * 2e11 / 2.6, 0.5 * 0.01 * 2e11 / 2.6])
    blank = bdf("PBAR,1,1,.01,1.-5,2.-5,3.-5\n" + BARS.format(""))
    values = next(iter(blank.made.sections.values())).values
    yield "nor is a blank one", numpy.allclose([values["GA1"], values["GA2"]], 1e3 * 0.01 * 2e11 / 2.6)
    yield "pressures at corners that are not given are the first one", pressures(varied) == [1.25]
    yield "pressure on what is no shell is told", any("no shells" in x for x in bdf("PBARL,1,1,,ROD\n,.1\n" + BARS.format("") + "PLOAD4,2,1,1.\n").findings.left_out)
    # 2 kg and 6 kg, 0.4 m apart along z: 0.3 m from the first, 2 * 6 / 8 * 0.16 kg m^2 about it
    pair = "CONM2,8,3,,2.,0.,0.,.1\n,1.,,2.,,,3.\nCONM2,9,3,,6.,0.,0.,.5\n,1.,,1.,,,1.\n"
    (body,) = [one for one in bdf(shell + SQUARE + pair).root.lists() if one.name == "Structures"][0].lists()[1:]
    values = {item[0]: item[1] for item in body.items}
    found = [[float(x) for x in values[key].strip("{}").split(",")] for key in ("Centre", "Inertia")]
    yield "masses at one node have the centre and inertia of all", values["Mass"] == "8" and numpy.allclose(found[0], [0, 0, 0.4])
    yield "about that centre", numpy.allclose(found[1], [2.24, 3.24, 4, 0, 0, 0])
    G = 2e11 / 2.6
    arm = rod.made.couplings[0]
    written = bdf("PBARL,1,1,,ROD\n,.1\nGRID,1,,0.,0.,0.,,456\n=,*1,=,*(.5),==\n=(2)\nCBAR,1,1,1,2,0.,0.,1.\n=       *1      =       *1      *1      ==\n=,*1,=,*1,*1,==\nFORCE,2,4,,1.,1.,0.,0.\n")
    yield "cards that say how they differ", abs(written.mass - 1000 * numpy.pi * 0.01 * 1.5) < 1e-9 and len(written.made.beams) == 3
    yield "their other fields", any(set(s.held) == {4, 5, 6} and s.nodes == [4] for s in written.made.supports)
    by_default = bdf(shell + SQUARE.replace("0.,1.,0.\n", "0.,1.,0.,,0\n") + "GRDSET,,,,,,,6\n")
    fixed = [(sorted(s.held), s.nodes) for s in by_default.made.supports]
    yield "what GRDSET holds, where a node does not say otherwise", fixed.count(([6], [2])) == 1 and all(n != [4] for _, n in fixed)
    marked = bdf("PCOMP   1" + " " * 63 + "CPLY\n+PLY    1       .1      0.\n" + SQUARE)
    yield "the first character of a name of the next line does not count", abs(marked.mass - 100.0) < 1e-9
    yield "mass that is not structural, of shells", cylinder.mass == 12.5 and abs(loaded.mass - 34) < 1e-12
    yield "mass that is not structural, of bars", abs(rod.mass - (1000 * numpy.pi * 0.1**2 + 3) * 2) < 1e-9
    yield "supports along a cylinder", any(numpy.allclose(x, [[0, 1, 0]]) for x in directions(cylinder))
    yield "arms to a beam beside its nodes", numpy.allclose(rod.made.nodes[arm.followers[0]] - rod.made.nodes[arm.reference], [0, 0, 0.2])
    yield "a load along a line", numpy.allclose(one(rod, "line").value, [0, 0, 5])
    yield "shear of PBEAM", numpy.isclose(shearing.made.sections["beam 1"].values["GA1"], 0.5 * G * 0.01)
    prestressed = case_control("103", "SUBCASE 1\nLOAD=2\nSUBCASE 2\nSTATSUB=1\nMETHOD=4\n", "EIGRL,4,,,5\n")
    steps = [(step.kind, step.preloaded) for step in prestressed.made.steps]
    yield "modes of a loaded structure", steps == [("static", None), ("modal", "case 1")]
    short = case_control("105", "SUBC 1\nLOAD=2\nSUBC 2\nMETH=4\n", "EIGRL,4,,,5\n")
    yield "names that are cut", [step.kind for step in short.made.steps] == ["static", "buckling"]
    combined = case_control("101", "TEMP(LOAD)=5\nSUBCASE 1\nLOAD=2\nSUBCOM 3\nSUBSEQ=2.\n", "PARAM,INREL,-1\n")
    told = " ".join(combined.findings.left_out)
    yield "combined cases, heat and forces of inertia are told", all(word in told for word in ("SUBCOM", "TEMPERATURE", "INREL"))
    alone = case_control("101", "SUBCASE 1\nLOAD=2\nSUBCASE 2\nDEFORM=7\n", "")
    yield "a case without loads is told", {"a case without LOAD", "DEFORM of the case control"} <= set(alone.findings.left_out)
    yield "thicknesses of an element and a membrane are told", {"field 10 of CQUAD4"} < set(membrane.findings.left_out)
    other = case_control("101", "LOAD=2\nMFLUID=3\n", "SPC1,2,3,3\n").findings
    yield "supports that no case names are told", "the support set 2 is in no case" in other.assumed
    turned = "CORD2R,6,5,1.,90.,0.,1.,90.,1.\n,2.,90.,0.\nCORD2C,5,7,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\nCORD2C,7,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\n"
    chained = bdf(shell + turned + "GRID,9,6,1.,0.,0.\n" + SQUARE).made
    yield "systems in cylindrical ones, in any order", numpy.allclose(chained.nodes[9], [-2, 1, 0])
    lighter = made_of_text("nastran", BDF.format(shell + SQUARE).replace("LOAD=2\n", "LOAD=2\nPARAM,WTMASS,0.5\n"), "model.bdf")
    yield "a factor of masses in the case control", lighter.mass == 6.25
    own = made_of_text("nastran", BDF.format(shell + SQUARE).replace("2.+11,,.3", "2.+11,1.+10,.3"), "model.bdf").findings
    yield "a shear modulus of its own is told", any("G of a MAT1" in x for x in own.left_out)
    mixed = case_control("103", "SUBCASE 1\nANALYSIS=STATICS\nLOAD=2\nSUBCASE 2\nMETHOD=4\n", "EIGRL,4,,,5\n").findings
    yield "another analysis of a case is told", "ANALYSIS of the case control" in mixed.left_out
    response = made_of_text("nastran", BDF.format(shell + SQUARE).replace("SOL 101", "SOL 111"), "model.bdf").made
    yield "modes in place of another solution have its supports", any(s.nodes == [1] and len(s.held) == 6 for s in response.supports)
    yield "what acts by case control and is not read is told", "MFLUID of the case control" in other.left_out


def of_ansys():
    varied, alone = cdb("SFE,1,1,PRES,0,10.,20.,30.,40.\n"), cdb("SFE,1,2,PRES,0,10.,0.,0.,0.\n")
    yield "a pressure that varies is its mean", pressures(varied) == [25]
    yield "one with zeros behind it is told", pressures(alone) == [-10] and any("all over" in x for x in alone.findings.assumed)
    turned = cdb("F,3,FX,10\nD,3,UX,0\nSFE,1,1,PRES,0,5\nSFE,1,1,PRES,0,7\nSFE,2,1,PRES,0,4,4\nMP,EX,1,2e11,1e6\n")
    yield "a temperature everywhere is told", "the command BFUNIF" in cdb("BFUNIF,TEMP,80\n").findings.left_out
    yield "none is not", "the command BFUNIF" not in cdb("BFUNIF,TEMP,_TINY\n").findings.left_out
    both = cdb("SOLVE\nFINISH\n/SOLU\nANTYPE,2\n")
    yield "a force in the system of its node", numpy.allclose(node_force(turned), [0, 10, 0, 0, 0, 0])
    yield "a support in the system of its node", any(numpy.allclose(x, [[0, 1, 0]]) for x in directions(turned))
    yield "the last pressure on a face stands", pressures(turned) == [7]
    # the beam lies along x, z of its section is up
    yield "a load along a line", numpy.allclose(one(turned, "line").value, [0, 0, -4])
    yield "a modulus that depends on temperature is told", "field 4 of MP" in turned.findings.left_out
    told = cdb("TB,FRIC,1\nMP,GXY,1,1e10\nSECFUNCTION,%T%\n").findings.left_out
    yield "tables, a shear modulus of its own, walls by functions are told", len(told) == 3
    section = {k: CDB.replace("BEAM,RECT\nSECDATA,0.1,0.2", f"BEAM,ASEC\nSECDATA,0.02,1e-5,{k},2e-5,,3e-5") for k in ("", "0")}
    blank, zero = (next(iter(made_of_text("ansys", text + "SOLVE\n", "model.cdb").made.sections.values())).values for text in section.values())
    yield "a value of a section that is left out is 0", blank == zero and numpy.isclose(blank["EI2"], 4e6)
    older = made_of_text("ansys", CDB.replace("ET,1,181", "ET,1,63") + "R,1,0.03\nSOLVE\n", "model.cdb")
    yield "SHELL63 has its constants, not the section of its number", abs(older.mass - 70) < 1e-9
    lighter = cdb("MPDELE,DENS,1\nMP,DENS,1,10\nMPDELE,ALL,7\nMPDELE,DENS,ALL\n")
    yield "a density that is deleted is none", lighter.mass == 0
    triangle = CDB.replace("        1        2        3        4\n", "        1        2        3        3\n") + "SFE,1,1,PRES,0,10.,20.,30.,30.\n"
    yield "a pressure that varies over a triangle", pressures(made_of_text("ansys", triangle + "SOLVE\n", "model.cdb")) == [20]
    modes = cdb("ANTYPE,2\nPSTRES,ON\n")
    yield "prestress of modes is told", any("PSTRES" in text for text in modes.findings.left_out)
    yield "the first of two analyses is told", any("static analysis before" in text for text in both.findings.left_out)


REFUSED = {
    "two densities of a material": ("abaqus", INP.replace("*density", "*density\n7\n*density"), "there twice"),
    "a job that goes on": ("abaqus", INP + STEP.format("*restart,read,step=1\n"), "another job"),
    "cases of load within a step": ("abaqus", INP + STEP.format("*load case,name=a\n*cload\n3,1,1\n*end load case\n"), "*LOAD CASE"),
    "data in a file of its own": ("abaqus", INP.replace("*node,", "*node,input=x.inp,"), "*NODE with INPUT"),
    "a tie": ("abaqus", INP + "*tie,name=t\na,b\n", "*TIE is not read"),
    "an orientation with another origin is not one about it": (
        "abaqus",
        INP.replace("*shell section,", "*orientation,name=o\n1,0,0,1,0,0,1,1,1\n*shell section,orientation=o,"),
        "the two points of a system are on one line",
    ),
    "a line of another card": ("nastran", BDF.format("PCOMP   1" + " " * 63 + "+A\n+B      1       .1      0.\n"), "calls its next line 'A'"),
    "more values than a line has": ("nastran", BDF.format("SPC1,1,123,1,2,3,4,5,6,7,8\n"), "more than 8 values"),
    "differences of a card that is none": ("nastran", BDF.format("=,*1,==\n").replace("MAT1,1,2.+11,,.3,1000.\nSPC1,1,123456,1\n", ""), "repetition"),
    "differences of nothing": ("nastran", BDF.format("=3\n"), "which must stand before it"),
    "differences of words": ("nastran", BDF.format("=,*1,*1\nSPC1,1,A,1\n=,*1,*1\n"), "expected a number"),
    "a superelement before the rest": ("nastran", BDF.format(SQUARE).replace("BEGIN BULK", "BEGIN SUPER=1\nGRID,9\nBEGIN BULK"), "in parts"),
    "a superelement after it": ("nastran", BDF.format(SQUARE + "begin bulk super=2\n"), "in parts, here 'BULK SUPER=2'"),
    "a word among nodes": ("nastran", BDF.format("PSHELL,1,1,.1,1\n" + SQUARE + "RBE3,3,,4,123456,1.,123,1,THRU\n,3\n"), "RBE3 with 'THRU'"),
    "systems in each other": ("nastran", BDF.format("CORD2R,1,2\nCORD2R,2,1\n" + SQUARE), "in one that is given in it"),
    "an angle among constants": ("ansys", CONSTANTS.format("63", "0.01,0,0,0,0,30"), "constant 6 of the set 1 is 30: of SHELL63"),
    "mass among constants": ("ansys", CONSTANTS.format("181", "0.01,0,0,0,0,30"), "constant 6 of the set 1 is 30: of SHELL181"),
    "mass of a BEAM4": (
        "ansys",
        CDB.replace("2,188", "2,4").replace("        1        2        1        2", "        1        2        2        2")
        + "R,2,0.02,1e-5,2e-5,0.1,0.2,0,0,3e-5,1.2,1.2,0,7\n",
        "constant 12 of the set 2 is 7",
    ),
    "a centroid beside the node": ("ansys", CDB.replace("RECT\nSECDATA,0.1,0.2", "ASEC\nSECDATA,1,1,0,1,0,1,0,.1"), "beside the node"),
    "nodes of elements": ("ansys", CDB + "ESEL,S,TYPE,,2\nNSLE,S\nF,ALL,FX,5\n", "F of ALL after NSLE"),
    "a table of moduli": ("ansys", CDB + "TB,ELAS,1\nTBDATA,1,1e11,.2\n", "TB,ELAS is not read"),
    "a mass in a plane": ("ansys", CDB.replace("2,188", "2,21") + "KEYOPT,2,3,4\nR,1,5\n", "MASS21 in a plane"),
    "an ellipse": (
        "abaqus",
        INP.replace("s4r", "b31").replace("1,1,2,3,4", "1,1,2").replace("*shell section", "*beam section,section=circ").replace("0.01,5", "0.1,0.2"),
        "culm import calculix",
    ),
    "layers that do not bend": ("nastran", BDF.format("PCOMP,1,,,,,,,MEM\n,1,.1,0.\n" + SQUARE), "LAM = MEM"),
    "nodes in a system of their own": ("ansys", CDB + "LOCAL,11,0,1,1,1\nCSYS,11\nN,9,1,1,1\n", "N in the coordinate system 11"),
    "a table without stiffness": ("csv", "position,EA,GA1,GA2,EI1,EI2,GIp\n0,1,0,1,1,1,1\n1,1,0,1,1,1,1\n", "the column 'GA1' has no value > 0"),
    "nodes in lines": ("ansys", CDB + "N,R5.3,LOC,9,1,1,1\n", "CDWRITE writes blocks"),
    "elements in lines": ("ansys", CDB + "EN,9,1,2,3,4\n", "elements stand in EBLOCK"),
    "directions on a cylinder": (
        "ansys",
        CDB.replace("        1        1        1        1        0        0", "        1        1        1        1        9        0")
        + "LOCAL,9,1\n",
        "which is not Cartesian",
    ),
}


def main():
    complaints = []
    for facts in (of_abaqus, of_beams, of_instances, of_nastran, of_ansys):
        complaints += [f"{facts.__name__}: {name}: does not hold" for name, holds in facts() if not holds]
    complaints += not_refused(REFUSED)
    sys.exit("\n".join(complaints) or 0)


if __name__ == "__main__":
    main()
