"""What the tests of the builder share."""

import pytest
from small_table import SKIN, SMALL

from lut_builder.assemble import build


@pytest.fixture(scope="session")
def small():
    """Built once for all tests of a process."""
    return build(SKIN, SMALL)
