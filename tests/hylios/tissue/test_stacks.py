"""Many stacks at once are those made one by one."""

from dataclasses import replace

import numpy as np
import pytest

import hylios
from hylios.adding import solve, spectra
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.tissue import Model, Stack
from hylios.tissue.stacks import joined, some_of, stacks_of

NM = np.array([300.0, 450.0, 550.0, 650.0, 1200.0])


def numbers(stack: Stack) -> list:
    own = [value for name, value in vars(stack).items() if name != "layers"]
    layers = [value for layer in stack.layers for value in vars(layer).values()]
    return [np.asarray(value) for value in own + layers if np.asarray(value).dtype == float]


@pytest.mark.parametrize(
    "readings",
    [
        {},
        {"colloidal_melanin": "solid", "complex_content": "packed", "rayleigh": "every_collision"},
    ],
)
def test_many_are_those_made_one_by_one(readings):
    model, skin = Model(readings=readings), hylios.skin_type("III")
    states = np.array([[0.2, 0.5, 0.3, 1.0, 1.0], [0.4, 0.9, 0.6, 1.2, 3.0]])
    specimens = [skin.at(state) for state in states]
    many = stacks_of(specimens, NM, model)
    single = joined([Stack.of(one, nm, model) for one in specimens for nm in NM.tolist()])
    for own, other in zip(numbers(many), numbers(single), strict=True):
        np.testing.assert_allclose(own, other, rtol=1e-14, atol=0.0)
    last = some_of(many, np.array([9]))
    assert last.layers[2].thickness == pytest.approx(many.layers[2].thickness[9])


@pytest.mark.parametrize("film", [None, (None, 1.33)])
def test_light_is_that_of_stacks_one_by_one(film):
    specimens = [*SPECIMENS.values(), hylios.skin_type("V").specimen]
    together = spectra(specimens, NM, angle=(8.0, 60.0), film=film)
    for number, specimen in enumerate(specimens):
        alone = solve([Stack.of(specimen, nm) for nm in NM.tolist()], (8.0, 60.0), film=film)
        for name in ("surface", "subsurface", "transmittance"):
            np.testing.assert_allclose(
                getattr(together, name)[..., number, :], getattr(alone, name), rtol=0.0, atol=1e-12
            )


def test_no_specimens_have_no_light():
    assert spectra([], NM).total.shape == (0, 5)
    assert solve([]).total.shape == (0,)


def test_one_that_cannot_be_made_is_told_as_alone():
    thin = replace(SPECIMENS["S1"], name="thin", basale_thickness=1e-7)
    with pytest.raises(InputError) as alone:
        Stack.of(thin, 450.0)
    with pytest.raises(InputError) as together:
        stacks_of([SPECIMENS["S1"], thin], NM)
    assert str(together.value) == str(alone.value)


def test_melanosomes_arranged_differently_are_refused():
    with pytest.raises(InputError, match="complexes, individual"):
        stacks_of([SPECIMENS["S1"], SPECIMENS["S4"]], NM)
