"""Lines of `make bench`: what was measured, and what it may be."""

import time
from collections.abc import Callable, Sequence

import numpy as np


def ranged(values: Sequence[float]) -> str:
    """Median, and least and most where there are several runs."""
    text = f"{np.median(values):.3g}"
    return f"{text} ({min(values):.3g} to {max(values):.3g})" if len(values) > 1 else text


def report(what: str, measured: str, limit: str, within: bool) -> None:
    """Print a line: a measurement, its limit, and whether it is within."""
    print(f"{what:<58} {measured}; must be {limit}: {'yes' if within else 'NO'}", flush=True)


def report_at_most(what: str, values: Sequence[float], unit: str, limit: float | None) -> None:
    """Print a line on some runs, of which the median counts; without a limit it is only told."""
    measured = f"{ranged(values)} {unit}"
    if limit is None:
        print(f"{what:<58} {measured}", flush=True)
    else:
        report(what, measured, f"{limit:g}", bool(np.median(values) <= limit))


def milliseconds(work: Callable[[int], object], repeats: int) -> list[float]:
    """Milliseconds of the processor that some work takes, which is told the number of the run."""
    spent = []
    for run in range(repeats):
        started = time.process_time()
        work(run)
        spent.append(1e3 * (time.process_time() - started))
    return spent
