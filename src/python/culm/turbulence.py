"""Makes a box of turbulence with the Kaimal spectrum of IEC 61400-1, as a file of TurbSim (.bts).

Each component is a sum of waves with random phases. Those of the component along the wind are coherent as the standard
has it, exp(-12 sqrt((f r / U)^2 + (0.12 r / L)^2)), those of the others are not (P. S. Veers, SAND88-0152). The same seed
makes the same box. What is slower than the box is long, or too fast for its step, is not in it: of 600 s by 0.2 s in 12 m/s
it holds 94 % of the deviation. --scaled makes up for it with what is there, as TurbSim does where it scales.

    python3 -m culm.turbulence wind.bts --speed 12 --deviation 2 --height 90 --size 140 140 --points 15 15
"""

import argparse
import struct

import numpy as np

from .option_types import finite, positive

# of the components along, across and upwards, in deviations and scales of length of the first
DEVIATIONS = (1.0, 0.8, 0.5)
LENGTHS = (8.1, 2.7, 0.66)


def scale(height):
    """Lambda of the standard [m]."""
    return 0.7 * min(height, 60.0)


def spectrum(frequency, deviation, length, speed):
    """One-sided Kaimal spectrum [m^2/s]; its integral is the square of the deviation."""
    time = length / speed
    return deviation**2 * 4.0 * time / (1.0 + 6.0 * frequency * time) ** (5.0 / 3.0)


def coherence(frequency, distance, height, speed):
    """Of the component along the wind at two points."""
    return np.exp(-12.0 * np.hypot(frequency * distance / speed, 0.12 * distance / (8.1 * scale(height))))


def frequencies(arguments):
    """Of a box: neither the mean nor the highest frequency, which has no phase."""
    count = int(round(arguments.duration / arguments.step))
    return np.arange(1, (count + 1) // 2) / (count * arguments.step)


def deviations_held(arguments):
    """What of DEVIATIONS is between the lowest and the highest frequency of a box."""
    lengths = [length * scale(arguments.height) for length in LENGTHS]
    width = 1.0 / (int(round(arguments.duration / arguments.step)) * arguments.step)
    return [np.sqrt(spectrum(frequencies(arguments), part, length, arguments.speed).sum() * width)
            for part, length in zip(DEVIATIONS, lengths)]


def fluctuations(arguments):
    """Velocities without the mean, by time, height, place across and component [m/s]."""
    ny, nz = arguments.points
    count = int(round(arguments.duration / arguments.step))
    y, z = np.meshgrid(np.linspace(0.0, arguments.size[0], ny), np.linspace(0.0, arguments.size[1], nz))
    place = np.stack([y.ravel(), z.ravel()], axis=1)
    distance = np.linalg.norm(place[:, None] - place[None, :], axis=2)
    held = deviations_held(arguments) if arguments.scaled else DEVIATIONS
    random = np.random.default_rng(arguments.seed)
    waves = np.zeros((count // 2 + 1, len(place), 3), complex)
    for m, frequency in enumerate(frequencies(arguments), 1):
        for component in range(3):
            power = spectrum(frequency, arguments.deviation * DEVIATIONS[component] ** 2 / held[component],
                             LENGTHS[component] * scale(arguments.height), arguments.speed)
            wave = np.exp(2j * np.pi * random.random(len(place)))
            if component == 0:
                wave = np.linalg.cholesky(coherence(frequency, distance, arguments.height, arguments.speed)) @ wave
            waves[m, :, component] = np.sqrt(0.5 * power / (count * arguments.step)) * wave
    return np.fft.irfft(waves * count, count, axis=0).reshape(count, nz, ny, 3)


def write(path, velocities, arguments):
    """Writes a periodic box; velocities by time, height, place across and component [m/s]."""
    count, nz, ny, _ = velocities.shape
    low, high = velocities.min(axis=(0, 1, 2)), velocities.max(axis=(0, 1, 2))
    slope = 65535.0 / np.maximum(high - low, 1e-6)
    intercept = -32768.0 - slope * low
    slope, intercept = slope.astype("<f4"), intercept.astype("<f4")
    bottom = arguments.height - 0.5 * arguments.size[1]
    text = b"Kaimal spectrum, made by culm"
    with open(path, "wb") as file:
        file.write(struct.pack("<hiiii", 8, nz, ny, 0, count))
        file.write(struct.pack("<6f", arguments.size[1] / (nz - 1), arguments.size[0] / (ny - 1), arguments.step,
                               arguments.speed, arguments.height, bottom))
        file.write(np.stack([slope, intercept], axis=1).tobytes())
        file.write(struct.pack("<i", len(text)) + text)
        values = np.rint(velocities * slope.astype(float) + intercept.astype(float))
        file.write(np.clip(values, -32768, 32767).astype("<i2").tobytes())


def parser():
    result = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    result.add_argument("file")
    result.add_argument("--speed", type=positive, required=True, help="mean wind [m/s]")
    result.add_argument("--deviation", type=finite, required=True, help="standard deviation along the wind [m/s]")
    result.add_argument("--height", type=positive, required=True, help="of the middle of the box above the ground [m]")
    result.add_argument("--size", type=positive, nargs=2, required=True, help="across and upwards [m]")
    result.add_argument("--points", type=int, nargs=2, required=True, help="across and upwards")
    result.add_argument("--duration", type=positive, default=600.0, help="[s]")
    result.add_argument("--step", type=positive, default=0.1, help="of time [s]")
    result.add_argument("--seed", type=int, default=1)
    result.add_argument("--scaled", action="store_true", help="the box has the whole deviation")
    return result


def main():
    arguments = parser().parse_args()
    if arguments.deviation < 0.0 or min(arguments.points) < 2:
        parser().error("the deviation must not be negative, points must be at least 2")
    velocities = fluctuations(arguments)
    velocities[..., 0] += arguments.speed
    write(arguments.file, velocities, arguments)
    held = DEVIATIONS if arguments.scaled else deviations_held(arguments)
    has = ", ".join(f"{arguments.deviation * value:.4g}" for value in held)
    print(f"{arguments.file}: standard deviations along, across and upwards {has} m/s by its spectrum")


if __name__ == "__main__":
    main()
