"""Work that can be interrupted and resumed from the shell, by --resume and --force."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager

from hylios.errors import InputError
from lut_builder.jobs.unfinished import Interrupted, UnfinishedWorkError, Work, unfinished


@contextmanager
def resumable(arguments: argparse.Namespace, suffix: str) -> Iterator[Work]:
    """`unfinished` for the arguments `output`, `resume` and `force`."""
    try:
        with unfinished(
            arguments.output, (suffix,), resume=arguments.resume, replace=arguments.force
        ) as work:
            yield work
    except UnfinishedWorkError as error:
        hint = "give --resume to go on with it, or --force to begin anew."
        raise InputError(f"{str(error).removesuffix('.')}; {hint}") from error
    except Interrupted as interrupt:
        raise KeyboardInterrupt(f"{interrupt}: give --resume to go on with it.") from None
