"""Draws the thesis's figures again into out/figures: `python -m examples.figures [C D.3 ...]`."""

import argparse
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType

from tqdm import tqdm

import hylios
from examples.figures import (
    absorbers,
    angular,
    compression,
    dose_responses,
    dose_schedules,
    goniometry,
    hyperspectral,
    measured_tans,
    melanin_forms,
    people,
    people_page,
    picture_page,
    predecessors,
    renders,
    report,
    sensitivity,
    spectral_renders,
    tanning_claims,
)
from examples.figures.light import Effort, Task
from examples.figures.measured_people import read_people
from hylios.commands.shell import run
from hylios.errors import InputError, require_whole

GROUPS = (
    absorbers,
    melanin_forms,
    predecessors,
    goniometry,
    hyperspectral,
    angular,
    sensitivity,
    compression,
    dose_schedules,
    dose_responses,
    tanning_claims,
    people,
    measured_tans,
    spectral_renders,
    renders,
)
"""Modules with FIGURES, `tasks(effort)` that computes and `draw(results, folder)` that draws."""


def main() -> int:
    """Read the arguments and draw."""
    names = ", ".join(name for group in GROUPS for name in group.FIGURES)
    parser = argparse.ArgumentParser(prog="python -m examples.figures", description=__doc__)
    parser.add_argument(
        "names", nargs="*", help=f"figures to draw; a letter or number draws several: {names}"
    )
    parser.add_argument("--rays", type=int, default=Effort.rays, help="rays for a wavelength")
    parser.add_argument("--seed", type=int, default=Effort.seed)
    parser.add_argument("--threads", type=int, help="number of threads (default: one per core)")
    parser.add_argument(
        "--people", type=Path, help="measured skin to draw beside ours: CSV of wavelength_nm,s1,..."
    )
    parser.add_argument("--out", type=Path, default=Path("out/figures"))
    parser.add_argument(
        "--page", type=Path, help="page of docs to write: of people, or of the rendered figures"
    )
    return run(figures, parser.parse_args())


def figures(arguments: argparse.Namespace) -> None:
    """Compute and draw the figures, and write the report."""
    require_whole("number of rays", arguments.rays, 1, 10**8)
    require_whole("seed", arguments.seed, 0, 2**32 - 1)
    groups = groups_with(arguments.names)
    measured = read_people(arguments.people) if arguments.people else None
    every = [figure for group in groups for figure in group.FIGURES]
    wanted = {
        figure for figure in every for name in arguments.names or every if matches(name, figure)
    }
    effort = Effort(
        arguments.rays, arguments.seed, arguments.threads, measured, tuple(sorted(wanted))
    )
    arguments.out.mkdir(parents=True, exist_ok=True)
    started = time.monotonic()
    work = {group: group.tasks(effort) for group in groups}
    results = computed(work)
    rows = [row for group in groups for row in group.draw(results[group], arguments.out)]
    seconds = time.monotonic() - started
    heading = (
        f"hylios {hylios.__version__}; {effort.rays:,} rays per wavelength where rays walk, seed "
        f"{effort.seed}; made in {seconds:.0f} s."
    )
    report.write(arguments.out / "report.md", rows, heading)
    if arguments.page:
        if measured_tans in groups and not {spectral_renders, renders} & {*groups}:
            people_page.write(arguments.page, results[measured_tans]["rows"], arguments.out)
        else:
            picture_page.write(arguments.page, rows, arguments.out)
    missed = [row for row in rows if row.met is False]
    print(
        f"Made in {seconds:.0f} s, in {arguments.out.resolve()}; report.md has {len(rows)} lines."
    )
    print(f"{sum(row.met is True for row in rows)} aims met, {len(missed)} not:")
    for row in missed:
        print(f"  {row.where}, {row.what}: printed {row.printed}, ours {row.ours}")


def groups_with(names: Sequence[str]) -> list[ModuleType]:
    """The groups that hold a named figure, or all without a name.

    Raises
    ------
    InputError
        If no figure has a name.
    """
    for name in names:
        if not any(matches(name, figure) for group in GROUPS for figure in group.FIGURES):
            names = ", ".join(figure for group in GROUPS for figure in group.FIGURES)
            raise InputError(f"there is no figure {name!r}; there are {names}.")
    return [
        group
        for group in GROUPS
        if not names or any(matches(name, figure) for name in names for figure in group.FIGURES)
    ]


def matches(name: str, figure: str) -> bool:
    """Whether a name means a figure: its own, or what stands before its first dot."""
    return figure == name or figure.startswith(f"{name}.")


def computed(
    work: Mapping[ModuleType, Mapping[str, Task]],
) -> dict[ModuleType, dict[str, object]]:
    """The results of all tasks by group and name, with a bar that shows the time left."""
    total = sum(task.size for tasks in work.values() for task in tasks.values())
    with tqdm(total=total, unit="wavelength", unit_scale=True, file=sys.stderr) as bar:

        def tick(size: float) -> None:
            bar.update(min(size, total - bar.n))  # no rounding beyond the end

        return {
            group: {name: task.work(tick) for name, task in tasks.items()}
            for group, tasks in work.items()
        }


if __name__ == "__main__":
    sys.exit(main())
