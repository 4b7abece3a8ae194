"""Steps of a deck and of a flow program in turns."""

import time

from ..errors import CulmError
from .case import INPUT
from .reversals import WINDOWS, Reversals
from .turns import LEFT

BROKEN = 8  # exit code: done, but what was promised does not hold
_SHORT = 1e-9  # of a step: no step of its own


class Coupling:
    """A deck at whose port a flow program sets loads, once per step of the flow program.

    @param simulation  culm.Simulation
    @param analysis    its name, the first one if empty
    @param port        name of the port whose points are the stations
    @param case        of the flow program
    """

    def __init__(self, simulation, analysis, port, case):
        self._simulation, self._case, self._name = simulation, case, port
        self.port = simulation.port(port)
        case.check_stations(port, self.port.reference)
        self._stepper = simulation.begin(analysis)
        if abs(self._stepper.time - case.start) > _SHORT * case.step:
            raise CulmError(f"the analysis starts at {self._stepper.time:g} s, and 'startTime' of '{case.folder}' is "
                            f"{case.start:g} s", INPUT)
        self._reversals = Reversals()
        self.exchanges = 0
        self.work = 0.0  # of the port [J]
        self.busy = 0.0  # culm's time for its part [s]

    def run(self, flow, turns, table):
        """Makes all steps. Raises CulmError where one of the programs cannot go on; the table then holds
        all steps before."""
        table.write(self._stepper.time, self._simulation.quantities(), self.work, self._no_loads())
        try:
            while turns.wait(flow):
                self._take_turn(turns, table)
        except CulmError as error:
            place = f"step {self.exchanges + 1} of {self._case.steps}, from {self._stepper.time:g} s"
            raise CulmError(f"{place}: {error}", error.exit_code) from error
        self._check_ends(flow)
        return self._stepper.finish()

    def _no_loads(self):
        return [[(0.0, 0.0, 0.0)] * len(self.port)] * 2

    def _take_turn(self, turns, table):
        start = time.perf_counter()
        if self.exchanges == self._case.steps:
            raise CulmError("the flow program asks for a step after its 'endTime'", LEFT)
        if self._stepper.is_at_end:
            raise CulmError(self._differing_ends(f"the analysis ends at {self._stepper.time:g} s"), INPUT)
        loads = turns.take_loads()
        self.port.set(*loads)
        self.exchanges += 1
        work = self._advance(self._case.start + self.exchanges * self._case.step)
        self.work += work
        table.write(self._stepper.time, self._simulation.quantities(), self.work, loads)
        if self._reversals.add(loads[0], work):
            raise CulmError(self._explain_reversals(work), BROKEN)
        turns.give_motion(self.port.position, self.port.rotation)
        self.busy += time.perf_counter() - start

    def _advance(self, end):
        """Makes one step to `end`, or several where the deck's own are smaller; returns the work."""
        work = 0.0
        while (left := end - self._stepper.time) > _SHORT * self._case.step:
            wanted = self._stepper.proposal - self._stepper.time
            target = self._stepper.time + wanted if wanted < left * (1.0 - 1e-6) else end
            if self._stepper.attempt(target):
                work += self.port.exchange()["work"]
                self._stepper.accept()
                continue
            self._stepper.fail()
            if self._stepper.is_exhausted:
                raise CulmError("culm finds no equilibrium, however small the step", 4)
        return work

    def _check_ends(self, flow):
        """Raises CulmError unless both programs came to their ends together."""
        if self.exchanges < self._case.steps:
            raise CulmError(self._differing_ends(f"{flow.name} ended at {self._stepper.time:g} s"), LEFT)
        if not self._stepper.is_at_end:
            raise CulmError(self._differing_ends(f"the analysis goes on after {self._stepper.time:g} s"), INPUT)

    def _differing_ends(self, which):
        return f"{which}, and 'endTime' of '{self._case.folder}' is {self._case.end:g} s: both must have the same end"

    def _explain_reversals(self, work):
        return (f"the loads of port '{self._name}' turn over from step to step, seen over the last {WINDOWS}, while "
                f"their work grows, to {abs(work):.2g} J in this one: this is the added-mass instability of programs "
                "that exchange loads once per step. The fluid that moves with the structure is not light against it. "
                "Smaller steps do not help; a program that can repeat a step does, through preCICE or culm's own "
                "interfaces")
