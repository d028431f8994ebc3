"""Time against error of tables, over all that can be traded.

Colour and profile are separate work with separate errors, so each is measured by itself, over the
settings that matter to it, and a table's point is put together from the two. Errors are against a
fine solution at reachable states that are no knots.

Two things are not measured for every combination:

- Another number of the solver's directions shifts a reflectance by an amount that hardly depends on
  the state. So the shift is measured at the states looked up and added there; on the coarsest
  tables that misses the largest error by 2 %.
- A profile that would take too long follows from the same table's less accurate ones
  (`table_errors.completed`).
"""

import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

from hylios.skin import Skin
from lut_builder.settings import BANDS_NM, Settings
from lut_builder.trade.extent import FULL, Extent, between_knots
from lut_builder.trade.pareto import front
from lut_builder.trade.parts import (
    Row,
    colour_parts,
    component_parts,
    file_parts,
    profile_parts,
    solver_parts,
)
from lut_builder.trade.points import Point
from lut_builder.trade.profiles import FineProfiles
from lut_builder.trade.solving import Cost
from lut_builder.trade.steps import planned
from lut_builder.trade.table_errors import (
    ColourError,
    ProfileError,
    colour_errors,
    completed,
    noise_share,
)


@dataclass(frozen=True)
class Trade:
    """What was measured.

    Attributes
    ----------
    points : list of Point
        All tables.
    parts : list of Row
        What each thing that can be traded does by itself.
    """

    points: list[Point]
    parts: list[Row]

    @property
    def front(self) -> list[Point]:
        """The tables that no other beats in time and error."""
        return front(self.points)


def measure(
    skin: Skin,
    extent: Extent = FULL,
    *,
    seed: int = 1,
    begin: Callable[[float], Callable[[float], object]] | None = None,
) -> Trade:
    """Measure all that `extent` names, for a skin, on one core.

    Parameters
    ----------
    begin : callable, optional
        Told the seconds of all; what it returns is told those of each step as it ends.
    """
    states = between_knots(skin, extent.states, seed)
    steps = planned(skin, extent, states, seed)
    progress = begin(sum(size for size, _ in steps.values())) if begin else None
    measured: dict[Any, Any] = {}
    for name, (size, work) in steps.items():
        measured[name] = work()
        if progress:
            progress(size)
    colour = colour_errors(skin, extent, states, measured)
    fine: FineProfiles = measured["profile fine"]
    profile = {}
    for count in extent.profile_wavelengths:
        runs = {number: measured["profile", number, count] for number in extent.design_states}
        noise = noise_share(list(runs.values()), fine.spreads)
        for number, walked in runs.items():
            profile[number, count] = completed(walked, fine, extent.profile_errors, noise)
    return Trade(
        points=_points(measured, colour, profile),
        parts=[
            *colour_parts(extent, measured, colour),
            *solver_parts(extent, measured),
            *profile_parts(profile, fine.misfits),
            *file_parts(*measured["half"]),
            *component_parts(measured["broad"]),
        ],
    )


def notes(skins: Sequence[Skin], extent: Extent) -> list[str]:
    """The machine, day and skins of a measurement."""
    names = "; ".join(f"{skin.specimen.name}, pigmentation {skin.pigmentation}" for skin in skins)
    several = ": of each table the slowest and least accurate" if len(skins) > 1 else ""
    return [
        f"lut-builder trade, {date.today().isoformat()}: seconds are of this machine's processor",
        f"machine: {_processor()}, Python {platform.python_version()}, numpy {np.__version__}",
        f"skin: {names}{several}",
        f"errors: at {extent.states} reachable states that are no knots, "
        f"{extent.profile_states} of them for profiles; tables have {len(BANDS_NM)} single bands",
    ]


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.processor() or platform.machine()


def _points(
    measured: dict[Any, Any],
    colour: dict[Any, ColourError],
    profile: dict[Any, list[ProfileError]],
) -> list[Point]:
    """All tables, with each profile and without."""
    points = []
    for (knots, kind, count, nodes), seen in colour.items():
        settings = Settings(knots, count, profile_error=0.0, nodes=nodes, interpolation=kind)
        cost: Cost = measured["cost", nodes]
        without = Point(
            settings,
            shared_seconds=cost.seconds(settings.states, count + len(BANDS_NM)),
            serial_seconds=0.0,
            start_seconds=measured["start without profile"],
            delta_e_mean=seen.mean,
            delta_e_largest=seen.largest,
            band_rmse=seen.bands,
        )
        points.append(without)
        for (states, wavelengths), errors in profile.items():
            walked = replace(settings, profile_states=states, profile_wavelengths=wavelengths)
            points += [_with_profile(without, walked, error, measured["start"]) for error in errors]
    return points


def _with_profile(without: Point, walked: Settings, profile: ProfileError, start: float) -> Point:
    """A table with a profile besides."""
    return replace(
        without,
        settings=replace(walked, profile_error=profile.error),
        shared_seconds=without.shared_seconds + profile.shared,
        serial_seconds=profile.serial,
        start_seconds=start,
        profile_rms=profile.rms,
        profile_largest=profile.largest,
        profile_lightness=profile.lightness,
    )
