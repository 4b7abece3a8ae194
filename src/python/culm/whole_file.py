"""Files that are there as a whole or not at all."""

import contextlib
import os
import pathlib
import tempfile

from .errors import CulmError

PAGE = b"<!DOCTYPE html"


def write_whole(path, data):
    """Bytes, or text, take the place of a file of this name when they are whole. Raises OSError that names the file."""
    path = pathlib.Path(path)
    data = data.encode("utf-8", "replace") if isinstance(data, str) else data  # names of files may be any bytes
    with _named(path):
        if path.exists() and not path.is_file():  # a device, a pipe
            path.write_bytes(data)
            return
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            try:
                file.write(data)
                file.close()
                os.chmod(file.name, 0o666 & ~_umask())
                os.replace(file.name, path)
            except BaseException:
                os.unlink(file.name)
                raise


def refuse_unwritable(path):
    """Raises OSError that names the file where it could not be written, before what takes long; changes nothing."""
    path = pathlib.Path(path)
    with _named(path):
        if path.exists():
            open(path, "ab").close()
        else:
            tempfile.TemporaryFile(dir=path.parent).close()


def refuse_to_replace(path, beginning, kind):
    """Raises CulmError where a file of this name is of another kind, as the results that are read.
    @param beginning  bytes with which files of the kind begin"""
    path = pathlib.Path(path)
    if not path.is_file() or path.stat().st_size == 0:
        return
    with open(path, "rb") as file:
        if not file.read(len(beginning)).lower() == beginning.lower():
            raise CulmError(f"'{path}' is there and no {kind}: it is left as it is; give another --output, or remove it", 6)


@contextlib.contextmanager
def _named(path):
    """Errors of the system are those of this file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
