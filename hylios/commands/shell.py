"""What the project's shell commands share: how they parse, end and print."""

import argparse
import re
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import NoReturn

import numpy as np

from hylios.commands.streams import discard_output, prepare_streams
from hylios.commands.texts import plain_number, plain_whole
from hylios.errors import InputError, require_whole, shown


class Parser(argparse.ArgumentParser):
    """A parser of a command's arguments whose errors are one sentence.

    An empty text is none of a path, a name or a number: in a shell it is mostly a variable that
    was never set.
    """

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        # As Python 3.14 has it: -1:2 and -1e9 are values, not options.
        self._negative_number_matcher = re.compile(r"-\.?\d")
        self.register("type", float, plain_number)
        self.register("type", int, plain_whole)

    def parse_args(self, args=None, namespace=None):  # pyright: ignore[reportIncompatibleMethodOverride]
        """The arguments; ends the process with status 2 and a sentence where one is missing."""
        given = sys.argv[1:] if args is None else args
        for before, text in zip(["", *given], given, strict=False):
            if not text or (text.startswith("--") and text.endswith("=") and text.count("=") == 1):
                name = text.removesuffix("=") or (before if before.startswith("-") else "")
                self.error(f"{name or 'an argument'} is empty; leave it out or give a value.")
        return super().parse_args(args, namespace)

    def error(self, message: str) -> NoReturn:
        """End the process with status 2."""
        sentence = message.strip().removesuffix(".")
        for type_of, meaning in (("float", "a number"), ("int", "a whole number")):
            sentence = sentence.replace(f"invalid {type_of} value:", f"expected {meaning}, not")
        print(f"error: {shown(sentence)}. `{self.prog} --help` says more.", file=sys.stderr)
        sys.exit(2)


def run(command: Callable[[argparse.Namespace], None], arguments: argparse.Namespace) -> int:
    """Run a command; bad input is one sentence and status 2, Ctrl-C status 130.

    Of Ctrl-C one word is said, or what the command gave the KeyboardInterrupt to say.
    """
    try:
        prepare_streams()
        command(arguments)
        sys.stdout.flush()
    except InputError as error:
        print(f"error: {shown(_in_options(str(error)))}", file=sys.stderr)
        return 2
    except MemoryError:
        print("error: there is not enough memory for this.", file=sys.stderr)
        return 2
    except KeyboardInterrupt as interrupt:
        print(str(interrupt) or "cancelled", file=sys.stderr)
        return 130
    except BrokenPipeError:
        discard_output()
        return 1
    except OSError as error:
        print(f"error: {shown(str(error))}.", file=sys.stderr)
        discard_output()
        return 2
    return 0


OPTIONS = {"with allow_unphysical": "with --allow-unphysical", "replacing=True": "--force"}
"""What the library's sentences call its arguments, and what the shell calls them."""


def _in_options(sentence: str) -> str:
    for argument, option in OPTIONS.items():
        sentence = sentence.replace(argument, option)
    return sentence


def print_table(columns: Mapping[str, np.ndarray], digits: int = 9) -> None:
    """Print columns of equal length as CSV with a header."""
    print(",".join(columns))
    print_rows(columns.values(), digits)


def print_rows(columns: Iterable[np.ndarray], digits: int = 9) -> None:
    """Print the rows of columns of equal length as CSV."""
    values = [column.tolist() for column in columns]
    row = ",".join([f"%.{digits}g"] * len(values)) + "\n"
    sys.stdout.writelines(row % cells for cells in zip(*values, strict=True))


def add_work_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of every simulation, which `require_work` checks."""
    parser.add_argument("--seed", type=int, default=1, help="seed of random numbers (default: 1)")
    parser.add_argument("--threads", type=int, help="number of threads (default: one per core)")


def require_work(arguments: argparse.Namespace) -> None:
    """Raise InputError where the seed or the number of threads is out of range."""
    require_whole("seed", arguments.seed, 0, 2**32 - 1)
    if arguments.threads is not None:
        require_whole("number of threads", arguments.threads, 1, 1024)
