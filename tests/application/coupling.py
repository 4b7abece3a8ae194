#!/usr/bin/env python3
"""Couplings with another program over a socket: equal to one in the same process bit by bit, killed and resumed,
recorded and replayed, and with partners that die in all ways.

usage: coupling.py --culm PROGRAM [--mpiexec PROGRAM --ranks N --socket-partner PROGRAM --mpi-partner PROGRAM
                   --socket-leader PROGRAM --mpi-leader PROGRAM]
"""

import argparse
import contextlib
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/kit"))
sys.path.insert(0, str(ROOT / "src/client"))
import culm_partner  # noqa: E402
from culm_runs import INPUTS, MPI_ENVIRONMENT  # noqa: E402

DECK = INPUTS / "coupling/partners.xml"
MASS = 20.0  # of the deck, at each point
TIME_LIMIT = 120  # s
FAILED_PARTNER = 9
OPTIONS = None
SHARED = {}  # folders of results by what was run, see CouplingTest.run_here
one_process_shows = unittest.skipIf("--ranks" in sys.argv, "the root alone talks with partners, and other tests fail on ranks, too")


def children_of(pid):
    """The processes that a process started and has not waited for yet."""
    children = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):  # of a thread that has ended meanwhile
            children += map(int, task.read_text().split())
    return children


def all_have_ended(pids):
    """Whether processes are there as entries only, if at all."""

    def has_ended(pid):
        try:
            return "\nState:\tZ" in pathlib.Path(f"/proc/{pid}/status").read_text()
        except OSError:
            return True

    return all(map(has_ended, pids))


def processes_in(folder):
    """Those whose present folder it is and that have not ended."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # of one that has ended meanwhile
            if pathlib.Path(os.readlink(process / "cwd")) == folder.resolve():
                found.append(int(process.name))
    return [pid for pid in found if not all_have_ended([pid])]


class Water(culm_partner.Partner):
    """The added mass of the deck; operation by operation as culm has it, for equal bits."""

    name = "water"
    wants = ("motion",)
    folder = None

    def begin(self, port, reference, velocity, start, window):
        super().begin(port, reference, velocity, start, window)
        self.velocity = velocity[:, :3].copy()
        self.start = self.kinetic()
        if window > 0:
            self.velocity, self.start = numpy.load(self.folder / f"water{window}.npy", allow_pickle=True)

    def kinetic(self):
        return 0.5 * MASS * float((self.velocity**2).sum())

    def loads(self, window):
        loads = numpy.zeros((self.points, 6))
        loads[:, :3] = -2.0 * MASS / window.length * (window.motion[:, :3] / window.length - self.velocity)
        return loads

    def accept(self, window):
        self.velocity = 2.0 / window.length * window.motion[:, :3] - self.velocity
        return self.kinetic() - self.start, 0.0

    def save(self, window):
        numpy.save(self.folder / f"water{window}.npy", numpy.array([self.velocity, self.start], dtype=object))


class Dying(Water):
    """Fails in the second attempt of the sixth window."""

    way = None

    def loads(self, window):
        if (window.number, window.attempt) == (5, 1) and self.way in WAYS:
            self.connection.last = (ANSWER, 5, 1, window.start, window.end)
            return WAYS[self.way](self, super().loads(window))
        return super().loads(window)

    def accept(self, window):
        energy, heat = super().accept(window)
        if self.way == "energy":
            return energy + 1.0, heat
        if window.number == 5 and self.way in BOOKS:
            return BOOKS[self.way][0](energy)
        return (numpy.inf if self.way == "infinite" and window.number == 5 else energy), heat


ANSWER = culm_partner.ANSWER


def kill(partner, loads):
    os.kill(os.getpid(), signal.SIGKILL)


def leave(partner, loads):
    os._exit(0)


def raise_error(partner, loads):
    raise RuntimeError("negative volume in cell 7")


def send_half(partner, loads):
    frame = culm_partner.encode(*partner.connection.last, loads.tobytes())
    partner.connection.socket.sendall(frame[:100])
    os._exit(0)


def send_damaged(partner, loads):
    frame = bytearray(culm_partner.encode(*partner.connection.last, loads.tobytes()))
    frame[80] ^= 1
    partner.connection.socket.sendall(frame)
    time.sleep(TIME_LIMIT)


def answer_before(partner, loads):
    partner.connection.send(ANSWER, 5, 0, *partner.connection.last[3:], payload=loads.tobytes())
    time.sleep(TIME_LIMIT)


def answer_too_little(partner, loads):
    partner.connection.send(*partner.connection.last, payload=loads[:2].tobytes())
    time.sleep(TIME_LIMIT)


def answer_no_number(partner, loads):
    loads[3, 1] = numpy.nan
    return loads


def answer_double(partner, loads):
    return 2.0 * loads


def be_slow(partner, loads):
    time.sleep(3.0)
    return loads


def stay_alive(partner, loads):
    time.sleep(TIME_LIMIT)  # its heart goes on


def fall_silent(partner, loads):
    partner.connection.ended.set()  # its heart, too
    time.sleep(TIME_LIMIT)


# what accept returns for an energy, and what culm_partner says to that
BOOKS = {
    "half of the books": (lambda energy: (energy, numpy.nan), "accept returned the energy "),
    "one number": (lambda energy: 3.5, "accept returns energy and heat, two numbers [J], or nothing; it returned 3.5"),
    "no books": (lambda energy: None, None),
}

# how a partner dies, and what culm says
WAYS = {
    "kill": kill,
    "leave": leave,
    "raise": raise_error,
    "half": send_half,
    "damaged": send_damaged,
    "before": answer_before,
    "little": answer_too_little,
    "nan": answer_no_number,
    "silence": fall_silent,
    "alive": stay_alive,
    "slow": be_slow,
    "double": answer_double,
}
SAID = {
    "kill": "it is gone without a word",
    "leave": "it is gone without a word",
    "raise": "it says: RuntimeError: negative volume in cell 7",
    "half": "it is gone in the middle of a frame",
    "damaged": "a frame is damaged",
    "before": "it answered for window 5, attempt 0, and was asked for window 5, attempt 1",
    "little": "its answer has 96 bytes; six numbers for each of 5 points are 240",
    "nan": "it answered nan for component 1 at point 3",
    "silence": "it said nothing for 5 s",
    "alive": "it says that it is alive, and has not answered for 2 s",
    "infinite": "its energy is inf J, its heat 0 J",
}


SAID_IN_PYTHON = {**SAID, "infinite": "it says: ValueError: accept returned the energy inf J and the heat 0.0 J"}


def every_frame(record):
    """Place, kind, window and length of each frame of a record."""
    at = 0
    while at + 64 <= len(record):
        kind, window = struct.unpack_from("<HI", record, at + 6)
        size, = struct.unpack_from("<Q", record, at + 32)
        yield at, kind, window, 64 + size
        at += 64 + size


def with_a_moved_step(record):
    """A record in which the structure is elsewhere after the second step of the fourth window, and back after the third."""
    record = bytearray(record)
    steps = [(at, size) for at, kind, window, size in every_frame(record) if kind == 17 and window == 3]
    for (at, size), sign in zip(steps[1:3], (1.0, -1.0), strict=True):
        moved, = struct.unpack_from("<d", record, at + 64)
        struct.pack_into("<d", record, at + 64, moved + sign * 1e-6)
        check = zlib.crc32(record[at + 64:at + size], zlib.crc32(record[at:at + 40]))
        struct.pack_into("<I", record, at + 40, check)
    return record


class Forgetful(Dying):
    """Keeps nothing when it is asked to."""

    save = culm_partner.Partner.save

    def begin(self, port, reference, velocity, start, window):
        super().begin(port, reference, numpy.zeros_like(velocity), start, 0)


class Wishful(Water):
    wants = ("speed",)


def be_partner(address, folder, way):
    """What this program does when it is started as a partner."""
    partner = {"": Water, "forget": Forgetful, "anew": Forgetful, "wants": Wishful}.get(way, Dying)()
    partner.folder = pathlib.Path(folder)
    partner.way = "kill" if way == "forget" else way
    connect = culm_partner.Connection

    class Watched(connect):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            partner.connection = self

    culm_partner.Connection = Watched
    culm_partner.run(address, partner, 20.0)


class CouplingTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="culm")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.address = f"unix:{self.folder}/socket"
        text = DECK.read_text()
        text = re.sub(r'<ParameterList name="damper">.*?</ParameterList>\s*', "", text, flags=re.S)
        self.deck = self.write("water.xml", text)
        self.remote = self.write("socket.xml", text.replace("Added Mass", "Socket").replace(
            '<Parameter name="Mass" value="20"/>',
            f'<Parameter name="Address" value="{self.address}"/><Parameter name="Patience" value="100"/>'))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def own_environment(self, pause):
        """For a launcher that others run beside: they make and remove the same folder of Open MPI, each in the way of the
        other. It waits so many seconds between the signals by which it ends its programs."""
        return {**os.environ, **MPI_ENVIRONMENT, "OMPI_MCA_odls_base_sigkill_timeout": str(pause),
                "TMPDIR": tempfile.mkdtemp(dir=self.folder, prefix="t")}

    def start(self, *words):
        ranks = [OPTIONS.mpiexec, "-n", str(OPTIONS.ranks)] if OPTIONS.ranks > 1 else []
        return subprocess.Popen(
            [*ranks, os.path.abspath(OPTIONS.culm), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, env={**os.environ, **MPI_ENVIRONMENT}, cwd=self.folder,
        )

    def over_mpi(self):
        """The deck with a partner on the rank after those of culm."""
        return self.write("mpi.xml", self.deck.read_text().replace("Added Mass", "MPI").replace(
            '<Parameter name="Mass" value="20"/>', f'<Parameter name="Rank" value="{OPTIONS.ranks}"/>'))

    def start_both(self, *words, way=""):
        """culm and the partner in C in one mpiexec, culm on the first ranks. A launcher waits between the signals by
        which it ends its programs, one second if nobody says otherwise: here longer, for busy machines."""
        return subprocess.Popen(
            [OPTIONS.mpiexec, "-n", str(OPTIONS.ranks), os.path.abspath(OPTIONS.culm), *map(str, words), "--ranks",
             str(OPTIONS.ranks), ":", "-n", "1", os.path.abspath(OPTIONS.mpi_partner), "mpi", way],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=self.own_environment(5), cwd=self.folder,
        )

    def with_partner(self, way="", starts=""):
        """Words by which culm starts itself and the partner in C in one mpiexec."""
        return ["--with", f"{starts}{os.path.abspath(OPTIONS.mpi_partner)} mpi {way}", "--ranks", OPTIONS.ranks]

    def start_alone(self, *words, pause="2"):
        """culm outside of MPI, also where it starts a launcher. That one has more time than usual to end its programs."""
        return subprocess.Popen(
            [os.path.abspath(OPTIONS.culm), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env=self.own_environment(pause), cwd=self.folder)

    def wait_until(self, holds):
        deadline = time.monotonic() + TIME_LIMIT
        while not holds():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)

    def outlast(self, launcher):
        """The exit code, output and errors of a launcher whose programs abort. Those of Open MPI 4 crash or stand
        still in one of a hundred such ends, after all is said and written; one that stands still is ended."""
        deadline = time.monotonic() + TIME_LIMIT
        has_started, alone_since = False, None
        while True:
            try:
                output, errors = launcher.communicate(timeout=1)
                return launcher.returncode, output, errors
            except subprocess.TimeoutExpired:
                now = time.monotonic()
                programs = children_of(launcher.pid)
                has_started = has_started or bool(programs)
                alone_since = (alone_since or now) if has_started and all_have_ended(programs) else None
                if alone_since is not None and now - alone_since > 10:
                    launcher.kill()
                elif now > deadline:
                    raise

    def start_partner(self, way=""):
        process = subprocess.Popen(
            [sys.executable, __file__, "--partner", self.address, str(self.folder), way], stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def partner_command(self):
        return f"{sys.executable} {__file__} --partner {self.address} {self.folder} ''"

    def start_partner_in_c(self, way=""):
        process = subprocess.Popen([os.path.abspath(OPTIONS.socket_partner), self.address, way], stderr=subprocess.DEVNULL,
                                   cwd=self.folder)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def finish(self, process, code=0):
        output, errors = process.communicate(timeout=TIME_LIMIT)
        self.assertEqual(process.returncode, code, output + errors)
        return errors

    def culm(self, *words, code=0):
        return self.finish(self.start(*words), code)

    def run_here(self, *settings, deck=None, code=0):
        """The folder 'here' with the results of the deck in one process of culm, or on its ranks: all tests share one run."""
        deck = deck or self.deck
        key = (deck.read_text(), settings)
        if key not in SHARED:
            folder = tempfile.TemporaryDirectory(prefix="culm")
            unittest.addModuleCleanup(folder.cleanup)
            results = pathlib.Path(folder.name) / "here"
            self.culm("run", deck, "--output", results, "--quiet", *(w for one in settings for w in ("--set", one)), code=code)
            SHARED[key] = results
        shutil.copytree(SHARED[key], self.folder / "here")

    def same(self, one, other, name="history.csv"):
        self.assertEqual((self.folder / one / name).read_bytes(), (self.folder / other / name).read_bytes(),
                         f"{name} of {one} and {other}")

    def rows(self, run):
        return len((self.folder / run / "history.csv").read_text().splitlines()) - 2  # but titles and the start


class Programs(CouplingTest):
    def test_over_a_socket_as_in_the_same_process(self):
        self.run_here()
        partner = self.start_partner()
        self.culm("run", self.remote, "--output", "there", "--quiet")
        self.assertEqual(partner.wait(TIME_LIMIT), 0, partner.stderr.read())
        self.same("here", "there")

    @one_process_shows
    def test_with_a_partner_in_c(self):
        self.run_here()
        partner = self.start_partner_in_c()
        self.culm("run", self.remote, "--output", "there", "--quiet")
        self.assertEqual(partner.wait(TIME_LIMIT), 0)
        self.same("here", "there")

    def test_over_mpi(self):
        self.run_here()
        self.finish(self.start_both("run", self.over_mpi(), "--output", "there", "--quiet"))
        self.same("here", "there")

    def test_over_mpi_with_a_launcher_that_culm_starts(self):
        self.run_here()
        launcher = self.start_alone("run", self.over_mpi(), "--output", "there", "--report", *self.with_partner())
        output, errors = launcher.communicate(timeout=TIME_LIMIT)
        self.assertEqual(launcher.returncode, 0, output + errors)
        self.same("here", "there")
        self.assertTrue((self.folder / "there/report.html").exists())
        self.assertNotIn("\033[K", output)  # the launcher shows culm a terminal where there is none
        bare = self.write("bare.xml", re.sub(r'  <ParameterList name="Coupling">.*?\n  </ParameterList>\n', "",
                                             self.deck.read_text(), flags=re.S))
        words = ["couple", bare, "--partner", "mpi", "--port", "wet", "--window", "0.02", "--tolerance", "1e-9",
                 "--output", "couple", "--quiet"]
        self.finish(self.start_alone(*words, *self.with_partner()))
        self.same("here", "couple")
        self.assertEqual(processes_in(self.folder), [])

    def test_replay_of_a_record(self):
        self.run_here("Coupling/Record=true")
        record = self.folder / "here/coupling_water.record"
        self.culm("replay", record, self.remote, "--output", "again", "--quiet")
        self.same("here", "again")
        errors = self.culm("replay", record, self.deck, "--output", "other", "--quiet", "--set",
                           "Sections/pole/Density=2701", code=8)
        self.assertIn("the structure moves differently, in window", errors)
        errors = self.culm("replay", record, self.deck, "--output", "early", "--quiet", "--set",
                           "Analyses/motion/End Time=0.1", code=8)
        self.assertIn("compared to 0.1 s only, the record goes on to", errors)
        short = self.write("short.record", "")
        short.write_bytes(record.read_bytes()[:5000])
        errors = self.culm("replay", short, self.deck, "--output", "cut", "--quiet", code=FAILED_PARTNER)
        self.assertIn("short.record: the record ends at", errors)
        errors = self.culm("replay", self.deck, self.deck, "--output", "none", "--quiet", code=6)
        self.assertIn("is no record of a coupling: what came is no frame of culm", errors)

    @one_process_shows
    def test_replay_of_several_partners(self):
        self.culm("run", DECK, "--output", "here", "--quiet", "--set", "Coupling/Record=true")
        self.culm("replay", self.folder / "here", DECK, "--output", "again", "--quiet")
        self.same("here", "again")
        errors = self.culm("replay", self.folder / "here/coupling_water.record", DECK, "--output", "one", "--quiet",
                           code=2)
        self.assertIn("the deck has 2 partners; its replay needs the folder with the records of all of them", errors)
        (self.folder / "here/coupling_damper.record").unlink()
        errors = self.culm("replay", self.folder / "here", DECK, "--output", "one", "--quiet", code=6)
        self.assertIn("coupling_damper.record", errors)

    def test_in_parallel_as_in_the_same_process(self):
        settings = ["--quiet", "--set", "Coupling/Parallel=true", "--set", "Output/Checkpoint Interval=0"]
        self.culm("run", self.deck, "--output", "here", *settings)
        partner = self.start_partner()
        self.culm("run", self.remote, "--output", "there", *settings)
        self.assertEqual(partner.wait(TIME_LIMIT), 0, partner.stderr.read())
        self.same("here", "there")
        self.start_partner("kill")
        self.culm("run", self.remote, "--output", "killed", *settings, code=FAILED_PARTNER)
        self.start_partner()
        self.culm("resume", "killed", "--quiet")
        self.same("here", "killed")

    @one_process_shows
    def test_replay_of_a_partner(self):
        self.run_here("Coupling/Record=true")
        record = self.folder / "here/coupling_water.record"
        partner = self.start_partner()
        output, errors = self.start("replay", record, "--partner", self.address).communicate(timeout=TIME_LIMIT)
        self.assertRegex(output + errors, r"25 windows, (\d+) attempts, \1 answered with the same bits")
        self.assertEqual(partner.wait(TIME_LIMIT), 0, partner.stderr.read())
        for way, said, code in (("double", "the partner answers differently, in window 5, attempt 1 by 1 of its loads", 8),
                                ("energy", "the partner keeps other books", 8),
                                ("nan", "it answered nan for component 1 at point 3", FAILED_PARTNER)):
            partner = self.start_partner(way)
            self.assertIn(said, self.culm("replay", record, "--partner", self.address, code=code))
            partner.wait(TIME_LIMIT)
        self.assertIn("either a deck", self.culm("replay", record, code=2))

    @one_process_shows
    def test_replay_of_what_couple_recorded(self):
        """The deck that was coupled by words of the command line has no list of partners."""
        bare = self.write("bare.xml", re.sub(r'  <ParameterList name="Coupling">.*?\n  </ParameterList>\n', "",
                                             self.deck.read_text(), flags=re.S))
        self.culm("couple", bare, "--partner", "added-mass", "--mass", "20", "--port", "wet", "--window", "0.02", "--record",
                  "--output", "here", "--quiet")
        for what in ("here/coupling_partner.record", "here"):
            self.culm("replay", self.folder / what, bare, "--output", "again", "--quiet")
            self.same("here", "again")
        errors = self.culm("replay", self.folder / "here", bare, "--output", "other", "--quiet", "--set",
                           "Sections/pole/Density=2701", code=8)
        self.assertIn("the structure moves differently, in window", errors)
        self.assertIn("holds no record of a coupling", self.culm("replay", self.folder, bare, "--output", "no", code=6))

    @one_process_shows
    def test_replay_compares_the_steps_within_windows(self):
        """A load that comes and goes within a window moves the structure there and hardly at its end."""
        self.run_here("Coupling/Record=true")
        record = self.folder / "here/coupling_water.record"
        frames = record.read_bytes()
        self.assertEqual(sum(frame[1] == 17 for frame in every_frame(frames)), 100)  # four steps in each window
        damaged = self.write("damaged.record", "")
        damaged.write_bytes(with_a_moved_step(frames))
        errors = self.culm("replay", damaged, self.deck, "--output", "again", "--quiet", code=8)
        self.assertIn("the structure moves differently, in window 3", errors)

    @one_process_shows
    def test_replay_of_one_way(self):
        one_way = ["--quiet", "--set", "Coupling/Scheme=One Way", "--set", "Coupling/Partners/water/Type=Random",
                   "--set", "Coupling/Partners/water/Force=100"]
        deck = self.write("noise.xml", self.deck.read_text().replace('<Parameter name="Mass" value="20"/>', ""))
        self.culm("run", deck, "--output", "here", *one_way, "--set", "Coupling/Record=true")
        record = self.folder / "here/coupling_water.record"
        self.culm("replay", record, deck, "--output", "again", *one_way)
        self.same("here", "again")
        errors = self.culm("replay", record, deck, "--output", "other", *one_way, "--set", "Sections/pole/Density=2701",
                           code=8)
        self.assertIn("the structure moves differently", errors)

    @one_process_shows
    def test_replay_in_other_windows(self):
        self.run_here("Coupling/Record=true")
        record = self.folder / "here/coupling_water.record"
        # each window in two: the same steps under the same loads
        self.culm("replay", record, self.deck, "--output", "halves", "--quiet", "--set", "Coupling/Window=0.01")
        rows = [(self.folder / run / "history.csv").read_text().splitlines() for run in ("here", "halves")]
        self.assertEqual(rows[0], rows[1][:1] + rows[1][1::2])
        self.culm("replay", record, self.deck, "--output", "longer", "--quiet", "--set", "Coupling/Window=0.03")
        self.same("here", "longer")
        errors = self.culm("replay", record, self.deck, "--output", "late", "--quiet", "--set",
                           "Analyses/motion/Start Time=0.1", code=FAILED_PARTNER)
        self.assertIn("the record goes on at 0 s, the motion at 0.1 s", errors)

    def test_goes_on_from_a_checkpoint(self):
        settings = ["--quiet", "--set", "Output/Checkpoint Interval=0", "--set", "Coupling/Record=true"]
        self.start_partner()
        self.culm("run", self.remote, "--output", "whole", *settings)
        self.start_partner()
        self.culm("run", self.remote, "--output", "parts", *settings, "--set", "Analyses/motion/End Time=0.2")
        self.start_partner()
        self.culm("resume", "parts", "--set", "Analyses/motion/End Time=0.5", "--quiet")
        self.same("whole", "parts")
        self.same("whole", "parts", "coupling_water.record")
        self.culm("run", self.remote, "--output", "third", *settings, "--set", "Analyses/motion/End Time=0.2", "--with",
                  self.partner_command())
        self.culm("resume", "third", "--set", "Analyses/motion/End Time=0.5", "--quiet", "--with", self.partner_command())
        self.same("whole", "third")
        self.assertIn("needs a command", self.culm("resume", "third", "--with", "", code=2))


class Partners(CouplingTest):
    def dies(self, way, said, errors, rows=5):
        """One message, and results up to the window before."""
        text = re.sub(r"\s+", " ", errors)
        self.assertEqual(text.count("the partner '"), 1, text)
        self.assertRegex(text, "the partner '[a-z]+' at port 'wet' failed in window 5, attempt [0-9], from 0.1 s to 0.12 s: "
                         + re.escape(said))
        self.assertEqual(self.rows(way), rows)

    def limits(self, way):
        """Long enough for a program to start on a busy machine."""
        return {"silence": ["--set", "Coupling/Partners/water/Patience=5"],
                "alive": ["--set", "Coupling/Partners/water/Time Limit=2"]}.get(way, [])

    def test_that_die(self):
        for way in SAID if OPTIONS.ranks == 1 else ("kill", "nan"):
            with self.subTest(way=way):
                partner = self.start_partner(way)
                errors = self.culm("run", self.remote, "--output", way, "--quiet", *self.limits(way), code=FAILED_PARTNER)
                self.dies(way, SAID_IN_PYTHON[way], errors)
                partner.kill()

    @one_process_shows
    def test_whose_books_come_and_go(self):
        for way, (_, said) in BOOKS.items():
            with self.subTest(way=way):
                partner = self.start_partner(way)
                errors = self.culm("run", self.remote, "--output", way, "--quiet", code=FAILED_PARTNER)
                self.dies(way, f"it says: ValueError: {said}" if said else "its energy is nan J, its heat nan J, and was ",
                          errors)
                partner.kill()

    @one_process_shows
    def test_that_want_what_is_not_there(self):
        partner = self.start_partner("wants")
        errors = self.culm("run", self.remote, "--output", "wants", "--quiet", code=FAILED_PARTNER)
        self.assertIn("it says: ValueError: there is no quantity 'speed' to want; allowed: position", errors)
        partner.kill()

    def test_that_want_one_quantity_by_its_name(self):
        self.assertEqual(culm_partner._bits("velocity"), culm_partner._bits(("velocity",)))

    def test_that_are_killed_and_resumed_from_an_early_checkpoint(self):
        """Checkpoints are there although the run is much shorter than their interval."""
        self.run_here()
        self.start_partner("kill")
        errors = self.culm("run", self.remote, "--output", "killed", "--quiet", code=FAILED_PARTNER)
        self.assertRegex(errors, r"Go on with: culm resume killed, from 0\.[0-9]+ s")
        self.start_partner()
        self.culm("resume", "killed", "--quiet")
        self.same("here", "killed")

    def save_nothing(self, start):
        start("forget")
        # so soft that the water still moves when its program is killed
        self.culm("run", self.remote, "--output", "forgot", "--quiet", "--set", "Output/Checkpoint Interval=0", "--set",
                  "Sections/pole/Young Modulus=5e9", code=FAILED_PARTNER)
        start("anew")
        errors = re.sub(r"\s+", " ", self.culm("resume", "forgot", "--quiet", code=8))
        self.assertIn("the partner 'water' saved nothing with the checkpoint: it begins anew", errors)
        self.assertIn("the partner had saved nothing and began anew", errors)

    def test_that_save_nothing(self):
        self.save_nothing(self.start_partner)

    @one_process_shows
    def test_in_c_that_save_nothing(self):
        self.save_nothing(self.start_partner_in_c)

    @one_process_shows
    def test_in_c_that_hear_nonsense(self):
        """A greeting that has no room for its points."""
        for payload in (b"", b"\1\0", struct.pack("<I", 5) + bytes(96)):
            address = self.folder / "nonsense"
            with socket.socket(socket.AF_UNIX) as server:
                server.bind(str(address))
                server.listen(1)
                partner = subprocess.Popen([os.path.abspath(OPTIONS.socket_partner), f"unix:{address}"], text=True,
                                           stderr=subprocess.PIPE)
                with server.accept()[0] as heard:
                    heard.sendall(culm_partner.encode(culm_partner.HELLO, 0, 0, 0.0, 0.0, payload))
                    errors = partner.communicate(timeout=TIME_LIMIT)[1]
            address.unlink()
            self.assertEqual((partner.returncode, errors.strip()), (1, "a frame has another length than it must"))

    @one_process_shows
    def test_in_c_that_die(self):
        for way in SAID:
            with self.subTest(way=way):
                partner = self.start_partner_in_c(way)
                said = SAID[way].replace("RuntimeError: ", "")
                errors = self.culm("run", self.remote, "--output", way, "--quiet", *self.limits(way), code=FAILED_PARTNER)
                self.dies(way, said, errors)
                partner.kill()

    # what culm says of partners over MPI
    ENDED = "the launcher ends all its programs, as it does when one of them has died"
    SAID_OVER_MPI = {**SAID, "kill": ENDED, "leave": ENDED, "raise": "it says: negative volume in cell 7",
                     "half": "a frame is not as long as it says"}

    def die_over_mpi(self, start, ways, finish):
        """Several at once: launchers mostly wait."""
        at_once = 4
        for first in range(0, len(ways), at_once):
            launchers = {}
            for way in ways[first : first + at_once]:
                settings = [*self.limits(way), "--set", "Output/Checkpoint Interval=0"]
                launchers[way] = start(way, "--output", way, "--quiet", *settings)
            for way, launcher in launchers.items():
                with self.subTest(way=way):
                    self.dies(way, self.SAID_OVER_MPI[way], finish(way, launcher))
                    self.assertFalse((self.folder / way / "run.h5.journal").exists())  # results were closed

    def test_over_mpi_that_die(self):
        """The code is culm's own where culm starts the launcher."""
        deck = self.over_mpi()

        def start(way, *words):
            return self.start_alone("run", deck, *words, *self.with_partner(way))

        def finish(way, launcher):
            return self.finish(launcher, FAILED_PARTNER)

        self.die_over_mpi(start, ["leave", "nan"] if OPTIONS.ranks > 1 else list(self.SAID_OVER_MPI), finish)
        self.assertEqual(processes_in(self.folder), [])

    def test_over_mpi_that_die_in_a_launcher_by_hand(self):
        """The launcher ends all programs with one that dies, and its code is that one's; culm says what it was about."""
        deck = self.over_mpi()

        def start(way, *words):
            return self.start_both("run", deck, *words, way=way)

        def finish(way, launcher):
            code, output, errors = self.outlast(launcher)
            codes = (137, 1) if self.SAID_OVER_MPI[way] == self.ENDED else (FAILED_PARTNER,)
            self.assertIn(code, (*codes, -signal.SIGSEGV, -signal.SIGKILL), output + errors)
            return errors

        self.die_over_mpi(start, ["leave", "nan"] if OPTIONS.ranks > 1 else ["kill", "leave", "nan"], finish)

    def test_over_mpi_that_die_and_are_resumed(self):
        settings = ["--quiet", "--set", "Output/Checkpoint Interval=0"]
        deck = self.over_mpi()
        self.run_here()
        self.finish(self.start_alone("run", deck, "--output", "killed", *settings, *self.with_partner("kill")),
                    FAILED_PARTNER)
        self.finish(self.start_alone("resume", "killed", "--quiet", *self.with_partner()))
        self.same("here", "killed")
        self.outlast(self.start_both("run", deck, "--output", "again", *settings, way="kill"))
        self.finish(self.start_both("resume", "again", "--quiet"))
        self.same("here", "again")

    def test_over_mpi_that_never_come(self):
        deck = self.over_mpi()
        words = ["--output", "never", "--quiet", "--ranks", OPTIONS.ranks, "--with"]
        errors = self.finish(self.start_alone("run", deck, *words, "exit 3"), FAILED_PARTNER)
        self.assertIn("the partner 'exit 3' ended with code 3, and the launcher ended culm with it", errors)
        self.assertFalse((self.folder / "never").exists())
        errors = self.finish(self.start_alone("run", deck, *words, "true"), FAILED_PARTNER)  # no MPI, and no error
        self.assertIn("the partner 'true' ended with code 0", errors)
        errors = self.finish(self.start_alone("run", deck, *words, "true", "--set", "Coupling/Partners/water/Rank=7"), 2)
        self.assertIn(f"as rank {OPTIONS.ranks}; its 'Rank' is 7", errors)
        errors = self.finish(self.start_alone("run", deck, *words, "true", "--set", "Coupling/Scheme=Aitkn"), 3)
        self.assertIn("did you mean", errors)
        launcher = subprocess.Popen([OPTIONS.mpiexec, "-n", str(OPTIONS.ranks), os.path.abspath(OPTIONS.culm), "run", deck, "--with", "true",
                                     "--ranks", str(OPTIONS.ranks)],
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                    env={**os.environ, **MPI_ENVIRONMENT})
        self.assertIn("call culm without mpiexec", self.finish(launcher, 2))

    def test_over_mpi_wait_for_no_deck_that_is_wrong(self):
        """Neither does who waits in the same launcher."""
        deck = self.over_mpi()
        wrong = ["--set", "Structures/mast/Section=none"]
        errors = self.finish(self.start_alone("run", deck, "--output", "no", "--quiet", *wrong, *self.with_partner()), 3)
        self.assertIn("none", errors)
        code, output, errors = self.outlast(self.start_both("run", deck, "--output", "no", "--quiet", *wrong))
        self.assertIn(code, (3, -signal.SIGSEGV, -signal.SIGKILL), output + errors)
        self.assertFalse((self.folder / "no").exists())

    def test_over_mpi_that_are_stopped(self):
        """A run that is told to stop does so after its window; Ctrl-C ends all; nothing is left where culm is killed."""
        deck = self.over_mpi()
        for sent, code in ((signal.SIGTERM, 7), (signal.SIGINT, None), (signal.SIGKILL, -signal.SIGKILL)):
            with self.subTest(signal=sent):
                name = sent.name
                launcher = self.start_alone("run", deck, "--output", name, "--set", "Analyses/motion/End Time=1000", "--quiet",
                                            *self.with_partner(), pause="1")
                history = self.folder / name / "history.csv"
                self.wait_until(lambda: history.exists() and self.rows(name) > 5)
                launcher.send_signal(sent)
                output, errors = launcher.communicate(timeout=TIME_LIMIT)
                self.assertIn(launcher.returncode, (code,) if code is not None else (7, FAILED_PARTNER, 130), output + errors)
                self.wait_until(lambda: not processes_in(self.folder))
                if sent == signal.SIGTERM:
                    self.assertFalse((self.folder / name / "run.h5.journal").exists())

    def test_that_let_a_run_wait_that_is_stopped(self):
        """Whoever stops a run does not wait for a partner: the state of the last window is there at once."""
        if OPTIONS.ranks > 1:
            self.skipTest("a launcher ends its programs by itself")
        for way in ("silence", "alive"):
            with self.subTest(way=way):
                self.start_partner(way)
                process = self.start("run", self.remote, "--output", way, "--quiet", "--set", "Output/Checkpoint Interval=0",
                                     "--set", "Coupling/Partners/water/Patience=100")
                self.wait_until(lambda: (self.folder / way / "run.checkpoint").exists())
                time.sleep(1.0)
                began = time.monotonic()
                process.send_signal(signal.SIGTERM)
                errors = self.finish(process, 7)
                self.assertLess(time.monotonic() - began, 30.0)
                self.assertIn("stopped: signal SIGTERM, while a partner had not answered yet", errors)
                self.assertIn("Go on with: culm resume", errors)
                self.assertEqual(self.rows(way), 5)
                self.assertFalse((self.folder / way / "run.h5.journal").exists())
        process = self.start("run", self.remote, "--output", "alone", "--quiet")
        self.wait_until(lambda: (self.folder / "alone" / "run.h5").exists())
        time.sleep(0.5)
        process.send_signal(signal.SIGUSR1)
        self.assertIn("stopped: signal SIGUSR1, before a partner came", self.finish(process, 7))

    @one_process_shows
    def test_that_lie_about_their_energy(self):
        """Nobody can tell a lie from a coupling that is too loose: a broken promise, after whole results."""
        partner = self.start_partner_in_c("energy")
        errors = self.culm("run", self.remote, "--output", "lie", "--quiet", code=8)
        self.assertIn("the interface 'water' makes", errors)
        partner.wait(TIME_LIMIT)
        self.assertEqual(self.rows("lie"), 25)

    @one_process_shows
    def test_that_are_slow_and_alive(self):
        """Signs of life keep a partner that takes longer than 'Patience'."""
        partner = self.start_partner("slow")
        self.culm("run", self.remote, "--output", "slow", "--quiet", "--set", "Coupling/Partners/water/Patience=2")
        self.assertEqual(partner.wait(TIME_LIMIT), 0, partner.stderr.read())
        self.run_here()
        self.same("here", "slow")

    def test_that_culm_starts_and_ends(self):
        self.run_here()
        words = ("run", self.remote, "--quiet", "--with")
        self.culm(*words, self.partner_command(), "--output", "there")
        self.same("here", "there")
        began = time.monotonic()
        errors = self.culm(*words, "echo $$ > pid; exit 3", "--output", "early", code=FAILED_PARTNER)
        self.assertIn("'echo $$ > pid; exit 3' ended with code 3 before it came", errors)
        self.culm(*words, "echo $$ > pid; exec sleep 100", "--output", "late", "--set", "Coupling/Partners/water/Patience=0.5",
                  code=FAILED_PARTNER)
        self.assertFalse(pathlib.Path(f"/proc/{int((self.folder / 'pid').read_text())}").exists())
        self.assertLess(time.monotonic() - began, 60.0)  # where patience is 100 s
        errors = self.culm("run", self.deck, "--with", "true", "--output", "nobody", code=2)
        self.assertIn("--with needs a partner of type 'Socket' or 'MPI'", errors)

    def test_that_never_come(self):
        errors = self.culm("run", self.remote, "--output", "alone", "--quiet", "--set",
                           "Coupling/Partners/water/Patience=0.5", code=FAILED_PARTNER)
        self.assertIn("nobody came to", errors)

    @one_process_shows
    def test_whose_port_is_where_a_support_drives(self):
        settings = ["Ports/top/Points={mast/first}", "Coupling/Partners/damper/Type=Oscillator",
                    "Coupling/Partners/damper/Port=top", "Coupling/Partners/damper/Mass=10",
                    "Coupling/Partners/damper/Stiffness=5000", "Functions/shake/Type=Expression",
                    "Functions/shake/Expression=1 - cos(10*t)", "Constraints/ground/Translation={0.1, 0, 0}",
                    "Constraints/ground/Function=shake"]
        words = [word for setting in settings for word in ("--set", setting)]
        errors = self.culm("run", self.deck, *words, "--output", "driven", "--quiet")
        self.assertIn("warning: Port 'top' moves nothing: all of it acts where supports hold the model", errors)
        self.assertNotIn("'wet'", errors)
        self.culm("run", self.deck, *words, "--output", "strict", "--quiet", "--strict", code=8)

    def test_that_die_and_are_resumed(self):
        settings = ["--quiet", "--set", "Output/Checkpoint Interval=0"]
        self.run_here()
        self.start_partner("kill")
        self.culm("run", self.remote, "--output", "killed", *settings, code=FAILED_PARTNER)
        self.start_partner()
        self.culm("resume", "killed", "--quiet")
        self.same("here", "killed")

    @one_process_shows
    def test_with_other_points(self):
        partner = subprocess.Popen([sys.executable, "-c", f"""
import struct, sys
sys.path.insert(0, {str(ROOT / 'src/client')!r})
import culm_partner as c
connection = c.Connection({self.address!r}, 20.0)
connection.receive()
connection.send(c.HELLO, payload=struct.pack("<IId", 4, 16, 1.0) + b"other")
connection.receive()
"""])
        errors = self.culm("run", self.remote, "--output", "other", "--quiet", code=FAILED_PARTNER)
        self.assertIn("it has 4 points, the port has 5", errors)
        partner.wait(TIME_LIMIT)


class Leaders(CouplingTest):
    """Programs that lead. The reference is culm's own explicit scheme: the answer to a step acts in the next one."""

    MASS = 0.1

    def setUp(self):
        super().setUp()
        text = re.sub(r'<Parameter name="Window" value="0.02"/>', "", self.deck.read_text())
        text = text.replace('<Parameter name="Mass" value="20"/>', f'<Parameter name="Mass" value="{self.MASS}"/>')
        text = text.replace("Quasi Newton", "Explicit")
        deck = self.write("explicit.xml", text)
        self.run_here(deck=deck, code=8)  # it loses energy, and says so
        self.led = self.write("led.xml", re.sub(r'  <ParameterList name="Coupling">.*?\n  </ParameterList>\n', "", text,
                                                flags=re.S))

    def serve(self, *words):
        return self.start("serve", self.led, "--at", self.address, "--port", "wet", "--output", "there", "--quiet", *words)

    def step(self, mast, loads, velocity):
        h = mast.proposal - mast.time
        self.assertTrue(mast.attempt(loads, mast.proposal))
        moved = mast.motion[:, :3]
        loads = numpy.zeros((mast.points, 6))
        loads[:, :3] = -2.0 * self.MASS / h * (moved / h - velocity)
        velocity = 2.0 / h * moved - velocity
        mast.accept()
        return loads, velocity

    def test_in_python(self):
        process = self.serve()
        with culm_partner.Structure(self.address, patience=20.0) as mast:
            self.assertEqual((mast.points, mast.port, mast.time, mast.final_time), (5, "wet", 0.0, 0.5))
            loads, velocity = numpy.zeros((5, 6)), mast.velocity[:, :3].copy()
            while not mast.is_at_end:
                if abs(mast.time - 0.15) < 1e-9:
                    mast.save(7)
                    mast.attempt(1e3 * loads, mast.time + 0.001)
                    mast.discard()
                    there = loads, velocity
                    for _ in range(12):
                        there = self.step(mast, *there)
                    mast.restore(7)
                    self.assertLess(abs(mast.time - 0.15), 1e-9)
                loads, velocity = self.step(mast, loads, velocity)
            self.assertNotEqual(mast.work, 0.0)
        self.finish(process)
        self.same("here", "there")

    def test_that_are_resumed(self):
        """culm and the leader keep themselves at the same time, are both stopped later, and go on from there."""
        process = self.serve()
        with self.assertRaises(KeyboardInterrupt):
            with culm_partner.Structure(self.address, patience=20.0) as mast:
                self.assertEqual(mast.kept, 0)
                loads, velocity = numpy.zeros((5, 6)), mast.velocity[:, :3].copy()
                for step in range(50):
                    loads, velocity = self.step(mast, loads, velocity)
                    if step in (20, 30):
                        mast.keep(step)
                        there = loads, velocity
                raise KeyboardInterrupt("no more wind")
        self.finish(process, FAILED_PARTNER)
        self.assertIn("this run was led by another program: say by --at", self.culm("resume", "there", "--quiet", code=2))
        process = self.start("resume", "there", "--at", self.address, "--port", "wet", "--quiet")
        with culm_partner.Structure(self.address, patience=20.0) as mast:
            self.assertEqual(mast.kept, 30)
            self.assertLess(abs(mast.time - 0.155), 1e-9)
            while not mast.is_at_end:
                there = self.step(mast, *there)
        self.finish(process)
        self.same("here", "there")

    @one_process_shows
    def test_in_c(self):
        process = self.serve()
        leader = subprocess.run([os.path.abspath(OPTIONS.socket_leader), self.address], timeout=TIME_LIMIT)
        self.assertEqual(leader.returncode, 0)
        self.finish(process)
        self.same("here", "there")

    def test_over_mpi(self):
        process = subprocess.Popen(
            [OPTIONS.mpiexec, "-n", str(OPTIONS.ranks), os.path.abspath(OPTIONS.culm), "serve", self.led, "--at",
             f"mpi:{OPTIONS.ranks}", "--port", "wet", "--output", "there", "--quiet", "--ranks", str(OPTIONS.ranks), ":",
             "-n", "1", os.path.abspath(OPTIONS.mpi_leader), "mpi"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, **MPI_ENVIRONMENT},
            cwd=self.folder)
        self.finish(process)
        self.same("here", "there")

    def fails(self, said, lead, *words):
        process = self.serve(*words)
        with self.assertRaisesRegex((culm_partner.PartnerError, KeyboardInterrupt), said):
            with culm_partner.Structure(self.address, patience=20.0) as mast:
                self.step(mast, numpy.zeros((5, 6)), numpy.zeros((5, 3)))
                lead(mast)
        errors = self.finish(process, FAILED_PARTNER)
        self.assertIn("the partner 'partner' at port 'wet' failed after 1 steps: ", re.sub(r"\s+", " ", errors))
        self.assertRegex(re.sub(r"\s+", " ", errors), said)
        self.assertEqual(self.rows("there"), 1)

    def test_that_fail(self):
        def leave(mast):
            mast._connection.socket.shutdown(2)
            raise KeyboardInterrupt("gone without a word")

        def give_up(mast):
            raise KeyboardInterrupt("no more wind")

        self.fails("gone without a word", leave)
        self.fails("no more wind", give_up)

    @one_process_shows
    def test_that_ask_what_makes_no_sense(self):
        def go_forward(mast):
            mast.save(1)
            self.step(mast, numpy.zeros((5, 6)), numpy.zeros((5, 3)))
            mast.save(2)
            mast.restore(1)
            mast.restore(2)

        self.fails("it asked for 'restore': the results that belong to the snapshot are gone", go_forward)
        self.fails("it asked for 'accept'", lambda mast: mast.accept())
        self.fails("nothing was saved under the number 3", lambda mast: mast.restore(3))
        self.fails("checkpoints have numbers above zero", lambda mast: mast.keep(0))
        self.fails("the deck wants no checkpoints", lambda mast: mast.keep(1), "--set", "Output/Checkpoints=false")
        self.fails("it answered nan for component 0 at point 0", lambda mast: mast.attempt(numpy.full((5, 6), numpy.nan), 1.0))
        self.fails("cannot end at 0 s", lambda mast: mast.attempt(numpy.zeros((5, 6)), 0.0))
        for end in (0.51, numpy.inf, numpy.nan):
            self.fails(f"a step cannot end at {end} s, the motion of the deck ends at 0.5 s",
                       lambda mast, end=end: mast.attempt(numpy.zeros((5, 6)), end))

    def test_that_leave_early(self):
        """The last state is recorded as every other one, though it is not due."""
        process = self.serve(*(word for one in ("Every=2", "Constraint Forces=true", "Velocities=true")
                               for word in ("--set", f"Output/{one}")))
        with culm_partner.Structure(self.address, patience=20.0) as mast:
            loads, velocity = numpy.zeros((5, 6)), mast.velocity[:, :3].copy()
            for _ in range(3):
                loads, velocity = self.step(mast, loads, velocity)
        self.finish(process)
        import h5py  # not above: partners do without

        with h5py.File(self.folder / "there" / "run.h5") as file:
            last = file["steps"][max(file["steps"])]
            self.assertEqual(last.attrs["step"], 3)
            self.assertIn("%arrays", last)
            self.assertIn("velocity", last)

    def test_that_die_in_an_attempt(self):
        """Which belongs to no state: the last one is that of the step before, though it is not due."""
        process = self.serve("--set", "Output/Every=2")
        with self.assertRaises(KeyboardInterrupt):
            with culm_partner.Structure(self.address, patience=20.0) as mast:
                self.step(mast, numpy.zeros((5, 6)), mast.velocity[:, :3].copy())
                mast.attempt(numpy.full((5, 6), 100.0), mast.proposal)
                raise KeyboardInterrupt("no more wind")
        self.finish(process, FAILED_PARTNER)
        import h5py

        with h5py.File(self.folder / "there" / "run.h5") as file:
            last = file["steps"][max(file["steps"])]
            self.assertEqual((last.attrs["step"], last.attrs["time"]), (1, mast.time))

    def test_that_are_silent(self):
        self.fails("said nothing", lambda mast: (mast._connection.ended.set(), time.sleep(3), mast.accept()),
                   "--patience", "1.5")

    @one_process_shows
    def test_of_decks_that_cannot_be_led(self):
        for words, said in ((("--port", "wett"), "did you mean 'wet'"), ((), "the deck has 2 ports: say which by --port")):
            errors = self.culm("serve", self.led, "--at", self.address, *words, "--output", "no", code=2)
            self.assertIn(said, errors)
        errors = self.culm("serve", self.deck, "--at", self.address, "--port", "wet", "--output", "no", code=3)
        self.assertIn("culm leads these partners", errors)
        self.assertFalse((self.folder / "no").exists())


@unittest.skipIf("--ranks" in sys.argv, "one rank reads the deck for all")
class Decks(CouplingTest):
    DAMPING = 10000.0  # N s/m

    def says(self, text, deck, *settings, code=3):
        words = [word for setting in settings for word in ("--set", setting)]
        for verb in ("check", "run"):
            errors = self.culm(verb, deck, *words, *(["--output", "out"] if verb == "run" else []), code=code)
            self.assertIn(text, errors)
        self.assertFalse((self.folder / "out").exists())

    def test_that_are_wrong(self):
        partner = "Coupling/Partners/water/"
        self.says("there is no port 'wett' – did you mean 'wet'?", self.deck, partner + "Port=wett")
        self.says("did you mean 'Quasi Newton'", self.deck, "Coupling/Scheme=Quasi-Newtn")
        self.says("needs 'Port': the deck has 2", self.deck, "Coupling/Partners/more/Type=Dashpot",
                  "Coupling/Partners/more/Damping=1")
        self.says("port 'wet' has a partner already", self.deck, "Coupling/Partners/more/Type=Dashpot",
                  "Coupling/Partners/more/Damping=1", "Coupling/Partners/more/Port=wet")
        other, address = "Coupling/Partners/air/", str(self.address).removeprefix("unix:")
        self.says("partner 'water' comes to 'unix:", self.remote, other + "Type=Socket", other + "Port=top",
                  f"{other}Address=unix:{pathlib.Path(address).parent}/./{pathlib.Path(address).name}")
        self.says("partner 'water' comes to 'tcp:127.0.0.1:5000' already", self.remote, partner + "Address=tcp:5000",
                  other + "Type=Socket", other + "Port=top", other + "Address=tcp:127.0.0.1:5000")

    def test_whose_partners_cannot_serve(self):
        self.says("'nowhere' is no address: 'unix:PATH'", self.remote, "Coupling/Partners/water/Address=nowhere")
        for port in ("99999", "0", "-1"):
            self.says("ports are 1 to 65535", self.remote, f"Coupling/Partners/water/Address=tcp:{port}")
        gas = "Coupling/Partners/gas/"
        self.says("face 0 names point 9; there are 1, from 0", self.deck, gas + "Type=Pressure", gas + "Port=top",
                  gas + "Pressure=1", gas + "Triangles={9, 0, 0}")

    def fault(self, name, code, *settings, more=()):
        words = [word for setting in settings for word in ("--set", "Coupling/Partners/fault/" + setting)]
        words += [word for setting in more for word in ("--set", setting)]
        errors = self.culm("run", self.deck, "--output", "fault", "--quiet", "--set", "Coupling/Partners/fault/Type=Faulty",
                           "--set", "Coupling/Partners/fault/Port=top", "--set", "Coupling/Partners/fault/Window=3",
                           "--set", f"Coupling/Partners/fault/Fault={name}", *words, code=code)
        return re.sub(r"\s+", " ", errors)

    def test_with_a_window_longer_than_the_motion(self):
        errors = self.culm("run", self.deck, "--output", "long", "--quiet", "--set", "Coupling/Window=10")
        self.assertIn("a window of 10 s does not end before the motion, which takes 0.5 s: all of it is one window",
                      re.sub(r"\s+", " ", errors))
        self.assertEqual(self.rows("long"), 1)

    def test_with_partners_that_fail(self):
        said = "the partner 'fault' at port 'top' failed in window 3, attempt "
        for name, words in (("Death", "as the deck wants it"), ("No Number", "it answered nan for component 0 at point 0"),
                            ("Infinite", "it answered inf for component 0 at point 0"),
                            ("Wrong Count", "it answered 0 numbers; six for each of 1 points are 6"),
                            ("Infinite Energy", "its energy is inf J, its heat 0 J"),
                            ("Lost Books", "its energy is nan J, its heat nan J, and was 0 J and 0 J before: it keeps books in "
                             "all windows, or in none")):
            with self.subTest(fault=name):
                errors = self.fault(name, FAILED_PARTNER)
                self.assertIn(said.replace(" 'fault'", "") if name == "Death" else said, errors)
                self.assertIn(f"from 0.06 s to 0.08 s: {words}", errors)
                self.assertEqual(self.rows("fault"), 3)

    def test_with_partners_that_lie(self):
        """Their forces are wrong and their books right, or the other way round: results are whole, the promise is broken."""
        errors = self.fault("Wrong Energy", 8)
        self.assertIn("the partner 'fault' books 1 J, and nothing went through its port", errors)
        for name in ("Scaled", "Turned", "Old", "Wrong Energy"):
            with self.subTest(fault=name):
                errors = self.fault(name, 8, "Mass=5")
                self.assertRegex(errors, "the interface 'fault' (makes|loses) ")
                self.assertIn("the partner answers or books", errors)
                self.assertNotIn("too loose", errors)  # windows are repeated
                self.assertNotRegex(errors, r"[0-9]e\+[0-9]+ %")
                self.assertEqual(self.rows("fault"), 25)

    def test_with_a_lie_in_one_window_of_many(self):
        """Over the run it is little: what counts is the window."""
        errors = self.fault("Wrong Energy", 8, "Mass=5", "Window=7", more=["Loads/push/Force={6000, 1000, 0}"])
        self.assertRegex(errors, "the interface 'fault' makes from 0.14 s to 0.16 s 1 J, .* % of the most that is exchanged in a "
                         "window")

    def test_whose_coupling_is_loose(self):
        """What a partner's mass does is not laid to the mesh."""
        deck = self.write("steps.xml", self.deck.read_text().replace('<Parameter name="Window" value="0.02"/>', ""))
        errors = self.culm("run", deck, "--output", "loose", "--quiet", "--set", "Coupling/Scheme=Explicit", "--set",
                           "Coupling/Partners/water/Mass=100", code=4)
        self.assertRegex(errors, "Likely cause: the coupling, not the structure. Partner 'water': it answers like a mass of ")
        self.assertEqual(errors.count("Likely cause"), 1)
        self.assertRegex(errors, r"Go on with: culm resume loose, from [0-9.]+ s\n")

    def test_whose_windows_are_cut(self):
        """Of a damper c at a mass m each try makes an error c h / 2 m times as large: in short windows it vanishes."""
        damper = ["Coupling/Partners/water/Type=Dashpot", "Coupling/Scheme=Constant", "Coupling/Relaxation=1",
                  "Coupling/Most Attempts=40", "Coupling/Tolerance=1e-6", "Analyses/motion/End Time=0.1"]
        deck = self.write("damped.xml", self.deck.read_text().replace(
            '<Parameter name="Mass" value="20"/>', f'<Parameter name="Damping" value="{self.DAMPING}"/>'))
        steps = self.write("steps.xml", deck.read_text().replace('<Parameter name="Window" value="0.02"/>', ""))
        for name, one in (("windows", deck), ("steps", steps)):
            with self.subTest(of=name):
                words = [word for setting in damper for word in ("--set", setting)]
                process = self.start("run", one, "--output", name, *words)
                output, errors = process.communicate(timeout=TIME_LIMIT)
                self.assertEqual(process.returncode, 0, output + errors)
                self.assertRegex(output, r"cut back [0-9]+ times, down to [0-9.e-]+ s, where structure and partners did not")
        errors = self.culm("run", deck, "--output", "never", "--quiet", *words, "--set", "Coupling/Most Attempts=4", "--set",
                           "Coupling/Relaxation=1e-9", code=4)
        self.assertIn("did not agree in 4 attempts", errors)
        self.assertIn("What they differ by does not fall from attempt to attempt", errors)
        self.assertNotIn("more 'Most Attempts'", errors)

    def test_with_partners_that_are_slow(self):
        self.assertEqual(self.fault("Slow", 0, "Mass=5", "Window=23"), "")
        self.culm("run", self.deck, "--output", "quick", "--quiet", "--set", "Coupling/Partners/fault/Type=Added Mass",
                  "--set", "Coupling/Partners/fault/Port=top", "--set", "Coupling/Partners/fault/Mass=5")
        self.same("fault", "quick")


if __name__ == "__main__":
    if sys.argv[1] == "--partner":
        be_partner(*sys.argv[2:])
        sys.exit()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--culm", required=True)
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--socket-partner")
    parser.add_argument("--mpi-partner")
    parser.add_argument("--socket-leader")
    parser.add_argument("--mpi-leader")
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
