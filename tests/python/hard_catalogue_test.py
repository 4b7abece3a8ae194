"""The catalogue, the choice of cases and the file of margins."""

import argparse
import contextlib
import io
import math
import pathlib
import tempfile
import unittest

from culm.hard import declare, main, margins, select
from culm.hard.case import KEYS
from culm.hard.catalogue import CASES, ILL_POSED

INPUTS = pathlib.Path(__file__).resolve().parents[2] / "inputs"


def entry(**changes):
    values = {
        "name": "a case", "keys": "LK LR", "stressor": "x", "recommended": 2.0, "last_good": 20.0,
        "first_bad": 22.0, "kind": "failed", "how": "exit 4", "told": True, "beyond": "failed",
    }  # fmt: skip
    return margins.Entry(**{**values, **changes})


class PartTest(unittest.TestCase):
    def listed(self, *words):
        parser = argparse.ArgumentParser()
        declare(parser)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            main(parser.parse_args([*words, "--list"]), program=None)
        return [one.name for one in (*CASES, *ILL_POSED) if f"{one.name}  " in printed.getvalue()]

    def test_parts_have_every_case_once(self):
        parts = [name for part in ("1/3", "2/3", "3/3") for name in self.listed("--part", part)]
        self.assertEqual(sorted(parts), sorted(self.listed()))
        self.assertGreater(len(parts), 50)

    def test_of_what_is_no_part(self):
        for text in ("0/3", "4/3", "1", "1/0", "a/b"):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                self.listed("--part", text)


class OutputTest(unittest.TestCase):
    def test_files_that_cannot_be_written_are_told_before_anything_runs(self):
        parser = argparse.ArgumentParser()
        declare(parser)
        with tempfile.TemporaryDirectory() as folder:
            for option in ("--json", "--plot"):
                path = f"{folder}/none/file"
                with self.assertRaises(OSError) as caught:
                    main(parser.parse_args(["--only", "snap", option, path]), program=None)
                self.assertEqual(caught.exception.filename, path)


class CatalogueTest(unittest.TestCase):
    def test_covers_every_key(self):
        used = {key for case in (*CASES, *ILL_POSED) for key in case.keys.split()}
        self.assertEqual(used, set(KEYS))

    def test_names_are_unique(self):
        names = [one.name for one in (*CASES, *ILL_POSED)]
        self.assertEqual(len(names), len(set(names)))

    def test_decks_exist(self):
        for one in (*CASES, *ILL_POSED):
            self.assertTrue((INPUTS / one.deck).exists(), one.name)

    def test_settings_follow_the_stressor(self):
        for case in CASES:
            mild, harsh = (case.settings(x) for x in (case.recommended, 4 * case.recommended))
            self.assertNotEqual(mild, harsh, case.name)
            self.assertTrue(all("=" in setting for setting in harsh), case.name)

    def test_choice(self):
        self.assertEqual(select(CASES, []), CASES)
        for case in select(CASES, ["MR"]):
            self.assertIn("MR", case.keys.split())
        self.assertTrue(all("Lee" in case.name for case in select(CASES, ["lee's"])))
        self.assertEqual(select(CASES, ["nothing like this"]), [])


class MarginsTest(unittest.TestCase):
    def test_come_back_from_the_file(self):
        found = [entry(), entry(name="open", first_bad=math.inf, kind="good", beyond="")]
        refused = [margins.Refusal("ill", "failed", "exit 3")]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "margins.json"
            margins.write(path, "1.2.3", found, refused)
            entries, refusals = margins.read(path)
        self.assertEqual(list(entries.values()), found)
        self.assertEqual(list(refusals.values()), refused)

    def test_margin(self):
        self.assertEqual(entry().margin, 10.0)
        self.assertFalse(entry().is_open)
        self.assertTrue(entry(first_bad=math.inf).is_open)

    def test_shrinking(self):
        def has_shrunk(last_good, resolution=1.1):
            return margins.has_shrunk(entry(), entry(last_good=last_good), resolution)

        self.assertFalse(has_shrunk(20.0))
        self.assertFalse(has_shrunk(18.5))
        self.assertTrue(has_shrunk(18.0))
        self.assertFalse(has_shrunk(7.0, resolution=3.0))
        self.assertTrue(has_shrunk(math.nan))
        self.assertFalse(margins.has_shrunk(entry(last_good=math.nan), entry(), 1.1))

    def test_faults_at_the_limit_and_beyond(self):
        self.assertFalse(margins.is_faulty(entry()))
        self.assertTrue(margins.is_faulty(entry(kind="faulty")))
        self.assertTrue(margins.is_faulty(entry(beyond="faulty")))
        self.assertTrue(margins.is_faulty(margins.Refusal("ill", "faulty", "")))


if __name__ == "__main__":
    unittest.main()
