"""Marks of runs that broke a promise, in tables of many runs, and the notes that say which."""


class Footnotes:
    """Numbers sentences in the order in which they are first cited."""

    def __init__(self):
        self._notes = []

    def mark(self, sentences):
        """'BROKEN [1, 3]' for the sentences of a run; empty if there are none."""
        for sentence in sentences:
            if sentence not in self._notes:
                self._notes.append(sentence)
        numbers = ", ".join(str(self._notes.index(sentence) + 1) for sentence in sentences)
        return f"BROKEN [{numbers}]" if sentences else ""

    @property
    def lines(self):
        """One per sentence."""
        return [f"[{number}] {sentence}" for number, sentence in enumerate(self._notes, 1)]
