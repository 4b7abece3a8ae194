"""The table of effects as text: what a run contained and what each part cost."""

import dataclasses

COLUMNS = ["effect", "items", "unknowns", "entries/iteration", "calls", "time [s]", "share"]


def merged(effects):
    """Lines of the same effect in several analyses as one, the most expensive first."""
    lines = {}
    for e in effects:
        same = lines.setdefault((e.name, e.items), dataclasses.replace(e, calls=0, seconds=0.0))
        same.calls += e.calls
        same.seconds += e.seconds
    return sorted(lines.values(), key=lambda e: -e.seconds)


def rows(effects):
    effects = merged(effects)
    total = sum(e.seconds for e in effects) or 1.0
    return [
        [
            e.name,
            *("–" if n is None else str(n) for n in (e.items, e.unknowns, e.entries)),
            str(e.calls),
            f"{e.seconds:.3g}",
            f"{100.0 * e.seconds / total:.1f} %",
        ]
        for e in effects
    ]
