"""Files are there as a whole or not at all, and so is what would be read from them."""

import argparse
import errno
import pathlib
import tempfile
import unittest
import unittest.mock

import culm
from culm import report
from culm.errors import CulmError
from culm.whole_file import refuse_unwritable, write_whole


class WholeFile(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)


class Writing(WholeFile):
    def test_text_and_bytes(self):
        for data, read in (("ü", b"\xc3\xbc"), (b"PK\xff", b"PK\xff"), ("d\udce9ck", b"d?ck")):
            write_whole(self.folder / "file", data)
            self.assertEqual((self.folder / "file").read_bytes(), read)

    def test_a_full_disk_leaves_nothing(self):
        full = OSError(errno.ENOSPC, "No space left on device")
        with unittest.mock.patch("os.replace", side_effect=full), self.assertRaises(OSError) as caught:
            write_whole(self.folder / "file", b"PK")
        self.assertEqual(caught.exception.filename, str(self.folder / "file"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_what_cannot_be_written_is_told_before(self):
        with self.assertRaises(OSError) as caught:
            refuse_unwritable(self.folder / "none/file")
        self.assertEqual(caught.exception.filename, str(self.folder / "none/file"))
        kept = self.folder / "kept"
        kept.write_text("kept")
        refuse_unwritable(kept)
        refuse_unwritable(self.folder / "new")
        self.assertEqual([(path.name, path.read_text()) for path in self.folder.iterdir()], [("kept", "kept")])


class Reading(WholeFile):
    def test_a_result_file_that_is_none_is_named(self):
        path = self.folder / "run.h5"
        path.touch()
        said = f"cannot read '{path}', which is damaged or incomplete"
        with self.assertRaisesRegex(CulmError, said):
            culm.read(self.folder)
        parser = argparse.ArgumentParser()
        report.declare(parser)
        with self.assertRaisesRegex(CulmError, said):
            report.main(parser.parse_args([str(self.folder)]), program=None)


if __name__ == "__main__":
    unittest.main()
