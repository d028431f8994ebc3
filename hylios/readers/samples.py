"""Choosing one sample of a file by its name."""

from collections.abc import Sequence
from typing import TypeVar

from hylios.errors import InputError, shown

SAMPLES_SHOWN = 8

Sample = TypeVar("Sample")


def the_sample(
    samples: Sequence[Sample],
    names: Sequence[Sequence[str]],
    labels: Sequence[str],
    wanted: str | None,
) -> Sample:
    """The only sample, or the only one that has a name.

    Parameters
    ----------
    names : sequence of sequences of str
        What each sample may be called.
    labels : sequence of str
        What each is called in a sentence.
    wanted : str, optional
        Name of the sample.

    Raises
    ------
    InputError
        If no sample or several fit.
    """
    fitting = [
        sample
        for sample, called in zip(samples, names, strict=True)
        if wanted is None or wanted in called
    ]
    if len(fitting) == 1:
        return fitting[0]
    some = ", ".join(shown(label[:40]) for label in labels[:SAMPLES_SHOWN])
    what = "several samples" if wanted is None else f"not one sample {shown(wanted[:40])!r}"
    raise InputError(f"it has {what if samples else 'no sample'}; there are {some or 'none'}")
