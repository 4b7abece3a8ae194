"""What is taken out of a deck, and what finders of effects ask a resolved deck."""

import dataclasses

LIGHT = 1e-6  # factor on what cannot be zero and stands for none


@dataclasses.dataclass
class Removal:
    effect: str
    where: str  # structures, loads or sections it is taken from
    settings: list  # path=value
    note: str = ""  # what 'off' means where it is not exactly that


def parameters(deck, path):
    """Parameters of a list by name, without those of lists below."""
    start = path + "/"
    return {
        one[len(start) :]: value
        for one, value in deck.parameters.items()
        if one.startswith(start) and "/" not in one[len(start) :]
    }


def of_types(deck, path, *types):
    return [name for name in deck.names_in(path) if deck.parameters.get(f"{path}/{name}/Type") in types]


def inactive(deck, analysis):
    return words(deck.parameters.get(f"Analyses/{analysis}/Inactive") or "{}")


def words(text):
    return [word.strip().strip('"') for word in text.strip("{}").split(",") if word.strip()]


def array(names):
    return "{" + ", ".join(f'"{name}"' for name in names) + "}"


def same(deck, path, kind, but=()):
    """Entries of a type whose parameters are the same but for some, as lists of names."""
    groups = {}
    for name in of_types(deck, path, kind):
        own = {key: value for key, value in parameters(deck, f"{path}/{name}").items() if key not in but}
        groups.setdefault(tuple(sorted(own.items())), []).append(name)
    return groups.values()
