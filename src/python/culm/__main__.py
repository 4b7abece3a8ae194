"""python3 -m culm VERB …: what the program calls for its verbs that are written in Python.

A verb is a module of its name with `declare(parser)`, its arguments, and `main(arguments, program)`,
which returns the exit code.
"""

import argparse
import os
import sys

from .commands import PYTHON_VERBS, explain_unknown_word, module_of
from .errors import CulmError


class Parser(argparse.ArgumentParser):
    """Its errors are one line."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def _print_no_more():
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def main():
    parser = Parser(prog="culm")
    verbs = parser.add_subparsers(dest="verb", required=True)
    for name in PYTHON_VERBS:
        if name not in sys.argv[1:2]:  # modules of other verbs take half a second to load
            verbs.add_parser(name)
            continue
        module = module_of(name)
        module.declare(verbs.add_parser(name, description=module.__doc__))
    arguments, unknown = parser.parse_known_args()
    if unknown:
        verb = verbs.choices[arguments.verb]
        print(explain_unknown_word(unknown[0], verb), file=sys.stderr)
        return 2
    module = module_of(arguments.verb)
    from .program import Program

    sys.stdout = sys.stdout or open(os.devnull, "w")  # none where it is closed
    sys.stdout.reconfigure(errors="surrogateescape")  # names of files may be any bytes
    try:
        code = module.main(arguments, Program(os.environ["CULM_PROGRAM"]))
    except CulmError as error:
        print(f"culm {arguments.verb}: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # who reads what is printed has seen enough, as `head` does
        _print_no_more()
        return 0
    except OSError as error:  # a full disk, a folder that may not be written
        name = error.filename or "a file that is written, or standard output"
        print(f"culm {arguments.verb}: {name}: {error.strerror}", file=sys.stderr)
        _print_no_more()
        return 6
    try:
        sys.stdout.flush()
    except OSError as error:
        _print_no_more()
        print(f"culm {arguments.verb}: standard output: {error.strerror}", file=sys.stderr)
        return 6
    return code


sys.exit(main())
