"""Where the soundings of a record truly are: where the beam's axis, from where the head truly was, hits the true seabed.

For a multibeam of one transmit sector that states it (`sectors: [{ share: 1 }]`), in water of one sound speed. What a record does not
hold, the true mounting and the water's speed, is given.
"""
from dataclasses import dataclass

import numpy as np

import ensonify
from ensonify_plot.truth import Seabed

ROUNDS = 12  # of the search along the ray; slopes as steep as the ray do not settle
SETTLED_M = 1e-3


@dataclass
class Mounting:
    """Of a head on its body, FRD."""

    position_m: np.ndarray
    roll_deg: float = 0.0
    pitch_deg: float = 0.0
    heading_deg: float = 0.0

    def body_from_head(self) -> np.ndarray:
        """Turned by the heading about down, by the pitch about starboard, by the roll about forward."""
        (sr, sp, sh), (cr, cp, ch) = (f(np.radians([self.roll_deg, self.pitch_deg, self.heading_deg])) for f in (np.sin, np.cos))
        return (np.array([[ch, -sh, 0], [sh, ch, 0], [0, 0, 1]]) @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
                @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]]))


@dataclass
class Head:
    """Where a head was at n times, and its axes: the columns of enu_from_head are forward, starboard, down."""

    position_enu_m: np.ndarray  # n x 3
    enu_from_head: np.ndarray  # n x 3 x 3


@dataclass
class Judged:
    """The valid soundings of a record and how wrong they are."""

    t_s: np.ndarray  # of transmission
    angle_rad: np.ndarray  # of the beam in the head's frame
    range_sd_m: np.ndarray  # predicted by the detector
    tvu_m: np.ndarray
    thu_m: np.ndarray
    up_error_m: np.ndarray  # less the seabed below the place that the sounding claims
    level_error_m: np.ndarray  # n x 2, east and north: less where the beam's axis hit the seabed; NaN where that was not found


class Poses:
    """A body's true poses; straight lines between those of the record."""

    def __init__(self, poses: list):
        self.t_s = np.array([pose.stamp_ns for pose in poses]) * 1e-9
        self._position_m = np.array([pose.position_enu_m for pose in poses])
        q = np.array([pose.enu_from_body for pose in poses])
        turns_over = np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1.0, 1.0)  # q and -q are one attitude
        self._enu_from_body = q * np.concatenate([[1.0], np.cumprod(turns_over)])[:, None]

    def head_at(self, t_s: np.ndarray, mounting: Mounting) -> Head:
        position_m, q = (np.stack([np.interp(t_s, self.t_s, column) for column in columns.T], axis=1)
                         for columns in (self._position_m, self._enu_from_body))
        enu_from_body = matrices(q / np.linalg.norm(q, axis=1, keepdims=True))
        return Head(position_m + enu_from_body @ mounting.position_m, enu_from_body @ mounting.body_from_head())


def matrices(q: np.ndarray) -> np.ndarray:
    """n x 3 x 3 of n quaternions w, x, y, z."""
    w, x, y, z = q.T
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def dot(a, b):
    return (a * b).sum(axis=-1)


def on_both_cones(transmit_axis, sin_transmit, receive_axis, sin_receive, down):
    """The unit vectors with these sines from the planes across two axes, on the side of `down`, as kernels/survey/georeference has them."""
    cosine = dot(transmit_axis, receive_axis)
    in_plane = ((sin_transmit - cosine * sin_receive)[:, None] * transmit_axis +
                (sin_receive - cosine * sin_transmit)[:, None] * receive_axis) / (1 - cosine**2)[:, None]
    normal = np.cross(transmit_axis, receive_axis) / np.sqrt(1 - cosine**2)[:, None]
    normal *= np.sign(dot(normal, down))[:, None]
    return in_plane + np.sqrt(1 - dot(in_plane, in_plane))[:, None] * normal


def axis_on_seabed(seabed: Seabed, transmit: Head, receive: Head, sin_transmit, sin_receive, about_m) -> np.ndarray:
    """Where beams' axes hit the seabed, n x 3; NaN where the search, from `about_m` along the ray, does not settle. Each array's cone
    starts where the head was when it worked."""
    transmit_axis, down = transmit.enu_from_head[:, :, 0], transmit.enu_from_head[:, :, 2]
    receive_axis = receive.enu_from_head[:, :, 1]
    middle = (transmit.position_enu_m + receive.position_enu_m) / 2
    half_way = (receive.position_enu_m - transmit.position_enu_m) / 2
    range_m = about_m
    for _ in range(ROUNDS):
        # As seen from the middle, an array's sine differs by half the way over the range.
        shift = half_way / range_m[:, None]
        direction = on_both_cones(transmit_axis, sin_transmit - dot(transmit_axis, shift), receive_axis,
                                  sin_receive + dot(receive_axis, shift), down)
        place = middle + range_m[:, None] * direction
        beyond_m = (place[:, 2] - seabed.height_m(place[:, 0], place[:, 1])) / direction[:, 2]
        range_m = np.where(np.isfinite(beyond_m), range_m - beyond_m, range_m)
    return np.where((np.abs(beyond_m) < SETTLED_M)[:, None], place, np.nan)


def judge(record: ensonify.Record, head: str, body: str, actual: Mounting, sound_speed_mps: float) -> Judged:
    """The soundings of topic `head`/soundings against the poses `body`/pose and the tiles. A head that takes the sound speed at its face
    for another steers beams elsewhere: their sines are as much too small as its speed is."""
    seabed = Seabed([message for _, _, message in record.messages(*record.topics_of(ensonify.Tile))])
    poses = Poses([message for _, _, message in record.messages(f"{body}/pose")])
    parts = []
    for _, _, ping in record.messages(f"{head}/soundings"):
        valid = np.asarray(ping.valid, bool)
        faster = sound_speed_mps / ping.sound_speed_mps
        each = (ping.beam_angle_rad, ping.travel_time_s, faster * np.sin(np.asarray(ping.beam_angle_rad, float)), ping.range_sd_m,
                ping.tvu_m, ping.thu_m, *np.asarray(ping.position_enu_m).T)
        whole = (ping.stamp_ns * 1e-9, faster * np.sin(ping.sectors[0].tilt_rad))
        parts.append(np.column_stack([np.asarray(values, float)[valid] for values in each] +
                                     [np.full(np.count_nonzero(valid), value) for value in whole]))
    rows = np.concatenate(parts)
    rows = rows[rows[:, -2] + rows[:, 1] <= poses.t_s[-1]]
    angle_rad, two_way_s, sin_receive, range_sd_m, tvu_m, thu_m, east_m, north_m, up_m, t_s, sin_transmit = rows.T
    truth = axis_on_seabed(seabed, poses.head_at(t_s, actual), poses.head_at(t_s + two_way_s, actual), sin_transmit, sin_receive,
                           0.5 * two_way_s * sound_speed_mps)
    return Judged(t_s, angle_rad, range_sd_m, tvu_m, thu_m, up_m - seabed.height_m(east_m, north_m),
                  np.column_stack([east_m, north_m]) - truth[:, :2])
