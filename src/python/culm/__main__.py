"""python3 -m culm VERB …: what the program calls for its verbs that are written in Python.

A verb is a module of its name with `declare(parser)`, its arguments, and `main(arguments, program)`,
which returns the exit code.
"""

import argparse
import importlib
import os
import sys

from .errors import CulmError

VERBS = {
    "effects": "tell what the effects of a scene cost and change",
    "hard": "margins of hard cases",
    "import": "make a deck from files of another program",
    "report": "draw the page of a run",
    "study": "measure what accuracy costs",
    "sweep": "run a deck with many values",
    "view": "write a page that shows a run in space",
}


def module_of(verb):
    # the word is one of Python's own
    name = "importing" if verb == "import" else verb
    return importlib.import_module(f".{name}", __package__)


def main():
    parser = argparse.ArgumentParser(prog="culm")
    verbs = parser.add_subparsers(dest="verb", required=True)
    for name, summary in VERBS.items():
        module = module_of(name)
        module.declare(verbs.add_parser(name, help=summary, description=module.__doc__))
    arguments = parser.parse_args()
    module = module_of(arguments.verb)
    from .program import Program

    try:
        return module.main(arguments, Program(os.environ["CULM_PROGRAM"]))
    except CulmError as error:
        print(f"culm {arguments.verb}: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        return 130


sys.exit(main())
