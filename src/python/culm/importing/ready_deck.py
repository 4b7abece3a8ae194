"""A deck that a reader has made itself, for formats that know beams as culm does."""

import dataclasses
import typing

from .deck_text import List
from .findings import Findings


@dataclasses.dataclass
class ReadyDeck:
    """@param mass  of all that has any, from the numbers of the file [kg]; None if not known"""

    root: List
    findings: Findings
    mass: typing.Optional[float] = None
    notes: list = dataclasses.field(default_factory=list)  # lines of the report
