# SPDX-License-Identifier: Apache-2.0
import datetime

import numpy as np
import pytest
import stonesoup_standin
from clip import clip

stonesoup_standin.install()

import glint.stonesoup as soup  # noqa: E402

import glint  # noqa: E402

START = datetime.datetime(2024, 5, 1, 12)
PERIOD = 0.04
POSITION = ["frame", "time", "track_id", "x", "y", "var_x", "cov_xy", "var_y"]
VELOCITY = ["vx", "vy", "cov_x_vx", "cov_x_vy", "cov_y_vx", "cov_y_vy", "var_vx", "cov_vx_vy",
            "var_vy"]


def tracks():
    return glint.track(clip(), PERIOD * np.arange(len(clip())), "mm-phd")


def test_tracks_come_back_as_they_were():
    whole = tracks()
    there = soup.to_tracks(whole, START, include_tentative=True)
    back = soup.from_tracks(there, START, PERIOD)
    assert len(whole) > 10
    for name in POSITION:
        np.testing.assert_allclose(back[name], whole[name], rtol=0, atol=1e-6, err_msg=name)
    assert (back["x"] == whole["x"]).all() and (back["var_x"] == whole["var_x"]).all()
    assert np.isnan(back["vx"]).all() and (back["status"] == glint.Status.CONFIRMED).all()


def test_states_carry_dates_places_and_covariances():
    whole = tracks()
    (track,) = soup.to_tracks(whole, START)
    confirmed = whole[whole["status"] != glint.Status.TENTATIVE]
    assert track.id == str(confirmed["track_id"][0])
    assert len(track) == len(confirmed) < len(whole)
    state, row = track[-1], confirmed[-1]
    assert abs((state.timestamp - START).total_seconds() - row["time"]) < 1e-6
    assert np.ravel(state.state_vector).tolist() == [row["x"], row["y"]]
    assert np.asarray(state.covar)[0, 1] == row["cov_xy"]


def test_velocities_stand_beside_their_places():
    whole = tracks()
    there = soup.to_tracks(whole, START, velocity=True, include_tentative=True)
    back = soup.from_tracks(there, START, PERIOD, position=(0, 2), velocity=(1, 3))
    for name in POSITION + VELOCITY:
        np.testing.assert_allclose(back[name], whole[name], rtol=0, atol=1e-6, err_msg=name)
    assert (back["vx"] == whole["vx"]).all() and (whole["var_vx"] > 0).all()


def known():
    """One row, its covariance 1 to 10 in the order of the array's fields."""
    row = np.zeros(1, glint.TRACK)
    row["status"], row["track_id"] = glint.Status.CONFIRMED, 1
    row["x"], row["vx"], row["y"], row["vy"] = 11, 12, 13, 14
    for value, name in enumerate(POSITION[-3:] + VELOCITY[2:], 1):
        row[name] = value
    return row


def test_a_state_has_the_whole_covariance_in_its_own_order():
    (track,) = soup.to_tracks(known(), START, velocity=True)
    assert np.ravel(track[0].state_vector).tolist() == [11, 12, 13, 14]
    assert np.asarray(track[0].covar).tolist() == [
        [1, 4, 2, 5],
        [4, 8, 6, 9],
        [2, 6, 3, 7],
        [5, 9, 7, 10],
    ]
    (back,) = soup.from_tracks([track], START, PERIOD, position=(0, 2), velocity=(1, 3))
    for name in POSITION[-3:] + VELOCITY:
        assert back[name] == known()[name][0], name
    (placed,) = soup.from_tracks([track], START, PERIOD, position=(0, 2))
    assert placed["var_y"] == 3
    assert all(np.isnan(placed[name]) for name in VELOCITY)


def test_a_covariance_that_is_known_in_part_is_none():
    row = known()
    row["cov_vx_vy"] = np.nan
    assert not hasattr(soup.to_tracks(row, START, velocity=True)[0][0], "covar")
    assert hasattr(soup.to_tracks(row, START)[0][0], "covar")


def test_truth_comes_back_as_it_was():
    clip_ = glint.simulate("ir-clip", seed=3)
    paths = soup.to_truth(clip_.truth, clip_.times, START, velocity=True)
    period = clip_.times[1] - clip_.times[0]
    back = soup.from_truth(paths, START, period, position=(0, 2), velocity=(1, 3))
    truth = np.sort(clip_.truth, order=["frame", "track_id"])
    for name in ["frame", "track_id", "x", "y", "vx", "vy"]:
        assert (back[name] == truth[name]).all(), name
    assert glint.evaluate(tracks(), back)  # the type that evaluate() takes


def test_ids_that_are_no_numbers_get_some():
    (track,) = soup.to_tracks(tracks(), START)
    track.id = "a4c1-77"
    other = soup.to_tracks(tracks(), START)[0]
    other.id = "1"
    assert set(soup.from_tracks([track, other], START, PERIOD)["track_id"]) == {1, 2}


def test_mistakes_are_named():
    (track,) = soup.to_tracks(tracks(), START)
    with pytest.raises(ValueError, match="give the start and the period"):
        soup.from_tracks([track], START + datetime.timedelta(seconds=PERIOD / 2), PERIOD)
    both = glint.track(clip(), tracker=["smc-phd", "mm-phd"])
    with pytest.raises(ValueError, match="one tracker"):
        soup.to_tracks(both)
    assert len(soup.from_tracks([])) == 0
