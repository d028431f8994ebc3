"""A bar on standard error for work whose length can be estimated."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

SECONDS_LEFT = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}, {remaining} left"
"""Format of a bar whose steps are estimated seconds, which are not worth printing."""


@contextmanager
def progress(total: float, label: str) -> Iterator[Callable[[float], object]]:
    """A bar; it is told how much more is done."""
    from tqdm import tqdm

    with tqdm(total=total, desc=label, bar_format=SECONDS_LEFT, mininterval=0.5) as bar:
        yield lambda size: bar.update(min(size, total - bar.n))  # no rounding beyond the end
