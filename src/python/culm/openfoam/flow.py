"""The flow program as a process that does not outlive the coupling."""

import os
import signal
import subprocess

from ..errors import CulmError
from .turns import LEFT

_PACKAGE = "/usr/share/openfoam"  # where Debian has the settings of OpenFOAM


class Flow:
    """A flow program while it runs; leaving the context ends it and all that it started.

    @param command  words
    @param case     of the flow program, in whose folder it runs
    @param log      file for what it says
    """

    def __init__(self, command, case, log):
        self.name = os.path.basename(command[0])
        self._log = log
        environment = {"WM_PROJECT_DIR": _PACKAGE, **os.environ}
        with open(log, "w") as output:
            try:  # a group of its own: mpirun and its ranks end together
                self._process = subprocess.Popen(
                    command, cwd=case.folder, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                    stderr=subprocess.STDOUT, start_new_session=True)
            except OSError as error:
                raise CulmError(f"cannot start '{command[0]}': {error.strerror}", 6) from error

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._stop(signal.SIGTERM, 5.0)
        self._stop(signal.SIGKILL, None)

    def _stop(self, how, time_limit):
        try:
            os.killpg(self._process.pid, how)
            self._process.wait(time_limit)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            pass

    def is_running(self):
        """Raises CulmError if it ended otherwise than well."""
        code = self._process.poll()
        if code:
            how = f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"
            raise CulmError(f"{self.name} {how}; the end of '{self._log}':\n{self._last_words()}", LEFT)
        return code is None

    def _last_words(self):
        with open(self._log, errors="replace") as said:
            return "".join("    " + line for line in said.readlines()[-8:]).rstrip()
