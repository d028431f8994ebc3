"""What the tests of jobs share."""

import pytest
from same_results import UNITS

from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units


@pytest.fixture
def undisturbed():
    return run_units(UNITS, None, "1", in_threads(1))
