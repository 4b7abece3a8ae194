"""Boxes of turbulence have the variance and the coherence that they were made for."""

import struct
import tempfile
import unittest

import numpy as np

from culm import turbulence

OPTIONS = ["--speed", "10", "--deviation", "1.5", "--height", "90", "--size", "20", "20", "--points", "3", "3",
           "--duration", "100", "--step", "0.25"]


def box(seed):
    arguments = turbulence.parser().parse_args(["x", *OPTIONS, "--seed", str(seed)])
    return turbulence.fluctuations(arguments), arguments


class Turbulence(unittest.TestCase):
    def test_the_same_seed_makes_the_same_box(self):
        self.assertTrue((box(3)[0] == box(3)[0]).all())
        self.assertFalse((box(3)[0] == box(4)[0]).all())

    def test_the_spectrum_holds_the_variance(self):
        edges = np.concatenate([[0.0], np.logspace(-6, 5, 20000)])
        values = turbulence.spectrum(edges, 1.5, 340.2, 10.0)
        area = (0.5 * (values[1:] + values[:-1]) * np.diff(edges)).sum()
        self.assertAlmostEqual(area / 1.5**2, 1.0, delta=1e-3)

    def test_variances_are_those_of_the_spectrum(self):
        frequency = np.arange(1, 200) / 100.0
        for component in range(3):
            power = turbulence.spectrum(frequency, 1.5 * turbulence.DEVIATIONS[component],
                                        42.0 * turbulence.LENGTHS[component], 10.0)
            # the first point follows one set of phases: its variance is exact
            self.assertAlmostEqual(box(1)[0][:, 0, 0, component].var() / (power.sum() / 100.0), 1.0, delta=1e-12)

    def test_a_scaled_box_has_what_was_asked_for(self):
        arguments = turbulence.parser().parse_args(["x", *OPTIONS, "--scaled"])
        found = turbulence.fluctuations(arguments)[:, 0, 0].std(axis=0)
        self.assertLess(np.abs(found / (1.5 * np.array(turbulence.DEVIATIONS)) - 1.0).max(), 1e-12)
        self.assertLess(turbulence.deviations_held(arguments)[0], 0.8)

    def test_pairs_are_as_coherent_as_asked(self):
        seeds = 60
        frequency = np.arange(1, 200) / 100.0
        low = slice(0, 8)
        along = across = 0.0
        for seed in range(seeds):
            waves = np.fft.rfft(box(seed)[0], axis=0)[1:200]
            first, last = waves[low, 0, 0], waves[low, 0, 1]
            along = along + (last[:, 0] * first[:, 0].conj()).real / np.abs(first[:, 0]) ** 2
            across = across + (last[:, 1] * first[:, 1].conj()).real / np.abs(first[:, 1]) ** 2
        expected = turbulence.coherence(frequency[low], 10.0, 90.0, 10.0)
        # the mean of so many cosines of random phases has this deviation
        error = np.sqrt(0.5 / (seeds * 8))
        self.assertLess(abs((along / seeds - expected).mean()), 4.0 * error)
        self.assertLess(abs((across / seeds).mean()), 4.0 * error)
        self.assertGreater(expected.mean(), 8.0 * error)

    def test_files_hold_the_velocities(self):
        velocities, arguments = box(1)
        with tempfile.NamedTemporaryFile(suffix=".bts") as file:
            turbulence.write(file.name, velocities, arguments)
            data = file.read()
        self.assertEqual(struct.unpack("<hiiii", data[:18]), (8, 3, 3, 0, 400))
        slope, intercept = np.frombuffer(data, "<f4", 6, 42).astype(float).reshape(3, 2).T
        length = struct.unpack("<i", data[66:70])[0]
        values = np.frombuffer(data, "<i2", velocities.size, 70 + length).reshape(velocities.shape)
        self.assertEqual(len(data), 70 + length + 2 * velocities.size)
        # half a step of the integers, and the rounding of the offset to single precision
        self.assertLess((np.abs((values - intercept) / slope - velocities) * slope).max(), 0.51)


if __name__ == "__main__":
    unittest.main()
