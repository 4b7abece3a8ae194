"""The table of benchmarks in doc/verification/README.md: all keys, and only decks, pages and tests that are there."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "doc/verification"
KEY = r"\b(?:SB|SS|DY|MO|BU|HY)-\d+(?=[a-f]?\b)"  # SS-8a is a case of SS-8


def rows():
    """Key -> decks, pages, tests, verdict."""
    table = re.findall(rf"^\| ({KEY}) \|(.*)\|$", (PAGES / "README.md").read_text(), re.MULTILINE)
    return {key: [cell.strip() for cell in rest.split("|")] for key, rest in table}


def expand(text):
    """Keys of a text, of lists such as 'DY-1, 2, 5' and 'SS-8 to SS-11' as well."""
    keys = set(re.findall(KEY, text))
    for kind, numbers in re.findall(r"\b(SB|SS|DY|MO|BU|HY)-(\d+(?:, \d+)+)\b", text):
        keys |= {f"{kind}-{number}" for number in numbers.split(", ")}
    for kind, first, last in re.findall(r"\b(SB|SS|DY|MO|BU|HY)-(\d+) to \1-(\d+)", text):
        keys |= {f"{kind}-{number}" for number in range(int(first), int(last) + 1)}
    return keys


class Benchmarks(unittest.TestCase):
    def test_every_key_that_something_names_has_a_row(self):
        files = [*ROOT.glob("inputs/**/*.xml"), *ROOT.glob("tests/verification/*.py"), *PAGES.glob("*.md")]
        named = set().union(*(expand(path.read_text()) for path in files))
        self.assertGreater(len(named), 30)
        self.assertEqual(named - set(rows()), set())

    def test_decks_pages_and_tests_are_there_and_name_the_key(self):
        for key, (decks, pages, tests, verdict) in rows().items():
            self.assertTrue(verdict, key)
            if decks == "–":
                self.assertEqual((pages, tests, verdict), ("–", "–", "not compared"), key)
                continue
            for deck in re.findall(r"`([^`]+)`", decks):
                self.assertTrue((ROOT / f"inputs/{deck}.xml").is_file(), f"{key}: {deck}")
            for test in re.findall(r"`([^`]+)`", tests):
                self.assertTrue((ROOT / f"tests/verification/{test}.py").is_file(), f"{key}: {test}")
            for page, link in re.findall(r"\[([^]]+)\]\(([^)]+)\)", pages):
                self.assertEqual(link, f"{page}.md")
                self.assertIn(key, expand((PAGES / link).read_text()), f"{link} names it")


if __name__ == "__main__":
    unittest.main()
