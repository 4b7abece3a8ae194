"""Runs the catalogue of hard cases, each with a growing stressor, until it fails or turns wrong."""

import pathlib
import subprocess
import tempfile

from ..at_once import at_once, declare_jobs, declare_part, share
from ..errors import CulmError
from ..option_types import positive
from ..whole_file import refuse_unwritable
from . import margins
from .case import KEYS

SHORT_OF_PROMISE = 4  # exit code


def declare(parser):
    parser.add_argument(
        "--only", nargs="+", metavar="WORD", default=[], help="keys, or parts of names of cases"
    )
    declare_part(parser, "cases")
    declare_jobs(parser, "cases")
    parser.add_argument("--list", action="store_true", help="name the cases and run nothing")
    parser.add_argument("--quick", action="store_true", help="margins to a factor of 2 only")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write the margins")
    parser.add_argument("--plot", type=pathlib.Path, metavar="FILE", help="draw the margins, PNG")
    parser.add_argument(
        "--compare",
        type=pathlib.Path,
        metavar="FILE",
        help="confirm the margins of an earlier --json by two runs per case",
    )
    parser.add_argument(
        "--output", type=pathlib.Path, metavar="FOLDER", help="keep the results of all runs there"
    )
    parser.add_argument(
        "--time-limit", type=positive, default=120.0, metavar="S", help="of each run [s]; default 120"
    )


def main(arguments, program):
    from . import catalogue
    from .terminal import Terminal

    cases = select(catalogue.CASES, arguments.only)
    refusals = select(catalogue.ILL_POSED, arguments.only)
    if not cases and not refusals:
        raise CulmError(f"no case has one of {arguments.only} in its keys or name; see --list", 2)
    cases, refusals = share(cases, arguments.part), share(refusals, arguments.part)
    terminal = Terminal()
    if arguments.list:
        terminal.list(cases, refusals)
        return 0
    try:
        known = margins.read(arguments.compare) if arguments.compare else ({}, {})
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise CulmError(f"{arguments.compare}: {error}", 6) from error
    for path in filter(None, (arguments.json, arguments.plot)):
        refuse_unwritable(path)
    with tempfile.TemporaryDirectory(prefix="culm-hard") as scratch:
        found, refused, shrunk = _run(
            arguments, program, arguments.output or scratch, cases, refusals, known, terminal
        )
    if arguments.json:
        margins.write(arguments.json, _version(program), found, refused)
    if arguments.plot:
        from .picture import draw

        draw(found, arguments.plot)
    faulty = [one.name for one in (*found, *refused) if margins.is_faulty(one)]
    terminal.close(faulty, shrunk)
    return SHORT_OF_PROMISE if faulty or shrunk else 0


def select(entries, words):
    """Those with a word as a key or in the name; all if there is no word."""

    def has(entry, word):
        return word in entry.keys.split() if word in KEYS else word.lower() in entry.name.lower()

    return [one for one in entries if not words or any(has(one, word) for word in words)]


def _run(arguments, program, folder, cases, ill_posed, known, terminal):
    from .trial import Trial

    decks = pathlib.Path(program.path).parent.parent / "share/culm/inputs"
    trial = Trial(program, decks, folder, arguments.time_limit, keep=arguments.output is not None)
    found, shrunk = [], []

    def measure(case):
        before = known[0].get(case.name)
        return trial.measure_again(case, before) if before else trial.measure(case, arguments.quick)

    terminal.open()
    for case, entry in zip(cases, at_once(measure, cases, arguments.jobs)):
        found.append(entry)
        terminal.show(entry)
        before = known[0].get(case.name)
        if before and margins.has_shrunk(before, entry, case.resolution):
            shrunk.append(f"{case.name}: {before.margin:.3g} -> {entry.margin:.3g}")
    refused = list(at_once(trial.refuse, ill_posed, arguments.jobs))
    terminal.show_refusals(refused)
    terminal.count(len(trial.times), sum(trial.times))
    return found, refused, shrunk


def _version(program):
    asked = subprocess.run([program.path, "--version"], capture_output=True, text=True, check=True)
    return asked.stdout.strip()
