"""Makes a deck from files of another program, and a report beside it; replaces nothing."""

import pathlib

from .formats import FORMATS, module_of
from .writing import write_import


def declare(parser):
    formats = parser.add_subparsers(dest="format", metavar="FORMAT", required=True)
    for name, summary in FORMATS.items():
        one = formats.add_parser(name, help=summary, description=summary)
        one.add_argument("file", type=pathlib.Path, help=getattr(module_of(name), "FILE", "file to read"))
        one.add_argument(
            "--output", type=pathlib.Path, help="deck to write; here, with the name of the file and .xml, if not given"
        )
        one.add_argument("--quiet", action="store_true", help="print warnings and errors only")
        getattr(module_of(name), "declare", lambda parser: None)(one)
    # read by the program itself; here for the help
    formats.add_parser("openfast", help="A blade of BeamDyn, a turbine of ElastoDyn")


def main(arguments, program):
    return write_import(arguments, module_of(arguments.format).read, program)
