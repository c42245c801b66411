# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from clip import clip

import glint


def tracks(*args, **settings):
    return glint.track(clip(), None, *args, **settings).tobytes()


def test_the_seed_changes_the_tracks_and_repeats_them():
    assert tracks("smc-phd", seed=2) == tracks("smc-phd", seed=2)
    assert tracks("smc-phd", seed=2) != tracks("smc-phd", seed=3)


def test_keywords_dicts_and_toml_say_the_same():
    toml = '[run]\nseed = 5\n[frames]\npolarity = "both"\n[trackers.smc-phd]\nsnr_low = 6.0\n'
    expected = tracks("smc-phd", config=toml)
    sections = {
        "run": {"seed": np.int64(5)},
        "frames": {"polarity": "both"},
        "trackers": {"smc-phd": {"snr_low": 6}},
    }
    assert tracks("smc-phd", config=sections) == expected
    assert tracks("smc-phd", seed=5, frames={"polarity": "both"}, snr_low=6.0) == expected
    assert tracks("smc-phd", **{"run.seed": 5, "polarity": "both", "snr_low": 6}) == expected
    assert tracks("smc-phd", seed=5, snr_low=6.0) != expected


def test_keywords_go_before_the_config_and_the_profile():
    assert tracks("smc-phd", config={"seed": 3}, seed=4) == tracks("smc-phd", seed=4)
    profile_p = {"snr_low": 8.0, "birth_particles": 4000, "confirm_hits": 5}
    frames = {"background_frames": 45, "background_stride": 3}
    assert tracks("smc-phd", profile="P") == tracks("smc-phd", frames=frames, **profile_p)


def test_the_tracker_is_the_given_one_or_the_configs_or_mm_phd():
    config = {"run": {"tracker": "viterbi"}}
    assert tracks(config=config) == tracks("viterbi")
    assert tracks("smc-phd", config=config) == tracks("smc-phd")
    assert tracks() == tracks("mm-phd")
    own = {"trackers": {"mm-phd": {"snr_low": 6}}}
    assert tracks(config=own) == tracks("mm-phd", snr_low=6)


def test_the_default_config_changes_nothing():
    text = glint.default_config("smc-phd")
    assert "[trackers.smc-phd]" in text and "[trackers.viterbi]" not in text
    assert tracks("smc-phd", config=text) == tracks("smc-phd")
    assert "[trackers.viterbi]" in glint.default_config()


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"sed": 1}, "did you mean seed"),
        ({"seed": -1}, r"run.seed must be in \[0"),
        ({"seed": "many"}, "run.seed"),
        ({"seed": [1, 2]}, "seed must be a single value"),
        ({"frames": {"polarty": "dark"}}, "did you mean frames.polarity"),
        ({"polarity": "grey"}, "bright, dark or both"),
        ({"tracker": "mm-phf"}, "mm-phd"),
        ({"tracker": "mm-phd mm-phd"}, "given twice"),
        ({"profile": "X"}, "choose one of P, L"),
        ({"config": "[run]\nsed = 1\n"}, "config:2: unknown key run.sed"),
        ({"config": "nonsense"}, "config:1"),
        ({"mask": "mask.png"}, "run.mask has no effect on frames that are pushed"),
        ({"size": "640x512"}, "a frame says its size itself"),
        ({"fps": 25}, "give each frame its time"),
        ({"trackers.viterbi.window": 5}, "a run with tracker \"mm-phd\" does not read it"),
        ({"device": "abacus"}, "abacus"),
    ],
)
def test_mistakes_are_named(settings, message):
    with pytest.raises(glint.ConfigError, match=message):
        glint.Engine(**settings)


def test_mistakes_in_the_call_are_named():
    with pytest.raises(TypeError, match="TOML text or a dict, got int"):
        glint.Engine(config=3)
    with pytest.raises(ValueError, match="'wait' or 'drop_oldest'"):
        glint.Engine(when_full="drop")
    with pytest.raises(ValueError, match="at least a frame"):
        glint.Engine(queue=0)
