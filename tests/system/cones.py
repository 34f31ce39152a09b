"""A sounding from what a sonar measures: where the transmitter's cone, the receiver's and the way of the sound agree."""
import math

import numpy as np


def ned_from_body(roll_deg, pitch_deg, heading_deg):
    (cr, sr), (cp, sp), (ch, sh) = ((math.cos(a), math.sin(a)) for a in np.radians([roll_deg, pitch_deg, heading_deg]))
    return np.array([[ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr],
                     [sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr], [-sp, cp * sr, cp * cr]])


def sounding(transmit, receive, along, across, tilt_deg, starboard_deg, way_m):
    """North, east, down. Of `along`, the transmitter's axis, and `across`, the receiver's to starboard, unit vectors at their
    times; of the angles from the planes across them; of the way out and back, which is straight. By Newton's steps."""
    wanted = np.array([math.sin(math.radians(tilt_deg)), math.sin(math.radians(starboard_deg)), way_m])
    there = transmit + 0.5 * way_m * (np.array([0, 0, 1.0]) + across * wanted[1])
    for _ in range(20):
        out, back = there - transmit, there - receive
        out_m, back_m = np.linalg.norm(out), np.linalg.norm(back)
        u, v = out / out_m, back / back_m
        error = np.array([along @ u, across @ v, out_m + back_m]) - wanted
        slope = np.array([(along - (along @ u) * u) / out_m, (across - (across @ v) * v) / back_m, u + v])
        there = there - np.linalg.solve(slope, error)
    return there
