"""Writes the page: its parts, three.js and the data in one file."""

import html
import json
import os
import pathlib
import tempfile

from ..errors import CulmError

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
    with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
        try:
            file.write(text)
            file.close()
            os.chmod(file.name, 0o666 & ~_umask())
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


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
