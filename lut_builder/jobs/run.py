"""Running units of work wherever they are to run, each kept as soon as it is done.

Only the process that started the work writes files: a unit's results come to it as bytes, it
keeps them in the folder of the unfinished work, and a later run goes on from there.

    with unfinished(target, (".exr",), resume=True, replace=False) as work:
        results = run_units(units, work.folder, software_digest(), in_processes(2), "table")
        write_table(work.result, table_of(results))

A kept unit is trusted only if its checksum holds and its digest is that of the unit to be done:
function, arguments, the sources of this project and the versions of the libraries below it.
"""

from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from tqdm import tqdm

from hylios.files import written_beside
from lut_builder.jobs.interrupts import interrupts_held
from lut_builder.jobs.unfinished import unit_file
from lut_builder.jobs.units import Arrays, Unit, is_result, unit_digest, unpacked

Runner = Callable[[Sequence[Unit], str], Generator[tuple[Unit, bytes], None, None]]
"""A function that does units for software of a digest; it gives a unit and its bytes as it ends."""


def run_units(
    units: Sequence[Unit],
    folder: Path | None,
    software: str,
    runner: Runner,
    label: str | None = None,
) -> dict[str, Arrays]:
    """Results of all units by name, in the order of the units.

    Parameters
    ----------
    folder : Path or None
        Where units are kept as soon as they are done, and looked for first; None keeps nothing.
    software : str
        `software_digest()`.
    label : str or None
        Of a bar on standard error that shows how many units are done and the time left by their
        sizes, such as "table". None shows nothing.

    Raises
    ------
    InputError
        If a unit cannot be kept, a unit raises it, or the runner loses what it runs on; units that
        were done by then stay.
    """
    if len({unit.name.lower() for unit in units}) < len(units):
        raise ValueError("two units have the same name, for a file system that ignores case")
    results: dict[str, Arrays] = {}
    if folder:
        for unit in units:
            kept = _kept(unit_file(folder, unit.name), unit_digest(unit, software))
            if kept is not None:
                results[unit.name] = kept
    # The largest first, lest one process is left with it when all others have ended.
    missing = [unit for unit in units if unit.name not in results]
    missing.sort(key=lambda unit: -unit.size)
    if missing:
        done = sum(unit.size for unit in units if unit.name in results)
        with (
            _bar(label, len(units), sum(unit.size for unit in units), done) as show,
            closing(runner(missing, software)) as running,
        ):
            show(len(results), 0.0)
            for unit, content in running:
                if folder:
                    with written_beside(unit_file(folder, unit.name)) as beside:
                        beside.write_bytes(content)
                results[unit.name] = unpacked(content)
                show(len(results), unit.size)
    return {unit.name: results[unit.name] for unit in units}


def _kept(path: Path, digest: str) -> Arrays | None:
    """The arrays of a kept unit; None if there is none, or it is damaged or another unit's."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    return unpacked(content) if is_result(content, digest) else None


@contextmanager
def _bar(
    label: str | None, count: int, total: float, initial: float
) -> Iterator[Callable[[int, float], None]]:
    """A bar over the sizes of all units; it is told how many are done, and the size of the last."""
    if label is None:
        yield lambda done, size: None
        return
    with ExitStack() as stack:
        # Ctrl-C between the bar's first sign and its `with` would leave its line without an end.
        with interrupts_held():
            bar = stack.enter_context(
                tqdm(
                    total=total,
                    initial=initial,
                    desc=label,
                    bar_format="{desc} {percentage:3.0f}%|{bar}| [{elapsed}<{remaining}]",
                    smoothing=0.0,
                    mininterval=0.5,
                )
            )

        def show(done: int, size: float) -> None:
            bar.set_description_str(f"{label}, {done} of {count}", refresh=size == 0.0)
            bar.update(min(size, bar.total - bar.n))  # no rounding beyond the end

        yield show
