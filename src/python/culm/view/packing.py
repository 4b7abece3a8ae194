"""Arrays as text for the page: base64 of little-endian numbers."""

import base64

import numpy

LEVELS = 65535  # of 16 bits


def integers(values):
    return _packed(numpy.asarray(values), "<i4")


def floats(values):
    return _packed(numpy.asarray(values), "<f4")


def halves(values):
    """Numbers rounded to 16 bits between the least and the largest of each column, the last axis."""
    values = numpy.asarray(values, dtype=float)
    axes = tuple(range(values.ndim - 1))
    low = values.min(axis=axes)
    step = (values.max(axis=axes) - low) / LEVELS
    rounded = numpy.rint((values - low) / numpy.where(step > 0.0, step, 1.0))
    return {**_packed(rounded, "<u2"), "low": low.tolist(), "step": step.tolist()}


def _packed(values, kind):
    data = numpy.ascontiguousarray(values, dtype=kind)
    return {"kind": kind[1:], "shape": list(data.shape), "data": base64.b64encode(data.tobytes()).decode()}


def unpacked(packed):
    """What was packed, as the page reads it."""
    values = numpy.frombuffer(base64.b64decode(packed["data"]), dtype=f"<{packed['kind']}")
    values = values.reshape(packed["shape"])
    return values if "low" not in packed else packed["low"] + values * numpy.array(packed["step"])
