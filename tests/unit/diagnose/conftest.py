"""What the tests of this folder share."""

import numpy as np
import pytest
from seeds import seed_of


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers of a seed that is printed."""
    seed = seed_of("conftest")
    return np.random.default_rng(seed)
