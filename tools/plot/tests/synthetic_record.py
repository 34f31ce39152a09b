"""A small survey written with the official MCAP library, its soundings made from a formula: what the plots are tested on."""
import numpy as np
from mcap.writer import CompressionType, Writer

import ensonify
from ensonify import wire

SPEED_MPS, PING_HZ, SOUND_SPEED_MPS = 2.0, 10, 1500.0
UTC_START_NS = 1_748_779_200 * 10**9  # 2025-06-01T12:00:00Z


def seabed_up_m(east_m, north_m):
    """A slope with a ridge and a boulder."""
    ridge = 3.0 * np.exp(-(((east_m - 0.4 * north_m - 60.0) / 18.0) ** 2))
    boulder = 1.5 * np.exp(-((east_m - 150.0) ** 2 + (north_m - 30.0) ** 2) / 8.0)
    return -20.0 - 0.03 * north_m + ridge + boulder


def tiles(west_m, south_m, east_m, north_m, posts=129, spacing_m=0.5):
    """The same seabed as tile/1 messages."""
    width = (posts - 1) * spacing_m
    for row in range(int(np.floor(south_m / width)), int(np.floor(north_m / width)) + 1):
        for col in range(int(np.floor(west_m / width)), int(np.floor(east_m / width)) + 1):
            east, north = np.meshgrid(col * width + np.arange(posts) * spacing_m, row * width + np.arange(posts) * spacing_m)
            yield ensonify.Tile(col=col, row=row, origin_east_m=col * width, origin_north_m=row * width, spacing_m=spacing_m,
                                height_m=seabed_up_m(east, north).astype("f4"), sediment=np.zeros((posts, posts), "u1"))


def soundings_of(ping, t_ns, east_m, north_m, heading, angles, noise_m, bias_m, random):
    """Where straight rays hit the seabed, with Gaussian depth errors."""
    across = np.tan(angles) * 20.0
    for _ in range(4):  # the seabed is gentle: a fixed point
        x, y = east_m + across * np.cos(heading), north_m - across * np.sin(heading)
        across = np.tan(angles) * -seabed_up_m(x, y)
    x, y = east_m + across * np.cos(heading), north_m - across * np.sin(heading)
    up = seabed_up_m(x, y)
    range_m = np.hypot(across, up)
    position = np.stack([x, y, up + bias_m + noise_m * random.standard_normal(len(angles)) / np.cos(angles)], axis=1)
    valid = (random.random(len(angles)) > 0.01).astype("u1")
    return ensonify.Soundings(stamp_ns=t_ns, ping=ping, beam_angle_rad=angles.astype("f4"), valid=valid,
                              travel_time_s=(2 * range_m / SOUND_SPEED_MPS).astype("f4"),
                              backscatter_db=np.full(len(angles), 100, "f4"), quality_db=np.full(len(angles), 20, "f4"),
                              position_enu_m=position, thu_m=np.full(len(angles), 1.5, "f4"),
                              tvu_m=(1.96 * np.hypot(bias_m, noise_m / np.cos(angles))).astype("f4")), range_m


def ping_of(soundings, range_m, samples, random):
    """Echoes at the soundings' ranges in noise."""
    time_s = np.arange(samples) * 2 * 60.0 / SOUND_SPEED_MPS / samples
    arrival = (2 * range_m / SOUND_SPEED_MPS)[:, None]
    width = 2e-4 + 1.5e-3 * np.abs(np.tan(soundings.beam_angle_rad))[:, None]
    echo = 1e5 / range_m[:, None] ** 2 * np.exp(-(((time_s - arrival) / width) ** 2)) * random.rayleigh(1, (len(range_m), samples))
    return ensonify.Ping(stamp_ns=soundings.stamp_ns, ping=soundings.ping, sample_period_s=time_s[1], first_sample_s=0.0,
                         beam_angle_rad=soundings.beam_angle_rad, frequency_hz=300e3, pulse_length_s=1e-4,
                         amplitude_upa=(echo + random.rayleigh(0.5, echo.shape)).astype("f4"), source_level_db=220.0,
                         range_m=60.0, sound_speed_mps=SOUND_SPEED_MPS)


def write(file, lines=3, line_m=150.0, beams=64, spacing_m=35.0, noise_m=0.05, bias_m=0.02, every=50, leave_out=(), turn_pings=0,
          names=(), stated_share=1.0):
    """Lawnmower lines east and west, as many pings behind each as a turn has, straight on and 1 m too deep; `names` of the lines; the
    uncertainty stated is a share of the true one; `leave_out` names types that the record does not hold."""
    random = np.random.default_rng(1)
    angles = np.radians(np.linspace(-65, 65, beams))
    with open(file, "wb") as stream:
        writer = Writer(stream, chunk_size=1 << 20, compression=CompressionType.NONE)
        writer.start(profile="x-ensonify/1", library="test")
        writer.add_metadata("ensonify", {"version": "0.1.0", "seed": "1", "utc_start_ns": str(UTC_START_NS)})
        channels = {}

        def put(topic, message, t_ns):
            if message.TYPE in leave_out:
                return
            if topic not in channels:
                schema = writer.register_schema(message.TYPE, "jsonschema", b"{}")
                facts = {"type": message.TYPE, "rank": str(len(channels)), "max_bytes": "1000000"}
                channels[topic] = writer.register_channel(topic, "msgpack", schema, facts)
            writer.add_message(channels[topic], UTC_START_NS + t_ns, wire.encode_inline(message.to_map()), UTC_START_NS + t_ns, 0)

        put("pager/chart", ensonify.Chart(origin_latitude_deg=54.3, origin_longitude_deg=10.2), 0)
        for tile in tiles(-80, -80, line_m + 80, lines * spacing_m + 80):
            put("pager/tile", tile, 0)
        ping, pings_of_line = 0, int(line_m / SPEED_MPS * PING_HZ)
        for line in range(lines):
            eastward = line % 2 == 0
            heading = np.pi / 2 if eastward else -np.pi / 2
            for n in range(pings_of_line + turn_pings):
                turning = n >= pings_of_line
                t_ns = ping * 10**9 // PING_HZ
                along = n * SPEED_MPS / PING_HZ
                east = along if eastward else line_m - along
                north = line * spacing_m
                put("auv_nav/estimate", ensonify.Estimate(stamp_ns=t_ns, position_enu_m=(east, north, 0.0)), t_ns)
                put("pilot/state", ensonify.MissionState(stamp_ns=t_ns, state="turn" if turning else "on_line", line=line,
                                                       line_name="" if turning or not names else names[line]), t_ns)
                soundings, range_m = soundings_of(ping, t_ns, east, north, heading, angles, noise_m, bias_m - turning, random)
                soundings.tvu_m *= np.float32(stated_share)
                put("bow/soundings", soundings, t_ns)
                if ping % every == 0:
                    put("bow/ping", ping_of(soundings, range_m, 1500, random), t_ns)
                ping += 1
        writer.finish()
    return ping
