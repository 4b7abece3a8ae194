"""The verbs of the program with their options, from the tables that `--help` prints."""

import argparse
import dataclasses
import difflib
import importlib
import json


PYTHON_VERBS = ("completion", "effects", "export", "hard", "import", "manual", "report", "study", "sweep", "view")


@dataclasses.dataclass
class Option:
    """A named option, or a word that stands without one."""

    names: list
    value: str  # what follows it; empty for flags and words
    help: str
    required: bool
    positional: bool


@dataclasses.dataclass
class Command:
    """The program, or a verb of it."""

    name: str  # as it is called: "culm import openfast"
    summary: str
    footer: str
    options: list
    verbs: list

    @property
    def verb(self):
        return self.name.split()[-1]

    def all(self):
        """The command and those below it."""
        yield self
        for verb in self.verbs:
            yield from verb.all()


def read(program):
    """The command `culm`, by the program that tells of the verbs in C++."""
    done = program.call("commands")
    culm = _command("", json.loads(done.stdout, strict=False))
    for verb in culm.verbs:
        if verb.verb in PYTHON_VERBS:
            parser = argparse.ArgumentParser()
            module = module_of(verb.verb)
            module.declare(parser)
            verb.footer = (module.__doc__ or "").strip()
            _take_over(parser, verb)
    return culm


def module_of(verb):
    """The module of a verb, which has its name, unless the word is one of Python's own."""
    name = "importing" if verb == "import" else verb
    return importlib.import_module(f".{name}", __package__)


def explain_unknown_word(word, parser):
    """What is wrong with an option, or another word, that the parser of a verb does not know."""
    if not word.startswith("-"):
        return f"'{word}' is one word too many for '{parser.prog}'\nRun with --help for more information."
    name = word.split("=")[0]
    known = [option for action in parser._actions for option in action.option_strings if option.startswith("--")]
    near = difflib.get_close_matches(name, known, n=1)
    hint = f" – did you mean '{near[0]}'?" if near else f" (allowed: {', '.join(known)})"
    return f"unknown option '{name}'{hint}\nRun with --help for more information."


def _command(above, table):
    name = f"{above} {table['name']}".strip()
    return Command(
        name,
        table["summary"],
        table["footer"],
        [Option(**option) for option in table["options"]],
        [_command(name, verb) for verb in table["verbs"]],
    )


def _take_over(parser, command):
    """Options of a parser, and verbs below it but those that the program knows itself."""
    known = {verb.verb for verb in command.verbs}
    command.options = []
    for action in parser._actions:
        if not isinstance(action, argparse._SubParsersAction):
            command.options.append(_option(parser, action))
            continue
        for name, below in action.choices.items():
            if name in known:
                continue
            verb = Command(f"{command.name} {name}", below.description or "", "", [], [])
            _take_over(below, verb)
            command.verbs.append(verb)


def _option(parser, action):
    formatter = parser._get_formatter()
    positional = not action.option_strings
    value = "" if positional or action.nargs == 0 else formatter._format_args(action, action.dest.upper())
    return Option(
        list(action.option_strings) or [action.dest],
        value,
        (action.help or "") % {"default": action.default} if action.help else "",
        action.required and not action.default,
        positional,
    )
