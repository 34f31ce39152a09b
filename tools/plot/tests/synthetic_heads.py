"""Echoes made from formulas, with targets whose places are known: what the pictures of pings are tested on, and what docs/manual/plots.md
shows of heads that its survey does not carry. The sonar equation in closed forms, straight rays, Rayleigh speckle."""
import json
import math

import numpy as np
from mcap.writer import CompressionType, Writer

import ensonify
from ensonify import wire

SOUND_SPEED_MPS = 1500.0
SILENCE_UPA = 10.0  # rms noise


def write(file, messages, declares=None):
    """A record of (topic, message) in the order given, and what the processes declared: by process, a message."""
    with open(file, "wb") as stream:
        writer = Writer(stream, chunk_size=1 << 20, compression=CompressionType.NONE)
        writer.start(profile="x-ensonify/1", library="test")
        writer.add_metadata("ensonify", {"version": "0.1.0", "seed": "1", "utc_start_ns": "0"})
        if declares:
            text = json.dumps({process: {message.TYPE: message.to_map()} for process, message in declares.items()})
            writer.add_attachment(0, 0, "declarations.json", "application/json", text.encode())
        channels = {}
        for topic, message in messages:
            if topic not in channels:
                schema = writer.register_schema(message.TYPE, "jsonschema", b"{}")
                channels[topic] = writer.register_channel(topic, "msgpack", schema, {"type": message.TYPE, "rank": "0", "max_bytes": "0"})
            stamp_ns = getattr(message, "stamp_ns", 0)  # a chart has none
            writer.add_message(channels[topic], stamp_ns, wire.encode_inline(message.to_map()), stamp_ns, 0)
        writer.finish()
    return file


def speckled(power, random):
    """Amplitudes whose mean squares are `power`."""
    return np.sqrt(random.exponential(1.0, np.shape(power)) * power).astype("f4")


def applied(**changed):
    """Settings in force, as fields of a message."""
    return {"frequency_hz": 445e3, "pulse_length_s": 1e-4, "source_level_db": 210.0, "sound_speed_mps": SOUND_SPEED_MPS} | changed


def level_pose(roll_rad=0.0):
    """Quaternion enu_from_head of a head with its bow to the north, rolled starboard down."""
    north = np.array([0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0])  # FRD to ENU: (x, y, z) -> (y, x, -z)
    half = roll_rad / 2
    w, x, y, z = north
    c, s = np.cos(half), np.sin(half)
    return np.array([[c * w - s * x, c * x + s * w, c * y + s * z, c * z - s * y]])


def sidescan(pings=200, altitude_m=12.0, target=(80, 1, 30.0), speed_mps=2.0, rate_hz=10.0, samples=1500, range_m=75.0,
             bottom_track=True, seed=1):
    """Pings of a sidescan with bottom track, over Lambert's seabed with ripples. `target` stands at (ping, side -1 or 1, ground range
    in m), seven pings long and half a metre wide, its shadow behind it."""
    random = np.random.default_rng(seed)
    period_s = 2 * range_m / SOUND_SPEED_MPS / samples
    slant_m = (np.arange(samples) + 1) * range_m / samples
    for ping in range(pings):
        height_m = altitude_m + 1.5 * np.sin(ping / 40)
        ground_m = np.sqrt(np.maximum(slant_m**2 - height_m**2, 0))
        lambert = 10**-2.5 * (height_m / slant_m) ** 2
        law = 210.0 - 30 * np.log10(slant_m) - 2 * 0.1 * slant_m - 33.0  # two-way loss and the area of 0.5 degrees by 7.5 cm
        along_m = ping * speed_mps / rate_hz
        rows = []
        for side in (-1, 1):
            band = np.abs(along_m - 25 + side * ground_m / 3) < 9
            ripples = 1 + 0.5 * np.sin(2 * np.pi * (side * ground_m + 0.3 * along_m) / 4.0) * band
            power = np.where(slant_m > height_m, lambert * ripples * 10 ** (law / 10), 0.0)
            if side == target[1] and abs(ping - target[0]) <= 3:
                behind = (ground_m > target[2] + 0.25) & (ground_m < target[2] + 3.5)
                power = np.where(np.abs(ground_m - target[2]) <= 0.25, 60 * power, np.where(behind, 0.0, power))
            rows.append(power + SILENCE_UPA**2)
        stamp_ns = int(ping / rate_hz * 1e9)
        yield "fish/ping", ensonify.Ping(
            stamp_ns=stamp_ns, ping=ping, sample_period_s=period_s, first_sample_s=period_s, amplitude_upa=speckled(rows, random),
            beam_angle_rad=np.array([-1.0, 1.0], "f4"), range_m=range_m, pose_time_s=np.zeros(1), pose_enu_from_head=level_pose(),
            pose_position_enu_m=np.array([[0.0, along_m, -5.0]]), **applied(gain_spreading_db=30.0, gain_absorption_dbpm=0.1))
        if bottom_track:
            yield "fish/bottom_track", ensonify.BottomTrack(
                stamp_ns=stamp_ns, ping=ping, valid=True, travel_time_s=2 * height_m / SOUND_SPEED_MPS, altitude_m=height_m,
                sound_speed_mps=SOUND_SPEED_MPS, beam_travel_time_s=np.full(2, 2 * height_m / SOUND_SPEED_MPS, "f4"))


def forward_looking(targets=((-0.4, 18.0), (0.3, 31.0)), beams=512, samples=1200, range_m=45.0, height_m=4.0, seed=1):
    """One ping over a level seabed with a pier and with targets at (azimuth in rad, slant range in m)."""
    random = np.random.default_rng(seed)
    azimuth = np.radians(np.linspace(-65, 65, beams))
    slant_m = (np.arange(samples) + 1) * range_m / samples
    loss = 10 ** ((205.0 - 30 * np.log10(slant_m) - 2 * 0.25 * slant_m - 35.0) / 10)
    seabed = np.where(slant_m > height_m, 10**-2.7 * (height_m / slant_m) ** 2 * np.minimum(1, (slant_m - height_m) / 6), 0.0)
    power = np.tile(seabed * loss, (beams, 1))
    x, y = np.outer(np.sin(azimuth), slant_m), np.outer(np.cos(azimuth), slant_m)
    wall = (np.abs(y - 0.35 * x - 34) < 0.25) & (x > -20) & (x < 2)
    power[wall] *= 80
    for at_rad, at_m in targets:
        near = (azimuth[:, None] - at_rad) ** 2 / 0.012**2 + (slant_m - at_m) ** 2 / 0.25**2
        shadow = (np.abs(azimuth[:, None] - at_rad) < 0.015) & (slant_m > at_m + 0.3) & (slant_m < 1.2 * at_m)
        power = np.where(shadow, 0.0, power) + 300 * (seabed * loss)[np.searchsorted(slant_m, at_m)] * np.exp(-near)
    yield "eye/ping", ensonify.Ping(
        stamp_ns=2_500_000_000, ping=25, sample_period_s=2 * range_m / SOUND_SPEED_MPS / samples,
        first_sample_s=2 * slant_m[0] / SOUND_SPEED_MPS, beam_angle_rad=azimuth.astype("f4"), range_m=range_m,
        amplitude_upa=speckled(power + SILENCE_UPA**2, random),
        **applied(frequency_hz=750e3, pulse_length_s=4e-5, source_level_db=205.0, gain_spreading_db=30.0, gain_absorption_dbpm=0.25))


def scanning(pings=400, step_deg=0.9, target=(math.radians(179.1), 7.0), samples=400, range_m=10.0, first_deg=-180.0):
    """A turn of a scanning head in silence but for one sample in the direction nearest to `target`: (angle in rad, slant range in m)."""
    for ping in range(pings):
        angle = np.radians((first_deg + ping * step_deg + 180) % 360 - 180)
        amplitude = np.full((1, samples), SILENCE_UPA, "f4")
        if abs(math.remainder(angle - target[0], 2 * math.pi)) < np.radians(step_deg) / 2:
            amplitude[0, int(round(target[1] / range_m * samples))] = 1e4
        yield "turner/ping", ensonify.Ping(
            stamp_ns=ping * 10**7, ping=ping, kind="scanning", sample_period_s=2 * range_m / SOUND_SPEED_MPS / samples,
            beam_angle_rad=np.array([angle], "f4"), amplitude_upa=amplitude, range_m=range_m, pose_time_s=np.zeros(1),
            pose_enu_from_head=level_pose(), pose_position_enu_m=np.array([[0.0, 0.01 * ping, -5.0]]), **applied(frequency_hz=750e3))


def soundings(mu_db=-25.0, pings=100, beams=256, depth_m=20.0, absorption_dbpm=0.07, roll_rad=0.0, seed=1, **changed):
    """Soundings of a 1 by 1 degree head over Lambert's level seabed, their levels from the footprint's area, with Gaussian spread
    of 1 dB."""
    random = np.random.default_rng(seed)
    angle = np.radians(np.linspace(-65, 65, beams))
    vertical = angle - roll_rad
    slant_m = depth_m / np.cos(vertical)
    width = 1.1288 * np.radians(1.0)
    area_m2 = slant_m**2 * width**2 / (np.cos(angle) * np.cos(vertical))
    strength = mu_db + 20 * np.log10(np.cos(vertical))
    level = 220 - 40 * np.log10(slant_m) - 2 * absorption_dbpm * slant_m + strength + 10 * np.log10(area_m2)
    settings = applied(source_level_db=220.0, frequency_hz=300e3, gain_absorption_dbpm=absorption_dbpm,
                       transmit_beamwidth_rad=np.radians(1.0), receive_beamwidth_rad=np.radians(1.0)) | changed
    for ping in range(pings):
        place = np.stack([depth_m * np.tan(vertical), np.full(beams, 0.2 * ping), np.full(beams, -depth_m)], axis=1)
        yield "bow/soundings", ensonify.Soundings(
            stamp_ns=ping * 10**8, ping=ping, beam_angle_rad=angle.astype("f4"), valid=np.ones(beams, "u1"),
            travel_time_s=(2 * slant_m / SOUND_SPEED_MPS).astype("f4"), position_enu_m=place,
            backscatter_db=(level + random.standard_normal(beams)).astype("f4"), quality_db=np.full(beams, 20, "f4"),
            pose_time_s=np.zeros(1), pose_enu_from_head=level_pose(roll_rad), pose_position_enu_m=np.array([[0.0, 0.2 * ping, 0.0]]),
            **settings)


def multibeam(points=((0.0, 10.0),), ping=0, beams=128, samples=600, range_m=30.0, roll_rad=None):
    """One ping in silence but for single samples at (head-frame angle in rad, slant range in m)."""
    angle = np.radians(np.linspace(-64, 63, beams))
    step_m = range_m / samples
    amplitude = np.full((beams, samples), SILENCE_UPA, "f4")
    for at_rad, at_m in points:
        amplitude[np.argmin(np.abs(angle - at_rad)), int(round(at_m / step_m))] = 1e4
    reported = {} if roll_rad is None else {"pose_time_s": np.zeros(1), "pose_enu_from_head": level_pose(roll_rad),
                                        "pose_position_enu_m": np.array([[0.0, 0.2 * ping, 0.0]])}
    return "bow/ping", ensonify.Ping(stamp_ns=ping * 10**8, ping=ping, sample_period_s=2 * step_m / SOUND_SPEED_MPS,
                                     beam_angle_rad=angle.astype("f4"), amplitude_upa=amplitude, range_m=range_m, **reported, **applied())
