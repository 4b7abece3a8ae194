#!/usr/bin/env python3
"""Checks that the documentation has not drifted from the code.

- Formulas in $$ stand between empty lines: others are not drawn on the site.
- Links between pages, also to headings, and paths in `code`, lead somewhere.
- Code below `<!-- verbatim PATH -->` stands so in that file.
- The table of packages in doc/developer/architecture.md says what their CMakeLists.txt say.
- CHANGELOG.md knows the version, and that of the format of decks.
- Every section that a comment cites, as in `@source formulation 4.1`, has a page in doc/theory/README.md.
"""

import pathlib
import re
import sys
import textwrap

from check_layers import PACKAGES, ROOT, close, read_dependencies

DOC = ROOT / "doc"
THEORY = DOC / "theory/README.md"
ARCHITECTURE = DOC / "developer/architecture.md"
ROOTS = ("packages/", "tests/", "tools/", "inputs/", "cmake/", "src/", "doc/")


def pages():
    yield ROOT / "README.md"
    yield ROOT / "CHANGELOG.md"
    yield from sorted(DOC.rglob("*.md"))
    yield from sorted(PACKAGES.glob("*/README.md"))
    yield from sorted((ROOT / "tests").rglob("README.md"))


def exists(base, name):
    return (base / name).exists() or any(base.glob(name))


def anchors(text):
    """By which links reach the headings of a page."""
    headings = re.findall(r"^#+ (.+?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def check_page(page):
    place = page.relative_to(ROOT)
    text = page.read_text()
    for link, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)]*))?\)", text):
        target = page.parent / link if link else page
        if "://" in link:
            continue
        if not target.exists():
            yield f"{place}: the link '{link}' leads nowhere"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text()):
            yield f"{place}: there is no heading '{anchor}' in '{link or page.name}'"
    for name in re.findall(r"`([^`\s{}<>…]+)`", text):
        name = re.sub(r":\d+$", "", name)
        if not name.startswith(ROOTS) or "NAME" in name or name.startswith("src/"):
            continue
        if not exists(ROOT, name.rstrip("/.,")):
            yield f"{place}: there is no '{name}'"


def check_code(page):
    for name, code in re.findall(r"<!-- verbatim (\S+) -->\s*```\w*\n(.*?)\n *```", page.read_text(), re.S):
        if textwrap.dedent(code).strip() not in (ROOT / name).read_text():
            yield f"{page.relative_to(ROOT)}: the code from '{name}' does not stand there any more"


def check_formulas(page):
    """Those of doc, of which tools/site makes pages."""
    text = re.sub(r"^```.*?^```", lambda code: re.sub(r"[^\n]", " ", code[0]), page.read_text(), flags=re.M | re.S)
    for found in re.finditer(r"\$\$.+?\$\$", text, re.S):
        before, after = text[: found.start()], text[found.end() :]
        if not re.search(r"\n[ \t]*\n[ \t]*$", before) or not re.match(r"[ \t]*\n([ \t]*\n|$)", after):
            yield f"{page.relative_to(ROOT)}:{before.count(chr(10)) + 1}: the formula does not stand between empty lines"


def check_packages():
    direct = {folder.name: read_dependencies(folder) for folder in sorted(PACKAGES.iterdir())
              if (folder / "CMakeLists.txt").exists()}
    reached = close(direct)
    told = {}
    section = ARCHITECTURE.read_text().split("## Packages\n")[1].split("\n## ")[0]
    for names, below in re.findall(r"^\| ((?:`\w+`(?:, )?)+) \| ([^|]*) \|", section, re.M):
        for name in re.findall(r"\w+", names):
            told[name] = set(re.findall(r"\w+", below))
    place = ARCHITECTURE.relative_to(ROOT)
    for name in direct:
        if name not in told:
            yield f"{place}: package '{name}' is not in the table"
        elif set(direct[name]) != told[name]:
            yield f"{place}: '{name}' depends on {sorted(direct[name])}, the table says {sorted(told[name])}"
    for name in told.keys() - reached.keys():
        yield f"{place}: there is no package '{name}'"


def key(section):
    return tuple(int(part) for part in section.split("."))


def cited_sections():
    """Section and place of all citations."""
    for path in sorted(PACKAGES.rglob("*.[ch]pp")) + sorted((ROOT / "tests").rglob("*.hpp")):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            cited = re.search(r"formulation ((?:\d+(?:\.\d+)*[a-z]?(?:, )?)+)", line)
            if not cited:
                continue
            for section in re.findall(r"\d+(?:\.\d+)*", cited.group(1)):
                yield section, f"{path.relative_to(ROOT)}:{number}"


def check_sources():
    known = []  # first and last of each range
    table = THEORY.read_text().split("## Section numbers in comments")[1].split("\n## ")[0]
    for row in re.findall(r"^\| ([0-9.,– ]+) \|", table, re.M):
        for entry in row.split(", "):
            ends = entry.split("–")
            known.append((key(ends[0].strip()), key(ends[-1].strip())))
    for section, place in cited_sections():
        cited = key(section)
        if not any(first <= cited <= last or cited[: len(last)] == last or first[: len(cited)] == cited
                   for first, last in known):
            yield f"{place}: section {section} of the formulation is not in {THEORY.relative_to(ROOT)}"


def check_changes():
    """The newest entry of CHANGELOG.md is that of the version and format of decks in the code."""
    entry = (ROOT / "CHANGELOG.md").read_text().split("\n## ")[1]
    version = re.search(r'version = "(.*)"', (PACKAGES / "base/include/culm/base/version.hpp").read_text())[1]
    number = re.search(r"format_version = (\d+)", (PACKAGES / "deck/include/culm/deck/format.hpp").read_text())[1]
    project = re.search(r"project\(culm VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
    if project != version:
        yield f"CMakeLists.txt: version {project}, but {version} in version.hpp"
    if not entry.startswith(version):
        yield f"CHANGELOG.md: the newest entry is not that of {version}"
    if f"Deck format {number}" not in entry:
        yield f"CHANGELOG.md: the newest entry does not name 'Deck format {number}'"


def main():
    errors = []
    count = 0
    for page in pages():
        count += 1
        errors += check_page(page)
        errors += check_code(page)
        if page.is_relative_to(DOC):
            errors += check_formulas(page)
    errors += check_packages()
    errors += check_sources()
    errors += check_changes()
    for error in errors:
        print(error)
    print(f"docs: {count} pages, {len(errors)} errors")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
