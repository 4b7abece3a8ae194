"""An archive of ANSYS, written by hand as CDWRITE has it: a plate of layers on a frame of beams, with a mass."""


def row(width, *values):
    return "".join(f"{value:>{width}}" for value in values) + "\n"


def mpdata(material, **values):
    text = ""
    for label, value in values.items():
        text += f"MPTEMP,R5.0, 1, 1,  0.00000000    ,\nMPDATA,R5.0, 1,{label},{material:6}, 1, {value:.8e}    ,\n"
    return text


N = 4


def model():
    text = "/COM,ANSYS RELEASE\n/PREP7\n/NOPR\n/TITLE,Plate on a frame\n*IF,_CDRDOFF,EQ,1,THEN\n_CDRDOFF=\n*ELSE\n*ENDIF\n"
    text += "ET,        1,181\nET,        2,188\nET,        3, 21\nKEYOP,       3, 3, 2\n"
    text += "RLBLOCK,       1,       7,       1,       7\n(2i8,6g16.9)\n(7g16.9)\n" + row(8, 7, 1) [:-1] + f"{7.5:16.9f}\n"
    nodes = {10 * j + i + 1: (0.25 * i, 0.25 * j, 0.0) for j in range(N + 1) for i in range(N + 1)}
    text += f"NBLOCK,6,SOLID,{max(nodes):9},{len(nodes):9}\n(3i9,6e21.13e3)\n"
    for number, (x, y, z) in nodes.items():
        text += row(9, number, 0, 0)[:-1] + "".join(f"{value:21.13E}" for value in (x, y, z)) + "\n"
    text += "N,R5.3,LOC,       -1,\n"
    rows = []
    for j in range(N):
        for i in range(N):
            a = 10 * j + i + 1
            # material, type, constants, section, system, death, solid, shape, nodes, -, number
            rows.append((1, 1, 1, 1, 0, 0, 0, 0, 4, 0, N * j + i + 1, a, a + 1, a + 11, a + 10))
    for j in range(N):
        a = 10 * j + 3
        rows.append((2, 2, 1, 2, 0, 0, 0, 0, 2, 0, 101 + j, a, a + 10))
    rows.append((1, 3, 7, 1, 0, 0, 0, 0, 1, 0, 201, 45))
    text += f"EBLOCK,19,SOLID,{201:9},{len(rows):9}\n(19i9)\n" + "".join(row(9, *one) for one in rows) + row(9, -1)
    text += "CMBLOCK,EDGE    ,NODE,       2  ! users node component definition\n(8i10)\n" + row(10, 1, -5)
    text += mpdata(1, EX=1.4e11, EY=1e10, EZ=1e10, PRXY=0.3, PRYZ=0.4, PRXZ=0.3, GXY=5e9, GYZ=3.5e9, GXZ=5e9, DENS=1600)
    text += mpdata(2, EX=2.1e11, NUXY=0.3, DENS=7850)
    text += "SECTYPE,    1,SHELL,    ,\nSECOFFSET,MID\nSECBLOCK,    3\n"
    text += " 2.00000000000E-03,    1,  45.0000    ,   3\n 4.00000000000E-03,    1,  0.0000    ,   3\n"
    text += " 2.00000000000E-03,    1, -45.0000    ,   3\nSECCONTROL,   0.0,   0.0\n"
    text += "SECTYPE,    2,BEAM,HREC,\nSECOFFSET,CENT\nSECDATA, 0.04, 0.06, 0.003, 0.003, 0.005, 0.005\n"
    text += "ACEL, 0.0, 0.0, 9.81\n/GO\nFINISH\n/SOLU\nANTYPE,0\n"
    for number in range(1, N + 2):
        text += f"D,{number:8},ALL, 0.0, 0.0\n"
    text += "F,      45,FZ, -100.000000    ,  0.00000000\nF,      43,MX,  5.0    ,  0.0\n"
    text += "".join(f"SFE,{e:8},  1,PRES,0, 250.000000    ,  250.0, 250.0, 250.0\n" for e in range(1, N * N + 1))
    return text + "SOLVE\nFINISH\n"


def model_in_blocks():
    """The same as releases from 2019 write it: another tag, and supports, forces and pressures in blocks."""
    lines = model().replace(",R5.0,", ",UNBL,").replace("N,R5.3", "N,UNBL").split("\n")
    rows = [[cell.strip() for cell in line.split(",")] for line in lines]
    supports, forces, pressures = ([row for row in rows if row[0] == name] for name in ("D", "F", "SFE"))
    kept = [line for line, row in zip(lines, rows) if row[0] not in ("D", "F", "SFE", "SOLVE", "FINISH", "")]
    text = "\n".join(kept) + "\n"
    for name, block in (("DBLOCK", supports), ("FBLOCK", forces)):
        text += f"{name},{len(block):8}\n(i9,a6,2(pg16.9))\n"
        text += "".join(f"{row[1]:>9}{row[2]:6}{float(row[3]):16.9f}{0:16.9f}\n" for row in block) + "       -1\n"
    text += f"SFEBLOCK,4,PRES,{len(pressures):10},       256,0\n(i9,i4,i4,6(pg20.9))\n"
    for row in pressures:
        for part, values in ((1, row[5:9]), (2, [0] * 4)):
            text += f"{row[1]:>9}{row[2]:>4}{part:4}" + "".join(f"{float(value):20.9f}" for value in values) + "\n"
    return text + "SFE,end,LOC,       -1,\nSOLVE\nFINISH\n"
