"""Models of Nastran, written by hand: a layered panel with a stiffener, a frame of bars."""


def card(*fields):
    """In small fields, over as many lines as they need."""
    text = f"{fields[0]:<8}"
    cells = [f"{cell:>8}" for cell in fields[1:]]
    lines = ["".join(cells[i : i + 8]) for i in range(0, len(cells), 8)]
    return text + ("\n" + 8 * " ").join(lines) + "\n"


def free(*fields):
    """In free fields, a comma between them."""
    lines = [list(map(str, fields[1 + i : 9 + i])) for i in range(0, len(fields) - 1, 8)]
    return "\n".join(",".join([str(fields[0]) if i == 0 else "", *line]) for i, line in enumerate(lines)) + "\n"


def wide(*fields):
    """In fields of sixteen columns."""
    cells = [f"{cell:>16}" for cell in fields[1:]]
    lines = ["".join(cells[i : i + 4]) for i in range(0, len(cells), 4)]
    return f"{fields[0] + '*':<8}" + "\n*       ".join(lines) + "\n"


N = 4


def panel():
    """1 m x 1 m of three layers, a bar along its middle, a mass on an arm; statics with pressure and forces."""
    text = "SOL 101\nCEND\nTITLE = Panel of layers with a stiffener\nSPC = 7\n"
    text += "SUBCASE 1\n  LOAD = 10\nSUBCASE 2\n  LOAD = 20\nBEGIN BULK\n$ nodes\n"
    for j in range(N + 1):
        for i in range(N + 1):
            text += wide("GRID", 100 * j + i + 1, "", f"{i / N:.9f}", f"{j / N:.9f}", "0.0")
    text += card("GRID", 900, "", "0.5", "1.0", "0.5")
    for j in range(N):
        for i in range(N):
            a = 100 * j + i + 1
            text += card("CQUAD4", N * j + i + 1, 1, a, a + 1, a + 101, a + 100, "30.")
    for j in range(N):
        text += card("CBAR", 501 + j, 5, 100 * j + 3, 100 * j + 103, "0.", "0.", "1.")
    text += free("PCOMP", 1, "", "", "", "", "", "", "SYM", 2, ".002", "0.", "YES", 2, ".003", "90.", "YES")
    text += free("MAT8", 2, "1.4+11", "1.0+10", ".3", "5.+9", "5.+9", "3.5+9", "1600.")
    text += card("MAT1", 3, "2.1+11", "", ".3", "7850.") + card("PBARL", 5, 3, "", "BOX", "", "", "", "", ".04", ".06",
                                                                ".003", ".004")  # fmt: skip
    text += card("CONM2", 700, 900, 0, "12.5") + card("RBE2", 701, 900, "123456", 402, 403, 404)
    text += card("SPC1", 7, "123456", 1, "THRU", N + 1) + card("PLOAD4", 10, 1, "250.", "", "", "", "THRU", N * N)
    text += card("GRAV", 21, 0, "9.81", "0.", "0.", "-1.") + card("FORCE", 22, 900, 0, "100.", "1.", "2.", "0.")
    return text + card("MOMENT", 22, 403, 0, "5.", "1.", "0.", "0.") + card("LOAD", 20, "1.", "1.", 21, "3.", 22) + "ENDDATA\n"


def frame():
    """A portal of bars; modes and buckling of it are those of beams with these values."""
    text = "SOL 103\nCEND\nTITLE = Portal of bars\nSPC = 1\nMETHOD = 4\nBEGIN BULK\n"
    n = 4  # bars of each member
    points = [(0, 0, 3 * i / n) for i in range(n)] + [(4 * i / n, 0, 3) for i in range(n)]
    points += [(4, 0, 3 - 3 * i / n) for i in range(n + 1)]
    for i, (x, y, z) in enumerate(points, 1):
        text += free("GRID", i, "", float(x), float(y), float(z))
    for i in range(1, 3 * n + 1):
        text += free("CBAR", i, 1 if n < i <= 2 * n else 2, i, i + 1, "0.", "1.", "0.")
    text += free("PBAR", 1, 1, "2.-2", "1.67-5", "6.67-5", "4.58-5") + free("PBAR", 2, 1, "1.5-2", "1.25-5", "2.81-5", "2.94-5")
    text += free("MAT1", 1, "2.1+11", "", ".3", "7850.") + free("EIGRL", 4, "", "", 4)
    return text + free("SPC1", 1, 123456, 1, 3 * n + 1) + "ENDDATA\n"
