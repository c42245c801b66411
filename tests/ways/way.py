# SPDX-License-Identifier: Apache-2.0
"""way.py FRAMES HEIGHT WIDTH CONFIG TRACKER: 16-bit grey frames in, rows of tracks on standard output."""

import sys

import numpy as np

import glint

path, height, width, config, tracker = sys.argv[1:]
frames = np.fromfile(path, np.uint16).reshape(-1, int(height), int(width))
with open(config, encoding="utf-8") as text:
    engine = glint.Engine(tracker, config=text.read())
for time, frame in enumerate(frames):
    engine.push(frame, time)
engine.finish()
for result in iter(engine.poll, None):
    sys.stdout.buffer.write(result.tracks.tobytes())
