"""Times and errors of what a scene shows of a tan: one mask by share, several by a time basis.

Errors are CIEDE2000 of the colour that is looked up, against simulating every place by the hour.
"""

import argparse
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from blender_addon.model import basis, catalogue, day_basis, grid, history, room
from blender_addon.model.look_grid import COLOUR
from hylios.colour_difference import ciede2000, lab
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.sun.doses import Doses, joined, of_sed
from hylios.tanning import Exposures, Spread, spread_of, states_at

TYPE = "III"
SCHEDULES = ((30, 1), (30, 20), (60, 10), (365, 20))
"""Days and exposures of schedules for one mask."""

MASKS, EXPOSURES_OF_MASK, DAYS = (2, 3, 5, 8), 4, 60

SHOWN = 20
"""The day of the frame that shows while somebody drags."""

ROOM = room.Room(32_768, 12, 12)
"""Of the images of five masks."""

SIDE, SOFT = 316, 10.0
"""Vertices along the side of a square mesh, 99,856 in all; width of masks' edges in vertices."""

PLACES, REPEATS, SEED = 600, 5, 0


def main() -> None:
    """Measure and print."""
    random = np.random.default_rng(SEED)
    skin = phototype(TYPE).skin
    print(f"tan of type {TYPE}: CPU milliseconds; CIEDE2000 mean, at 99 %, most")
    for days, count in SCHEDULES:
        received = joined(_doses(random, count, days, skin))
        for name, precision in (("Apply", history.FULL), ("dragging", history.DRAG)):
            _report_history(
                random, skin, received, days, f"{name}, {days} days, {count}", precision
            )
    for masks in MASKS:
        received = [joined(_doses(random, EXPOSURES_OF_MASK, DAYS, skin)) for _ in range(masks)]
        shares = _soft_masks(random, masks)
        for name, day in (("Apply", None), (f"dragging, day {SHOWN}", SHOWN)):
            _report_basis(random, skin, received, shares, f"{name}, {masks} masks", day)


def _report_history(random, skin: Skin, received: Doses, days: int, name: str, precision) -> None:
    span: dict[str, Any] = {
        "first_day": 0.0,
        "last_day": float(days),
        "mmd": skin.mmd,
        "med": skin.med,
    }

    def work():
        return history.history(received, skin.dynamics, precision=precision, **span)[0]

    made, milliseconds = _timed(work)
    shares, hours = random.random((PLACES, 1)), random.integers(0, 24 * days, PLACES)
    steps = np.linspace(0.0, 1.0, made.places.shape[1])
    column, row = (
        np.interp(part, steps, made.places[0, :, channel]) * made.coordinates.shape[1 - channel]
        for channel, part in enumerate((shares[:, 0], hours / (24.0 * days)))
    )
    errors = _errors(skin, _sampled(made.coordinates, column, row), [received], shares, hours)
    _print(name, milliseconds, errors, str(made.coordinates.shape[:2]))


def _report_basis(
    random, skin: Skin, received: Sequence[Doses], shares: NDArray, name: str, day: int | None
) -> None:
    """All days of an exact basis, or the one that shows while dragging."""
    span: dict[str, Any] = {
        "first_day": 0.0,
        "last_day": float(DAYS),
        "mmd": skin.mmd,
        "med": skin.med,
    }

    def work():
        if day is None:
            made = basis.basis(received, skin.dynamics, **span)[0]
        else:
            made = day_basis.day_basis(received, skin.dynamics, float(day), ROOM, **span)[0]
        images = grid.images_of(made.coefficients)
        return made, images, grid.places_among(made.knots, made.weights)

    (made, images, places), milliseconds = _timed(work)
    hours = random.integers(0, 24 * DAYS, PLACES) if day is None else np.full(PLACES, 24 * day)
    for where, faces, weights in _places(random):
        between = np.clip(np.einsum("nk,nkm->nm", weights, shares[faces]), 0.0, 1.0)
        part = basis.rows_at(made, hours / 24.0)[1]
        told = places, between, part, made.parts
        seen = basis.shown(made, grid.coefficients_at(images, *told), hours / 24.0)
        errors = _errors(skin, seen, received, between, hours)
        size = f"{len(images)} images {images[0].shape[:2]}"
        _print(f"{name}, {where}", milliseconds, errors, size)


def _places(random) -> tuple[tuple[str, NDArray, NDArray], ...]:
    """Vertices and points in faces: points of a face (places, 3), and their weights."""
    corners = random.integers(0, SIDE - 1, (PLACES, 2)) @ [SIDE, 1]
    faces = corners[:, None] + [0, 1, SIDE]
    inside = random.dirichlet(np.ones(3), PLACES)
    return ("vertices", faces, np.eye(3)[:1].repeat(PLACES, 0)), ("in faces", faces, inside)


def _doses(random, count: int, days: int, skin: Skin) -> list[Doses]:
    hours = random.integers(0, 20 * days, count)
    return [of_sed(int(hour), skin.mmd * random.uniform(0.35, 10.5)) for hour in hours]


def _soft_masks(random, masks: int) -> NDArray[np.float64]:
    """Shares (points, masks) of blobs with soft edges."""
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    shares = []
    for _ in range(masks):
        waves, phases = random.normal(0.0, 10.0, (4, 2)), random.uniform(0.0, 2.0 * np.pi, 4)
        height = np.sin(
            waves[:, 0, None, None] * x + waves[:, 1, None, None] * y + phases[:, None, None]
        )
        across = height.sum(axis=0)
        distance = across / np.maximum(np.hypot(*np.gradient(across)), 1e-3)
        part = np.clip(distance / SOFT + 0.5, 0.0, 1.0)
        shares.append((part * part * (3.0 - 2.0 * part)).ravel())
    return np.stack(shares, axis=1)


def _errors(
    skin: Skin, seen: NDArray, received: Sequence[Doses], shares: NDArray, hours: NDArray
) -> NDArray[np.float64]:
    """CIEDE2000 (N,) of coordinates against simulating every place by the hour."""
    mask = np.repeat(np.arange(len(received)), [own.hours.size for own in received])
    doses = shares[:, mask] * np.concatenate([own.melanogenesis for own in received])
    when = np.concatenate([own.hours for own in received])
    exact = np.empty((len(shares), 4))
    for some in np.array_split(np.arange(len(shares)), max(len(shares) // 200, 1)):
        times, which = np.unique(hours[some], return_inverse=True)
        states = states_at(
            Exposures(when, doses[some]), skin.dynamics, times=times, mmd=skin.mmd, med=skin.med
        )
        exact[some] = states[np.arange(len(some)), which]
    expected = np.stack([np.log(exact[:, :3].sum(axis=1)), np.log(exact[:, 3])], axis=1)
    spread = spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med)
    return ciede2000(_lab(spread, seen[:, :2]), _lab(spread, expected))


def _lab(spread: Spread, coordinates: NDArray) -> NDArray[np.float64]:
    table = catalogue.table(catalogue.shipped_path(TYPE))
    return lab(table.plane(COLOUR, spread.states(*coordinates.T)))


def _sampled(image: NDArray, column: NDArray, row: NDArray) -> NDArray[np.float64]:
    """An image (rows, columns, 3) at places in texels, linear between their centres."""
    x, y = (
        np.clip(place - 0.5, 0.0, size - 1.0)
        for place, size in ((column, image.shape[1]), (row, image.shape[0]))
    )
    left, low = (
        np.minimum(p.astype(int), n - 2) for p, n in ((x, image.shape[1]), (y, image.shape[0]))
    )
    x, y = (x - left)[:, None], (y - low)[:, None]
    lower = image[low, left] * (1.0 - x) + image[low, left + 1] * x
    upper = image[low + 1, left] * (1.0 - x) + image[low + 1, left + 1] * x
    return lower * (1.0 - y) + upper * y


def _timed(work: Callable):
    """What work gives, and the median of its CPU milliseconds; the first run is not counted."""
    made = work()
    spent = []
    for _ in range(REPEATS):
        start = time.process_time()
        made = work()
        spent.append(1e3 * (time.process_time() - start))
    return made, float(np.median(spent))


def _print(name: str, milliseconds: float, errors: NDArray, size: str) -> None:
    numbers = f"{errors.mean():.3f}  {np.quantile(errors, 0.99):.2f}  {errors.max():.2f}"
    print(f"{name:<48} {milliseconds:>8.1f} ms  {numbers}  {size}", flush=True)


if __name__ == "__main__":
    argparse.ArgumentParser("python -m examples.bench_history", description=__doc__).parse_args()
    main()
