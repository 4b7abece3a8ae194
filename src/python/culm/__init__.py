"""culm from Python: simulations step by step, and results as frames and arrays.

    wing = culm.Simulation("wing.xml")          # the model of a deck
    stepper, port = wing.begin(), wing.port("skin")
    while not stepper.is_at_end:
        port.set(force)                         # (points, 3) [N]
        if not stepper.attempt():
            raise RuntimeError(stepper.failure)
        stepper.accept()                        # port.motion, .position, .rotation, .velocity, .acceleration

    culm.history("results/wing")                # of a run, as a pandas frame
    culm.read("results/wing")                   # all its results

help(culm.Simulation), help(culm.Stepper), help(culm.Port) tell the rest. Programs that speak with culm as partners or lead it
over a socket import `culm_partner`, which stands beside this package.
"""

_LIBRARY = ("Simulation", "Stepper", "Snapshot", "Port", "Error", "UsageError", "InputError", "NumericalError",
            "NonFiniteError", "FileError")
__all__ = [*_LIBRARY, "history", "read"]

from . import history as _history  # noqa: E402  first: a later import of it would take the name of the function


def __getattr__(name):
    """What the extension module offers, loaded with MPI and Trilinos when it is first asked for; and `statistics`, with numpy."""
    if name == "statistics":
        import importlib
        return importlib.import_module(".statistics", __name__)
    if name not in _LIBRARY:
        raise AttributeError(f"module 'culm' has no attribute '{name}'")
    import _culm
    return getattr(_culm, name)


def __dir__():
    return sorted([*globals(), *_LIBRARY])


def history(folder):
    """The history of a run as a pandas frame, by time or level, number by number as the file has it; the last two columns
    are the number of the analysis in the deck, from 0, and its step, 0 at its start."""
    import pathlib

    return _history.frame_of(pathlib.Path(folder) / "history.csv")


def read(folder):
    """The results of a run: history, states, modes and tables as frames and arrays; see culm.reading.Run."""
    from .reading import Run
    return Run(folder)
