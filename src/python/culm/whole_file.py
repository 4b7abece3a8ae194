"""Files that are there as a whole or not at all."""

import os
import pathlib
import tempfile


def write_whole(path, text):
    """Takes the place of a file of this name when it is whole. Raises OSError that names the file."""
    path = pathlib.Path(path)
    try:
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


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
