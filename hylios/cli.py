"""The command `hylios`: reflectance and tanning as CSV on standard output."""

import argparse
import sys
from pathlib import Path

import numpy as np

from hylios.command_line import named_values, number, run, wavelength_range
from hylios.errors import InputError, require_range
from hylios.specimen import specimen, with_values
from hylios.spectra import estimates_within, figures, replaced
from hylios.tanning import (
    PIGMENTATIONS,
    Exposures,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
    simulate,
)

TYPICAL_PIGMENTATION = {"low": 0.0235, "intermediate": 0.10, "high": 0.25}
"""Melanin fraction that stands for a tanning set where no minimal doses are given (an estimate:
S3's, a value between, and S4's)."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = _parser().parse_args(arguments)
    return run(parsed.command, parsed)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="hylios", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    light = commands.add_parser("reflectance", help="spectrum of a specimen by random walk")
    light.set_defaults(command=_reflectance)
    light.add_argument("--specimen", default="S3", help="S1 to S4 of table 6.1 (default S3)")
    light.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="set a parameter"
    )
    light.add_argument(
        "--reading",
        action="append",
        default=[],
        metavar="NAME=CHOICE",
        help="another reading of the thesis's text (hylios.tissue.READINGS)",
    )
    light.add_argument(
        "--figure",
        action="append",
        default=[],
        metavar="NAME=FILE",
        help="a spectrum of your own: CSV of nm and value",
    )
    light.add_argument("--wavelengths", default="400:700:10", help="nm, FIRST:LAST:STEP or a,b,c")
    light.add_argument("--angle", type=float, default=8.0, help="of incidence, degrees")
    light.add_argument("--rays", type=int, default=100_000, help="per wavelength")
    light.add_argument("--seed", type=int, default=1)
    light.add_argument(
        "--as-printed",
        action="store_true",
        help="walk every path inside a melanosome (same model, slower)",
    )
    light.add_argument("--threads", type=int, help="default: all cores")

    tan = commands.add_parser("tan", help="melanin and thickness over time")
    tan.set_defaults(command=_tan)
    tan.add_argument("--pigmentation", choices=list(PIGMENTATIONS), default="low")
    tan.add_argument(
        "--dose", action="append", default=[], metavar="HOUR:SED", help="an exposure; repeatable"
    )
    tan.add_argument("--mmd", type=float, help="minimal melanogenesis dose, SED (default: 3.2)")
    tan.add_argument("--med", type=float, help="minimal erythema dose, SED (default: 3.1)")
    tan.add_argument("--hours", type=int, default=720)
    return parser


def _reflectance(asked: argparse.Namespace) -> None:
    from hylios.transport.simulate import spectrum  # numba: only when light is asked for

    known = figures()
    for name, path in named_values(asked.figure, "a figure").items():
        known = replaced(known, name, Path(path))
    values = {
        name: number(text, name) for name, text in named_values(asked.set, "a setting").items()
    }
    if asked.threads is not None:
        require_range("number of threads", asked.threads, 1, 1024)
    result = spectrum(
        with_values(specimen(asked.specimen), values),
        wavelength_range(asked.wavelengths),
        angle=asked.angle,
        rays=asked.rays,
        seed=asked.seed,
        threads=asked.threads,
        known=known,
        chosen=named_values(asked.reading, "a reading"),
        as_printed=asked.as_printed,
    )
    for line in estimates_within(known, result.wavelengths):
        print(f"note: {line}", file=sys.stderr)
    print("wavelength_nm,total,surface,subsurface,absorptance,standard_error")
    columns = (
        result.wavelengths,
        result.total,
        result.surface,
        result.subsurface,
        result.absorptance,
        result.standard_error,
    )
    for row in zip(*columns, strict=True):
        print(",".join(f"{value:.9g}" for value in row))


def _tan(asked: argparse.Namespace) -> None:
    typical = TYPICAL_PIGMENTATION[asked.pigmentation]
    history = simulate(
        _exposures(asked.dose),
        PIGMENTATIONS[asked.pigmentation],
        mmd=minimal_melanogenesis_dose(typical) if asked.mmd is None else asked.mmd,
        med=minimal_erythema_dose(typical) if asked.med is None else asked.med,
        hours=asked.hours,
    )
    print("hour,basale,spinosum,granulosum,total,thickness")
    columns = (history.hours, *history.melanin.T, history.total, history.thickness)
    for row in zip(*columns, strict=True):
        print(",".join(f"{value:.10g}" for value in row))


def _exposures(texts: list[str]) -> Exposures:
    """Doses from texts HOUR:SED."""
    pairs = []
    for text in texts:
        hour, separator, dose = text.partition(":")
        if not separator:
            raise InputError(f"a dose is {text!r}; expected HOUR:SED, such as 0:30.")
        pairs.append((number(hour, "hour of a dose"), number(dose, "dose")))
    hours, doses = np.array(pairs, dtype=float).reshape(-1, 2).T
    return Exposures(hours, doses)


if __name__ == "__main__":
    sys.exit(main())
