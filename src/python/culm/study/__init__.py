"""Measures what accuracy costs: varies a deck, compares with a reference, and advises."""

import os
import pathlib
import shlex
import sys

from .. import quantities
from ..at_once import declare_jobs
from ..errors import CulmError
from ..history import History
from ..option_types import at_least_one, positive
from ..resolved_deck import ResolvedDeck
from ..results import Results
from . import advice, variation
from .judgement import Judgement, Plan
from .runs import StudyRuns

TARGET = "target.xml"


def declare(parser):
    parser.add_argument("deck", type=pathlib.Path, help="input deck, XML")
    variation.declare(parser, required=True)
    parser.add_argument(
        "--watch", nargs="+", default=[], metavar="QUANTITY",
        help="entries of the history, such as tip or tip/uz, or 'energy drift', 'momentum drift', "
        "'constraint drift'; the whole history if not given",
    )
    parser.add_argument(
        "--hold-out", nargs="+", default=[], metavar="QUANTITY", help="shown, but not used for any choice"
    )
    parser.add_argument(
        "--norm", choices=quantities.NORMS, help="of errors; rms over time for dynamics, otherwise end"
    )
    parser.add_argument(
        "--reference", type=pathlib.Path, help="history.csv, or the folder of a run, instead of refinement"
    )
    parser.add_argument(
        "--finer", type=int, default=1, metavar="LEVELS",
        help="how many levels the reference is finer than the finest run; 1 if not given",
    )
    parser.add_argument(
        "--truth", nargs="+", default=[], metavar="NAME=VALUE", help="compared values that the reference has"
    )
    parser.add_argument(
        "--repeat", type=at_least_one, default=3, help="times each run is timed; 3 if not given"
    )
    declare_jobs(parser, "reference runs, which are not timed,")
    parser.add_argument(
        "--time-limit", type=positive, metavar="S", help="after which a run counts as failed"
    )
    parser.add_argument(
        "--target", type=float, metavar="ERROR", help="write the deck that reaches it most cheaply"
    )
    parser.add_argument(
        "--output", type=pathlib.Path, help="folder; studies/<name of the deck> if not given"
    )


def main(arguments, program):
    _check(arguments)
    # without --set: a path that a variation opens may not be there yet
    deck = ResolvedDeck.of(program, arguments.deck, arguments.set)
    axes = variation.pair([variation.parse(text, deck) for text in arguments.vary], arguments.paired)
    variation.refuse_set(arguments.set, [(axis.name, axis.paths()) for axis in axes])
    _check_values(program, arguments, axes)
    folder = arguments.output or pathlib.Path("studies") / arguments.deck.stem
    runs = StudyRuns(program, arguments.deck, deck, folder, arguments.time_limit, _say)
    judgement = Judgement(axes, arguments.set, runs, _plan(arguments, deck, axes))
    promise = _write_target(judgement, program, arguments, folder) if arguments.target else None
    _write(judgement, deck, arguments, folder, promise)
    if arguments.target and not (folder / TARGET).exists():
        return 4
    return 8 if judgement.has_broken_promises else 0


def _check(arguments):
    if not 0 <= arguments.finer <= 3:
        raise CulmError(f"--finer {arguments.finer}: must be from 0 to 3")
    if arguments.target is not None and not 0.0 < arguments.target < 1.0:
        raise CulmError(f"--target {arguments.target:g}: must be between 0 and 1")


def _check_values(program, arguments, axes):
    """Each value by itself, so that a wrong one is said before hours are spent."""
    for axis in axes:
        for i in range(len(axis.values)):
            ResolvedDeck.of(program, arguments.deck, [*arguments.set, *axis.settings(i)])


def _plan(arguments, deck, axes):
    watched = quantities.parse(arguments.watch or deck.names_in("Output/History"), deck)
    if not watched:
        raise CulmError("the deck has no Output / History: there is nothing to watch", 3)
    reference = arguments.reference
    if reference is not None:
        path = reference / "history.csv" if reference.is_dir() else reference
        if not path.is_file():
            raise CulmError(f"--reference {reference}: there is no such history", 6)
        _refuse_other_kind(path, deck)
        reference = History(path)
    return Plan(
        watched=watched,
        held_out=quantities.parse(arguments.hold_out, deck, "--hold-out"),
        norm=arguments.norm or _usual_norm(deck),
        reference=reference,
        finer=arguments.finer,
        repeat=arguments.repeat,
        jobs=arguments.jobs,
        truth=_truth(arguments.truth, axes),
        usual={axis.name: _usual(axis, deck) for axis in axes},
    )


def _refuse_other_kind(path, deck):
    """A motion has times where statics have levels, and both are numbers. A history without its run does not tell."""
    run = path.parent / "run.h5"
    if path.name != "history.csv" or not run.is_file():
        return
    there, here = (_last_kind(kinds) for kinds in ([kind for _, kind in Results(run).analyses()], _kinds(deck)))
    if there != here:
        raise CulmError(f"--reference {path}: it ends with an analysis of type {there}, that of the deck is of type {here}", 2)


def _last_kind(kinds):
    """Of the last analysis that makes steps, as histories have them: statics and paths go by levels alike."""
    steps = [kind for kind in kinds if kind in ("Static", "Path", "Dynamic")]
    return "none" if not steps else "Dynamic" if steps[-1] == "Dynamic" else "Static or Path"


def _kinds(deck):
    return [deck.parameters[f"Analyses/{name}/Type"] for name in deck.names_in("Analyses")]


def _usual_norm(deck):
    return "rms" if "Dynamic" in _kinds(deck) else "end"


def _usual(axis, deck):
    """The value that the reference has where values are different models: the full one, or the deck's."""
    if "Full" in axis.values:
        return axis.values.index("Full")
    own = {deck.parameters.get(setting.partition("=")[0]) for setting in axis.settings(0)}
    return next((i for i, value in enumerate(axis.values) if value in own), 0)


def _truth(given, axes):
    truth = {}
    for text in given:
        name, _, value = text.partition("=")
        axis = next((axis for axis in axes if axis.name == name), None)
        values = axis.values if axis else []
        value = next((one for one in values if one in (value, value.replace("-", " "))), None)
        if value is None:
            raise CulmError(f"--truth {text}: not among what varies")
        truth[name] = value
    return truth


def _write_target(judgement, program, arguments, folder):
    """Writes the deck that reaches the target most cheaply, after running it; what it promises."""
    target = arguments.target
    path = folder / TARGET
    path.unlink(missing_ok=True)  # that of an earlier study
    for promise in advice.promises(judgement, target):
        settings = [*arguments.set, *promise.settings]
        record = judgement.runs.time(settings, arguments.repeat, f"{promise.label} (target)")
        if not record.succeeded:
            judgement.notes.append(f"For the target {promise.label} was tried and failed: {record.reason}")
            continue
        point = judgement.judge(record)
        if not (point.bound <= target and promise.error / 2.0 <= point.bound <= promise.error * 2.0):
            judgement.notes.append(
                f"For the target {promise.label} was tried; "
                f"it promised {promise.error:.2g} and has {point.bound:.2g}."
            )
            continue
        text = (
            f"{promise.label}: promised error {promise.error:.2g} at {advice.seconds(promise.cpu)}; "
            f"measured {point.bound:.2g} at {advice.seconds(record.cpu)}"
        )
        _write_deck(program, arguments.deck, settings, path, text)
        held_out = ", ".join(f"{name} {error:.2g}" for name, error in point.held_out.items())
        return f"{path}, error at most {target:g}: {text}" + (f"; held out: {held_out}" if held_out else "")
    best = min(point.bound for point in judgement.points.values() if point.succeeded)
    return f"No run reached {target:g}; the smallest error is {best:.2g}. Refine further."


def _write_deck(program, deck, settings, path, comment):
    resolved = ResolvedDeck.of(program, deck, settings)
    places = {name: os.path.relpath(file, path.parent) for name, file in resolved.only_files(deck).items()}
    head = f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- {comment.replace("--", "- -")} -->\n'
    path.write_text(f"{head}{resolved.with_files(places)}\n", encoding="utf-8")


def _write(judgement, deck, arguments, folder, promise):
    from . import outputs

    print()
    print(outputs.table(*outputs.columns_and_rows(judgement)))
    for line in outputs.broken_promises(judgement):
        print(line)
    print()
    for line in [outputs.explanation(judgement), *judgement.notes, *outputs.orders(judgement)]:
        print(line)
    print(f"\n{advice.sentence(judgement)}")
    if promise:
        print(promise)
    command = "culm " + shlex.join(sys.argv[1:])
    title = deck.parameters.get("Title") or arguments.deck.stem
    outputs.write_all(judgement, title, command, folder, promise)
    print(f"\n{folder / 'study.html'}")


def _say(text):
    print(text, flush=True)
