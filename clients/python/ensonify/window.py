"""A window that shows pictures, by pygame."""
import os

import numpy as np

UNSEEN = ("dummy", "offscreen")  # what SDL takes where there is no display
LEAST_PIXELS = 512  # smaller pictures are magnified, by a whole number


class Window:
    """It opens with the first picture. An ImportError or a RuntimeError says at once what it lacks."""

    def __init__(self, title: str, fps: float):
        try:
            import pygame
        except ModuleNotFoundError:
            raise ImportError("render_mode='human' needs pygame: pip install 'ensonify[human]'; without it 'rgb_array' is allowed, or None") from None
        self._pygame, self._title, self._fps = pygame, title, fps
        self._surface = None
        try:
            pygame.display.init()
            seen = pygame.display.get_driver() not in UNSEEN or "SDL_VIDEODRIVER" in os.environ
        except pygame.error:
            seen = False
        if not seen:
            raise RuntimeError("render_mode='human' needs a display; without one 'rgb_array' is allowed, or None")
        self._clock = pygame.time.Clock()

    def show(self, picture: np.ndarray) -> None:
        """Rows x columns x 3 bytes, the first row at the top; waits, so that no more than fps pictures a second are shown."""
        times = -(-LEAST_PIXELS // max(picture.shape[:2]))
        large = picture.repeat(times, axis=0).repeat(times, axis=1)
        if self._surface is None or self._surface.get_size() != large.shape[1::-1]:
            self._surface = self._pygame.display.set_mode(large.shape[1::-1])
            self._pygame.display.set_caption(self._title)
        self._pygame.surfarray.blit_array(self._surface, large.swapaxes(0, 1))
        self._pygame.event.pump()
        self._pygame.display.flip()
        self._clock.tick(self._fps)

    def close(self) -> None:
        """It opens again with the next picture."""
        if self._surface is not None:
            self._surface = None
            self._pygame.display.quit()
            self._pygame.display.init()
