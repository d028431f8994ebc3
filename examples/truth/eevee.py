"""EEVEE beside Cycles, by region, on skin that half is lit, without the lamp's reflection in it."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth.edge import COLUMNS, LINES
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from examples.truth.stages import EDGE_WIDTH
from hylios.lab.colour import difference

CASES = (("II", "untanned"), ("III", "dark"), ("VI", "untanned"))
SAMPLES = {"CYCLES": 256, "BLENDER_EEVEE": 32}
CLEAR = 3.0
"""Millimetres from the edge of the light at which the regions begin."""

LIT = (None, 1.0)


def shots() -> list[Shot]:
    """A few skins with both engines."""
    return [
        Shot(
            _name(skin, tan, engine),
            "edge",
            skin,
            tan,
            gloss=False,
            size=(COLUMNS, LINES),
            samples=samples,
            engine=engine,
        )
        for skin, tan in CASES
        for engine, samples in SAMPLES.items()
    ]


def _name(skin: str, tan: str, engine: str) -> str:
    return f"{engine.lower()} {skin} {tan}"


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare the engines."""
    places = 1000.0 * EDGE_WIDTH * ((np.arange(COLUMNS) + 0.5) / COLUMNS - 0.5)
    rows, readings = [], []
    for region, inside, allowed in (
        ("lit", places > CLEAR, LIT),
        ("at the edge", np.abs(places) <= CLEAR, (None, None)),
        ("in the dark", places < -CLEAR, (None, None)),
    ):
        some = []
        for skin, tan in CASES:
            cycles, eevee = (
                lights[_name(skin, tan, engine)]["combined"].mean(axis=0)[inside]
                for engine in SAMPLES
            )
            case = f"{region}, {skin} {tan}"
            apart = difference(eevee, cycles)
            some.append(Reading("eevee", case, eevee, cycles, apart, places[inside]))
        rows.append(Row.of(some, f"EEVEE from Cycles, {region}", allowed))
        readings += some
    return Outcome(rows, readings)
