"""Files that are there as a whole or not at all."""

import os
import pathlib
import tempfile

from .errors import CulmError

PAGE = b"<!DOCTYPE html"


def write_whole(path, text):
    """Takes the place of a file of this name when it is whole. Raises OSError that names the file."""
    path = pathlib.Path(path)
    try:
        if path.exists() and not path.is_file():  # a device, a pipe
            path.write_text(text, encoding="utf-8")
            return
        with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
            try:
                file.write(text)
                file.close()
                os.chmod(file.name, 0o666 & ~_umask())
                os.replace(file.name, path)
            except BaseException:
                os.unlink(file.name)
                raise
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def refuse_to_replace(path, beginning, kind):
    """Raises CulmError where a file of this name is of another kind, as the results that are read.
    @param beginning  bytes with which files of the kind begin"""
    path = pathlib.Path(path)
    if not path.is_file() or path.stat().st_size == 0:
        return
    with open(path, "rb") as file:
        if not file.read(len(beginning)).lower() == beginning.lower():
            raise CulmError(f"'{path}' is there and no {kind}: it is left as it is; give another --output, or remove it", 6)


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
