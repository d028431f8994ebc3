"""Specimens found again from their own light, and what light does not tell of them."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.adding import solve
from hylios.commands.cli import main
from hylios.errors import InputError
from hylios.lab import fit
from hylios.lab.colour import linear_rec709, srgb
from hylios.lab.fit import fit_colour, fit_spectrum
from hylios.lab.free_parameters import GROUPS, USUAL, scaled
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import SPECIMENS, parameters
from hylios.skin.specimen_file import read_specimen
from hylios.tissue import Stack
from hylios.transport.melanosome_paths import with_survival

S3 = SPECIMENS["S3"]
VISIBLE = np.arange(400.0, 701.0, 20.0)


def light(specimen, wavelengths=VISIBLE):
    return solve(
        [with_survival(Stack.of(specimen, wavelength)) for wavelength in wavelengths]
    ).total


def test_what_made_a_spectrum_is_found_again():
    names, factors = ("melanin", "blood", "oxygenation", "hypodermis"), (1.6, 2.0, 0.8, 0.9)
    fit = fit_spectrum(S3, VISIBLE, light(scaled(S3, names, np.array(factors))), free=names)
    assert fit.rmse < 1e-3  # not 0: each unknown is drawn a little to its start
    determined = [group.name for group in fit.free if group.determined]
    assert determined[::2] == ["melanin", "hypodermis"]
    for group, factor in zip(fit.free, factors, strict=True):
        assert abs(np.log(group.factor / factor)) < min(group.spread, 0.1), group.name
    oxygenation = fit.free[2].factor
    assert fit.specimen.oxygenated_blood == pytest.approx(oxygenation * S3.oxygenated_blood)


def test_noise_moves_an_unknown_by_its_stated_spread():
    """Ten drawings of normal noise; 7 of 10 within one spread are expected.

    Fewer than 3 or more than ten times as near come by chance in one of 600 runs; the seed is
    fixed.
    """
    random = np.random.default_rng(5)
    names = ("melanin", "hypodermis")
    start = replace(S3, hypodermis_reflectance=80.0)
    clean = light(start)
    off = []
    for _ in range(10):
        noisy = clean + random.normal(0.0, 0.01, clean.size)
        fit = fit_spectrum(start, VISIBLE, noisy, free=names)
        off.append([np.log(group.factor) / group.spread for group in fit.free])
    near = np.mean(np.abs(off) < 1.0, axis=0)
    assert np.all(near >= 0.3)
    assert np.all(np.abs(off) < 4.5)


def test_a_colour_is_met_and_leaves_the_rest_open():
    aim = scaled(S3, ("melanin", "blood"), np.array([2.0, 1.5]))
    wanted = srgb(linear_rec709(VISIBLE, light(aim)))
    fit = fit_colour(S3, wanted)
    assert np.linalg.norm(fit.residual) < 1.0
    groups = {group.name: group for group in fit.free}
    assert groups["water"].left > 0.9 and not groups["water"].determined
    assert groups["melanin"].left < 0.5
    assert any("water is not determined" in line for line in fit.remarks())
    assert fit.specimen.reticular_water == pytest.approx(S3.reticular_water, rel=0.05)


@pytest.mark.slow
def test_every_group_stays_within_physiology():
    fit = fit_spectrum(S3, VISIBLE[::2], np.full(8, 0.95))
    for name in (parameter.name for parameter in parameters()):
        low, high = PHYSIOLOGY[name].low, PHYSIOLOGY[name].high
        value = getattr(fit.specimen, name)
        assert min(low, getattr(S3, name)) * 0.999 <= value <= high * 1.001, name
    assert any("end of its physiological range" in line for line in fit.remarks())


def test_melanin_and_the_layer_that_holds_it_are_told_apart_badly():
    fit = fit_spectrum(S3, VISIBLE, light(S3), free=("melanin", "epidermis", "blood"))
    assert ("epidermis", "melanin") in [pair[:2] for pair in fit.confounded]
    assert any("told apart badly" in line for line in fit.remarks())


@pytest.mark.parametrize(
    ("free", "sentence"),
    [
        (("melanin", "gold"), "there is nothing called 'gold' to fit"),
        (("melanin", "melanosomes"), "allowed is no parameter twice"),
        (("blood", "blood"), "allowed is no parameter twice"),
        ((), "nothing is free"),
    ],
)
def test_what_cannot_be_fitted_is_refused(free, sentence):
    with pytest.raises(InputError, match=sentence):
        fit_spectrum(S3, VISIBLE, light(S3), free=free)


def test_nothing_cannot_be_scaled():
    bloodless = replace(S3, papillary_blood=0.0, reticular_blood=0.0)
    with pytest.raises(InputError, match="blood is 0 at the start"):
        fit_spectrum(bloodless, VISIBLE, light(S3))


def test_groups_name_parameters():
    names = {parameter.name for parameter in parameters()}
    assert all(set(fields) <= names for fields in GROUPS.values())
    assert set(USUAL) <= set(GROUPS)


def test_the_command_prints_a_specimen(capsys, tmp_path):
    spectrum = tmp_path / "arm.csv"
    aim = light(scaled(S3, ("melanin",), np.array([1.5])))
    rows = [f"{w:g},{r:.6f}" for w, r in zip(VISIBLE, aim, strict=True)]
    spectrum.write_text("\n".join(["# an arm", *rows]), encoding="utf-8")
    assert main(["fit", "--spectrum", str(spectrum), "--free", "melanin,blood"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("# Fitted to arm, total, at 16 wavelengths: root mean square error")
    fitted = tmp_path / "arm.toml"
    fitted.write_text(printed, encoding="utf-8")
    assert read_specimen(fitted).pigmentation == pytest.approx(1.5 * S3.pigmentation, rel=0.02)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--srgb", "300,0,0"], "allowed are three numbers from 0 to 255"),
        (["--srgb", "1,2"], "allowed are three numbers from 0 to 255"),
        (["--srgb", "200,160,130", "--free", "gold"], "nothing called 'gold'"),
        (["--srgb", "200,160,130", "--angle", "95"], "angle of incidence is 95"),
        (["--spectrum", "none.csv"], "cannot be read"),
    ],
)
def test_the_command_refuses_with_one_sentence(capsys, arguments, sentence):
    assert main(["fit", *arguments]) == 2
    said = capsys.readouterr().err
    assert sentence in said and said.count("\n") == 1


@pytest.mark.parametrize(
    ("wavelengths", "reflectance", "sentence"),
    [
        ([], [], "have shapes"),
        ([500.0, 600.0], [0.5], "have shapes"),
        ([500.0], 0.5, "have shapes"),
        ([[500.0]], [[0.5]], "have shapes"),
        ([500.0], [np.nan], "a reflectance to fit is nan; allowed is 0 to 1"),
        ([500.0], [-0.1], "a reflectance to fit is -0.1; allowed is 0 to 1"),
    ],
)
def test_arrays_that_are_no_spectrum_are_refused(wavelengths, reflectance, sentence):
    with pytest.raises(InputError, match=sentence):
        fit_spectrum(S3, np.array(wavelengths), np.array(reflectance))


@pytest.mark.parametrize("colour", [[0.5, 0.5], [[0.5, 0.5, 0.5]], [np.nan, 0, 0], [200, 160, 140]])
def test_arrays_that_are_no_colour_are_refused(colour):
    with pytest.raises(InputError, match="colour to fit"):
        fit_colour(S3, np.array(colour))


def test_a_fit_in_parts_tells_how_far_it_is_and_ends_alike(monkeypatch):
    """Memory is bounded by the wavelengths solved at once; that changes numbers by rounding only.

    By not even that where numpy and OpenBLAS have wide registers, by 1e-11 where they have none.
    """
    wavelengths = np.arange(450.0, 651.0, 50.0)
    reflectance = np.linspace(0.2, 0.5, wavelengths.size)
    results, told = [], []
    for together in (fit.SOLVED_TOGETHER, 3):
        monkeypatch.setattr(fit, "SOLVED_TOGETHER", together)
        told.append([])
        results.append(
            fit_spectrum(
                SPECIMENS["S3"], wavelengths, reflectance, free=["melanin"], advance=told[-1].append
            )
        )
    for parameter in parameters():
        first, second = (getattr(result.specimen, parameter.name) for result in results)
        assert first == pytest.approx(second, rel=1e-9)
    assert results[0].observed == pytest.approx(results[1].observed, rel=1e-9)
    solved = (results[0].evaluations + 1) * wavelengths.size
    assert sum(told[0]) == sum(told[1]) == solved
    assert max(told[1]) <= 3
