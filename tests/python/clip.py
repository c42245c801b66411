# SPDX-License-Identifier: Apache-2.0
"""A bright target that moves to the right over ripples."""

import numpy as np

WIDTH, HEIGHT, FRAMES = 48, 32, 25


def picture(frame):
    """uint16, (HEIGHT, WIDTH) [grey levels]."""
    x, y = np.arange(WIDTH), np.arange(HEIGHT)[:, None]
    light = 90 * np.exp(-((x - 8 - 1.2 * frame) ** 2) - (y - 10 - 0.5 * frame) ** 2)
    ripple = (7 * x + 5 * y + 11 * frame + x * y) % 23
    return (100 + ripple + light).astype(np.uint16)


def clip():
    return [picture(frame) for frame in range(FRAMES)]
