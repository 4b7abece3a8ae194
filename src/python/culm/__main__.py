"""python3 -m culm VERB …: what the program calls for its verbs that are written in Python.

A verb is a module with `declare(parser)`, its arguments, and `main(arguments, program)`, which
returns the exit code.
"""

import argparse
import importlib
import os
import sys

from .errors import CulmError

VERBS = {
    "effects": "tell what the effects of a scene cost and change",
    "hard": "margins of hard cases",
    "report": "draw the page of a run",
    "study": "measure what accuracy costs",
    "sweep": "run a deck with many values",
    "view": "write a page that shows a run in space",
}


def main():
    parser = argparse.ArgumentParser(prog="culm")
    verbs = parser.add_subparsers(dest="verb", required=True)
    for name, summary in VERBS.items():
        module = importlib.import_module(f".{name}", __package__)
        module.declare(verbs.add_parser(name, help=summary, description=module.__doc__))
    arguments = parser.parse_args()
    module = importlib.import_module(f".{arguments.verb}", __package__)
    from .program import Program

    try:
        return module.main(arguments, Program(os.environ["CULM_PROGRAM"]))
    except CulmError as error:
        print(f"culm {arguments.verb}: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        return 130


sys.exit(main())
