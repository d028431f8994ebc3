"""The command `hylios`: reflectance and tanning as CSV on standard output."""

import argparse
import sys

import numpy as np

from hylios.errors import InputError
from hylios.shell import (
    add_skin_arguments,
    add_work_arguments,
    chosen_skin,
    number,
    require_work,
    run,
    wavelength_range,
)
from hylios.spectra import estimates_within
from hylios.tanning import (
    PIGMENTATIONS,
    TYPICAL_PIGMENTATION,
    Exposures,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
    simulate,
)
from hylios.tissue import FIGURES


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = _parser().parse_args(arguments)
    return run(parsed.command, parsed)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="hylios", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    light = commands.add_parser("reflectance", help="spectrum of a specimen by random walk")
    light.set_defaults(command=_reflectance)
    add_skin_arguments(light)
    add_work_arguments(light)
    light.add_argument("--wavelengths", default="400:700:10", help="nm, FIRST:LAST:STEP or a,b,c")
    light.add_argument("--angle", type=float, default=8.0, help="of incidence, degrees")
    light.add_argument("--rays", type=int, default=100_000, help="per wavelength")
    light.add_argument(
        "--as-printed",
        action="store_true",
        help="walk every path inside a melanosome (same model, slower)",
    )

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

    require_work(asked)
    specimen, known, chosen = chosen_skin(asked)
    result = spectrum(
        specimen,
        wavelength_range(asked.wavelengths),
        angle=asked.angle,
        rays=asked.rays,
        seed=asked.seed,
        threads=asked.threads,
        known=known,
        chosen=chosen,
        as_printed=asked.as_printed,
    )
    for line in estimates_within(known, FIGURES, result.wavelengths):
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
