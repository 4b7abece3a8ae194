"""The report of an import."""

from .findings import with_places


def report_text(arguments, made, mass, summary):
    """@param mass     of the file's elements [kg]; None if not known
    @param summary  what culm says of the deck"""
    findings = made.findings
    lines = [f"import of {arguments.file} as {arguments.format}", "", "read"]
    lines += [f"  {name}: {count}" for name, count in findings.read.items()]
    lines += _section("assumed", findings.assumed)
    lines += _section("LEFT OUT: in the file, not in the deck", findings.left_out)
    if mass is not None:
        lines += ["", f"mass of what was read: {mass:.9g} kg"]
    lines += _loads(made)
    lines += getattr(made, "notes", [])
    # what culm says of the model comes once for each set of analyses
    said = [line for line, before in zip(summary.splitlines(), ["", *summary.splitlines()]) if line != before]
    return "\n".join([*lines, "", "the model", *("  " + line for line in said)]) + "\n"


def _section(title, sentences):
    if not sentences:
        return []
    return ["", title, *(f"  {with_places(sentence, places)}" for sentence, places in sentences.items())]


def _loads(made):
    """Sums of the forces at nodes, by step."""
    lines = []
    for number, step in enumerate(getattr(made, "steps", [])):
        acting = [load for load in made.node_loads if number in load.steps]
        if acting:
            sums = sum(len(load.nodes) * load.vector[:3] for load in acting)
            lines.append(f"sum of forces at nodes in {step.name}: {sums[0]:.9g}, {sums[1]:.9g}, {sums[2]:.9g} N")
    return ["", *lines] if lines else []
