"""Message types, generated from messages/*.h by generate_messages.py: edit those, not this.

Arrays are numpy arrays; received ones are read-only views. docs/messages.md is the reference.
"""
from dataclasses import dataclass

import numpy as np

from ensonify.typed import Message, Struct, array, fixed, list_of

__all__ = [
    "Counter",
    "Health",
    "Pose",
    "Guidance",
    "MissionState",
    "Attitude",
    "Position",
    "Estimate",
    "Ping",
    "Soundings",
    "Transmit",
    "Tile",
    "TileRelease",
    "Chart",
]


@dataclass(eq=False)
class Counter(Struct):
    """Part of a message: Counter.

    name: what is counted
    count [1]: how often since the start
    """

    name: str = ""
    count: int = 0


@dataclass(eq=False)
class Health(Message):
    """How a process is doing, in sim time: published when it changes. Wall-clock facts are the clock's.

    stamp_ns [ns]: time of the report, sim time
    state: ok, degraded or failed
    message: why, in one line
    counters: what happened how often
    """

    TYPE = "health/1"
    stamp_ns: int = 0
    state: str = "ok"
    message: str = ""
    counters: list = list_of(Counter)


@dataclass(eq=False)
class Pose(Message):
    """Where a vehicle truly is. Truth: acoustics uses it, instruments and records of instruments never do.

    stamp_ns [ns]: time of validity, sim time
    position_enu_m [m]: body origin in the world frame: east, north, up from chart datum
    enu_from_body [1]: attitude quaternion w, x, y, z (w >= 0) from body FRD to world ENU
    velocity_enu_mps [m/s]: velocity of the body origin in the world frame
    rate_body_radps [rad/s]: angular rate in the body frame, FRD
    """

    TYPE = "pose/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_body: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    velocity_enu_mps: tuple = fixed(0.0, 0.0, 0.0)
    rate_body_radps: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class Guidance(Message):
    """What a pilot (autopilot or agent) asks of a vehicle.

    stamp_ns [ns]: time of the command, sim time
    heading_grid_rad [rad]: heading to steer, clockwise from grid north
    speed_mps [m/s]: speed through the water to reach, forward
    """

    TYPE = "guidance/1"
    stamp_ns: int = 0
    heading_grid_rad: float = 0.0
    speed_mps: float = 0.0


@dataclass(eq=False)
class MissionState(Message):
    """What the mission is doing.

    stamp_ns [ns]: time of the state, sim time
    state: run_in, on_line, turn or done
    line [1]: index of the runline being flown, -1 before the first
    line_count [1]: number of runlines in the mission
    cross_track_m [m]: estimated distance right of the runline, positive to starboard
    distance_to_go_m [m]: distance to the end of the runline
    """

    TYPE = "mission_state/1"
    stamp_ns: int = 0
    state: str = ""
    line: int = -1
    line_count: int = 0
    cross_track_m: float = 0.0
    distance_to_go_m: float = 0.0


@dataclass(eq=False)
class Attitude(Message):
    """What the motion sensor and gyro report.

    stamp_ns [ns]: time of measurement, sim time
    roll_rad [rad]: roll, positive starboard down
    pitch_rad [rad]: pitch, positive bow up
    heading_grid_rad [rad]: heading, clockwise from grid north
    heave_m [m]: vertical displacement from the mean level, positive up
    """

    TYPE = "attitude/1"
    stamp_ns: int = 0
    roll_rad: float = 0.0
    pitch_rad: float = 0.0
    heading_grid_rad: float = 0.0
    heave_m: float = 0.0


@dataclass(eq=False)
class Position(Message):
    """What the positioning system reports, referred to the body origin.

    stamp_ns [ns]: time of measurement, sim time
    position_enu_m [m]: measured body origin in the world frame: east, north, up
    latitude_deg [deg]: geodetic latitude of the same point, WGS 84, positive north
    longitude_deg [deg]: longitude of the same point, WGS 84, positive east
    sigma_horizontal_m [m]: stated standard deviation, each horizontal axis
    sigma_vertical_m [m]: stated standard deviation, up
    """

    TYPE = "position/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    latitude_deg: float = 0.0
    longitude_deg: float = 0.0
    sigma_horizontal_m: float = 0.0
    sigma_vertical_m: float = 0.0


@dataclass(eq=False)
class Estimate(Message):
    """The navigation estimate: what autopilot, agents and records use for where the vehicle is.

    stamp_ns [ns]: time of validity, sim time
    position_enu_m [m]: estimated body origin in the world frame: east, north, up
    enu_from_body [1]: estimated attitude quaternion w, x, y, z (w >= 0), body FRD to ENU
    velocity_enu_mps [m/s]: estimated velocity of the body origin
    """

    TYPE = "estimate/1"
    stamp_ns: int = 0
    position_enu_m: tuple = fixed(0.0, 0.0, 0.0)
    enu_from_body: tuple = fixed(1.0, 0.0, 0.0, 0.0)
    velocity_enu_mps: tuple = fixed(0.0, 0.0, 0.0)


@dataclass(eq=False)
class Ping(Message):
    """What one transmission brought back, for any head.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    sample_period_s [s]: time between samples
    first_sample_s [s]: time of the first sample after transmission
    beam_angle_rad [rad]: receive beam axes in the head frame, from its down axis, positive to starboard
    amplitude_upa [uPa]: rms pressure amplitude at the receiver (beam x sample), linear
    frequency_hz [Hz]: centre frequency in force
    pulse_length_s [s]: pulse length in force
    source_level_db [dB re 1 uPa^2 at 1 m]: source level in force, on the axis, rms
    range_m [m]: range setting in force
    sound_speed_mps [m/s]: sound speed at the face as the head knows it
    """

    TYPE = "ping/1"
    stamp_ns: int = 0
    ping: int = 0
    sample_period_s: float = 0.0
    first_sample_s: float = 0.0
    beam_angle_rad: np.ndarray = array("f4")
    amplitude_upa: np.ndarray = array("f4")
    frequency_hz: float = 0.0
    pulse_length_s: float = 0.0
    source_level_db: float = 0.0
    range_m: float = 0.0
    sound_speed_mps: float = 0.0


@dataclass(eq=False)
class Soundings(Message):
    """What the head made of a ping: one entry per beam. Positions use the estimated pose and the measured mounting.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    beam_angle_rad [rad]: receive beam axes in the head frame, positive to starboard
    travel_time_s [s]: two-way travel time of the detection
    backscatter_db [dB]: level of the detection re 1 uPa, uncorrected
    quality_db [dB]: signal to noise ratio of the detection
    valid [1]: 1 where the beam has a detection; other entries of that beam mean nothing if 0
    position_enu_m [m]: sounding (beam x 3): east, north, up from chart datum, by estimate and measured mounting
    """

    TYPE = "soundings/1"
    stamp_ns: int = 0
    ping: int = 0
    beam_angle_rad: np.ndarray = array("f4")
    travel_time_s: np.ndarray = array("f4")
    backscatter_db: np.ndarray = array("f4")
    quality_db: np.ndarray = array("f4")
    valid: np.ndarray = array("u1")
    position_enu_m: np.ndarray = array("f8")


@dataclass(eq=False)
class Transmit(Message):
    """A head transmitted: other heads may hear it.

    stamp_ns [ns]: time of transmission, sim time
    ping [1]: ping number of this head, from 0
    frequency_hz [Hz]: centre frequency
    pulse_length_s [s]: pulse length
    source_level_db [dB re 1 uPa^2 at 1 m]: source level on the axis, rms
    """

    TYPE = "transmit/1"
    stamp_ns: int = 0
    ping: int = 0
    frequency_hz: float = 0.0
    pulse_length_s: float = 0.0
    source_level_db: float = 0.0


@dataclass(eq=False)
class Tile(Message):
    """A square piece of seabed. Truth.

    col [1]: tile index, east
    row [1]: tile index, north
    origin_east_m [m]: world east of the south-west post (false origin)
    origin_north_m [m]: world north of the south-west post (false origin)
    spacing_m [m]: distance between posts, both axes
    height_m [m]: posts (north x east, south-west first), up from chart datum; NaN is a hole
    sediment [1]: sediment class of each post, as height_m
    """

    TYPE = "tile/1"
    col: int = 0
    row: int = 0
    origin_east_m: float = 0.0
    origin_north_m: float = 0.0
    spacing_m: float = 1.0
    height_m: np.ndarray = array("f4")
    sediment: np.ndarray = array("u1")


@dataclass(eq=False)
class TileRelease(Message):
    """The pager will not refer to this tile again until it sends it anew.

    col [1]: tile index, east
    row [1]: tile index, north
    """

    TYPE = "tile_release/1"
    col: int = 0
    row: int = 0


@dataclass(eq=False)
class Chart(Message):
    """What is known of the terrain as a whole, as a chart would tell: mission planning may use it.

    origin_latitude_deg [deg]: geodetic latitude of the world's origin, WGS 84 (a scenario may leave it to the raster)
    origin_longitude_deg [deg]: longitude of the world's origin, WGS 84
    west_m [m]: world east of the western edge
    south_m [m]: world north of the southern edge
    east_m [m]: world east of the eastern edge
    north_m [m]: world north of the northern edge
    shallowest_m [m]: least depth below chart datum, positive down
    deepest_m [m]: greatest depth below chart datum, positive down
    spacing_m [m]: distance between the posts of height_m
    height_m [m]: coarse heights (north x east, south-west first), up; NaN where nothing is known
    """

    TYPE = "chart/1"
    origin_latitude_deg: float = 0.0
    origin_longitude_deg: float = 0.0
    west_m: float = 0.0
    south_m: float = 0.0
    east_m: float = 0.0
    north_m: float = 0.0
    shallowest_m: float = 0.0
    deepest_m: float = 0.0
    spacing_m: float = 1.0
    height_m: np.ndarray = array("f4")


TYPES = {cls.TYPE: cls for cls in (
    Health,
    Pose,
    Guidance,
    MissionState,
    Attitude,
    Position,
    Estimate,
    Ping,
    Soundings,
    Transmit,
    Tile,
    TileRelease,
    Chart,
)}
