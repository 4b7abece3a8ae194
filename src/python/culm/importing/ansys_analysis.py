"""The analysis of ANSYS: its kind, what it counts, its title."""

KINDS = {"0": "static", "STATIC": "static", "STAT": "static", "1": "buckling", "BUCKLE": "buckling", "2": "modal", "MODAL": "modal"}


def read_kind(reader, command):
    kind = command.text(1).upper()
    if kind not in KINDS:
        reader.findings.leave_out(f"ANTYPE,{kind}", command.place)
    elif reader.kind not in (None, KINDS[kind]):
        reader.findings.leave_out(f"the {reader.kind} analysis before: one is read, the last", reader.kind_place)
    if command.text(2).upper() == "NEW":
        for i in (3, 4, 5):
            command.text(i)  # says where a restart would begin
    reader.kind, reader.kind_place = KINDS.get(kind), command.place


def read_large(reader, command):
    reader.nonlinear = command.text(1).upper() in ("ON", "1")


def read_prestress(reader, command):
    reader.prestress = command if command.text(1).upper() in ("ON", "1", "YES") else None


def read_count(reader, command):
    if command.text(2):
        reader.modes = min(max(command.integer(2, "the number of modes"), 1), 100000)


def read_title(reader, command):
    reader.model.title = ",".join(command.fields).strip() or reader.model.title


def read_solution(reader, command):
    reader.solutions += 1
    if reader.solutions == 2:
        text = "load steps before the last one: one analysis is read, with what acts at the end"
        reader.findings.leave_out(text, command.place)
