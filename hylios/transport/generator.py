"""Random numbers: xoshiro256++ (Blackman and Vigna 2019), one stream per piece of work.

A stream depends on the seed and on what is simulated alone, so results do not depend on how many
threads share the work.
"""

import numpy as np

from hylios.transport.compiling import part

_DOUBLE = 1.0 / 9007199254740992.0


def stream(*key: int) -> np.ndarray:
    """State of the generator for a key of whole numbers from 0 on, shape (4,), uint64."""
    return np.random.SeedSequence(key).generate_state(4, np.uint64)


@part
def uniform(state):
    """A random number from [0, 1), advancing the state in place."""
    s0, s1, s2, s3 = state[0], state[1], state[2], state[3]
    mixed = s0 + s3
    result = ((mixed << np.uint64(23)) | (mixed >> np.uint64(41))) + s0
    shifted = s1 << np.uint64(17)
    s2 ^= s0
    s3 ^= s1
    s1 ^= s2
    s0 ^= s3
    s2 ^= shifted
    s3 = (s3 << np.uint64(45)) | (s3 >> np.uint64(19))
    state[0], state[1], state[2], state[3] = s0, s1, s2, s3
    return np.float64(result >> np.uint64(11)) * _DOUBLE
