"""Renders skin and compares it with the light model: `python -m examples.truth [--only NAME]`.

Prints what was compared, how far the two are apart and how far they may be; writes rows.csv,
readings.csv and pictures into out/truth, and with --page docs/truth.md.
"""

import argparse
import sys
import time
from pathlib import Path

from tqdm import tqdm

from examples.truth import (
    albedo,
    alike,
    burn,
    cost,
    edge,
    eevee,
    film,
    gloss,
    illuminants,
    page,
    slab,
)
from examples.truth.outcome import Outcome, table, write_readings, write_rows
from examples.truth.rendering import rendered
from hylios.commands.shell import run
from hylios.errors import InputError

COMPARISONS = {
    "albedo": albedo,
    "gloss": gloss,
    "edge": edge,
    "slab": slab,
    "film": film,
    "burn": burn,
    "illuminants": illuminants,
    "alike": alike,
    "cost": cost,
    "eevee": eevee,
}
"""Modules with `shots()`, and `read(shots, lights)` that compares them with the model."""


OPTIONAL = ("eevee",)
"""Comparisons that need what not every machine has."""


def truth(arguments: argparse.Namespace) -> None:
    """Render, compare, print and write."""
    started = time.monotonic()
    names = arguments.only or list(COMPARISONS)
    outcomes = compared(names)
    rows = [row for outcome in outcomes.values() for row in outcome.rows]
    readings = [reading for outcome in outcomes.values() for reading in outcome.readings]
    seconds = time.monotonic() - started
    arguments.out.mkdir(parents=True, exist_ok=True)
    machine = page.machine(seconds)
    write_rows(arguments.out / page.ROWS, rows, machine)
    write_readings(arguments.out / "readings.csv", readings)
    page.draw(outcomes, arguments.out)
    if arguments.page:
        page.write(arguments.page, [arguments.out, *arguments.beside])
    print(table(rows))
    missed = sum(row.met is False for row in rows)
    print(f"{len(rows)} rows, {missed} not met; {seconds:.0f} s, in {arguments.out.resolve()}")


def compared(names: list[str]) -> dict[str, Outcome]:
    """The outcome of comparisons by name, but of those that cannot be made on this machine."""
    shots = {name: COMPARISONS[name].shots() for name in names}
    outcomes = {}
    with tqdm(total=sum(map(len, shots.values())), unit="picture", file=sys.stderr) as bar:
        for name, some in shots.items():
            bar.set_description(name)
            try:
                lights = rendered(some, lambda _: bar.update())
            except InputError:
                if name not in OPTIONAL:
                    raise
                print(f"{name} does not run here", file=sys.stderr)
                continue
            outcomes[name] = COMPARISONS[name].read(some, lights)
    return outcomes


def main() -> int:
    """Read the arguments and compare."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.truth",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--only", action="append", choices=COMPARISONS, metavar="NAME", help=", ".join(COMPARISONS)
    )
    parser.add_argument("--out", type=Path, default=Path("out/truth"))
    parser.add_argument("--page", type=Path, help="page of docs to write, its pictures beside it")
    parser.add_argument(
        "--beside",
        type=Path,
        action="append",
        default=[],
        help="output folder of a run with another Blender, for the page",
    )
    return run(truth, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
