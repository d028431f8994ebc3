"""Skin types I to VI: fitted to people, within physiology, and tanning as people do."""

import re
import tomllib
from dataclasses import asdict, fields, replace
from pathlib import Path

import numpy as np
import pytest

from hylios.adding import spectrum
from hylios.errors import InputError
from hylios.lab import phototype_fits as fitting
from hylios.lab.colour import difference, linear_rec709
from hylios.skin import Skin, varied
from hylios.skin.phototypes import PHOTOTYPES, named_specimen, phototype
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import SPECIMENS, Specimen, parameters, specimen_of
from hylios.tanning import PIGMENTATIONS, Exposures, TanningHistory

VISIBLE = np.arange(400.0, 701.0, 20.0)
ULTRAVIOLET = np.arange(300.0, 381.0, 20.0)
TANNING = PHOTOTYPES[1:]
MULTIPLES = (1.0, 2.0, 5.0, 10.0)
SED = 30.0
DAYS = 45


def seen(specimen: Specimen) -> np.ndarray:
    return linear_rec709(VISIBLE, spectrum(specimen, VISIBLE).total)


def after(skin: Skin, *doses: float) -> TanningHistory:
    """Histories after single doses in SED, one each."""
    return skin.history(Exposures([0], np.array(doses)[:, None]), 24 * DAYS)


def largest_change(skin: Skin, history: TanningHistory, index: int = 0) -> float:
    """Largest CIEDE2000 from the untanned skin, looked at every second day of 30."""
    days = 24 * np.arange(2, 31, 2)
    states = history.states[index][days]
    tans = np.array([seen(skin.at(state)) for state in states])
    return float(difference(tans, seen(skin.specimen)).max())


@pytest.mark.parametrize("name", PHOTOTYPES)
def test_each_type_reflects_as_its_people_do(name):
    """RMSE .015 and CIEDE2000 3 at most, from the light model itself; and the file says it."""
    kind = phototype(name)
    wavelengths, measured = kind.people.wavelengths, kind.people.reflectance
    assert (wavelengths[0], wavelengths[-1], wavelengths.size) == (400.0, 700.0, 31)
    reflectance = spectrum(kind.skin.specimen, wavelengths, angle=8.0).total
    rmse = np.sqrt(np.mean((reflectance - measured) ** 2))
    apart = difference(
        linear_rec709(wavelengths, reflectance), linear_rec709(wavelengths, measured)
    )
    assert rmse <= 0.015 and apart <= 3.0
    assert kind.rmse == pytest.approx(rmse, abs=1e-4)
    assert kind.ciede2000 == pytest.approx(apart, abs=0.01)


def test_people_are_the_six_classes_in_order():
    people = [phototype(name).people for name in PHOTOTYPES]
    assert [group.subjects for group in people] == [79, 408, 578, 458, 159, 8]
    assert people[0].reflectance[0] == 0.2338 and people[5].reflectance[-1] == 0.2451


@pytest.mark.parametrize("name", PHOTOTYPES)
def test_parameters_are_physiological_and_none_is_at_an_end_by_the_fit(name):
    specimen = phototype(name).skin.specimen
    assert specimen_of(asdict(specimen)) == specimen
    for field in fitting.FITTED:
        usual, value = PHYSIOLOGY[field], getattr(specimen, field)
        assert usual.low < value < usual.high
    for parameter in parameters():
        assert PHYSIOLOGY[parameter.name].holds(getattr(specimen, parameter.name))


def test_reflectance_falls_from_type_to_type_at_every_wavelength():
    wavelengths = np.arange(400.0, 701.0, 5.0)
    spectra = [spectrum(named_specimen(name), wavelengths).total for name in PHOTOTYPES]
    assert np.all(np.diff(spectra, axis=0) < 0.0)


def test_melanin_and_minimal_doses_rise_from_type_to_type():
    skins = [phototype(name).skin for name in PHOTOTYPES]
    for values in (
        [skin.specimen.pigmentation for skin in skins],
        [skin.mmd for skin in skins],
        [skin.med for skin in skins],
    ):
        assert np.all(np.diff(values) > 0.0)
    # Equation 3.1 by hand, and published: 15-30, 25-40, 30-50, 40-60, 60-90, 90-150 mJ/cm2
    # (D'Orazio et al. 2013), of which V just misses the lower end.
    assert skins[5].med == pytest.approx(2.1973 * np.exp(7.4043 * skins[5].specimen.pigmentation))
    published = [(1.5, 3.0), (2.5, 4.0), (3.0, 5.0), (4.0, 6.0), (5.8, 9.0), (9.0, 15.0)]
    for skin, (low, high) in zip(skins, published, strict=True):
        assert low < skin.med < high


@pytest.mark.parametrize("name", PHOTOTYPES)
def test_a_type_without_sun_is_its_specimen(name):
    """5.16 as printed, at the steady state of the type's dynamics."""
    skin = phototype(name).skin
    steady = skin.dynamics.steady_state()
    bare = skin.at([*(steady / steady.sum()), 1.0])
    for field in fields(Specimen):
        value = getattr(skin.specimen, field.name)
        expected = value if isinstance(value, str) else pytest.approx(value, rel=1e-12)
        assert getattr(bare, field.name) == expected


def test_each_type_tans_by_its_set():
    """By the thesis I to IV are of the low set; what differs from the sets is a guess."""
    sets = [phototype(name).skin.pigmentation for name in PHOTOTYPES]
    assert sets == ["low", "low", "low", "low", "intermediate", "high"]
    for name in PHOTOTYPES:
        kind = phototype(name)
        assert kind.guesses
        assert bool(kind.tanning) == (kind.skin.dynamics != PIGMENTATIONS[kind.skin.pigmentation])
    low = PIGMENTATIONS["low"]
    ability = [phototype(name).skin.dynamics.extra_production[0] for name in ("II", "III", "IV")]
    assert ability[0] == low.extra_production[0] and np.all(np.diff(ability) > 0.0)
    assert ability[-1] < 0.0858


def test_type_1_makes_no_melanin_but_thickens():
    """Thickening alone moves its colour by 1.2 CIEDE2000 after 30 SED."""
    skin = phototype("I").skin
    history = after(skin, SED, 1e6)
    assert history.total == pytest.approx(1.0, abs=1e-12)
    assert history.thickness.max() > 1.1
    assert 1.0 < largest_change(skin, history) < 1.5


@pytest.mark.slow
def test_darker_skin_needs_more_sun_for_the_first_visible_change():
    """The least dose whose largest change reaches 1 CIEDE2000, from 0.98 to 1.05 MMD in each type,
    rises from II to VI."""
    first = []
    for name in TANNING:
        skin = phototype(name).skin
        bracket = 0.98 * skin.mmd, 1.05 * skin.mmd
        below, above = (largest_change(skin, after(skin, dose)) for dose in bracket)
        assert below < 1.0 <= above
        first.append(bracket)
    for (_, lighter), (darker, _) in zip(first[:-1], first[1:], strict=True):
        assert lighter < darker


def test_darker_skin_gains_more_at_equal_multiples_of_the_mmd():
    """Melanin content of the epidermis gained at the peak, as a volume fraction."""
    gained = []
    for name in PHOTOTYPES:
        skin = phototype(name).skin
        peaks = after(skin, *(multiple * skin.mmd for multiple in MULTIPLES)).total.max(axis=1)
        gained.append(skin.specimen.pigmentation * (peaks - 1.0))
    assert np.all(np.diff(gained, axis=0) > 0.0)


@pytest.mark.parametrize("name", TANNING)
def test_a_tan_comes_fast_stays_and_fades_slowly(name):
    """Half of it is there within four days, nine tenths of it for a week, and half of it is left
    more than twelve days after the peak."""
    gained = after(phototype(name).skin, SED).total[0] - 1.0
    peak = gained.argmax()
    half, top = (np.flatnonzero(gained >= share * gained.max()) for share in (0.5, 0.9))
    assert half[0] < 24 * 4
    assert top.size > 24 * 7
    assert half[-1] - peak > 24 * 12
    assert half[-1] - peak > 1.5 * (peak - half[0])
    assert np.all(np.diff(gained[peak:]) <= 0.0)


def test_reflectance_in_the_ultraviolet_converges_with_melanin():
    """From 300 to 380 nm: tanned types lie nearer to each other than untanned ones, and each
    further melanin changes less than the melanin before."""
    untanned, tans, steps = [], [], []
    for name in TANNING:
        skin = phototype(name).skin
        history = after(skin, 5.0 * skin.mmd)
        state = history.states[0][history.total[0].argmax()]
        untanned.append(spectrum(skin.specimen, ULTRAVIOLET).total)
        tans.append(spectrum(skin.at(state), ULTRAVIOLET).total)
        more = [skin.at([*(factor * skin.untanned_melanin), 1.0]) for factor in (1.0, 2.0, 3.0)]
        steps.append(
            np.abs(np.diff([spectrum(specimen, ULTRAVIOLET).total for specimen in more], axis=0))
        )
    assert np.all(np.ptp(tans, axis=0) < 0.65 * np.ptp(untanned, axis=0))
    first, second = np.mean(steps, axis=-1).T
    lightest = slice(0, 3)  # in V and VI both are below .006 of reflectance
    assert np.all(second[lightest] < 0.7 * first[lightest])
    assert max(first[3:].max(), second[3:].max()) < 0.006


@pytest.mark.parametrize("name", PHOTOTYPES)
def test_no_tan_of_a_type_overfills_a_layer(name):
    """Ten MMD on each of 30 days."""
    skin = phototype(name).skin
    sun = Exposures(24 * np.arange(30), np.full(30, 10.0 * skin.mmd))
    history = skin.history(sun, 24 * DAYS)
    assert not any(skin.overfull(state) for state in history.states)
    assert history.total.max() < 2.6


def test_the_thesis_ability_all_but_fills_the_granulosum_of_type_4():
    """As `types.toml` says of 0.0858 in type IV after 30 SED; no layer is cut."""
    usual = phototype("IV").skin
    able = replace(usual, dynamics=varied(usual.dynamics, {"basale_extra_production": 0.0858}))
    history = after(able, SED)
    assert history.total.max() == pytest.approx(7.2, abs=0.1)
    held = [able.at(state).melanin for state in history.states[0]]
    assert np.max(held, axis=0) == pytest.approx([0.36, 0.50, 0.93], abs=0.01)
    assert not any(able.overfull(state) for state in history.states[0])


def assert_fitted_as_the_file_says(name):
    fit = fitting.fitted(name)
    assert not any(parameter.at_bound for parameter in fit.free)
    kept = phototype(name).skin.specimen
    assert kept.pigmentation == pytest.approx(fit.specimen.pigmentation, rel=2e-3)
    for field in fitting.FITTED:
        assert getattr(kept, field) == pytest.approx(getattr(fit.specimen, field), rel=5e-3)
    written = tomllib.loads(fitting.as_toml(name, fit))[name]
    assert written["rmse"] == pytest.approx(phototype(name).rmse, abs=1.1e-4)


def test_a_type_fitted_anew_is_the_type():
    assert_fitted_as_the_file_says("III")


@pytest.mark.slow
@pytest.mark.parametrize("name", PHOTOTYPES)
def test_all_types_fitted_anew_are_the_types(name):
    assert_fitted_as_the_file_says(name)


def test_fitting_writes_the_file_whole(tmp_path, monkeypatch):
    """Beside its target, moved there, twice the same; types that are fitted are not asked for."""
    once = fitting.fitted("I")
    monkeypatch.setattr(fitting, "fitted", lambda name: once)
    monkeypatch.setattr(fitting, "TARGET", tmp_path / "fitted.toml")
    assert fitting.main() == 0
    text = (tmp_path / "fitted.toml").read_text()
    assert list(tomllib.loads(text)) == list(PHOTOTYPES)
    assert fitting.main() == 0
    assert (tmp_path / "fitted.toml").read_text() == text
    assert [path.name for path in tmp_path.iterdir()] == ["fitted.toml"]


def test_the_page_of_skin_types_has_them_as_they_are():
    page = (Path(__file__).parents[3] / "docs" / "skin_types.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (I|II|III|IV|V|VI) \|(.*)\|$", page, re.MULTILINE)
    assert [name for name, _ in rows] == list(PHOTOTYPES)
    for name, text in rows:
        people, subjects, rmse, apart, pigmentation, mmd, med = map(str.strip, text.split("|"))
        kind = phototype(name)
        assert people.replace(" ", "_") == kind.people.name
        assert int(subjects) == kind.people.subjects
        assert (float(rmse), float(apart)) == (kind.rmse, kind.ciede2000)
        assert pigmentation.startswith(kind.skin.pigmentation)
        assert (mmd, med) == (f"{kind.skin.mmd:.1f}", f"{kind.skin.med:.1f}")


def test_names_that_are_none_are_refused():
    assert named_specimen("S3") == SPECIMENS["S3"]
    with pytest.raises(InputError, match="there is no skin type 'VII'; there are I, II, III, IV"):
        phototype("VII")
    with pytest.raises(InputError, match="there is no specimen 'VII'; there are S1, S2, S3, S4, I"):
        named_specimen("VII")
