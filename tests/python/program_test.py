"""What the program says, whatever bytes are in it."""

import pathlib
import tempfile
import unittest

from culm.errors import CulmError
from culm.program import Program

SAYS = r"""#!/bin/sh
printf 'd\351ck'
printf 'd\351ck' >&2
exit 3
"""
READ = "d\ufffdck"


class Bytes(unittest.TestCase):
    def test_are_read_as_text(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            path = folder / "culm"
            path.write_text(SAYS)
            path.chmod(0o755)
            program = Program(path)
            run = program.run("deck.xml", folder / "out")
            self.assertEqual((run.exit, run.output, run.errors), (3, READ, READ))
            self.assertEqual(program.call("check").stdout, READ)
            with self.assertRaisesRegex(CulmError, READ):
                program.resolve("deck.xml", folder / "resolved.xml")


if __name__ == "__main__":
    unittest.main()
