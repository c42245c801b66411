# SPDX-License-Identifier: Apache-2.0
"""way.py FRAMES HEIGHT WIDTH CONFIG TRACKER: 16-bit grey frames in, rows of tracks on standard output, the number of
results on standard error."""

import sys

import numpy as np

import glint

path, height, width, config, tracker = sys.argv[1:]
frames = np.fromfile(path, np.uint16).reshape(-1, int(height), int(width))
with open(config, encoding="utf-8") as file:
    text = file.read()
results = []
with glint.Engine(tracker, config=text) as engine:
    for time, frame in enumerate(frames):
        engine.push(frame, time)
        while (result := engine.poll()) is not None:
            results.append(result)
results += engine
for result in results:
    sys.stdout.buffer.write(result.tracks.tobytes())
print(len(results), file=sys.stderr)
