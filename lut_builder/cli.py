"""The command `lut-builder`: builds, describes and checks tables of skin that tans."""

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
from tqdm import tqdm

from hylios.command_line import named_values, number, run
from hylios.errors import InputError, require_range
from hylios.specimen import specimen, with_values
from hylios.table import PLANES
from hylios.tanning import PIGMENTATIONS
from lut_builder.build import PRESETS, Settings, build
from lut_builder.check import check, check_settings
from lut_builder.exr import read_table, write_table
from lut_builder.states import skin


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parsed = _parser().parse_args(arguments)
    return run(parsed.command, parsed)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="lut-builder", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    building = commands.add_parser("build", help="simulate a skin's tanning states into a table")
    building.set_defaults(command=_build)
    building.add_argument("--specimen", default="S3", help="S1 to S4 of table 6.1 (default S3)")
    building.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="set a parameter"
    )
    building.add_argument(
        "--pigmentation",
        choices=list(PIGMENTATIONS),
        help="tanning set of table 6.4 (default: the specimen's)",
    )
    building.add_argument("--mmd", type=float, help="minimal melanogenesis dose, SED")
    building.add_argument("--med", type=float, help="minimal erythema dose, SED")
    building.add_argument("--preset", choices=list(PRESETS), default="standard")
    building.add_argument("--knots", help="numbers of knots per axis, such as 9,3,2")
    building.add_argument("--step", type=float, help="spacing of visible wavelengths, nm")
    building.add_argument("--rays", type=int, help="rays per wavelength and state")
    building.add_argument("--seed", type=int, default=1)
    building.add_argument("--threads", type=int, help="default: all cores")
    building.add_argument("--force", action="store_true", help="replace an existing file")
    building.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.exr")

    info = commands.add_parser("info", help="say what a table is")
    info.set_defaults(command=_info)
    info.add_argument("table", type=Path)

    checking = commands.add_parser("check", help="compare a table with direct simulation")
    checking.set_defaults(command=_check)
    checking.add_argument("table", type=Path)
    checking.add_argument("--states", type=int, default=20, help="states between the knots")
    checking.add_argument("--rays", type=int, help="rays per wavelength (default: the table's)")
    checking.add_argument("--seed", type=int, default=1001)
    checking.add_argument("--threads", type=int, help="default: all cores")
    return parser


@contextmanager
def _progress(total: int, what: str) -> Iterator:
    with tqdm(total=total, desc=what, unit="ray", unit_scale=True, mininterval=0.5) as bar:
        yield bar.update


def _settings(asked: argparse.Namespace) -> Settings:
    settings = PRESETS[asked.preset]
    if asked.knots:
        counts = tuple(int(number(part, "knots")) for part in asked.knots.split(","))
        require_range("number of axes", len(counts), 1, 4)
        for count in counts:
            require_range("knots of an axis", count, 1, 100)
        settings = replace(settings, knots=counts)
    if asked.step is not None:
        settings = replace(settings, step=require_range("step", asked.step, 1.0, 100.0, "nm"))
    if asked.rays is not None:
        require_range("number of rays", asked.rays, 100, 1e9)
        settings = replace(settings, rays=asked.rays)
    return settings


def _build(asked: argparse.Namespace) -> None:
    target = asked.output
    if target.exists() and not asked.force:
        raise InputError(f"{target} exists already; --force replaces it.")
    if not target.parent.is_dir():
        raise InputError(f"the folder {target.parent} does not exist.")
    values = {
        name: number(text, name) for name, text in named_values(asked.set, "a setting").items()
    }
    for name in ("mmd", "med"):
        if getattr(asked, name) is not None:
            require_range(name.upper(), getattr(asked, name), 0.01, 1000.0, "SED")
    made_for = skin(
        with_values(specimen(asked.specimen), values), asked.pigmentation, asked.mmd, asked.med
    )
    settings = _settings(asked)
    with _progress(settings.total_rays, f"table of {settings.states} states") as progress:
        table = build(made_for, settings, seed=asked.seed, threads=asked.threads, progress=progress)
    write_table(target, table)
    print(f"wrote {target}: {target.stat().st_size / 1000:.1f} KB")


def _info(asked: argparse.Namespace) -> None:
    table = read_table(asked.table)
    for name, value in table.provenance.items():
        if name == "specimen_parameters":
            print("specimen_parameters:")
            print("\n".join(f"  {each}: {setting}" for each, setting in value.items()))
        elif name == "estimated_figures":
            print("estimated_figures:")
            print("\n".join(f"  {line}" for line in value))
        else:
            print(f"{name}: {value}")
    print(f"planes: {', '.join(PLANES)}")
    for number_of, (direction, knots) in enumerate(
        zip(table.axes.basis.T, table.axes.knots, strict=True), start=1
    ):
        print(
            f"axis {number_of}: {np.round(direction, 3)} in ln of (basale, spinosum, "
            f"granulosum, thickness) to the untanned, knots {np.round(knots, 3)}"
        )


def _check(asked: argparse.Namespace) -> None:
    table = read_table(asked.table)
    require_range("number of states", asked.states, 1, 10_000)
    rays = table.provenance["rays"] if asked.rays is None else asked.rays
    require_range("number of rays", rays, 100, 1e9)
    total = asked.states * check_settings(table, rays).wavelengths.size * rays
    with _progress(total, f"{asked.states} states directly") as progress:
        result = check(
            table,
            count=asked.states,
            rays=rays,
            seed=asked.seed,
            threads=asked.threads,
            progress=progress,
        )
    print(f"states: {len(result.differences)}, reachable, none of them a knot")
    print(f"mean CIEDE2000 between table and simulation: {result.differences.mean():.3f}")
    print(f"largest: {result.differences.max():.3f}")
    print(f"mean CIEDE2000 that Monte Carlo noise alone gives: {result.noise.mean():.3f}")
    print(f"share of the mean squared difference that is noise: {result.noise_share:.0%}")


if __name__ == "__main__":
    sys.exit(main())
