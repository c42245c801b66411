# SPDX-License-Identifier: Apache-2.0
import gc
import sys
import threading
import weakref

import numpy as np
import pytest
from clip import FRAMES, clip, picture

import glint


def results_of(engine):
    return list(iter(engine.poll, None))


def test_poll_gives_the_frames_in_order_with_their_tracks():
    engine = glint.Engine("smc-phd")
    for number, frame in enumerate(clip()):
        assert engine.push(frame, 0.5 * number)
    engine.drain()
    results = results_of(engine)
    assert [r.frame for r in results] == list(range(FRAMES))
    assert [r.time for r in results] == [0.5 * i for i in range(FRAMES)]
    assert all(r.latency > 0 for r in results)
    assert sum(len(r.tracks) for r in results) > 10
    assert all((r.tracks["frame"] == r.frame).all() for r in results)
    assert results[0].tracks.dtype == glint.TRACK
    assert (engine.pushed, engine.dropped) == (FRAMES, 0)


def test_start_begins_a_track_in_the_next_frame():
    engine = glint.Engine("mm-phd")
    engine.start(20, 12, sigma=1)
    engine.push(picture(0), 0)
    (track,) = engine.poll(timeout=60).tracks
    # Of the first frame's background nothing is known: the track may doubt itself.
    likely = track["existence"] >= 0.5
    assert track["status"] == (glint.Status.CONFIRMED if likely else glint.Status.TENTATIVE)
    assert abs(track["x"] - 20) < 3 and abs(track["y"] - 12) < 3
    engine.start(20, 12, vx=1, vy=-1)  # upon a track: no second
    engine.push(picture(1), 1)
    assert len(engine.poll(timeout=60).tracks) == 1
    with pytest.raises(ValueError, match="both"):
        engine.start(1, 2, vx=3)
    with pytest.raises(ValueError, match="sigma"):
        engine.start(1, 2, sigma=0)
    engine.finish()
    with pytest.raises(RuntimeError):
        engine.start(1, 2)


def test_with_and_iteration_lose_no_frame():
    seen = []
    with glint.Engine("smc-phd") as engine:
        for number, frame in enumerate(clip()):
            engine.push(frame, number)
            while (result := engine.poll()) is not None:
                seen.append(result.frame)
    seen += [result.frame for result in engine]
    assert seen == list(range(FRAMES))
    assert list(engine) == []
    with pytest.raises(RuntimeError):
        engine.push(picture(0), 0)


def test_iteration_waits_for_the_frames_pushed_so_far():
    engine = glint.Engine("smc-phd")
    for number in range(5):
        engine.push(picture(number), number)
    assert [result.frame for result in engine] == list(range(5))
    engine.push(picture(5), 5)
    assert engine.poll(timeout=60).frame == 5
    assert engine.poll(timeout=0.01) is None


def test_an_error_in_the_block_is_not_hidden():
    with pytest.raises(ZeroDivisionError), glint.Engine("smc-phd") as engine:
        engine.push(picture(0), 0)
        1 / 0


def test_rows_that_overlap_are_copied():
    flat = np.broadcast_to(picture(0)[:1], picture(0).shape)
    assert flat.strides[0] == 0
    expected = glint.track([np.ascontiguousarray(flat)] * 3, tracker="smc-phd")
    assert glint.track([flat] * 3, tracker="smc-phd").tobytes() == expected.tobytes()


def test_tracks_follow_the_target():
    tracks = glint.track(clip(), tracker="mm-phd")
    last = tracks[tracks["frame"] == FRAMES - 1]
    assert len(last) == 1
    assert last["status"] == glint.Status.CONFIRMED
    assert abs(last["x"][0] - (8 + 1.2 * (FRAMES - 1))) < 1
    assert abs(last["y"][0] - (10 + 0.5 * (FRAMES - 1))) < 1


def test_track_gives_what_the_engine_reported():
    engine = glint.Engine("smc-phd", seed=3)
    for number, frame in enumerate(clip()):
        engine.push(frame, number)
    engine.finish()
    polled = np.concatenate([r.tracks for r in results_of(engine)])
    whole = glint.track(np.stack(clip()), range(FRAMES), "smc-phd", seed=3)
    assert whole.tobytes() == polled.tobytes()
    assert engine.reported().tobytes() == polled.tobytes()


def test_several_trackers_are_told_apart():
    tracks = glint.track(clip(), tracker=["smc-phd", "viterbi"])
    for index, name in enumerate(["smc-phd", "viterbi"]):
        alone = glint.track(clip(), tracker=name)
        alone["tracker"] = index
        assert len(alone) > 5
        assert tracks[tracks["tracker"] == index].tobytes() == alone.tobytes()


def test_revised_tracks_reach_further_back():
    reported = glint.track(clip(), tracker="mm-phd")
    revised = glint.track(clip(), tracker="mm-phd", revised=True)
    assert revised["frame"].min() < reported["frame"].min()
    engine = glint.Engine()
    with pytest.raises(RuntimeError, match="call finish"):
        engine.revised()


def test_points_are_pushed_without_frames():
    engine = glint.Engine("imm-jpda")
    for number in range(20):
        assert engine.push_points([[10 + number, 20 + 0.5 * number, 8]], number)
    engine.finish()
    last = results_of(engine)[-1].tracks
    assert len(last) == 1 and abs(last["x"][0] - 29) < 0.5
    with pytest.raises(ValueError, match=r"\(n, 2\)"):
        engine.push_points(np.zeros(3), 0)
    with pytest.raises(TypeError, match="must be numbers"):
        engine.push_points("abc", 0)


def test_points_keep_their_digits():
    engine = glint.Engine("imm-jpda")
    for number in range(20):
        engine.push_points(np.array([[500000.02 + number, 5000000.01]]), 2e9 + number)
    engine.finish()
    last = results_of(engine)[-1].tracks[0]
    assert last["time"] == 2e9 + 19
    assert abs(last["x"] - 500019.02) < 1e-3 and abs(last["y"] - 5000000.01) < 1e-3


def test_a_full_queue_drops_what_has_waited_longest():
    engine = glint.Engine("mm-phd", queue=1, when_full="drop_oldest")
    rng = np.random.default_rng(1)
    frame = rng.normal(100, 5, (256, 256)).astype(np.float32)
    kept = [engine.push(frame, number) for number in range(50)]
    engine.finish()
    assert engine.dropped == kept.count(False) > 0
    assert len(results_of(engine)) == 50 - engine.dropped


def test_nothing_is_pushed_after_the_end():
    engine = glint.Engine()
    engine.finish()
    frame = picture(0)
    before = sys.getrefcount(frame)
    with pytest.raises(RuntimeError, match="after finish"):
        engine.push(frame, 0)
    assert sys.getrefcount(frame) == before


def test_frames_live_until_they_were_read_and_no_longer():
    engine = glint.Engine("smc-phd")
    frames = clip()
    alive = [weakref.ref(frame) for frame in frames]
    for number in range(FRAMES):
        engine.push(frames[number], number)
        frames[number] = None
    engine.drain()
    gc.collect()
    assert not any(frame() is not None for frame in alive)


def test_frames_that_still_wait_are_let_go_of_with_the_engine():
    engine = glint.Engine(queue=FRAMES)
    frames = clip()
    counts = [sys.getrefcount(frame) for frame in frames]
    for number, frame in enumerate(frames):
        engine.push(frame, number)
    del engine, frame
    assert [sys.getrefcount(frame) for frame in frames] == counts


def test_frames_are_the_same_through_a_copy_that_is_overwritten():
    engine = glint.Engine("smc-phd")
    buffer = np.empty_like(picture(0))
    for number, frame in enumerate(clip()):
        buffer[:] = frame
        engine.push(buffer, number, copy=True)
        buffer[:] = 0
    engine.finish()
    assert engine.reported().tobytes() == glint.track(clip(), tracker="smc-phd").tobytes()


def test_other_threads_run_while_a_call_waits():
    engine = glint.Engine("mm-phd", queue=1)
    frame = np.random.default_rng(1).normal(100, 5, (512, 512)).astype(np.float32)
    done = threading.Event()
    turns = 0

    def push():
        for number in range(10):
            engine.push(frame, number)
        engine.drain()
        done.set()

    thread = threading.Thread(target=push)
    thread.start()
    while not done.wait(0.001):
        turns += 1
    thread.join()
    assert turns > 5


def test_threads_may_push_into_one_engine():
    engine = glint.Engine("smc-phd", queue=2)
    frame = picture(0)
    lock = threading.Lock()
    times = iter(range(1000))

    def push():
        for _ in range(20):
            with lock:
                engine.push(frame, next(times))
            engine.poll()

    threads = [threading.Thread(target=push) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    engine.drain()
    assert engine.pushed == 80


def test_a_restored_engine_goes_on_with_the_same_tracks():
    whole, first, second = (glint.Engine("smc-phd", seed=3) for _ in range(3))
    for number, frame in enumerate(clip()):
        whole.push(frame, number)
        if number == 12:
            second.restore(first.checkpoint())
        (first if number < 12 else second).push(frame, number)
    whole.finish()
    second.finish()
    assert second.revised().tobytes() == whole.revised().tobytes()
    assert [r.frame for r in results_of(second)] == list(range(FRAMES))
    with pytest.raises(RuntimeError):
        second.checkpoint()


def test_a_checkpoint_of_other_settings_is_refused():
    made = glint.Engine("smc-phd", seed=3).checkpoint()
    with pytest.raises(glint.CheckpointError, match="seed = 3.*seed = 4"):
        glint.Engine("smc-phd", seed=4).restore(made)
    with pytest.raises(ValueError, match="checksum"):
        glint.Engine("smc-phd", seed=3).restore(made[:-1])
