"""Be the partner of culm from another program: the wire format over sockets, in one file without culm.

    import culm_partner

    class Wind(culm_partner.Partner):
        def loads(self, window):
            loads = numpy.zeros((self.points, 6))
            loads[:, 0] = 12.0 - window.motion[:, 0] / window.length
            return loads

    culm_partner.run("unix:/tmp/wind", Wind())

culm listens (partner of type 'Socket') and leads: for each window of time it sends how the points of a port move, as
often as it takes, and then says that the window is over. Where the program shall lead, `culm serve` follows:

    with culm_partner.Structure("unix:/tmp/wind") as mast:
        while not mast.is_at_end:
            converged = mast.attempt(loads_of(mast), mast.proposal)  # as often as it takes
            mast.accept()

doc/developer/wire_format.md describes the bytes.
"""

import math
import os
import socket
import struct
import sys
import threading
import time
import zlib

import numpy

QUANTITIES = (("position", 3), ("rotation", 9), ("velocity", 6), ("acceleration", 6), ("motion", 6))
HELLO, ATTEMPT, ANSWER, ACCEPT, ACCEPTED, SAVE, SAVED, ALIVE, BYE, ERROR = range(1, 11)
DISCARD, DISCARDED, FAIL, FAILED, RESTORE, RESTORED = range(11, 17)  # of programs that lead
KEEP, KEPT = 18, 19  # as well
HEADER = struct.Struct("<4sHHIIddQI20x")  # magic, version, kind, window, attempt, start, end, payload, checksum
CHECKED = 40  # bytes of the header that the checksum covers
VERSION = 1


class PartnerError(Exception):
    """culm is gone, was silent for too long, or says what makes no sense."""


class Window:
    """A window of time [s] and how the points move in it: arrays with a row for each point.

    number, attempt  from 0; every attempt at a window begins where the window begins
    start, end       [s]
    motion           displacement and rotation vector in the window [m, rad], what loads work on
    position         at the end [m]
    rotation         at the end: 3x3 matrices that turn the reference into the present, the unit matrix at first
    velocity         and angular velocity at the end [m/s, rad/s]; acceleration: mean of the last step
    loads            that acted, once the window is over: mean force and moment [N, N m]
    """

    def __init__(self, number, attempt, start, end):
        self.number, self.attempt, self.start, self.end = number, attempt, start, end
        self.loads = None

    def __getattr__(self, name):
        if name in (quantity for quantity, _ in QUANTITIES):
            raise AttributeError(f"the {name} of the points was not asked for: name it in `wants`")
        raise AttributeError(f"a window has no '{name}'")

    @property
    def length(self):
        return self.end - self.start


class Partner:
    """What culm asks; override what the program can answer."""

    name = "partner"
    wants = ("position",)  # names of QUANTITIES, beside the motion, which is always there
    longest_window = math.inf  # [s]

    def begin(self, port, reference, velocity, start, window):
        """Before the first window; calls of an own version begin with super().begin(...). reference: (points, 3) [m],
        in the axes of the deck as everything is; velocity: (points, 6); window: above 0 where a run goes on, from what
        was saved under this number."""
        self.points = len(reference)

    def loads(self, window):
        """Mean force and moment of each point in this window, (points, 6) [N, N m]. The next call may be the same
        window once more, with another motion: as if this call had not been."""
        raise NotImplementedError

    def accept(self, window):
        """The window is over with this motion. Returns the energy that the partner holds more than at the start and
        what it has turned into heat since [J], from which culm finds what the coupling loses; or nothing, in all windows,
        if it keeps no books. Lift on a structure that moves with it is work that comes out of the wind: heat below zero."""

    def save(self, window):
        """Keep what you are under this number, in a file: a run may go on from here, with begin(…, window) in a new program.
        A partner without a version of its own keeps nothing and begins anew then; culm warns of that."""

    def end(self, why):
        """culm says good-bye. why: it failed; empty if it did not."""


class Connection:
    """Frames over a socket. Another thread says every second that this program is alive while it computes."""

    def __init__(self, address, patience):
        self.patience = patience
        self.socket = _connect(address, patience)
        self.sending = threading.Lock()
        self.listens = True
        self.ended = threading.Event()
        threading.Thread(target=self._beat, daemon=True).start()

    def close(self):
        self.ended.set()
        self.socket.close()

    def send(self, kind, window=0, attempt=0, start=0.0, end=0.0, payload=b""):
        with self.sending:
            self.socket.sendall(encode(kind, window, attempt, start, end, payload))

    def receive(self):
        """(kind, window, attempt, start, end, payload) of the next frame that is more than a sign of life."""
        while True:
            self.listens = True
            self.socket.settimeout(self.patience)
            header = self._read(HEADER.size)
            payload = self._read(HEADER.unpack(header)[7])
            self.listens = False
            frame = decode(header, payload)
            if frame[0] != ALIVE:
                return frame

    def _read(self, size):
        data = bytearray()
        while len(data) < size:
            try:
                piece = self.socket.recv(min(size - len(data), 1 << 24))
            except socket.timeout:
                raise PartnerError(f"culm said nothing for {self.patience:g} s") from None
            except OSError as error:
                raise PartnerError(f"culm is gone ({error.strerror})") from None
            if not piece:
                raise PartnerError("culm is gone without a word")
            data += piece
        return bytes(data)

    def _beat(self):
        while not self.ended.wait(1.0):
            if self.listens:
                continue
            try:
                self.send(ALIVE)
            except OSError:
                return


def encode(kind, window, attempt, start, end, payload):
    def header(checksum):
        return HEADER.pack(b"CULM", VERSION, kind, window, attempt, start, end, len(payload), checksum)

    return header(zlib.crc32(payload, zlib.crc32(header(0)[:CHECKED]))) + payload


def decode(header, payload):
    magic, version, kind, window, attempt, start, end, _, checksum = HEADER.unpack(header)
    if magic != b"CULM" or version != VERSION:
        raise PartnerError(f"what came is no frame of culm in version {VERSION}")
    if zlib.crc32(payload, zlib.crc32(header[:CHECKED])) != checksum:
        raise PartnerError("a frame is damaged")
    return kind, window, attempt, start, end, payload


def run(address, partner, patience=600.0):
    """Serves culm until it says good-bye. address: 'unix:PATH' or 'tcp:[HOST:]PORT', where culm listens; culm may take
    so long to begin, and be silent for so long [s]. An exception of the partner is told to culm and goes on."""
    connection = Connection(address, patience)
    try:
        _serve(connection, partner)
    except PartnerError:
        raise
    except BaseException as error:
        why = "it left" if isinstance(error, SystemExit) else f"{type(error).__name__}: {error}"
        connection.send(ERROR, payload=why.encode())
        raise
    finally:
        connection.close()


class Structure:
    """culm as it follows: `culm serve DECK --at ADDRESS`. Steps are tried under loads at a port as often as wanted, then
    accepted; each attempt begins from the last accepted state, whatever was tried before.

    port, points, reference, final_time   the port, its points [m], where the analysis ends [s]
    kept               the number of its last checkpoint if a run goes on, else 0
    time, proposal     of the accepted state, and where culm would go next [s]
    work, step_work    of the loads on the structure: so far, and in the last step [J]
    position, …        what `wants` names, of the attempt that converged last: arrays with a row for each point
    """

    def __init__(self, address, wants=("position",), patience=600.0, name="partner"):
        self._wanted = _bits(wants)
        self._connection = Connection(address, patience)
        self._step, self._attempts = 0, 0
        kind, window, _, start, end, payload = self._connection.receive()
        if kind != HELLO or end <= start:
            raise PartnerError("culm leads here: start it by 'culm serve'")
        self.port, self.reference, self.velocity = _hello(payload)
        self.points, self.final_time, self.kept = len(self.reference), end, window
        hello = struct.pack("<IId", self.points, self._wanted, math.inf) + name.encode()
        self._connection.send(HELLO, payload=hello)
        self._take(self._connection.receive(), ACCEPTED)

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        try:
            if error is None:
                self._connection.send(BYE)
            elif not isinstance(error, PartnerError):
                self._connection.send(ERROR, payload=f"{kind.__name__}: {error}".encode())
        except OSError:
            pass  # culm has left before
        finally:
            self._connection.close()

    @property
    def is_at_end(self):
        return self.proposal == self.time

    def attempt(self, loads, end):
        """Tries a step to `end` [s] under these mean loads, (points, 6) [N, N m]. Returns whether it converged."""
        loads = _loads(loads, self.points)
        about = (self._step, self._attempts, self.time, end)
        self._attempts += 1
        payload = self._ask(ATTEMPT, ANSWER, about, loads.tobytes())[5]
        converged = struct.unpack_from("<d", payload)[0] == 1.0
        if converged:
            _read(self, payload, 8, self.points, self._wanted)
        return converged

    def accept(self):
        """Makes the last attempt, which converged, the accepted state; culm writes its results."""
        self._do(ACCEPT, ACCEPTED)
        self._step, self._attempts = self._step + 1, 0

    def discard(self):
        """Forgets the last attempt."""
        self._do(DISCARD, DISCARDED)

    def fail(self):
        """Forgets an attempt that did not converge, or was not good: `proposal` is nearer. culm ends if none is left."""
        self._do(FAIL, FAILED)

    def save(self, number):
        """Keeps the accepted state in culm's memory under a number, in place of what it was for before."""
        self._do(SAVE, SAVED, number)

    def restore(self, number):
        """Goes back to what was saved under this number, with results as they were then."""
        self._do(RESTORE, RESTORED, number)

    def keep(self, number):
        """Lets culm write a checkpoint, from which `culm resume` goes on; keep yourself under the same number, above 0."""
        self._do(KEEP, KEPT, number)

    def close(self):
        """The end: culm closes its results."""
        self._connection.send(BYE)
        self._connection.close()

    def _do(self, kind, expected, number=None):
        about = (self._step if number is None else number, self._attempts, self.time, self.time)
        self._take(self._ask(kind, expected, about), expected)

    def _ask(self, kind, expected, about, payload=b""):
        try:
            self._connection.send(kind, *about, payload=payload)
        except OSError:
            pass  # its last word may say why it is gone
        frame = self._connection.receive()
        if frame[0] == ERROR:
            raise PartnerError("culm says: " + frame[5].decode())
        if frame[0] != expected or frame[1:3] != about[:2]:
            raise PartnerError(f"culm answered {frame[:3]} to {(kind, *about[:2])}")
        return frame

    def _take(self, frame, expected):
        if frame[0] != expected:
            raise PartnerError(f"culm sent a frame of kind {frame[0]}")
        self.time, self.proposal = frame[3], frame[4]
        self.step_work, self.work = struct.unpack("<dd", frame[5])


def _bits(wants):
    names = [name for name, _ in QUANTITIES]
    wants = (wants,) if isinstance(wants, str) else wants  # ("velocity") is a text
    for name in wants:
        if name not in names:
            raise ValueError(f"there is no quantity '{name}' to want; allowed: {', '.join(names)}")
    return sum(1 << i for i, name in enumerate(names) if name in (*wants, "motion"))


def _loads(loads, points):
    if loads is None:
        raise TypeError(f"loads returned nothing instead of an array of shape {(points, 6)}")
    if numpy.ma.is_masked(loads):  # what lies under the mask would act
        raise ValueError("loads have masked values: say what stands there, as with filled(0.0)")
    if numpy.iscomplexobj(loads):
        raise ValueError("loads are complex numbers: say which part acts, as with .real")
    loads = numpy.ascontiguousarray(loads, "<f8")
    if loads.shape != (points, 6):
        raise ValueError(f"loads have the shape {loads.shape} instead of {(points, 6)}")
    return loads


def _books(books):
    """Energy and heat as culm reads them; no numbers, which only stand for no books, if the partner keeps none."""
    if books is None:
        return math.nan, math.nan
    if numpy.shape(books) != (2,):
        raise ValueError(f"accept returns energy and heat, two numbers [J], or nothing; it returned {books!r}")
    energy, heat = map(float, books)
    if not (math.isfinite(energy) and math.isfinite(heat)):
        raise ValueError(f"accept returned the energy {energy} J and the heat {heat} J: they must be finite; a partner that "
                         "keeps no books returns nothing")
    return energy, heat


def _hello(payload):
    """Port, reference positions, velocities."""
    points = struct.unpack_from("<I", payload)[0]
    numbers = numpy.frombuffer(payload, "<f8", 9 * points, 4)
    reference, velocity = numbers[: 3 * points].reshape(-1, 3), numbers[3 * points :].reshape(-1, 6)
    return payload[4 + 72 * points :].decode(), reference, velocity


def _read(target, payload, at, points, wanted):
    """Sets the quantities of a payload as attributes. Returns where they end."""
    for i, (name, width) in enumerate(QUANTITIES):
        if not wanted >> i & 1:
            continue
        values = numpy.frombuffer(payload, "<f8", width * points, at)
        setattr(target, name, values.reshape(-1, 3, 3) if name == "rotation" else values.reshape(-1, width))
        at += 8 * width * points
    return at


def _serve(connection, partner):
    kind, window, _, start, end, payload = connection.receive()
    if kind != HELLO:
        raise PartnerError(f"culm began with a frame of kind {kind}")
    wanted = _bits(partner.wants)
    if end > start:
        raise PartnerError("culm follows here: it is to be led by a Structure, or to be started by 'culm couple'")
    port, reference, velocity = _hello(payload)
    points = len(reference)
    partner.begin(port, reference, velocity, start, window)
    hello = struct.pack("<IId", points, wanted, partner.longest_window) + partner.name.encode()
    connection.send(HELLO, payload=hello)
    while True:
        kind, number, attempt, start, end, payload = connection.receive()
        about = (number, attempt, start, end)
        if kind == ATTEMPT:
            loads = _loads(partner.loads(_window(about, payload, points, wanted)), points)
            connection.send(ANSWER, *about, payload=loads.tobytes())
        elif kind == ACCEPT:
            books = _books(partner.accept(_window(about, payload, points, wanted)))
            connection.send(ACCEPTED, *about, payload=struct.pack("<dd", *books))
        elif kind == SAVE:
            keeps_nothing = type(partner).save is Partner.save
            partner.save(number)
            connection.send(SAVED, *about, payload=b"nothing" if keeps_nothing else b"")
        elif kind in (BYE, ERROR):
            partner.end(payload.decode())
            return
        else:
            raise PartnerError(f"culm sent a frame of kind {kind}")


def _window(about, payload, points, wanted):
    window = Window(*about)
    at = _read(window, payload, 0, points, wanted)
    if at < len(payload):
        window.loads = numpy.frombuffer(payload, "<f8", 6 * points, at).reshape(-1, 6)
    return window


def _connect_unix(path):
    channel = socket.socket(socket.AF_UNIX)
    try:
        channel.connect(path)
    except OSError:
        channel.close()
        raise
    return channel


def _connect(address, patience):
    kind, _, place = address.partition(":")
    start = time.monotonic()
    has_said = False
    while True:
        try:
            if kind == "unix":
                channel = _connect_unix(place)
            elif kind == "tcp":
                host, _, port = place.rpartition(":")
                channel = socket.create_connection((host or "127.0.0.1", int(port)))
                channel.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            else:
                raise ValueError(f"'{address}' is no address: 'unix:PATH' or 'tcp:[HOST:]PORT'")
            return channel
        except OSError as error:
            waited = time.monotonic() - start
            if waited > 2.0 and not has_said:
                print(f"waiting for culm at {address}", file=sys.stderr)
                has_said = True
            if waited > patience:
                raise PartnerError(f"nobody listens at '{address}' ({os.strerror(error.errno or 0)})") from None
            time.sleep(0.01)
