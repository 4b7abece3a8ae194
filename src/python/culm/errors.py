"""Errors that end a verb with one clear line, and its exit code."""


class CulmError(Exception):
    """@param exit_code as of the program: 2 command line, 3 deck, 4 numerical, 6 files"""

    def __init__(self, text, exit_code=2):
        super().__init__(text)
        self.exit_code = exit_code
