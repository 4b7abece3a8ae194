"""Couples a deck with a flow program of OpenFOAM that moves a wall by lumpedPointDisplacement.

The points of a port are the stations of system/lumpedPointMovement. Loads are exchanged once per step of the
flow program, which is started here, in the folder of its case.
"""

import argparse
import pathlib
import shlex
import signal
import sys
import threading

from ..errors import CulmError
from ..option_types import positive
from .case import Case
from .coupling import Coupling
from .flow import Flow
from .table import Table
from .turns import Turns

# of the errors that culm raises, the most general last
EXITS = {"UsageError": 2, "InputError": 3, "NonFiniteError": 5, "NumericalError": 4, "FileError": 6, "Error": 1}


def parse():
    parser = argparse.ArgumentParser(prog="python3 -m culm.openfoam", description=__doc__)
    parser.add_argument("deck")
    parser.add_argument("case", type=pathlib.Path, help="folder of the flow program's case, with its mesh made")
    parser.add_argument("--port", help="whose points are the stations; the only one if absent")
    parser.add_argument("--analysis", default="", help="that makes the steps; the first one if absent")
    parser.add_argument("--command", help="the flow program; 'application' of controlDict if absent")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("results"), metavar="FOLDER")
    parser.add_argument("--patience", type=positive, default=600.0, metavar="SECONDS",
                        help="how long the flow program may work on a step (default: %(default)g)")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="overrides a value of the deck")
    return parser.parse_args()


def find_port(simulation, asked):
    names = simulation.ports
    if asked or len(names) == 1:
        return asked or names[0]
    raise CulmError(f"--port must say which of the deck's ports has the stations: {', '.join(names) or 'it has none'}")


def couple(arguments, stop):
    import culm  # starts MPI, which --help does not need

    case = Case(arguments.case)
    simulation = culm.Simulation(arguments.deck, arguments.set)
    coupling = Coupling(simulation, arguments.analysis, find_port(simulation, arguments.port), case)
    print(simulation.messages(), end="", flush=True)
    arguments.output.mkdir(parents=True, exist_ok=True)
    turns = Turns(case, arguments.patience, stop)
    turns.begin()
    command = shlex.split(arguments.command or case.application)
    try:
        with (Table(arguments.output / "history.csv", coupling.port.name) as table,
              Flow(command, case, arguments.output / "flow.log") as flow):
            numbers = coupling.run(flow, turns, table)
    finally:
        print(simulation.messages(), end="", file=sys.stderr)
        tell(coupling, turns)
    for name, value in numbers.items():
        print(f"  {name:32} {value:.6g}")


def tell(coupling, turns):
    """What the exchange cost and moved."""
    each = 1.0 / max(coupling.exchanges, 1)
    print(f"{coupling.exchanges} exchanges; culm took {each * coupling.busy:.2g} s each, the flow program "
          f"{each * turns.waited:.2g} s")
    print(f"  {'work of port ' + coupling.port.name:32} {coupling.work:.6g} J")


def exit_code_of(error, culm):
    return next(code for kind, code in EXITS.items() if isinstance(error, getattr(culm, kind)))


def main():
    import culm

    arguments, stop = parse(), threading.Event()
    for one in (signal.SIGINT, signal.SIGTERM):  # an exception could come between any two instructions
        signal.signal(one, lambda *_: stop.set())
    try:
        couple(arguments, stop)
    except CulmError as error:
        return fail(error, error.exit_code)
    except culm.Error as error:
        return fail(error, exit_code_of(error, culm))
    return 0


def fail(text, exit_code):
    print(f"culm.openfoam: {text}", file=sys.stderr)
    return exit_code


sys.exit(main())
