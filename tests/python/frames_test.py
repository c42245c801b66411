# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from clip import HEIGHT, WIDTH, clip, picture

import glint


def tracks(frames):
    return glint.track(frames, tracker="smc-phd").tobytes()


@pytest.fixture(scope="module")
def expected():
    return tracks(clip())


def wide(frame):
    """The frame as a window of a larger one: rows with gaps."""
    larger = np.zeros((HEIGHT + 4, WIDTH + 7), frame.dtype)
    larger[2:-2, 3:-4] = frame
    return larger[2:-2, 3:-4]


def flipped(frame):
    """Rows that run backwards in memory."""
    return np.ascontiguousarray(frame[::-1])[::-1]


def every_second_row(frame):
    larger = np.zeros((2 * HEIGHT, WIDTH), frame.dtype)
    larger[::2] = frame
    return larger[::2]


def misaligned(frame):
    """Rows that begin between two pixels."""
    row = 2 * WIDTH + 3
    memory = np.zeros(1 + HEIGHT * row, np.uint8)
    shifted = np.ndarray((HEIGHT, WIDTH), np.uint16, memory, 1, (row, 2))
    shifted[:] = frame
    return shifted


@pytest.mark.parametrize("laid_out", [wide, flipped, every_second_row, misaligned])
def test_rows_may_lie_any_distance_apart(laid_out, expected):
    assert tracks(laid_out(frame) for frame in clip()) == expected


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
def test_pixels_of_other_types_mean_the_same(dtype):
    def run(frames):
        return glint.track(frames, tracker="smc-phd", sigma_floor=1).tobytes()

    assert max(frame.max() for frame in clip()) < 256
    assert run(frame.astype(dtype) for frame in clip()) == run(clip())


def test_colour_is_blue_green_red():
    shares = np.array([0.114, 0.587, 0.2989])
    for channel, share in enumerate(shares):
        colour, grey = [], []
        for frame in clip():
            colour.append(np.zeros((HEIGHT, WIDTH, 3), np.float32))
            colour[-1][..., channel] = frame
            grey.append((share * frame).astype(np.float32))
        found, expected = (glint.track(c, tracker="smc-phd", sigma_floor=1) for c in (colour, grey))
        assert len(found) > 5
        assert np.array_equal(found["frame"], expected["frame"])
        assert np.allclose(found["x"], expected["x"], atol=0.05)
        with_alpha = [np.dstack([c, np.full((HEIGHT, WIDTH), 7, np.float32)]) for c in colour]
        assert tracks(with_alpha) == tracks(colour)


@pytest.mark.parametrize(
    ("frame", "error", "remedy"),
    [
        ([[1, 2], [3, 4]], TypeError, "numpy.asarray"),
        (np.zeros((4, 4)), TypeError, r"frame.astype\(numpy.float32\)"),
        (np.zeros((4, 4), np.int32), TypeError, r"frame.astype\(numpy.float32\)"),
        (np.zeros((4, 4), bool), TypeError, r"frame.astype\(numpy.float32\)"),
        (np.zeros((4, 4), ">u2"), TypeError, r"frame.astype\(numpy.uint16\)"),
        (np.zeros(4, np.uint8), ValueError, r"\(height, width\)"),
        (np.zeros((3, 4, 5), np.uint8), ValueError, "one by one"),
        (np.zeros((4, 4, 2), np.uint8), ValueError, "for BGR"),
        (np.zeros((0, 4), np.uint8), ValueError, "at least one pixel"),
        (np.broadcast_to(np.uint8(0), (1, 70000)), ValueError, "crop"),
        (np.zeros((4, 6), np.uint16).T, ValueError, "numpy.ascontiguousarray"),
        (np.zeros((4, 6), np.uint16)[:, ::2], ValueError, "numpy.ascontiguousarray"),
        (np.zeros((4, 6), np.uint16)[:, ::-1], ValueError, "numpy.ascontiguousarray"),
        (np.zeros((4, 6, 3), np.uint8)[..., ::-1], ValueError, "numpy.ascontiguousarray"),
    ],
)
def test_what_cannot_be_taken_is_refused_with_the_remedy(frame, error, remedy):
    engine = glint.Engine()
    with pytest.raises(error, match=remedy):
        engine.push(frame, 0)
    assert engine.pushed == 0


def test_a_frame_of_another_size_is_refused():
    engine = glint.Engine()
    engine.push(picture(0), 0)
    with pytest.raises(ValueError, match=r"\(32, 48\), this one has \(48, 32\)"):
        engine.push(np.ascontiguousarray(picture(1).T), 1)
    engine.push(picture(1), 1)
    engine.drain()


def test_as_many_times_as_frames():
    with pytest.raises(ValueError, match="shorter"):
        glint.track(clip(), [0, 1, 2])
