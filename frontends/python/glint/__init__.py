# SPDX-License-Identifier: Apache-2.0
"""Glint: finds and follows targets that are too dim for any single frame.

    import glint

    with glint.Engine("mm-phd", seed=1) as engine:
        for time, frame in camera:          # uint8, uint16 or float32, (height, width)
            engine.push(frame, time)
            while (result := engine.poll()) is not None:
                print(result.frame, result.tracks["x"], result.tracks["y"])
    for result in engine:                   # the last frames
        print(result.frame, result.tracks["x"], result.tracks["y"])

Positions are in pixels; (0, 0) is the centre of the top-left pixel, x to the right, y down.
Tracks are structured arrays of the type `TRACK`; what is not known is NaN.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _glint
from ._glint import TRACK, TRUTH, CheckpointError, ConfigError, Result

__all__ = [
    "TRACK",
    "TRUTH",
    "CheckpointError",
    "ConfigError",
    "Engine",
    "Result",
    "Simulation",
    "Status",
    "default_config",
    "evaluate",
    "experiment",
    "experiments",
    "scenes",
    "simulate",
    "track",
    "trackers",
    "tracks_dict",
]
__version__: str = _glint.version

Config = Union[str, Mapping[str, Any]]


class Status(enum.IntEnum):
    """What the field `status` of a track holds."""

    TENTATIVE = 0
    CONFIRMED = 1
    HALTED = 2


def _flat(settings: Mapping[str, Any], path: str = "") -> list[tuple[str, Any]]:
    """Settings of nested sections by full key; NumPy's scalars as Python's."""
    values: list[tuple[str, Any]] = []
    for name, value in settings.items():
        if isinstance(value, Mapping):
            values += _flat(value, f"{path}{name}.")
            continue
        value = value.item() if isinstance(value, np.generic) else value
        if not isinstance(value, (bool, int, float, str)):
            raise ConfigError(
                f"{path}{name} must be a single value (bool, int, float or str), "
                f"got {type(value).__name__}"
            )
        values.append((path + name, value))
    return values


def _names(trackers: Union[None, str, Iterable[str]]) -> Optional[str]:
    return trackers if trackers is None or isinstance(trackers, str) else " ".join(trackers)


class Engine(_glint.Engine):
    """Trackers that are fed frame by frame.

    `tracker` is a name, several names separated by spaces, or a list of them; `trackers()` lists
    those there are. None stands for the one that `config` names, or else mm-phd.
    `profile` ("P" or "L") and `config` (TOML text as `default_config()` gives it, or a dict of its
    sections) set what differs from the defaults, and so do keywords, which go before both:
    `seed=2`, `frames={"polarity": "dark"}`, `birth_particles=8000`.
    `queue` frames may wait; when it is full, push() waits (`when_full="wait"`), or the frame that
    has waited longest is dropped ("drop_oldest"). For a stream without an end set `keep`: it bounds
    what is held for reported() and revised().

    Frames are tracked on the engine's own threads, and every call lets other Python threads run.
    What is tracked is a function of the frames, their times and the settings alone. References to
    frames whose pixels were read are dropped in the next call.

    Leaving a `with` block calls finish(). Iterating gives the results of all frames that were
    pushed by then, waited for: after finish() it ends with the last frame's.

    Raises ConfigError (a ValueError), with the nearest known name, for settings that are unknown or
    have no effect.
    """

    def __init__(
        self,
        tracker: Union[None, str, Iterable[str]] = None,
        profile: Optional[str] = None,
        config: Optional[Config] = None,
        queue: int = 8,
        when_full: str = "wait",
        **settings: Any,
    ) -> None:
        text = config if isinstance(config, str) else ""
        values = _flat(config) if isinstance(config, Mapping) else []
        if config is not None and not isinstance(config, (str, Mapping)):
            raise TypeError(f"config must be TOML text or a dict, got {type(config).__name__}")
        super().__init__(
            profile, text, values, _names(tracker), _flat(settings), queue, when_full
        )

    def __enter__(self) -> Engine:
        return self

    def __exit__(self, kind: Any, error: Any, traceback: Any) -> None:
        if kind is None:
            self.finish()

    def __iter__(self) -> Iterator[Result]:
        while (result := self._next()) is not None:
            yield result


def track(
    frames: Iterable[npt.NDArray[Any]],
    /,
    times: Optional[Iterable[float]] = None,
    tracker: Union[None, str, Iterable[str]] = None,
    *,
    revised: bool = False,
    **settings: Any,
) -> npt.NDArray[np.void]:
    """Tracks of a whole sequence, by tracker, frame and track_id.

    `frames` are arrays as `Engine.push()` takes them: a stack (frames, height, width), a list or a
    generator. `times` [s] are as many; without them frames are 1 s apart. `revised` gives tracks
    with all later corrections instead of what was reported at the time. `settings` are those of
    `Engine`. Raises as that does, and ValueError if there are more or fewer times than frames.
    """
    engine = Engine(tracker, **settings)
    frames = iter(frames)
    if times is None:
        for time, frame in enumerate(frames):
            engine.push(frame, time)
            engine.poll()
    else:
        for frame, time in zip(frames, times, strict=True):
            engine.push(frame, time)
            engine.poll()
    engine.finish()
    return engine.revised() if revised else engine.reported()


def tracks_dict(tracks: npt.NDArray[np.void]) -> dict[str, npt.NDArray[Any]]:
    """The columns of a structured array of tracks by name, as `pandas.DataFrame` takes them.

    `status` is in words: "tentative", "confirmed", "halted".
    """
    columns = {name: np.ascontiguousarray(tracks[name]) for name in tracks.dtype.names}
    if "status" in columns:
        words = np.array([status.name.lower() for status in Status])
        columns["status"] = words[columns["status"]]
    return columns


class Simulation(NamedTuple):
    """A simulated sequence."""

    frames: npt.NDArray[np.float32]  #: (frames, height, width)
    times: npt.NDArray[np.float64]  #: [s]
    truth: npt.NDArray[np.void]  #: structured array of the type TRUTH


def simulate(scene: str, seed: int = 1, **settings: Any) -> Simulation:
    """Frames and truth of a built-in scene; `scenes()` lists those there are.

    `settings` are the scene's own: `simulate("ir-clip", snr=6)`. The same frames as
    `glint simulate SCENE --seed N`. Raises ConfigError.
    """
    return Simulation(*_glint.simulate(scene, seed, _flat(settings)))


def _rows(table: Any, rows: np.dtype[np.void]) -> npt.NDArray[np.void]:
    """A structured array of the type `rows`, from one, a dict of columns or a DataFrame."""
    dtype = getattr(table, "dtype", None)
    names = dtype.names if isinstance(dtype, np.dtype) and dtype.names else list(table)
    needed = ["frame", "track_id", "x", "y"]
    missing = [name for name in needed if name not in names]
    if missing:
        raise ValueError(f"a table needs the columns {', '.join(needed)}; missing: {missing}")
    array = np.zeros(len(table["frame"]), rows)
    for name in rows.names or ():
        if rows[name].kind == "f":
            array[name] = np.nan
        if name in names:
            column = np.asarray(table[name])
            if name == "status" and column.dtype.kind in "UO":
                column = [Status[str(word).upper()] for word in column]
            array[name] = column
        elif name == "status":
            array[name] = Status.CONFIRMED
    return array


def evaluate(
    tracks: Any,
    truth: Any,
    cutoff: float = 5,
    order: float = 2,
    include_tentative: bool = False,
    frames: Optional[int] = None,
) -> dict[str, Any]:
    """Scores of tracks against the truth, under the names of `glint evaluate --json`.

    Both are structured arrays, dicts of columns or DataFrames with frame, track_id, x and y [px];
    tracks without `status` count as confirmed. `cutoff` [px] and `order` are those of OSPA and
    GOSPA. Scored are frames 0 to `frames` - 1, by default up to the last in either table; delays
    are in frames; None stands for what is undefined. `position_nees` and `state_nees` say how true
    the covariances of position and of position and velocity are (a mean of 2 and of 4 if they are
    right), `brier` how true `existence` is. Columns that a table lacks are not known. Raises
    ValueError.
    """
    rows = _rows(tracks, TRACK)
    if len(np.unique(rows["tracker"])) > 1:
        raise ValueError(
            "tracks of several trackers cannot be scored as one: "
            "choose one, tracks[tracks['tracker'] == 0]"
        )
    return _glint.evaluate(rows, _rows(truth, TRUTH), cutoff, order, include_tentative, frames)


def experiment(name: str, runs: int = 0, seed: int = 1, threads: int = 0) -> dict[str, Any]:
    """A paper's experiment by Monte Carlo, as `glint experiment NAME --json` gives it.

    `experiments()` lists those there are; the ones on recorded data are in the command alone.
    `runs` = 0 is the experiment's own number, `threads` = 0 all of the machine's; the result does
    not depend on them. Each row holds `name`, `metric`, `ours`, `spread`, the `paper`'s figure, the
    `band` (low, high) and whether ours is `inside`; `curves` are values over frames. Raises
    ConfigError.
    """
    return _glint.experiment(name, runs, seed, threads)


def trackers() -> dict[str, str]:
    """Name and summary of every tracker."""
    return _glint.trackers()


def scenes() -> dict[str, str]:
    """Name and summary of every built-in scene."""
    return _glint.scenes()


def experiments() -> dict[str, str]:
    """Name and summary of every experiment that needs no recorded data."""
    return _glint.experiments()


def default_config(tracker: Union[None, str, Iterable[str]] = None) -> str:
    """Settings with meaning, unit, range and default as TOML, fit for `Engine(config=...)`.

    Those that a run with `tracker` reads, or all of them.
    """
    return _glint.default_config(_names(tracker))
