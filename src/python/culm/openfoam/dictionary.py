"""Files of OpenFOAM in its text format: entries, lists and dictionaries."""

import re

from ..errors import CulmError

# comments, code blocks and directives, which say nothing of what is read here
_IGNORED = re.compile(r"/\*.*?\*/|//[^\n]*|#\{.*?#\}|^\s*#[^\n]*", re.DOTALL | re.MULTILINE)
_TOKEN = re.compile(r'"[^"]*"|[{}();]|[^\s{}();"]+')


def read_dictionary(path):
    """Entries by their names: a word, a list of words and lists, or a dictionary. Raises CulmError where
    the file cannot be read or is no dictionary."""
    try:
        text = path.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise CulmError(f"cannot read '{path}': {error}", 6) from error
    tokens = _TOKEN.findall(_IGNORED.sub(" ", text))[::-1]
    try:
        return _read_entries(tokens, is_inner=False)
    except IndexError:
        raise CulmError(f"'{path}' ends within an entry or a list", 6) from None
    except ValueError as error:
        raise CulmError(f"'{path}': {error}", 6) from None


def _read_entries(tokens, is_inner):
    entries = {}
    while tokens or is_inner:
        name = tokens.pop()
        if name == "}" and is_inner:
            break
        if name in "{}()" or name == "}":
            raise ValueError(f"'{name}' stands where a name must be")
        if name == ";":
            continue
        if tokens[-1] == "{":
            tokens.pop()
            entries[name] = _read_entries(tokens, is_inner=True)
        else:
            values = _read_values(tokens, ";")
            entries[name] = values[0] if len(values) == 1 else values
    return entries


def _read_values(tokens, end):
    values = []
    while (token := tokens.pop()) != end:
        if token == "(":
            if values and isinstance(values[-1], str) and values[-1].isdigit():
                values.pop()  # the length, which may stand before a list
            values.append(_read_values(tokens, ")"))
        elif token in "{});":
            raise ValueError(f"'{token}' stands within a list or an entry that is not closed")
        else:
            values.append(token)
    return values
