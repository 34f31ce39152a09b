"""Pictures: rows x columns x 3 bytes, the first row at the top."""
import numpy as np

from ensonify.messages import Ping

SHOWN_DB = 60.0  # from black to white


def picture(ping: Ping) -> np.ndarray:
    """Samples x beams x 3 bytes, the farthest sample first, port left: grey by level, the strongest white."""
    linear = ping.amplitude_upa if ping.amplitude_upa.size else ping.amplitude_count
    if not linear.size:
        return np.zeros((1, 1, 3), np.uint8)
    level_db = 20 * np.log10(np.maximum(linear.astype(np.float32), 1e-6))
    level = np.rint(np.clip(255 * (1 + (level_db - level_db.max()) / SHOWN_DB), 0, 255)).astype(np.uint8)
    port_first = level[np.argsort(ping.beam_angle_rad, kind="stable")] if ping.beam_angle_rad.size == len(level) else level
    return grey(port_first.T[::-1])


def grey(level: np.ndarray) -> np.ndarray:
    """A picture of bytes, 0 is black."""
    return np.repeat(level[:, :, None], 3, axis=2)
