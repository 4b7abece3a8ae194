#!/usr/bin/env python3
"""Every formula on the pages of the documentation is one that KaTeX can draw.

usage: formulas.py     (77: skipped, there is no browser or no KaTeX)
"""

import json
import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
from browser import Browser, find_browser  # noqa: E402

KATEX = pathlib.Path("/usr/share/javascript/katex/katex.min.js")
CODE = re.compile(r"^```.*?^```|^(?: {4,}|\t).*?$|`[^`\n]*`", re.M | re.S)
FORMULA = re.compile(r"\$\$(.+?)\$\$|(?<![\\$])\$(?!\s)([^$]+?)(?<!\s)\$", re.S)


def formulas():
    """Page, line, text and whether it stands by itself."""
    for page in sorted((ROOT / "doc").rglob("*.md")):
        text = CODE.sub(lambda code: re.sub(r"[^\n]", " ", code[0]), page.read_text())
        for found in FORMULA.finditer(text):
            line = text.count("\n", 0, found.start()) + 1
            yield page.relative_to(ROOT), line, found[1] or found[2], found[1] is not None


def main():
    program = find_browser()
    if program is None or not KATEX.exists():
        print("there is no browser, or no KaTeX")
        return 77
    found = list(formulas())
    with tempfile.TemporaryDirectory(prefix="culm") as folder:
        page = pathlib.Path(folder) / "formulas.html"
        page.write_text(f"<!DOCTYPE html><meta charset='utf-8'><script>{KATEX.read_text()}</script>")
        with Browser(program) as browser:
            browser.open(page.as_uri())
            draw = """(texts) => texts.map(([tex, displayMode]) => {
                try { katex.renderToString(tex, { displayMode, strict: 'ignore' }); return ''; }
                catch (error) { return error.message; } })"""
            texts = [[tex, display] for _, _, tex, display in found] + [["\\frac{1", False]]
            *errors, wrong = browser.run(f"({draw})({json.dumps(texts)})")
    mistakes = [(place, error) for place, error in zip(found, errors) if error]
    for (path, line, tex, _), error in mistakes:
        print(f"{path}:{line}: {error}: {tex}")
    print(f"{len(found)} formulas, {len(mistakes)} that cannot be drawn")
    return 1 if mistakes or not wrong or len(found) < 100 else 0


sys.exit(main())
