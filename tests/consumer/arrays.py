"""Arrays of any kind at ports, and threads beside a simulation that solves."""

import sys
import threading
import time
import warnings

import culm
import numpy as np


def refused(error, words, call, *arguments):
    try:
        call(*arguments)
    except error as found:
        assert words in str(found), found
        return
    raise AssertionError(f"{arguments} were not refused")


deck = sys.argv[1]
points = np.array([[0.2, 0.0, 3.0], [0.0, -0.1, 7.0], [0.1, 0.1, 9.9]])


def make():
    mast = culm.Simulation(deck)
    mast.add_port("net", points.astype(np.float32)[::-1][::-1], ["mast"], 1.0)
    return mast


mast = make()
assert mast.ports == ["skin", "net"]
net = mast.port("net")
assert len(net) == 3 and net.reference.shape == (3, 3)
refused(culm.UsageError, "did you mean 'net'?", mast.port, "nett")
refused(culm.UsageError, "shape (points, 3)", mast.add_port, "other", points.T[:, :2])
refused(culm.UsageError, "a reach above 0 m, got nan", mast.add_port, "other", points, ["mast"], np.nan)
stepper = mast.begin()

# one load in every layout: each attempt gives the same bits
force = np.array([[1.0, 2.0, -4.0], [0.5, 0.25, 8.0], [2.0, 0.0, 1.5]])
wide = np.zeros((6, 7))
wide[::2, 1::2] = force
ways = [force, np.asfortranarray(force), wide[::2, 1::2], force.astype(np.float32), force[::-1][::-1], force.tolist()]
seen = []
for way in ways:
    net.set(way, way)
    assert stepper.attempt()
    seen.append((net.position, net.rotation, net.velocity, net.acceleration, net.motion))
for other in seen[1:]:
    assert all(np.array_equal(a, b) for a, b in zip(seen[0], other))
assert [a.shape for a in seen[0]] == [(3, 3), (3, 3, 3), (3, 6), (3, 6), (3, 6)]
assert np.abs(seen[0][4]).max() > 1e-6
assert stepper.final_time == 1.0 and not stepper.is_exhausted and mast.broken_promises == ""

refused(culm.UsageError, "force must have the shape (3, 3), and has (3, 2)", net.set, force[:2].T)
refused(culm.UsageError, "force must have the shape (3, 3), and has (2, 3)", net.set, force[:2])
refused(culm.UsageError, "force must have the shape (3, 3), and has (9,)", net.set, force.ravel())

# what numpy would drop in silence: what a mask hides, imaginary parts, fractions of numbers of points
hidden = np.ma.array(force, mask=np.zeros((3, 3), bool))
net.set(hidden, hidden)
assert stepper.attempt() and np.array_equal(net.motion, seen[0][4])
hidden[1, 2] = np.ma.masked
refused(culm.UsageError, "force has masked values", net.set, hidden)
refused(culm.UsageError, "moment has masked values", net.set, force, hidden)
refused(culm.UsageError, "points has masked values", mast.add_port, "other", hidden)
refused(culm.UsageError, "real numbers, and is one of complex128", net.set, force * 1j)
refused(culm.UsageError, "faces must be whole numbers", net.set_pressure, [[0.0, 1.0, 1.9]], [1.0])
refused(culm.UsageError, "face 0 names point 2147483647", net.set_pressure, [[0, 1, 2 + 2**32]], [1.0])
refused(culm.UsageError, "face 0 names point -7", net.set_pressure, [[0, 1, 2, -7]], [1.0])
net.set_pressure(np.array([[0.0, 1.0, 2.0, -1.0]]), [1.0])

# a load on all nodes, in rows and not in columns
pushed = culm.Simulation(deck, ["Loads/push/Type=External", "Loads/push/Node=mast"])
pushing, nodes = pushed.begin(), len(pushed.nodes("push"))
rows = np.zeros((nodes, 6))
rows[-1, 0] = 100.0
for way in (rows, rows.ravel(), rows.reshape(nodes, 2, 3)):
    pushed.set_load("push", way)
    assert pushing.attempt() and 0.004 < pushed.port("skin").motion[-1, 0] < 0.006
    pushing.discard()
refused(culm.UsageError, f"shape ({nodes}, 6), force and moment of each node, got (6, {nodes})", pushed.set_load, "push", rows.T)

# why an attempt failed, and what culm warns of
assert stepper.failure == ""
net.set(1e12 * force)
assert not stepper.attempt() and "diverged, from 0 to 0.02, after" in stepper.failure, stepper.failure
stepper.discard()
net.set(force, force)
assert stepper.attempt() and stepper.failure == ""
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    coupled = culm.Simulation(deck, ["Coupling/Partners/wind/Type=Dashpot", "Coupling/Partners/wind/Damping=1"])
    coupled.begin()
assert [str(one.message) for one in told] == ["the partners of the deck do not act: a program makes the steps"]
assert told[0].filename == __file__ and "warning: the partners" in coupled.messages()
assert {"Simulation", "Stepper", "Port"} <= set(culm.__all__) and set(culm.__all__) <= set(dir(culm))

broken = force.copy()
broken[1, 2] = np.nan
refused(culm.NonFiniteError, "point 1", net.set, broken)

# what it works on is what it books
work = np.sum(force * net.motion[:, :3]) + np.sum(force * net.motion[:, 3:])
sums = net.exchange()
assert abs(work - sums["work"]) <= 1e-14 * abs(work), (work, sums)
assert np.allclose(sums["force"], force.sum(axis=0), rtol=1e-15)

# copies are their own, and a port keeps its simulation alive
position = net.position
stepper.discard()
assert not np.array_equal(position, net.position)
del mast, stepper
assert net.position.shape == (3, 3)

# the interpreter goes on while culm solves: another thread looks at the clock, which with the lock
# held it could do at most as the run begins and ends
times, over = [], threading.Event()


def watch():
    while not over.wait(1e-3):
        times.append(time.perf_counter())


solver = culm.Simulation(deck, ["Analyses/gust/Step=0.0005"]).begin()
thread = threading.Thread(target=watch)
thread.start()
begin = time.perf_counter()
solver.run()
end = time.perf_counter()
over.set()
thread.join()
assert sum(begin < now < end for now in times) > 5, (begin, end, times)

# two threads in one simulation: the one that comes second is told, and changes nothing
alone = culm.Simulation(deck, ["Analyses/gust/Step=0.0005"])
alone.begin().run()
shared = culm.Simulation(deck, ["Analyses/gust/Step=0.0005"])
stepper = shared.begin()
thread = threading.Thread(target=stepper.run)
thread.start()
solves = False
while thread.is_alive() and not solves:
    try:
        shared.quantities()
    except culm.UsageError:
        solves = True
busy = "another thread is in this simulation"
for call in (stepper.attempt, stepper.discard, lambda: shared.coordinates, lambda: shared.begin("gust")):
    refused(culm.UsageError, busy, call)
thread.join()
assert np.array_equal(shared.coordinates, alone.coordinates)
print("Python: arrays of any layout")
