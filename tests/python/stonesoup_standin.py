# SPDX-License-Identifier: Apache-2.0
"""Stone Soup's classes as far as glint.stonesoup calls them, for machines that lack the package:
the same modules, constructors, attributes and sequence behaviour, with their checks."""

import sys
import types
from collections.abc import MutableSequence

import numpy as np


class State:
    def __init__(self, state_vector, timestamp=None):
        vector = np.asarray(state_vector)
        if vector.ndim != 2 or vector.shape[1] != 1:
            raise ValueError("state vector must be a column")
        self.state_vector, self.timestamp = vector, timestamp


class GaussianState(State):
    def __init__(self, state_vector, covar, timestamp=None):
        super().__init__(state_vector, timestamp)
        self.covar = np.asarray(covar)
        if self.covar.shape != (len(self.state_vector),) * 2:
            raise ValueError("state vector and covariance should have same dimensions")


class Sequence(MutableSequence):
    def __init__(self, states=None, id=None):
        self.states, self.id = list(states or []), id

    def __len__(self):
        return len(self.states)

    def __getitem__(self, index):
        return self.states[index]

    def __setitem__(self, index, value):
        self.states[index] = value

    def __delitem__(self, index):
        del self.states[index]

    def insert(self, index, value):
        self.states.insert(index, value)


class Track(Sequence):
    pass


class GroundTruthPath(Sequence):
    pass


class GroundTruthState(State):
    pass


def install():
    """Puts the classes where Stone Soup's would be, unless it is there."""
    try:
        import stonesoup.types.track  # noqa: F401
    except ModuleNotFoundError:
        for name in ("stonesoup", "stonesoup.types"):
            sys.modules[name] = types.ModuleType(name)
        for name, classes in {
            "state": (State, GaussianState),
            "track": (Track,),
            "groundtruth": (GroundTruthPath, GroundTruthState),
        }.items():
            module = types.ModuleType(f"stonesoup.types.{name}")
            for cls in classes:
                setattr(module, cls.__name__, cls)
            sys.modules[module.__name__] = module
