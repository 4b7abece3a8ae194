"""Tells what the effects of a scene cost, and what each changes: reruns the deck without them."""

import csv
import dataclasses
import pathlib

from . import effects_table, quantities, removals
from .at_once import at_once, declare_jobs
from .errors import CulmError
from .footnotes import Footnotes
from .option_types import positive
from .page import Page
from .resolved_deck import ResolvedDeck

PATIENCE = 10.0  # a run without an effect may take so many times the time of the whole one


@dataclasses.dataclass
class Outcome:
    """A run without an effect, compared with the whole one."""

    removal: removals.Removal
    cpu: float  # [s]
    unknowns: int
    entries: int
    changes: dict  # relative change by quantity
    failure: str = ""  # why there is nothing to compare
    broken: list = dataclasses.field(default_factory=list)  # promises, as sentences

    @property
    def change(self):
        return max(self.changes.values(), default=0.0)


def declare(parser):
    parser.add_argument("deck", type=pathlib.Path)
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE", dest="settings")
    parser.add_argument("--watch", nargs="+", metavar="QUANTITY", help="entries of the history; all by default")
    parser.add_argument("--norm", choices=quantities.NORMS, default="rms", help="of changes of histories")
    parser.add_argument("--accuracy", type=positive, default=0.01, help="change that matters; 0.01 by default")
    parser.add_argument("--only", nargs="+", metavar="EFFECT", help="effects to take away; all by default")
    declare_jobs(parser, "runs without an effect")
    parser.add_argument("--output", type=pathlib.Path, help="folder; effects/<name of the deck> by default")


def main(arguments, program):
    deck = ResolvedDeck.of(program, arguments.deck, arguments.settings)
    watched = quantities.parse(arguments.watch or deck.names_in("Output/History"), deck)
    folder = arguments.output or pathlib.Path("effects") / arguments.deck.stem
    wanted = _wanted(removals.find(deck), arguments.only)
    whole = program.run(arguments.deck, folder / "whole", arguments.settings)
    if not whole.succeeded:
        raise CulmError(whole.errors.strip() or whole.outcome, whole.exit or 4)
    print(f"{whole.cpu:9.2f} s  the whole scene")

    def run_without(number):
        settings = [*arguments.settings, *wanted[number].settings]
        patience = max(30.0, PATIENCE * whole.wall)
        return program.run(arguments.deck, folder / f"without {number}", settings, patience)

    outcomes = []
    for removal, run in zip(wanted, at_once(run_without, range(len(wanted)), arguments.jobs)):
        outcomes.append(_compare(removal, whole, run, watched, arguments.norm))
        print(f"{run.cpu:9.2f} s  without {removal.effect} of {removal.where}", flush=True)
    outcomes.sort(key=lambda one: (bool(one.failure), -one.change))
    present = whole.results.effects()
    print("\n" + _text(effects_table.COLUMNS, effects_table.rows(present)))
    print(_text(RANKING, _ranking(outcomes, whole, arguments.accuracy)))
    for line in _broken_promises(outcomes, whole):
        print(line)
    print(_advice(outcomes, whole, arguments.accuracy))
    _write_csv(outcomes, whole, folder / "effects.csv")
    _write_page(arguments, present, outcomes, whole, folder / "effects.html")
    print(f"\n{folder / 'effects.html'}")
    return whole.exit


def _wanted(found, only):
    if not only:
        return found
    known = {removal.effect for removal in found}
    unknown = [name for name in only if name not in known]
    if unknown:
        raise CulmError(f"--only {unknown[0]}: this scene has {', '.join(sorted(known))}")
    return [removal for removal in found if removal.effect in only]


def _compare(removal, whole, run, watched, norm):
    if not run.succeeded:
        reason = next((line for line in run.errors.splitlines() if not line.startswith("warning")), run.outcome)
        return Outcome(removal, run.cpu, 0, 0, {}, reason)
    changes = {}
    before, after = whole.history, run.history
    for one in watched:
        try:
            measure = quantities.Measure([one], norm, [before, after])
        except CulmError:
            continue  # the quantity goes with the effect
        if not measure.columns:
            continue
        state = measure.state(before)
        measure.refer_to(state)
        changes.update(measure.sizes(measure.state(after) - state))
    changes.update(_changes_of_modes(whole.results.tables(), run.results.tables()))
    return Outcome(removal, run.cpu, *_size(run.results.effects()), changes, broken=run.broken)


def _changes_of_modes(whole, other):
    """Largest relative change of the frequencies that both have, by table."""
    found = {}
    others = {table.title: table for table in other}
    for table in whole:
        if "frequency [Hz]" not in table.columns or table.title not in others:
            continue
        a = _frequencies(table)
        b = _frequencies(others[table.title])
        pairs = [(x, y) for x, y in zip(a, b) if x is not None and y is not None and x > 0.0]
        found[f"{table.title}, frequencies"] = max((abs(y - x) / x for x, y in pairs), default=0.0)
    return found


def _frequencies(table):
    at = table.columns.index("frequency [Hz]")
    return [row[at] for row in table.rows]


def _size(effects):
    """Unknowns of the equations, and additions to the matrix per iteration."""
    unknowns = max((e.unknowns for e in effects if e.name.startswith("Factorisation") and e.unknowns), default=0)
    return unknowns, sum(e.entries or 0 for e in effects)


RANKING = ["without", "of", "largest change", "in", "time", "unknowns", "entries", "verdict"]


def _ranking(outcomes, whole, accuracy):
    unknowns, entries = _size(whole.results.effects())
    rows = []
    footnotes = Footnotes()
    footnotes.mark(whole.broken)
    for one in outcomes:
        name = one.removal.effect + (f" ({one.removal.note})" if one.removal.note else "")
        if one.failure:
            rows.append([name, one.removal.where, "–", "", "", "", "", f"no run: {one.failure}"])
            continue
        worst = max(one.changes, key=one.changes.get, default="")
        rows.append(
            [
                name,
                one.removal.where,
                _per_cent(one.change),
                worst,
                f"{100.0 * (one.cpu / whole.cpu - 1.0):+.0f} %",
                f"{one.unknowns - unknowns:+d}",
                f"{one.entries - entries:+d}",
                f'{"needed" if one.change > accuracy else "not needed"} {footnotes.mark(one.broken)}'.strip(),
            ]
        )
    return rows


def _broken_promises(outcomes, whole):
    """What the marks in the ranking stand for, and what the whole scene broke."""
    footnotes = Footnotes()
    of_whole = footnotes.mark(whole.broken)
    for one in outcomes:
        footnotes.mark(one.broken)
    return ([f"the whole scene: {of_whole}"] if of_whole else []) + footnotes.lines


def _per_cent(change):
    return f"{100.0 * change:.2g} %" if change < 10.0 else f"{change:.2g} times"


def _advice(outcomes, whole, accuracy):
    """One sentence: what this scene needs."""
    needed = [f"{o.removal.effect} of {o.removal.where}" for o in outcomes if not o.failure and o.change > accuracy]
    spare = [o for o in outcomes if not o.failure and o.change <= accuracy]
    text = f"For changes below {_per_cent(accuracy)} this scene needs " + (", ".join(needed) or "none of them") + "."
    cheaper = [o for o in spare if o.cpu < 0.9 * whole.cpu]
    if cheaper:
        best = min(cheaper, key=lambda o: o.cpu)
        saved = 100.0 * (1.0 - best.cpu / whole.cpu)
        text += (
            f" Most time is saved, {saved:.0f} %, without {best.removal.effect} of {best.removal.where},"
            f" at a change of {_per_cent(best.change)}."
        )
    return text


def _text(columns, rows):
    widths = [max(len(str(row[i])) for row in [columns, *rows]) for i in range(len(columns))]
    lines = ["  ".join(str(cell).ljust(width) for cell, width in zip(row, widths)) for row in [columns, *rows]]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _write_csv(outcomes, whole, path):
    names = sorted({name for one in outcomes for name in one.changes})
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["effect", "of", "time [s]", "unknowns", "entries per iteration", *names, "failure", "broken promises"])
        zeros = [0.0 for _ in names]
        writer.writerow(["", "", whole.cpu, *_size(whole.results.effects()), *zeros, "", "; ".join(whole.broken)])
        for one in outcomes:
            numbers = [one.changes.get(name, "") for name in names]
            about = [one.removal.effect, one.removal.where, one.cpu, one.unknowns, one.entries]
            writer.writerow([*about, *numbers, one.failure, "; ".join(one.broken)])


def _write_page(arguments, present, outcomes, whole, path):
    page = Page(f"Effects of {arguments.deck.name}", f"{whole.cpu:.3g} s CPU; accuracy asked {_per_cent(arguments.accuracy)}")
    page.paragraph(_advice(outcomes, whole, arguments.accuracy), "advice")
    page.heading("What it contains")
    page.table(effects_table.COLUMNS, effects_table.rows(present))
    page.heading("What happens without")
    broken = [i for i, one in enumerate(outcomes) if one.broken]
    page.table(RANKING, _ranking(outcomes, whole, arguments.accuracy), broken)
    for line in _broken_promises(outcomes, whole):
        page.paragraph(line, "broken")
    figure = _draw(outcomes, whole, arguments.accuracy)
    page.figure(figure, "change of what is watched, and of the time, without each effect")
    figure.savefig(path.with_suffix(".png"), dpi=110)
    page.paragraph(
        f"Changes are relative to the whole scene, norm '{arguments.norm}', the largest of what is watched; "
        "times are those of single runs"
        + (f", {arguments.jobs} of them at once." if arguments.jobs > 1 else ".")
    )
    page.write(path)


def _draw(outcomes, whole, accuracy):
    from . import drawing

    shown = [one for one in outcomes if not one.failure][::-1]
    figure, axes = drawing.plot(2, width=5.2, height=max(1.6, 0.6 + 0.24 * len(shown)))
    names = [f"{one.removal.effect}: {_short(one.removal.where)}" for one in shown]
    changes = [max(100.0 * one.change, 1e-6) for one in shown]
    colours = ["tab:red" if one.change > accuracy else "tab:green" for one in shown]
    places = range(len(shown))
    axes[0][0].barh(places, changes, color=colours)
    axes[0][0].set_yticks(places, names, fontsize=7)
    drawing.scale_log(axes[0][0], "x")
    axes[0][0].set(xlabel="largest change without it [%]")
    axes[0][0].axvline(100.0 * accuracy, color="0.3", lw=0.8, ls="--")
    axes[0][1].barh(places, [100.0 * (one.cpu / whole.cpu - 1.0) for one in shown], color="tab:blue")
    axes[0][1].set_yticks(places, [])
    axes[0][1].set(xlabel="change of the time without it [%]")
    return figure


def _short(text):
    return text if len(text) <= 28 else text[:27] + "…"
