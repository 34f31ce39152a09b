"""A gateway from an autopilot's MAVLink to a nav_feed: KM binary samples of its attitude and position, with UTC.

    python -m ensonify.mavlink --listen udp:127.0.0.1:14550 --to 127.0.0.1:10110
    python -m ensonify.mavlink --connect tcp:127.0.0.1:5760 --to 127.0.0.1:10110

Frames and signs are those of the MAVLink definitions: body forward, starboard, down; latitude and longitude in 1e-7
degrees; altitude in mm above mean sea level. In KM binary [KongsbergKmall] roll is port up, pitch bow up and heading true,
which is the same attitude; its height is of the ellipsoid.
"""
import argparse
import collections
import datetime
import ipaddress
import json
import math
import signal
import socket
import struct
import sys
import time
from typing import Callable, Iterator, NamedTuple

from ensonify.session import EXIT_BAD_INPUT

POSITION_GAP_S = 1.5  # positions farther apart are not joined; it bounds how long an attitude waits for the next one
REORDERED_S = 1.0  # a boot time that is older by more is of another boot
BOOT_JUMP_S = 5.0  # a boot time that runs ahead of its arrival by more is of another boot
UTC_JUMP_S = 0.1  # a step of UTC that is said; every one is followed
EARLIEST_UTC_US, LATEST_UTC_US = 946684800 * 10**6, 4102444800 * 10**6  # 2000 to 2100: clocks without UTC say 0 or count from 1970
FASTEST_RADPS = 1000.0
TRY_AGAIN_S, CONNECT_S = 1.0, 5.0

# The #KMB sample of #SKM, alone: mark, bytes, version; s, ns, status; latitude, longitude; ellipsoid height, roll, pitch,
# heading, heave; rates; velocity; deviations and acceleration, which are 0; delayed heave with its time.
SAMPLE = struct.Struct("<4sHH 3I 2d 5f 3f 3f 40x 2If")
NO_PLACE = 1 << 0
NO_HEAVE, NO_ACCELERATION, NO_DEVIATIONS, NO_DELAYED_HEAVE = (1 << bit for bit in (3, 4, 5, 6))  # never in MAVLink's
UNKNOWN_DEG = 200.0

EARTH_RADIUS_M, EARTH_ECCENTRICITY_SQUARED = 6378137.0, 0.00669437999014  # WGS 84


class Attitude(NamedTuple):
    boot_ms: int
    angles_rad: tuple  # roll, pitch, yaw
    rates_radps: tuple

    def is_possible(self) -> bool:
        """Yaw may be up to 360 degrees, as some count it; what is not a number is not possible."""
        most = (3.1416, math.pi / 2, 6.2832) + 3 * (FASTEST_RADPS,)
        return all(abs(value) <= limit for value, limit in zip(self.angles_rad + self.rates_radps, most))


class Position(NamedTuple):
    boot_ms: int
    place: tuple  # latitude and longitude in degrees, altitude in m above mean sea level
    velocity_mps: tuple  # north, east, down

    def is_possible(self) -> bool:
        """0 N 0 E to the last digit is what autopilots send before their first fix."""
        return abs(self.place[0]) <= 90 and abs(self.place[1]) <= 180 and self.place[:2] != (0, 0)

    def rates(self) -> tuple:
        """Degrees and metres of altitude per second."""
        s = 1 - EARTH_ECCENTRICITY_SQUARED * math.sin(math.radians(self.place[0])) ** 2
        normal_m = EARTH_RADIUS_M / math.sqrt(s)
        meridian_m = normal_m * (1 - EARTH_ECCENTRICITY_SQUARED) / s
        north, east, down = self.velocity_mps
        return (math.degrees(north / meridian_m), math.degrees(east / (normal_m * math.cos(math.radians(self.place[0])))), -down)


def wrapped_deg(angle_deg: float) -> float:
    """In -180 to 180."""
    return (angle_deg + 180) % 360 - 180


def between(a: Position, b: Position, boot_ms: int) -> Position:
    """On the cubic that has the places and velocities of both (Hermite). Velocities that are all zero while the place moves
    are not known: then straight from one to the other."""
    step_s = (b.boot_ms - a.boot_ms) / 1000
    u = (boot_ms - a.boot_ms) / (b.boot_ms - a.boot_ms)
    way = (b.place[0] - a.place[0], wrapped_deg(b.place[1] - a.place[1]), b.place[2] - a.place[2])
    if any(a.velocity_mps + b.velocity_mps):
        begin, end = ([rate * step_s for rate in position.rates()] for position in (a, b))
    else:
        begin = end = way
    latitude, longitude, altitude = (
        p + (3 - 2 * u) * u * u * d + u * (1 - u) ** 2 * m - u * u * (1 - u) * n
        for p, d, m, n in zip(a.place, way, begin, end))
    velocity = tuple((1 - u) * v + u * w for v, w in zip(a.velocity_mps, b.velocity_mps))
    return Position(boot_ms, (latitude, wrapped_deg(longitude), altitude), velocity)


def km_binary(utc_us: int, attitude: Attitude, position: Position | None, geoid_above_ellipsoid_m: float) -> bytes:
    """One sample. Heave, acceleration and deviations are marked as not there, and place and velocity where they are not."""
    status = NO_HEAVE | NO_ACCELERATION | NO_DEVIATIONS | NO_DELAYED_HEAVE | (NO_PLACE if position is None else 0)
    latitude, longitude, altitude_m = position.place if position else (UNKNOWN_DEG, UNKNOWN_DEG, 0.0)
    velocity = position.velocity_mps if position else (0.0, 0.0, 0.0)
    height_m = altitude_m + geoid_above_ellipsoid_m if position else 0.0
    roll, pitch, yaw = map(math.degrees, attitude.angles_rad)
    seconds, left_us = divmod(utc_us, 10**6)
    return SAMPLE.pack(b"#KMB", SAMPLE.size, 1, seconds, 1000 * left_us, status, latitude, longitude, height_m, roll, pitch,
                       yaw % 360, 0.0, *map(math.degrees, attitude.rates_radps), *velocity, 0, 0, 0.0)


class Join:
    """Attitudes with the position of their time, and UTC. Each goes out in order, once a position of its time or later is
    there, or without one after POSITION_GAP_S. Nothing is extrapolated."""

    def __init__(self, send: Callable[[bytes], None], say: Callable[[str], None], geoid_above_ellipsoid_m: float = 0.0):
        self._send, self._say = send, say
        self._geoid_above_ellipsoid_m = geoid_above_ellipsoid_m
        self._offset_us: int | None = None  # UTC less boot time
        self._said_to_wait = False
        self._newest: tuple | None = None  # boot time in ms, and when it came in s
        self._waiting: collections.deque = collections.deque()
        self._positions: collections.deque = collections.deque(maxlen=2)
        self._newest_attitude_ms = -1
        self.counts: collections.Counter = collections.Counter()

    def time(self, boot_ms: int, utc_us: int, arrival_s: float) -> None:
        """SYSTEM_TIME: what UTC is at a boot time."""
        self._follow_boot(boot_ms, arrival_s)
        if not EARLIEST_UTC_US <= utc_us < LATEST_UTC_US:
            self.counts["times_without_utc"] += 1
            return
        self.counts["times"] += 1
        offset_us = utc_us - 1000 * boot_ms
        if self._offset_us is None:
            stamp = datetime.datetime.fromtimestamp(utc_us // 10**6, datetime.timezone.utc)
            self._say(f"UTC is known at boot time {boot_ms / 1000:.3f} s: {stamp:%Y-%m-%d %H:%M:%S}")
        elif abs(offset_us - self._offset_us) > UTC_JUMP_S * 10**6:
            self.counts["utc_jumps"] += 1
            self._say(f"UTC jumped by {(offset_us - self._offset_us) / 10**6:+.3f} s: followed")
        self._offset_us = offset_us

    def attitude(self, attitude: Attitude, arrival_s: float) -> None:
        self._follow_boot(attitude.boot_ms, arrival_s)
        if not attitude.is_possible():
            self.counts["attitudes_impossible"] += 1
        elif attitude.boot_ms <= self._newest_attitude_ms:
            self.counts["attitudes_late_or_double"] += 1
        elif self._offset_us is None:
            self.counts["attitudes_before_utc"] += 1
            if not self._said_to_wait:
                self._say("no UTC by SYSTEM_TIME yet: nothing is sent")
            self._said_to_wait = True
        else:
            self.counts["attitudes"] += 1
            self._newest_attitude_ms = attitude.boot_ms
            self._waiting.append(attitude)
            self._send_due()

    def position(self, position: Position, arrival_s: float) -> None:
        self._follow_boot(position.boot_ms, arrival_s)
        if not position.is_possible():
            self.counts["positions_impossible"] += 1
        elif self._positions and position.boot_ms <= self._positions[-1].boot_ms:
            self.counts["positions_late_or_double"] += 1
        else:
            self.counts["positions"] += 1
            self._positions.append(position)
            self._send_due()

    def _follow_boot(self, boot_ms: int, arrival_s: float) -> None:
        """Another boot's clock has another UTC: with it all that was known begins again."""
        if self._newest is not None:
            before_ms, before_arrival_s = self._newest
            step_s = (boot_ms - before_ms) / 1000
            if step_s < -REORDERED_S or step_s - (arrival_s - before_arrival_s) > BOOT_JUMP_S:
                self._begin_again(before_ms, boot_ms)
        if self._newest is None or boot_ms > self._newest[0]:
            self._newest = boot_ms, arrival_s

    def _begin_again(self, before_ms: int, boot_ms: int) -> None:
        self.counts["boot_time_jumps"] += 1
        if self._offset_us is not None:
            self._say(f"boot time jumped from {before_ms / 1000:.3f} s to {boot_ms / 1000:.3f} s (the autopilot restarted?): "
                      "nothing is sent before its next SYSTEM_TIME")
        while self._waiting:
            self._send_sample(self._waiting.popleft(), None)
        self._positions.clear()
        self._offset_us, self._newest, self._newest_attitude_ms = None, None, -1
        self._said_to_wait = True

    def _send_due(self) -> None:
        while self._waiting:
            oldest = self._waiting[0]
            may_wait = self._newest_attitude_ms - oldest.boot_ms <= 1000 * POSITION_GAP_S
            if may_wait and not (self._positions and oldest.boot_ms <= self._positions[-1].boot_ms):
                return
            self._send_sample(self._waiting.popleft(), self._position_at(oldest.boot_ms))

    def _position_at(self, boot_ms: int) -> Position | None:
        for position in self._positions:
            if position.boot_ms == boot_ms:
                return position
        if len(self._positions) < 2:
            return None
        a, b = self._positions
        inside = a.boot_ms < boot_ms < b.boot_ms and b.boot_ms - a.boot_ms <= 1000 * POSITION_GAP_S
        return between(a, b, boot_ms) if inside else None

    def _send_sample(self, attitude: Attitude, position: Position | None) -> None:
        assert self._offset_us is not None  # none waits without it
        self.counts["sent" if position else "sent_without_position"] += 1
        self._send(km_binary(self._offset_us + 1000 * attitude.boot_ms, attitude, position, self._geoid_above_ellipsoid_m))


class Decoder:
    """Messages of one system's autopilot; version 1 or 2, signatures are not checked. Each datagram has whole frames; a connection
    goes on where it was."""

    def __init__(self, system: int, component: int, counts: collections.Counter):
        from pymavlink.dialects.v20 import common

        self._mavlink, self._system, self._component, self._counts = common, system, component, counts
        self._parser = None

    def begin(self) -> None:
        """Another datagram, or another connection: what is left of a frame is lost."""
        if self._parser is not None and self._parser.buf_len() > 0:
            self._counts["frames_cut"] += 1
        self._parser = self._mavlink.MAVLink(None)
        self._parser.robust_parsing = True

    def take(self, piece: bytes, join: Join, arrival_s: float) -> None:
        for message in self._messages(piece):
            kind = message.get_type()
            if message.get_srcSystem() != self._system:
                self._counts["of_other_systems"] += 1
            elif message.get_srcComponent() != self._component:
                self._counts["of_other_components"] += 1
            elif kind == "SYSTEM_TIME":
                join.time(message.time_boot_ms, message.time_unix_usec, arrival_s)
            elif kind == "ATTITUDE":
                m = message
                join.attitude(Attitude(m.time_boot_ms, (m.roll, m.pitch, m.yaw), (m.rollspeed, m.pitchspeed, m.yawspeed)), arrival_s)
            elif kind == "GLOBAL_POSITION_INT":
                m = message
                join.position(Position(m.time_boot_ms, (m.lat / 1e7, m.lon / 1e7, m.alt / 1e3), (m.vx / 100, m.vy / 100, m.vz / 100)),
                              arrival_s)
            else:
                self._counts["other_messages"] += 1

    def _messages(self, piece: bytes) -> Iterator:
        assert self._parser is not None
        for message in self._parser.parse_buffer(piece) or []:
            kind = message.get_type()
            if kind == "BAD_DATA":
                self._counts["bad_crc" if "invalid MAVLink CRC" in message.reason else "not_mavlink"] += 1
            elif kind.startswith("UNKNOWN"):  # not in the common definitions: its CRC cannot be checked
                self._counts["other_messages"] += 1
            else:
                yield message


class Address(NamedTuple):
    host: str  # of IPv6 without brackets
    port: int

    def __str__(self) -> str:
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"


def address(text: str, *ways: str) -> Address:
    """HOST:PORT, behind one of the ways where some are given."""
    allowed = " or ".join(f"{way}HOST:PORT" for way in ways or [""]) + f", as {(ways or [''])[0]}127.0.0.1:14550 or {(ways or [''])[0]}[::1]:14550"
    way = next((way for way in ways if text.startswith(way)), "")
    host, _, port = text.removeprefix(way).rpartition(":")
    bare = host[1:-1] if host.startswith("[") and host.endswith("]") else host
    if bool(ways) != bool(way) or not bare or (":" in bare) != (bare != host) or not port.isdigit() or not 0 < int(port) < 65536:
        raise argparse.ArgumentTypeError(f"{text}; allowed is {allowed}")
    return Address(bare, int(port))


class Way(NamedTuple):
    """How MAVLink comes: to a UDP port, over a connection that the autopilot makes, or over one to it."""

    name: str  # "udp", "tcp_server", "tcp"
    address: Address


def listened(text: str) -> Way:
    return Way("tcp_server" if text.startswith("tcp:") else "udp", address(text, "udp:", "tcp:"))


def connected(text: str) -> Way:
    return Way("tcp", address(text, "tcp:"))


def sender(text: str) -> str:
    try:
        return str(ipaddress.ip_address(text))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}; allowed is an address, as 127.0.0.1 or ::1") from None


def identity(text: str) -> int:
    if not text.isdigit() or not 0 < int(text) < 256:
        raise argparse.ArgumentTypeError(f"{text}; allowed is 1 to 255")
    return int(text)


def parser() -> argparse.ArgumentParser:
    of = argparse.ArgumentParser(prog="python -m ensonify.mavlink", description="MAVLink in, KM binary out, for a nav_feed.")
    ways = of.add_mutually_exclusive_group()
    ways.add_argument("--listen", dest="way", metavar="WAY:HOST:PORT", type=listened, default="udp:127.0.0.1:14550",
                      help="where MAVLink comes; tcp: over one connection at a time (default: udp:127.0.0.1:14550)")
    ways.add_argument("--connect", dest="way", metavar="tcp:HOST:PORT", type=connected,
                      help="an autopilot that waits for connections: tried again every second")
    of.add_argument("--to", type=address, required=True, help="HOST:PORT of the nav_feed's source with `format: km_binary`")
    of.add_argument("--system", type=identity, default=1, help="system id that is followed (default: 1)")
    of.add_argument("--component", type=identity, default=1, help="its component that is followed (default: 1, the autopilot)")
    of.add_argument("--sender", type=sender, nargs="+", default=["127.0.0.1", "::1"],
                    help="addresses whose datagrams and connections are taken (default: 127.0.0.1 and ::1)")
    of.add_argument("--geoid-above-ellipsoid-m", type=float, default=0.0,
                    help="added to altitudes, which are above mean sea level: the scenario's `geoid_above_ellipsoid_m` (default: 0)")
    return of


def family_of(where: Address) -> socket.AddressFamily:
    return socket.getaddrinfo(where.host, where.port)[0][0]


def is_of(senders: list, sender: tuple) -> bool:
    return sender[0].split("%")[0] in senders


def datagrams(incoming: socket.socket, args: argparse.Namespace, counts: collections.Counter) -> Iterator:
    """What comes, and whether it begins anew: each datagram does."""
    while True:
        datagram, sender = incoming.recvfrom(65536)
        if is_of(args.sender, sender):
            yield datagram, True
        else:
            counts["senders_refused"] += 1


def of_connection(connection: socket.socket, counts: collections.Counter) -> Iterator:
    """The same of one connection, until its end."""
    counts["connections"] += 1
    begins = True
    with connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        while True:
            try:
                piece = connection.recv(65536)
            except OSError:
                return
            if not piece:
                return
            yield piece, begins
            begins = False


def by_server(listener: socket.socket, args: argparse.Namespace, counts: collections.Counter) -> Iterator:
    """One connection after the other; whoever comes meanwhile waits."""
    listener.listen(1)
    while True:
        connection, sender = listener.accept()
        if is_of(args.sender, sender):
            yield from of_connection(connection, counts)
        else:
            connection.close()
            counts["senders_refused"] += 1


def by_client(args: argparse.Namespace, counts: collections.Counter, say: Callable[[str], None]) -> Iterator:
    there = True
    while True:
        try:
            connection = socket.create_connection(args.way.address, timeout=CONNECT_S)
        except OSError as error:
            if there:
                say(f"no connection to {args.way.address}: {error.strerror or error}; tried again every second")
            there = False
            time.sleep(TRY_AGAIN_S)
            continue
        there = True
        connection.settimeout(None)
        say(f"connected to {args.way.address}")
        yield from of_connection(connection, counts)
        say(f"the connection to {args.way.address} has ended")
        time.sleep(TRY_AGAIN_S)


def serve(args: argparse.Namespace) -> None:
    """Until it is ended; then the counts are printed."""
    def say(text: str) -> None:
        print(text, flush=True)

    server = args.way.name == "tcp_server"
    with socket.socket(family_of(args.way.address), socket.SOCK_STREAM if server else socket.SOCK_DGRAM) as incoming, \
            socket.socket(family_of(args.to), socket.SOCK_DGRAM) as outgoing:
        def send(sample: bytes) -> None:
            try:
                outgoing.sendto(sample, args.to)
            except OSError:  # no way there now
                join.counts["not_sent"] += 1

        join = Join(send, say, args.geoid_above_ellipsoid_m)
        decoder = Decoder(args.system, args.component, join.counts)
        if args.way.name == "tcp":
            pieces = by_client(args, join.counts, say)
        else:
            if server:
                incoming.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            incoming.bind(args.way.address)
            pieces = (by_server if server else datagrams)(incoming, args, join.counts)
        say(f"receives MAVLink of system {args.system} {'from' if args.way.name == 'tcp' else 'at'} {args.way.address}, sends to {args.to}")
        try:
            for piece, begins in pieces:
                if begins:
                    decoder.begin()
                decoder.take(piece, join, time.monotonic())
        finally:
            say(json.dumps(join.counts))


def main(arguments: list | None = None) -> int:
    args = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        serve(args)
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] != "pymavlink":
            raise
        print("ensonify.mavlink: needs pymavlink: pip install 'ensonify[mavlink]'", file=sys.stderr)
        return EXIT_BAD_INPUT
    except OSError as error:
        print(f"ensonify.mavlink: {args.way.address}: {error.strerror}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        return 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
