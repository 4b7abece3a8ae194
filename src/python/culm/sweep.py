"""Runs a deck with many values, several runs at once or in the jobs of an array, and collects what came out."""

import csv
import itertools
import pathlib

from . import quantities
from .at_once import declare_jobs, declare_part, share
from .errors import CulmError
from .history import owners_of
from .option_types import positive
from .program import DONE
from .resolved_deck import ResolvedDeck
from .results import Results
from .study import variation
from .study.runs import StudyRuns

TABLE = "sweep.csv"
LOST = "not run"
# Columns of tables of analyses that are collected.
OF_TABLES = ("frequency [Hz]", "factor")


def declare(parser):
    parser.add_argument("deck", type=pathlib.Path, help="input deck, XML")
    variation.declare(parser, required=False)
    parser.add_argument(
        "--cases", type=pathlib.Path, metavar="CSV",
        help="a run per line instead; the first line names the paths or variables",
    )
    parser.add_argument(
        "--watch", nargs="+", default=[], metavar="QUANTITY",
        help="entries of the history, such as tip or tip/uz; the whole history if not given",
    )
    declare_jobs(parser, "runs")
    declare_part(parser, "runs")
    parser.add_argument("--collect", action="store_true", help="run nothing: write what was run")
    parser.add_argument(
        "--time-limit", type=positive, metavar="S", help="after which a run counts as failed"
    )
    parser.add_argument(
        "--output", type=pathlib.Path, help="folder; sweeps/<name of the deck> if not given"
    )


def main(arguments, program):
    if arguments.collect and arguments.part:
        raise CulmError("--collect and --part exclude each other: what is collected are the runs of all parts", 2)
    deck = ResolvedDeck.of(program, arguments.deck, arguments.set)
    names, cases = _cases(arguments, deck)
    if not cases:
        raise CulmError("nothing varies: give --vary or --cases", 2)
    watched = quantities.parse(arguments.watch or deck.names_in("Output/History"), deck)
    ResolvedDeck.of(program, arguments.deck, [*arguments.set, *cases[0].settings])  # a wrong path is said at once
    folder = arguments.output or pathlib.Path("sweeps") / arguments.deck.stem
    runs = StudyRuns(
        program, arguments.deck, deck, folder, arguments.time_limit, _say, needs_history=False
    )
    if not arguments.collect:
        distinct = list({tuple(case.settings): case for case in reversed(cases)}.values())[::-1]  # a case may be listed twice
        wanted = [([*arguments.set, *case.settings], case.label) for case in share(distinct, arguments.part)]
        for _ in runs.each(wanted, arguments.jobs):
            pass
    if arguments.part:
        return 0  # the last job of an array does not know that it is the last: --collect
    return _collect(runs, arguments, names, cases, watched, deck, folder / TABLE)


class Case:
    """One run: a value for each name, and what it sets."""

    def __init__(self, names, values, settings):
        self.values = values
        self.settings = settings
        self.label = ", ".join(f"{name}={value}" for name, value in zip(names, values))


def _cases(arguments, deck):
    """Names of what varies, and all cases in their order."""
    if arguments.cases and arguments.vary:
        raise CulmError("--cases and --vary exclude each other", 2)
    if arguments.cases:
        return _listed(arguments, deck)
    axes = variation.pair([variation.parse(text, deck) for text in arguments.vary], arguments.paired)
    variation.refuse_set(arguments.set, [(axis.name, axis.paths()) for axis in axes])
    names = [axis.name for axis in axes]
    cases = []
    for index in itertools.product(*(range(len(axis.values)) for axis in axes)):
        values = [axis.value(i) for axis, i in zip(axes, index)]
        cases.append(Case(names, values, [s for axis, i in zip(axes, index) for s in axis.settings(i)]))
    return names, cases if axes else []


def _listed(arguments, deck):
    path = arguments.cases
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:  # spreadsheets begin with a mark
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise CulmError(f"--cases {path}: {error}", 6) from error
    if len(rows) < 2:
        raise CulmError(f"--cases {path}: needs a line of names and a line for each run", 6)
    names = [name.strip() for name in rows[0]]
    places = [variation.places(name, deck) for name in names]
    variation.refuse_overlaps(f"--cases {path}", list(zip(names, places)))
    variation.refuse_set(arguments.set, list(zip(names, places)))
    cases = []
    for number, row in enumerate(rows[1:], 2):
        if not row:
            continue
        if len(row) != len(names):
            raise CulmError(f"--cases {path}, line {number}: {len(row)} values for {len(names)} names", 6)
        values = [value.strip() for value in row]
        settings = [f"{place}={value}" for value, found in zip(values, places) for place in found]
        cases.append(Case(names, values, settings))
    return names, cases


def _collect(runs, arguments, names, cases, watched, deck, path):
    """Writes the table; the exit code."""
    columns, lines = {}, []
    failed, broken, lost = [], 0, 0
    for case in cases:
        record = runs.find([*arguments.set, *case.settings])
        values = _results(record, watched, deck) if record and record.succeeded else {}
        columns.update(dict.fromkeys(values))
        lines.append((case, record, values))
        if record is None:
            lost += 1
        elif record.exit not in DONE:
            failed.append(f"{case.label}: {record.reason}")
        elif record.broken:
            broken += 1
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([*names, "outcome", "reason", "broken promises", *columns])
        for case, record, values in lines:
            outcome = [record.outcome, record.reason, "; ".join(record.broken)] if record else [LOST, "", ""]
            writer.writerow([*case.values, *outcome, *(values.get(name, "") for name in columns)])
    done = len(cases) - lost - len(failed)
    print(f"\n{len(cases)} runs: {done} done" + (f", {broken} of them BROKE a promise" if broken else "")
          + (f", {len(failed)} failed" if failed else "") + (f", {lost} not run" if lost else ""))
    for line in failed[:5]:
        print(f"failed: {line}")
    print(path)
    return 4 if failed or lost else 8 if broken else 0


def _results(record, watched, deck):
    """Numbers of a run by column: last, least and largest of what is watched, and those of tables."""
    found = {}
    if (record.folder / "history.csv").exists():
        history = record.history()
        owners = owners_of(history.names, deck.names_in("Output/History"))
        for one in watched:
            if one.drift is not None:
                found[one.name] = quantities.drift(record.scalars(), one.drift)
                continue
            for names in one.columns(history).values():
                for name in names:
                    least_step = 1 if quantities.begins_unsolved(*owners[name], deck) else 0
                    rows = zip(history.columns[name], history.steps)
                    values = [value for value, step in rows if value == value and step >= least_step]
                    if values:
                        found[f"{name} last"] = values[-1]
                        found[f"{name} least"] = min(values)
                        found[f"{name} largest"] = max(values)
    for table in Results(record.folder / "run.h5").tables():
        for column in set(OF_TABLES) & set(table.columns):
            at = table.columns.index(column)
            for number, row in enumerate(table.rows, 1):
                found[f"{table.title} {number} {column}"] = row[at]
    return found


def _say(text):
    print(text, flush=True)
