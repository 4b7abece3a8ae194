"""What partners answer is taken as they mean it, or refused."""

import unittest

import culm_partner
import numpy


class Loads(unittest.TestCase):
    def test_of_any_layout(self):
        loads = numpy.arange(12.0).reshape(2, 6)
        for given in (loads, numpy.asfortranarray(loads), loads.tolist(), loads.astype(numpy.float32), numpy.ma.array(loads)):
            self.assertEqual(culm_partner._loads(given, 2).tobytes(), loads.tobytes())

    def test_what_is_hidden_is_refused(self):
        loads = numpy.ma.array(numpy.ones((2, 6)), mask=False)
        loads[1, 2] = numpy.ma.masked
        with self.assertRaisesRegex(ValueError, "masked values"):
            culm_partner._loads(loads, 2)

    def test_columns_for_rows_are_refused(self):
        with self.assertRaisesRegex(ValueError, r"\(6, 2\) instead of \(2, 6\)"):
            culm_partner._loads(numpy.ones((6, 2)), 2)


if __name__ == "__main__":
    unittest.main()
