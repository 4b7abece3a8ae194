"""Entries of the catalogue of hard cases."""

import dataclasses
from collections.abc import Callable

# what makes a case hard
KEYS = {
    "LK": "locking",
    "SN": "snap-through, path following",
    "BI": "bifurcation",
    "MR": "high mass ratio",
    "NS": "near-singular or redundant constraints",
    "ST": "stiff",
    "LD": "long-time drift",
    "LR": "large rotation",
    "HF": "unresolved high frequencies",
    "IP": "ill-posed: to be refused with a diagnosis",
}

SHARP = 1.1
ROUNDING = 3.0


@dataclasses.dataclass(frozen=True)
class Case:
    """A deck, and a number that grows until a run is no longer good."""

    name: str
    keys: str  # of KEYS, separated by blanks
    deck: str  # below inputs/
    stressor: str  # what grows, with its unit
    recommended: float
    settings: Callable[[float], list]  # path=value for a value of the stressor
    checks: list  # of judge.Check; all must hold
    limit: float = 1e6  # growth at which the search ends: 'no limit found'
    growth: float = 10.0  # from one try to the next
    # first bad over last good value at which the search ends; limits that rounding sets are not
    # sharp, because other machines round otherwise: ROUNDING
    resolution: float = SHARP
    whole: bool = False  # the stressor counts something

    def rounded(self, value):
        return float(round(value)) if self.whole else value


@dataclasses.dataclass(frozen=True)
class IllPosed:
    """A deck that has no solution: it must fail as told."""

    name: str
    deck: str
    settings: list
    exit: int
    says: str  # part of the message
    keys: str = "IP"
