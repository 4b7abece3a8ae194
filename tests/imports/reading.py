"""Imports in this process: what a file becomes, without the program."""

import pathlib
import sys
import tempfile
import types

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "src/python"))
from culm.errors import CulmError  # noqa: E402
from culm.importing.deck import Deck  # noqa: E402
from culm.importing.deck_text import render  # noqa: E402
from culm.importing.formats import module_of  # noqa: E402
from culm.importing.model import Model  # noqa: E402


class Made:
    """@param text  of the deck;  @param files  meshes by name"""

    def __init__(self, format, path):
        self.made = module_of(format).read(pathlib.Path(path), types.SimpleNamespace(file=pathlib.Path(path)))
        self.files = {}
        self.mass = getattr(self.made, "mass", None)
        root = getattr(self.made, "root", None)
        if isinstance(self.made, Model):
            self.deck = Deck(self.made, "deck")
            root, self.files = self.deck.write()
            self.mass = self.deck.mass()
        self.root = root
        self.text = render(root)
        self.findings = self.made.findings

    def count(self):
        """How many entries each list of the deck has."""
        return {one.name: len(one.lists()) for one in self.root.lists()}

    def messages(self):
        return set(self.findings.left_out) | set(self.findings.assumed)


def made_of_text(format, data, name="sample.inp"):
    """@param data  bytes or text, or files by name, the first of which is read"""
    files = data if isinstance(data, dict) else {name: data}
    with tempfile.TemporaryDirectory() as folder:
        for one, content in files.items():
            content = content.encode() if isinstance(content, str) else content
            path = pathlib.Path(folder) / one
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        made = Made(format, pathlib.Path(folder) / next(iter(files)))
        made.text = made.text.replace(folder, "")  # in the places of comments
        return made


def not_refused(cases):
    """Complaints of texts that become a deck, or are refused in other words.

    @param cases  name -> text for Abaqus and words of the message; a format may stand before them"""
    complaints = []
    for name, (*format, text, words) in cases.items():
        try:
            made_of_text(*(format or ["abaqus"]), text)
            complaints.append(f"{name}: is not refused")
        except CulmError as error:
            if words not in str(error):
                complaints.append(f"{name}: {error}")
    return complaints
