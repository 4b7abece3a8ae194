"""Writes the page: its parts, three.js and the data in one file."""

import html
import json
import pathlib

from ..errors import CulmError
from ..whole_file import write_whole

PARTS = pathlib.Path(__file__).parent / "page"
THREE = pathlib.Path("/usr/share/javascript/three")
LIBRARY = (THREE / "build/three.min.js", THREE / "examples/js/controls/OrbitControls.js")

# In this order: each uses what stands above it.
MODULES = (
    "data", "structure", "body_shapes", "surface", "drawn_structure", "markers", "loads", "links", "colours", "fields", "model",
    "camera", "axes", "plot", "picking", "inspector", "timeline", "controls", "address", "main",
)  # fmt: skip


def write(path, scene, ghost):
    """Takes the place of a file of this name when it is whole. Raises OSError."""
    data = json.dumps({"run": scene, "ghost": ghost}, separators=(",", ":"))
    text = (PARTS / "page.html").read_text(encoding="utf-8")
    # the data come last: nothing in them is taken for a mark
    for mark, part in (
        ("@title@", html.escape(scene["title"])),
        ("@style@", (PARTS / "style.css").read_text(encoding="utf-8")),
        ("@library@", _in_script("\n".join(_library()))),
        ("@program@", _in_script("\n".join(_modules()))),
        ("@data@", data.replace("</", "<\\/")),
    ):
        before, after = text.split(mark)
        text = before + part + after
    write_whole(path, text)


def _library():
    for path in LIBRARY:
        if not path.exists():
            raise CulmError(f"there is no '{path}'; install the package libjs-three", 6)
        yield path.read_text(encoding="utf-8")


def _modules():
    return ((PARTS / f"{name}.js").read_text(encoding="utf-8") for name in MODULES)


def _in_script(text):
    """Nothing in a script may end it."""
    return text.replace("</script", "<\\/script")
