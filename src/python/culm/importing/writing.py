"""What is made of a file is written only when culm can build it, and never over another file."""

import pathlib
import shutil
import sys
import tempfile

from ..errors import CulmError
from .deck import Deck
from .deck_text import render, safe_name
from .findings import DECK_ERROR, FILE_ERROR
from .model import Model
from .report import report_text

DOES_NOT_SOLVE = 4  # exit code of culm


def write_import(arguments, read, program):
    """Reads the file, writes deck, meshes and report. @return exit code"""
    deck_path = arguments.output or pathlib.Path(arguments.file.name).with_suffix(".xml")
    report_path = deck_path.with_suffix(".report.txt")
    for path in (deck_path, report_path):
        _refuse_existing(path)
    made, root, meshes, mass = _read(arguments, read, safe_name(deck_path.stem))
    for name in meshes:
        _refuse_existing(deck_path.parent / name)
    root.comment = _header(arguments.file, arguments.format, made.findings)
    with tempfile.TemporaryDirectory(prefix="culm import ") as folder:
        folder = pathlib.Path(folder)
        files = {deck_path.name: render(root), **meshes}
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        summary = _build(program, folder / deck_path.name)
        report = report_text(arguments, made, mass, summary)
        files[report_path.name] = report
        (folder / report_path.name).write_text(report, encoding="utf-8")
        _move(folder, deck_path.parent, files)
    for sentence in made.findings.left_out:
        print(f"warning: left out: {sentence}", file=sys.stderr)
    if not arguments.quiet:
        print(report)
        print("written: " + ", ".join(str(deck_path.parent / name) for name in files))
    return 0


def _read(arguments, read, stem):
    try:
        made = read(arguments.file, arguments)
        if not isinstance(made, Model):
            return made, made.root, {}, made.mass
        deck = Deck(made, stem)
        root, meshes = deck.write()
        return made, root, meshes, deck.mass()
    except OSError as error:
        raise CulmError(f"{error.filename or arguments.file}: cannot read: {error.strerror}", FILE_ERROR) from error
    except (ArithmeticError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise CulmError(
            f"{arguments.file}: internal error: {type(error).__name__}: {error}\n"
            "This is a bug in culm; please report it.",
            1,
        ) from error


def _refuse_existing(path):
    if path.exists() or path.is_symlink():
        raise CulmError(
            f"{path}: exists and may have been edited: remove it, or name another file with --output", FILE_ERROR
        )


def _header(file, format, findings):
    lines = [f" Imported from {file.name} by 'culm import {format}'; yours to edit. The report stands beside it."]
    lines += [f"     Left out: {sentence}" for sentence in findings.left_out]
    return "\n".join(lines).strip()


def _build(program, deck):
    """The model as culm sees it. Raises CulmError with what culm says if it refuses the deck."""
    done = program.call("check", deck)
    said = done.stderr.replace(str(deck.parent) + "/", "").strip()
    if done.returncode == DOES_NOT_SOLVE:  # the deck is what the file is: a mechanism, for example
        print(f"warning: the deck does not solve as it is:\n{said}", file=sys.stderr)
    elif done.returncode != 0:
        raise CulmError(f"the deck that this file makes cannot be built, nothing is written:\n{said}", DECK_ERROR)
    return (done.stdout + done.stderr).replace(str(deck.parent) + "/", "")


def _move(folder, target, names):
    """All files or none."""
    moved = []
    try:
        for name in names:
            with open(target / name, "x"):
                moved.append(target / name)
            shutil.copyfile(folder / name, target / name)
    except OSError as error:
        for path in moved:
            path.unlink(missing_ok=True)
        raise CulmError(f"{error.filename}: cannot write: {error.strerror}", FILE_ERROR) from error
