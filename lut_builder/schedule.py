"""The tanning states that the doses of a scene lead through."""

import numpy as np

from hylios.history import history_of_shares, require_last_day
from hylios.skin import Skin
from hylios.tanning import Exposures

HOURS = 2.0
"""Between two looks at the skin."""


def reached_states(skin: Skin, exposures: Exposures, days: float) -> np.ndarray:
    """States (N, 4) of a skin anywhere on a body, from day 0 to a last one.

    Raises
    ------
    InputError
        If the last day is out of range.
    """
    last = 24.0 * require_last_day(days)
    history = history_of_shares(
        exposures,
        skin.dynamics,
        hours=np.append(np.arange(0.0, last, HOURS), last),
        mmd=skin.mmd,
        med=skin.med,
    )
    return history.states.reshape(-1, 4)
