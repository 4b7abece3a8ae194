"""Numbers of the command line, refused before anything runs."""

import argparse
import math
import re


def positive(text):
    """A finite number above zero."""
    number = finite(text)
    if number <= 0.0:
        raise argparse.ArgumentTypeError(f"needs a number above 0, got '{text}'")
    return number


def finite(text):
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"needs a finite number, got '{text}'")
    return number


def at_least_one(text):
    if not re.fullmatch(r"0*[1-9]\d*", text, re.ASCII):
        raise argparse.ArgumentTypeError(f"needs a whole number from 1 on, got '{text}'")
    return int(text)
