"""How well the solver without noise agrees with the random walk: `make agreement`.

Both compute the reflectance at 8 degrees of S1 to S4 and of tanned skins, from 250 to 2500 nm. All
pairs go to a CSV file, skin by skin; after Ctrl-C, --resume goes on. The default of ten million
rays takes hours. A tenth of them gives the mean just as well, for the walk's own noise is
subtracted.
"""

import argparse
import csv
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
from tqdm import tqdm

from hylios.adding import spectrum as spectrum_without_noise
from hylios.commands.shell import add_work_arguments, require_work, run
from hylios.errors import InputError, require_whole
from hylios.files import written_beside
from hylios.skin import Skin
from hylios.skin.phototypes import PHOTOTYPES, phototype
from hylios.skin.specimen import SPECIMENS, Specimen
from hylios.transport.simulate import MOST_RAYS, Progress, spectrum
from lut_builder.reachable import reachable_states

WAVELENGTHS = np.array(
    [250.0, 290.0, 320.0, 365.0, 420.0, 470.0, 545.0, 600.0, 700.0, 900.0, 1200.0, 1650.0, 2500.0]
)
"""Over the whole range; two in the blue and two in bands of blood and beyond, as colours need."""

TANNED, SCHEDULES = 30, 60
"""Tanned states in all, and random schedules of a skin from which its states are drawn."""

LEAST_CHANGE = 0.02
"""Relative change of a layer's melanin, or of thickness, that makes a state count as tanned."""

MOST_RMS, MOST = 5e-4, 2e-3
"""The largest root mean square difference, and the largest difference, that are aimed at."""

ANGLE = 8.0
DEFAULT = Path("out/agreement.csv")


@dataclass(frozen=True)
class Pair:
    """Reflectance of one skin at one wavelength, by both solvers.

    `state` is empty for S1 to S4 as they are, else melanin of basale, spinosum, granulosum and
    thickness. `error` is the walk's standard error.
    """

    skin: str
    state: str
    wavelength: float
    rays: int
    seed: int
    walked: float
    error: float
    solved: float

    @property
    def difference(self) -> float:
        """Solved less walked."""
        return self.solved - self.walked


@dataclass(frozen=True)
class Agreement:
    """Differences of some pairs.

    Attributes
    ----------
    rms, noise : float
        Root mean squares of the differences and of the walk's standard errors.
    largest : float
    own : float
        Root mean square difference without the walk's noise; 0 where noise explains all.
    """

    rms: float
    noise: float
    largest: float
    own: float


def agreement(pairs: Sequence[Pair]) -> Agreement:
    """The agreement of one pair or more."""
    differences = np.array([pair.difference for pair in pairs])
    errors = np.array([pair.error for pair in pairs])
    square, noise = np.mean(differences**2), np.mean(errors**2)
    own = np.sqrt(max(0.0, square - noise))
    largest = np.abs(differences).max()
    return Agreement(float(np.sqrt(square)), float(np.sqrt(noise)), float(largest), float(own))


def skins() -> dict[str, Skin]:
    """Skins that tan: S1 to S4 and the skin types, by name."""
    types = {name: phototype(name).skin for name in PHOTOTYPES}
    return {**{name: Skin.of(specimen) for name, specimen in SPECIMENS.items()}, **types}


def specimens(seed: int, tanned: int = TANNED) -> list[tuple[str, str, Specimen]]:
    """Name, state and specimen of S1 to S4, and of tanned states, drawn in turn from all skins."""
    drawn = [(name, "", specimen) for name, specimen in SPECIMENS.items()]
    tanning_skins = list(skins().items())
    tanned_states = [_tanned_states(skin, seed) for _, skin in tanning_skins]
    random = np.random.default_rng(seed)
    for number in range(tanned):
        name, skin = tanning_skins[number % len(tanning_skins)]
        state = random.choice(tanned_states[number % len(tanning_skins)])
        printed = " ".join(f"{value:.6g}" for value in state)
        drawn.append((name, printed, skin.at(state)))
    return drawn


def _tanned_states(skin: Skin, seed: int) -> np.ndarray:
    """States (N, 4) that a skin reaches and that differ from the untanned."""
    states = reachable_states(skin, SCHEDULES, seed)
    change = np.abs(states / skin.untanned_state - 1.0).max(axis=1)
    return states[change > LEAST_CHANGE]


def compared(
    name: str,
    state: str,
    specimen: Specimen,
    *,
    rays: int,
    seed: int,
    threads: int | None = None,
    wavelengths: np.ndarray = WAVELENGTHS,
    progress: Progress | None = None,
) -> list[Pair]:
    """Both reflectances of a specimen at wavelengths in nm."""
    walked = spectrum(
        specimen,
        wavelengths,
        angle=ANGLE,
        rays=rays,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    solved = spectrum_without_noise(specimen, wavelengths, angle=ANGLE).total
    columns = wavelengths, walked.total, walked.standard_error, solved
    return [
        Pair(name, state, float(nm), rays, seed, float(total), float(error), float(ours))
        for nm, total, error, ours in zip(*columns, strict=True)
    ]


def written(pairs: Sequence[Pair], path: Path) -> None:
    """Write pairs as CSV."""
    names = [field.name for field in fields(Pair)]
    with written_beside(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, [*names, "difference"])
        writer.writeheader()
        writer.writerows({**asdict(pair), "difference": pair.difference} for pair in pairs)


def read(path: Path) -> list[Pair]:
    """Pairs of a file that `written` wrote.

    Raises
    ------
    InputError
        If it is none.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return [
                Pair(**{field.name: field.type(row[field.name]) for field in fields(Pair)})
                for row in csv.DictReader(file)
            ]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path} is no file of this command: {error!r}.") from error


def report(pairs: Sequence[Pair]) -> str:
    """A table of the agreement by wavelength, by skin, and of all pairs."""
    lines = [f"{'':<12}{'pairs':>6}{'rms':>10}{'noise':>10}{'own rms':>10}{'largest':>10}"]

    def line(name: str, group: Sequence[Pair]) -> Agreement:
        summary = agreement(group)
        numbers = (summary.rms, summary.noise, summary.own, summary.largest)
        lines.append(f"{name:<12}{len(group):>6}" + "".join(f"{x:>10.2e}" for x in numbers))
        return summary

    for nm in sorted({pair.wavelength for pair in pairs}):
        line(f"{nm:g} nm", [pair for pair in pairs if pair.wavelength == nm])
    for name in dict.fromkeys(pair.skin for pair in pairs):
        line(name, [pair for pair in pairs if pair.skin == name])
    if any(pair.state for pair in pairs):
        line("tanned", [pair for pair in pairs if pair.state])
    summary = line("all", pairs)
    lines.append(
        f"aimed at: rms {MOST_RMS:g}: {_met(summary.rms <= MOST_RMS)}; largest {MOST:g}: "
        f"{_met(summary.largest <= MOST)}"
    )
    return "\n".join(lines)


def _met(is_met: bool) -> str:
    return "met" if is_met else "NOT met"


def compare(arguments: argparse.Namespace) -> None:
    """Compute the pairs that are missing, and print the agreement."""
    require_work(arguments)
    rays = require_whole("number of rays", arguments.rays, 100, MOST_RAYS)
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    pairs = read(arguments.output) if arguments.resume and arguments.output.exists() else []
    # every specimen has its own seed, or all would share their noise
    tasks = {
        (name, state, rays, seed): specimen
        for seed, (name, state, specimen) in enumerate(
            specimens(arguments.seed), start=arguments.seed
        )
    }
    done = {(pair.skin, pair.state, pair.rays, pair.seed) for pair in pairs}
    if not done <= tasks.keys():
        raise InputError(
            f"{arguments.output} is of other rays or another seed; leave out --resume."
        )
    left = {key: specimen for key, specimen in tasks.items() if key not in done}
    total = len(left) * WAVELENGTHS.size * rays
    with tqdm(total=total, unit="ray", unit_scale=True, file=sys.stderr) as bar:
        for (name, state, _, seed), specimen in left.items():
            bar.set_description(f"{name} tanned" if state else name)
            pairs += compared(
                name,
                state,
                specimen,
                rays=rays,
                seed=seed,
                threads=arguments.threads,
                progress=bar.update,
            )
            written(pairs, arguments.output)
    print(report(pairs))
    print(f"wrote {arguments.output}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m examples.agreement", description=__doc__)
    parser.add_argument("--rays", type=int, default=10_000_000, help="rays for a pair")
    parser.add_argument("--resume", action="store_true", help="keep the pairs that the file holds")
    parser.add_argument("-o", "--output", type=Path, default=DEFAULT, metavar="FILE.csv")
    add_work_arguments(parser)
    return parser


if __name__ == "__main__":
    sys.exit(run(compare, _parser().parse_args()))
