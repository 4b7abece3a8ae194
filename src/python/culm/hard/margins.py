"""What was found, as numbers to keep: JSON."""

import dataclasses
import json
import math

from . import judge


@dataclasses.dataclass(frozen=True)
class Entry:
    """A case and its margin."""

    name: str
    keys: str
    stressor: str
    recommended: float
    last_good: float  # nan if not even the recommended value is good
    first_bad: float  # inf if none was found
    kind: str  # of judge: what happens at the first bad value
    how: str
    told: bool
    beyond: str  # kind of what happens ten times farther; '' if there is no limit

    @property
    def margin(self):
        return self.last_good / self.recommended

    @property
    def is_open(self):
        return math.isinf(self.first_bad)


@dataclasses.dataclass(frozen=True)
class Refusal:
    """An ill-posed deck and what was said of it."""

    name: str
    kind: str
    how: str


def is_faulty(found):
    return judge.FAULTY in (found.kind, getattr(found, "beyond", ""))


def has_shrunk(before, after, resolution):
    """Below what it was by more than the search resolves; nothing can shrink below no margin."""
    return not math.isnan(before.margin) and not after.margin >= before.margin / resolution


def write(path, version, entries, refusals):
    data = {
        "culm": version,
        "cases": [_numbers(dataclasses.asdict(entry)) for entry in entries],
        "ill-posed": [dataclasses.asdict(refusal) for refusal in refusals],
    }
    with open(path, "w") as file:
        json.dump(data, file, indent=1, ensure_ascii=False)
        file.write("\n")


def read(path):
    """Entries and refusals by name."""
    with open(path) as file:
        data = json.load(file)
    entries = [
        Entry(**{**entry, **{name: float(entry[name]) for name in ("last_good", "first_bad")}})
        for entry in data["cases"]
    ]
    refusals = [Refusal(**refusal) for refusal in data["ill-posed"]]
    return {one.name: one for one in entries}, {one.name: one for one in refusals}


def _numbers(entry):
    """JSON knows no infinity: as text, which float() reads."""
    return {
        name: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in entry.items()
    }
