"""Writes a page that shows a run in three dimensions: one HTML file that opens without a network."""

import pathlib

from ..errors import CulmError
from ..option_types import at_least_one
from ..whole_file import PAGE, refuse_to_replace
from . import page_file
from .recording import Recording
from .scene import scene_of

MOST_STATES = 400


def declare(parser):
    parser.add_argument("run", type=pathlib.Path, help="folder with the results of a run")
    parser.add_argument(
        "other", type=pathlib.Path, nargs="?", help="folder of another run, to be shown as its ghost"
    )
    parser.add_argument(
        "--output", type=pathlib.Path, help="page to write; view.html in the folder if not given"
    )
    parser.add_argument(
        "--up", choices=("x", "y", "z"), help="axis that points up; found from gravity or the model if not given"
    )
    parser.add_argument(
        "--states", type=at_least_one, default=MOST_STATES, help=f"most states to show; {MOST_STATES} if not given"
    )
    parser.add_argument(
        "--unsolved", action="store_true", help="the file is that of a model, by culm check --view"
    )
    parser.add_argument("--quiet", action="store_true", help="print warnings and errors only")


def main(arguments, program):
    del program  # what is shown stands in the files
    with Recording(arguments.run) as run:
        scene = scene_of(run, arguments.states, up=arguments.up)
        if arguments.unsolved:
            scene["notes"] = ["This is the model of a deck; nothing is solved."]
        folder = run.folder
    ghost = None
    if arguments.other is not None:
        with Recording(arguments.other) as other:
            ghost = scene_of(other, arguments.states, with_fields=False)
    output = arguments.output or folder / "view.html"
    refuse_to_replace(output, PAGE, "page")
    try:
        page_file.write(output, scene, ghost)
    except OSError as error:
        raise CulmError(f"cannot write '{output}': {error.strerror}", 6) from error
    if not arguments.quiet:
        for sentence in scene["broken"]:
            print(f"broken: {sentence}")
        for note in scene["notes"]:
            print(f"note: {note}")
        print(output)
    return 0
