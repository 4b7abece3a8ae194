#!/usr/bin/env python3
"""What the program offers to shells and readers: completion of bash and zsh, pages for man.

usage: shells.py --culm PROGRAM
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def output(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=True, **more).stdout


def completed(script, words):
    """What bash offers for the last of the words."""
    line = " ".join(f"'{word}'" for word in words)
    return output("bash", "-c", f"""
        source {script}
        COMP_WORDS=({line}) COMP_CWORD={len(words) - 1}
        _culm
        printf '%s\\n' "${{COMPREPLY[@]}}"
    """, cwd=script.parent).split()


def check_bash(culm, folder):
    script = folder / "culm.bash"
    script.write_text(output(culm, "completion", "bash"))
    (folder / "mast.xml").write_text("")
    yield completed(script, ["culm", "ch"]), ["check"]
    yield completed(script, ["culm", "run", "--se"]), ["--set"]
    yield completed(script, ["culm", "run", "ma"]), ["mast.xml"]
    yield completed(script, ["culm", "run", "--output", "mast"]), ["mast.xml"]
    yield completed(script, ["culm", "study", "--va"]), ["--vary"]
    yield completed(script, ["culm", "import", "openf"]), ["openfast"]
    yield completed(script, ["culm", "import", "openfast", "--blade-"]), ["--blade-mass"]
    yield completed(script, ["culm", "nothing", "--x"]), []


def check_zsh(culm, folder):
    """The functions, with those of zsh that they call in place of a terminal."""
    script = folder / "_culm"
    script.write_text(output(culm, "completion", "zsh"))
    stubs = """
        _describe() { print -l -- ${(P)2} }
        _arguments() { print -l -- "$@" }
    """
    verbs = output("zsh", "-fc", f"{stubs}; words=(culm ''); CURRENT=2; source {script}")
    yield "run:Run a deck" in verbs.split("\n"), True
    options = output("zsh", "-fc", f"{stubs}; words=(culm run ''); CURRENT=3; source {script}")
    yield "*--quiet[Print warnings and errors only]" in options.split("\n"), True


def check_options(culm, folder):
    """Completion and manual know exactly the options that --help names."""
    script = folder / "culm.bash"
    pages = folder / "man"
    subprocess.run([culm, "manual", pages], check=True)
    for verb in ("run", "check", "couple", "resume", "study", "hard", "view"):
        told = set(re.findall(r"^ +(?:-\w, ?)?(--[a-z-]+)", output(culm, verb, "--help"), re.M))
        page = (pages / f"culm-{verb}.1").read_text().replace("\\-", "-")
        terms = set(re.findall(r"\\fB(--[a-z-]+)\\fR", page))
        yield (verb, terms), (verb, told)
        yield (verb, set(completed(script, ["culm", verb, "--"]))), (verb, told)


def check_manual(culm, folder):
    for page in sorted((folder / "man").glob("*.1")):
        done = subprocess.run(["man", "--warnings", "--encoding=UTF-8", "-l", page], capture_output=True, text=True,
                              env={"MANWIDTH": "100", "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
        yield (page.name, done.stderr), (page.name, "")
        named = subprocess.run(["lexgrog", page], capture_output=True, text=True)
        yield (page.name, named.returncode), (page.name, 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--culm", required=True)
    culm = parser.parse_args().culm
    count = failures = 0
    checks = [check_bash, check_options]
    checks += [check_zsh] if shutil.which("zsh") else []
    checks += [check_manual] if shutil.which("lexgrog") else []
    with tempfile.TemporaryDirectory() as name:
        for check in checks:
            for found, expected in check(culm, pathlib.Path(name)):
                count += 1
                if found != expected:
                    failures += 1
                    print(f"{check.__name__}: got {found}, expected {expected}")
    print(f"{count} checks by {len(checks)} of 4 programs, {failures} failures")
    return 1 if failures else 0


sys.exit(main())
