# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess

import numpy as np
import pytest

import glint


def glint_command(*words):
    return subprocess.run([os.environ["GLINT_BINARY"], *words], check=True, capture_output=True)


@pytest.fixture(scope="module")
def scene():
    return glint.simulate("phd-5.1", seed=3, snr=12)


def test_a_scene_is_the_commands(scene, tmp_path):
    glint_command("simulate", "phd-5.1", "--out", str(tmp_path), "--seed", "3", "--set", "snr=12",
                  "--format", "npy", "--quiet")
    written = np.load(tmp_path / "frames.npy")
    assert scene.frames.dtype == np.float32
    assert np.array_equal(scene.frames, written)
    assert len(scene.times) == len(written) and scene.times[0] == 0
    lines = (tmp_path / "truth.csv").read_text().splitlines()
    lines = [line for line in lines if not line.startswith("#")]
    truth = np.genfromtxt(lines, delimiter=",", names=True)
    for name in ["frame", "track_id", "x", "y"]:
        assert np.allclose(truth[name], scene.truth[name], rtol=1e-7)


def test_scores_are_the_commands(scene, tmp_path):
    tracks = glint.track(scene.frames, scene.times, "smc-phd", background="none")
    confirmed = tracks[tracks["status"] == glint.Status.CONFIRMED]
    assert len(confirmed) > 5
    for name, table in [("tracks", tracks), ("truth", scene.truth)]:
        columns = glint.tracks_dict(table)
        lines = [",".join(columns)]
        lines += [",".join(map(str, row)) for row in zip(*columns.values())]
        (tmp_path / f"{name}.csv").write_text("\n".join(lines) + "\n")
    printed = glint_command("evaluate", "--truth", str(tmp_path / "truth.csv"),
                            "--tracks", str(tmp_path / "tracks.csv"),
                            "--json", "--cutoff", "4", "--frames", "45").stdout
    scores = glint.evaluate(tracks, scene.truth, cutoff=4, frames=45)
    assert json.loads(json.dumps(scores)) == json.loads(printed)
    assert scores["points"]["detected"] > 0.2
    assert scores["position_nees"]["points"] > 5 and scores["state_nees"]["mean"] > 0
    assert 0 < scores["brier"] < 1


def test_columns_that_a_table_lacks_are_not_known(scene):
    tracks = glint.track(scene.frames, scene.times, "smc-phd", background="none")
    expected = glint.evaluate(tracks, scene.truth)
    earlier = {name: tracks[name] for name in glint.TRACK.names[:-7]}
    scores = glint.evaluate(earlier, scene.truth)
    assert expected["state_nees"] and scores["state_nees"] is None
    del expected["state_nees"], scores["state_nees"]
    assert scores == expected
    bare = {name: tracks[name] for name in ["frame", "track_id", "x", "y"]}
    places = {name: scene.truth[name] for name in ["frame", "track_id", "x", "y"]}
    scores = glint.evaluate(bare, places)
    assert scores["brier"] is None and scores["position_nees"] is None
    assert glint.evaluate(tracks, places)["state_nees"] is None


def test_tables_are_arrays_or_columns(scene):
    tracks = glint.track(scene.frames, scene.times, "smc-phd", background="none")
    expected = glint.evaluate(tracks, scene.truth)
    columns = glint.tracks_dict(tracks)
    assert set(columns) == set(glint.TRACK.names)
    assert set(columns["status"]) <= {"tentative", "confirmed", "halted"}
    assert all(column.flags.c_contiguous for column in columns.values())
    assert glint.evaluate(columns, scene.truth) == expected
    tentative = glint.evaluate(columns, scene.truth, include_tentative=True)
    assert (columns["status"] == "tentative").any() and tentative != expected
    with pytest.raises(ValueError, match="missing: .'track_id'"):
        glint.evaluate({"frame": [], "x": [], "y": []}, scene.truth)
    tracks["tracker"][0] = 1
    with pytest.raises(ValueError, match="choose one"):
        glint.evaluate(tracks, scene.truth)


def test_an_experiment_is_the_commands():
    result = glint.experiment("pmht-table1", runs=1, seed=2)
    command = [os.environ["GLINT_BINARY"], "experiment", "pmht-table1",
               "--runs", "1", "--seed", "2", "--json"]
    # Exit code 1 says that a band is missed, which a single run may do.
    printed = json.loads(subprocess.run(command, capture_output=True, check=False).stdout)
    del result["curves"]
    assert json.loads(json.dumps(result)) == printed
    assert len(printed["rows"]) > 1


def test_lists_and_mistakes_are_named():
    assert "mm-phd" in glint.trackers()
    assert "ir-clip" in glint.scenes()
    assert "phd-5.1" in glint.experiments()
    with pytest.raises(glint.ConfigError, match="phd-5.1"):
        glint.experiment("phd-5.9")
    with pytest.raises(glint.ConfigError, match="ir-clip"):
        glint.simulate("ir-clop")
    with pytest.raises(glint.ConfigError, match="snr"):
        glint.simulate("phd-5.1", snrr=3)
