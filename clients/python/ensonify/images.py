"""A ping as a picture."""
import numpy as np

from ensonify.messages import Ping

SHOWN_DB = 60.0  # from black to white


def picture(ping: Ping) -> np.ndarray:
    """Samples x beams x 3 bytes, the farthest sample first, port left: grey by level, the strongest white."""
    linear = ping.amplitude_upa if ping.amplitude_upa.size else ping.amplitude_count
    if not linear.size:
        return np.zeros((1, 1, 3), np.uint8)
    level_db = 20 * np.log10(np.maximum(linear.astype(np.float32), 1e-6))
    grey = np.rint(np.clip(255 * (1 + (level_db - level_db.max()) / SHOWN_DB), 0, 255)).astype(np.uint8)
    port_first = grey[np.argsort(ping.beam_angle_rad, kind="stable")] if ping.beam_angle_rad.size == len(grey) else grey
    return np.repeat(port_first.T[::-1, :, None], 3, axis=2)
