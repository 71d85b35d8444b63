"""The truth package on the path of these tests, and the seed they draw from."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest
from seeds import seed_of

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def seed():
    """Drawn anew for every test; BLIND_SEED repeats it."""
    value = int(os.environ.get("BLIND_SEED") or seed_of("conftest"))
    print(f"seed {value}: BLIND_SEED={value} repeats it")
    return value


@pytest.fixture
def rng(seed):
    """Random numbers of the seed."""
    return np.random.default_rng(seed)
