"""Writes the manual as pages for `man`: culm.1, and one page for each verb, such as culm-run.1."""

import pathlib

from . import commands
from .errors import CulmError


def declare(parser):
    parser.add_argument("folder", type=pathlib.Path, help="where to write the pages")


def main(arguments, program):
    version = program.call("--version").stdout.split("\n")[0]
    culm = commands.read(program)
    try:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        for command in culm.all():
            path = arguments.folder / f"{_page_name(command)}.1"
            path.write_text(_page(command, culm, version), encoding="utf-8")
    except OSError as error:
        raise CulmError(str(error), 6) from error
    return 0


def _page_name(command):
    return command.name.replace(" ", "-")


def _escaped(text):
    """A text as roff takes it literally."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(f"\\&{line}" if line[:1] in ".'" else line for line in text.split("\n"))


def _page(command, culm, version):
    name = _page_name(command)
    summary = command.summary.removeprefix("culm: ").rstrip(".")
    lines = [
        f'.TH {name.upper()} 1 "" "culm {version}" "culm"',
        ".SH NAME",
        f"{_escaped(name)} \\- {_escaped(summary[0].lower() + summary[1:])}",
        ".SH SYNOPSIS",
        *_synopsis(command),
    ]
    if command.footer and not command.footer.startswith("Exit codes"):
        lines += [".SH DESCRIPTION", _escaped(command.footer)]
    if command.verbs:
        lines.append(".SH COMMANDS")
        for verb in command.verbs:
            lines += [".TP", f".BR {_escaped(_page_name(verb))} (1)", _escaped(verb.summary)]
    words = [option for option in command.options if option.positional]
    options = [option for option in command.options if not option.positional]
    for title, entries in (("ARGUMENTS", words), ("OPTIONS", options)):
        if entries:
            lines.append(f".SH {title}")
        for entry in entries:
            lines += [".TP", _term(entry), _escaped(" ".join(entry.help.split())) or "\\&"]
    if command.footer.startswith("Exit codes"):
        codes = " ".join(command.footer.removeprefix("Exit codes:").split())
        lines.append(".SH EXIT STATUS")
        for code in codes.split("; "):
            number, meaning = code.split(" ", 1)
            lines += [".TP", f".B {number}", _escaped(meaning)]
    if command is not culm:
        lines += [".SH SEE ALSO", ".BR culm (1)"]
    return "\n".join(lines) + "\n"


def _synopsis(command):
    if command.verbs:
        return [f".B {_escaped(command.name)}", ".I command", "[...]"]
    words = [option.names[0] for option in command.options if option.positional]
    return [f".B {_escaped(command.name)}", "[\\fIoptions\\fR]", *(f".I {_escaped(word)}" for word in words)]


def _term(option):
    names = ", ".join(f"\\fB{_escaped(name)}\\fR" for name in option.names)
    return names + (f" \\fI{_escaped(option.value)}\\fR" if option.value else "")
