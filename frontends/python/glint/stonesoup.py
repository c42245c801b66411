# SPDX-License-Identifier: Apache-2.0
"""Tracks and truth as Stone Soup's classes, and back. Needs the package `stonesoup` (PyPI).

    tracks = glint.stonesoup.to_tracks(glint.track(frames), start=datetime(2024, 5, 1))

Stone Soup's time stamps are dates: `start` is that of time 0. Its tracks have no frame numbers:
coming back, frame n is the one at start + n * period.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterable, Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import TRACK, TRUTH, Status

_EPOCH = datetime.datetime(1970, 1, 1)
_LATE = 0.25  # of a period: beyond it a time is no frame's


# The upper triangle of the covariance of (x, y, vx, vy), as TRACK names it.
_COVARIANCE = {
    ("x", "x"): "var_x",
    ("x", "y"): "cov_xy",
    ("y", "y"): "var_y",
    ("x", "vx"): "cov_x_vx",
    ("x", "vy"): "cov_x_vy",
    ("y", "vx"): "cov_y_vx",
    ("y", "vy"): "cov_y_vy",
    ("vx", "vx"): "var_vx",
    ("vx", "vy"): "cov_vx_vy",
    ("vy", "vy"): "var_vy",
}


def _covariance(a: str, b: str) -> str:
    return _COVARIANCE.get((a, b)) or _COVARIANCE[b, a]


def _date(start: datetime.datetime, seconds: float) -> datetime.datetime:
    return start + datetime.timedelta(seconds=float(seconds))


def _state(row: np.void, date: datetime.datetime, velocity: bool) -> Any:
    from stonesoup.types.state import GaussianState, State

    order = ("x", "vx", "y", "vy") if velocity else ("x", "y")
    vector = [[row[name]] for name in order]
    covar = np.array([[row[_covariance(a, b)] for b in order] for a in order])
    if np.isnan(covar).any():
        return State(vector, timestamp=date)
    return GaussianState(vector, covar, timestamp=date)


def _groups(rows: npt.NDArray[np.void]) -> list[tuple[int, npt.NDArray[np.void]]]:
    """Rows by track, in the order of frames."""
    ids = np.unique(rows["track_id"])
    groups = ((number, rows[rows["track_id"] == number]) for number in ids)
    return [(int(number), np.sort(group, order="frame")) for number, group in groups]


def to_tracks(
    tracks: npt.NDArray[np.void],
    start: datetime.datetime = _EPOCH,
    velocity: bool = False,
    include_tentative: bool = False,
) -> list[Any]:
    """`stonesoup.types.track.Track`, one a track of the array, its id the track's number in text.

    States are positions (x, y) [px], with `velocity` (x, vx, y, vy) [px, px/s]: GaussianState with
    their covariance where all of it is known, else State. Raises ValueError for tracks of several
    trackers.
    """
    from stonesoup.types.track import Track

    if len(np.unique(tracks["tracker"])) > 1:
        raise ValueError("choose the tracks of one tracker: tracks[tracks['tracker'] == 0]")
    rows = tracks if include_tentative else tracks[tracks["status"] != Status.TENTATIVE]
    return [
        Track([_state(row, _date(start, row["time"]), velocity) for row in group], id=str(number))
        for number, group in _groups(rows)
    ]


def to_truth(
    truth: npt.NDArray[np.void],
    times: Sequence[float],
    start: datetime.datetime = _EPOCH,
    velocity: bool = False,
) -> list[Any]:
    """`stonesoup.types.groundtruth.GroundTruthPath`, one a target; `times` [s] are the frames'."""
    from stonesoup.types.groundtruth import GroundTruthPath, GroundTruthState

    keys = ("x", "vx", "y", "vy") if velocity else ("x", "y")
    return [
        GroundTruthPath(
            [
                GroundTruthState(
                    [[row[key]] for key in keys], timestamp=_date(start, times[row["frame"]])
                )
                for row in group
            ],
            id=str(number),
        )
        for number, group in _groups(truth)
    ]


def _frame(date: datetime.datetime, start: datetime.datetime, period: float) -> int:
    frames = (date - start).total_seconds() / period
    if abs(frames - round(frames)) > _LATE:
        raise ValueError(
            f"{date} is at frame {frames:.2f}, between two: "
            "give the start and the period [s] of the frames"
        )
    return round(frames)


def _number(given: Any, position: int, taken: set[int]) -> int:
    """The id as a number if it is one that no other has, else the next free one."""
    number = int(given) if isinstance(given, str) and given.isdecimal() else position + 1
    while number in taken:
        number += 1
    taken.add(number)
    return number


def _rows_from(
    sequences: Iterable[Any],
    dtype: np.dtype[np.void],
    start: datetime.datetime,
    period: float,
    position: tuple[int, int],
    velocity: Optional[tuple[int, int]],
) -> npt.NDArray[np.void]:
    rows: list[npt.NDArray[np.void]] = []
    taken: set[int] = set()
    for place, sequence in enumerate(sequences):
        number = _number(getattr(sequence, "id", None), place, taken)
        for state in sequence:
            row = np.zeros(1, dtype)
            for name in dtype.names or ():
                if dtype[name].kind == "f":
                    row[name] = np.nan
            row["frame"] = _frame(state.timestamp, start, period)
            row["track_id"] = number
            vector = np.asarray(state.state_vector, float).ravel()
            at = dict(zip(("x", "y", "vx", "vy"), position + (velocity or ())))
            for name, i in at.items():
                row[name] = vector[i]
            if "time" in (dtype.names or ()):
                row["time"] = (state.timestamp - start).total_seconds()
                row["status"] = Status.CONFIRMED
                covar = getattr(state, "covar", None)
                if covar is not None:
                    covar = np.asarray(covar, float)
                    for (a, b), name in _COVARIANCE.items():
                        if a in at and b in at:
                            row[name] = covar[at[a], at[b]]
            rows.append(row)
    if not rows:
        return np.zeros(0, dtype)
    return np.sort(np.concatenate(rows), order=["frame", "track_id"])


def from_tracks(
    tracks: Iterable[Any],
    start: datetime.datetime = _EPOCH,
    period: float = 1.0,
    position: tuple[int, int] = (0, 1),
    velocity: Optional[tuple[int, int]] = None,
) -> npt.NDArray[np.void]:
    """An array of the type `glint.TRACK`, all confirmed, by frame and track.

    `position` and `velocity` say where x and y stand in the state vector: (0, 2) and (1, 3) for
    (x, vx, y, vy); of what is named the covariance is taken too. Ids that are numbers are kept.
    Raises ValueError for times between two frames.
    """
    return _rows_from(tracks, TRACK, start, period, position, velocity)


def from_truth(
    paths: Iterable[Any],
    start: datetime.datetime = _EPOCH,
    period: float = 1.0,
    position: tuple[int, int] = (0, 1),
    velocity: Optional[tuple[int, int]] = None,
) -> npt.NDArray[np.void]:
    """An array of the type `glint.TRUTH`; the arguments are those of `from_tracks`."""
    return _rows_from(paths, TRUTH, start, period, position, velocity)
