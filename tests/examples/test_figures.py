"""The thesis's figures: what is computed, compared and drawn."""

import subprocess
import sys

import numpy as np
import pytest

from examples.figures import __main__ as program
from examples.figures import (
    absorbers,
    compression,
    melanin_forms,
    principal_components,
    report,
    sensitivity,
    specimen_database,
)
from examples.figures.light import RANGE, Curve, Effort, noisy
from hylios.errors import InputError
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import published_spectra

RANDOM = np.random.default_rng(5)
SPECTRA = 0.3 + 0.1 * RANDOM.random((12, 3)) @ RANDOM.random((3, RANGE.size))
"""Twelve spectra that three components span."""


def flat(reflectance, rays=0):
    return Curve(RANGE, np.full(RANGE.size, reflectance), np.full(RANGE.size, 0.01), rays)


def test_a_name_chooses_its_group():
    assert program.groups_with([]) == list(program.GROUPS)
    assert program.groups_with(["D.3"]) == [compression]
    assert program.groups_with(["C", "A"]) == [absorbers, melanin_forms]
    assert program.groups_with(["table 6.3"]) == [sensitivity]
    with pytest.raises(InputError, match="no figure 'E'; there are A.1"):
        program.groups_with(["E"])
    with pytest.raises(InputError):
        program.groups_with(["6.1"])  # 6.13 is not 6.1


def test_every_figure_of_the_appendices_has_one_owner():
    named = [name for group in program.GROUPS for name in group.FIGURES]
    assert len(named) == len(set(named))
    for letter, count in (("A", 1), ("C", 5), ("D", 9)):
        assert {f"{letter}.{n}" for n in range(1, count + 1)} <= set(named)
    assert {"5.3", "table 6.3", "table D.1", *(f"6.{n}" for n in range(13, 19))} <= set(named)


def test_the_database_has_96_melanotic_and_48_amelanotic_specimens_within_the_ranges():
    skins = list(specimen_database.database().values())
    melanotic = [skin for skin in skins if skin.melanin.any()]
    assert [len(skins), len(melanotic)] == [144, 96]
    assert len({repr(skin).split(",", 1)[1] for skin in skins}) == 144
    for skin in skins:
        assert 0.225 - 1e-12 <= skin.papillary_blood == skin.reticular_blood <= 3.125
        waters = [getattr(skin, f"{layer}_water") for layer in specimen_database.WATERY]
        assert 26.25 <= min(waters) and max(waters) <= 93.75
        lipids = [getattr(skin, f"{layer}_lipids") for layer in specimen_database.FATTY]
        assert 11.32 <= min(lipids) and max(lipids) <= 25.0
    for skin in melanotic:
        assert 24.0 <= skin.eumelanin_concentration <= 62.5
        assert 1.5 <= skin.pheomelanin_concentration <= 5.0


def test_components_span_what_they_span():
    """As many components as the rank give the spectra back; fewer leave what SVD says."""
    assert np.allclose(principal_components.reconstructed(SPECTRA, 4), SPECTRA, atol=1e-12)
    singular = np.linalg.svd(SPECTRA, compute_uv=False)
    for count in (1, 2, 3):
        left = SPECTRA - principal_components.reconstructed(SPECTRA, count)
        assert np.linalg.norm(left) == pytest.approx(np.linalg.norm(singular[count:]), rel=1e-9)


def test_no_mean_is_subtracted():
    """Multiples of one curve need one component, which a centred analysis would not give 0."""
    shape = SPECTRA[:1]
    assert np.allclose(
        principal_components.reconstructed(np.vstack([shape, 2 * shape]), 1)[1], 2 * shape
    )


def test_piecewise_analysis_keeps_the_pieces_apart_and_in_order():
    pieces = principal_components.pieces()
    assert [int(piece.sum()) for piece in pieces] == [91, 140, 220]
    assert np.all(sum(piece.astype(int) for piece in pieces) == 1)
    again = principal_components.piecewise(SPECTRA, 2)
    for piece in pieces:
        assert np.array_equal(
            again[:, piece], principal_components.reconstructed(SPECTRA[:, piece], 2)
        )
    whole = principal_components.reconstructed(SPECTRA, 2)
    assert np.linalg.norm(SPECTRA - again) <= np.linalg.norm(SPECTRA - whole)


def test_components_needed_for_a_low_error():
    assert [compression.needed(row) for row in compression.PRINTED.values()] == [2, 3, 4]
    assert compression.needed([0.02] * 5) is None


def test_the_sensitivity_index_by_hand():
    """Two wavelengths: |0.2 - 0.4| / 0.4 and |0.5 - 0.4| / 0.5."""
    assert sensitivity.index(np.array([0.2, 0.5]), np.array([0.4, 0.4])) == pytest.approx(0.35)
    index = sensitivity.indices(flat(0.2), flat(0.4))
    assert index == pytest.approx({"UV": 0.5, "visible": 0.5, "IR": 0.5, "Hyper": 0.5})


def test_noise_alone_has_the_index_that_is_expected():
    """|difference| of two normal values of equal spread is 2/sqrt(pi) of it on average.

    1e4 rays, 451 wavelengths, 50 draws: the mean of 22550 values scatters by 0.5 %; 2.5 % are
    five times that, for the false alarm rate of 1 in 1e6 (max in the denominator moves 0.5 %).
    """
    curve = np.full(RANGE.size, 0.5)
    expected = 2.0 / np.sqrt(np.pi) * np.sqrt(0.25 / 10_000) / 0.5
    assert sensitivity.noisy_index(curve, curve, 10_000) == pytest.approx(expected, rel=0.025)


def test_each_material_is_removed_and_nothing_else():
    start = SPECIMENS["S3"]
    bloodless = sensitivity.without(start, "blood")
    assert (bloodless.papillary_blood, bloodless.reticular_blood) == (0.0, 0.0)
    assert bloodless.oxygenated_blood == start.oxygenated_blood
    assert not sensitivity.without(start, "melanin").melanin.any()
    dry = sensitivity.without(start, "water")
    assert [getattr(dry, f"{layer}_water") for layer in specimen_database.WATERY] == [0.0] * 4
    assert dry.corneum_lipids == start.corneum_lipids


def test_the_colloidal_case_keeps_the_melanin():
    for name in ("S3", "S4"):
        for case in ("baseline", "dispersion"):
            particles = melanin_forms.specimen(name, case)
            colloidal = melanin_forms.specimen(name, case, colloidal=True)
            assert np.allclose(particles.melanin, colloidal.melanin)
            assert colloidal.basale_melanosomes == 0.0
    assert melanin_forms.specimen("S3", "baseline") == SPECIMENS["S3"]
    assert melanin_forms.specimen("S4", "dispersion") == SPECIMENS["S4"]


def test_rows_become_a_table():
    rows = [
        report.relative("table 6.3", "DNA", 0.135, 0.0135, 0.15),
        report.claim("C.1", "sign", "higher", "+0.01", True),
    ]
    assert report.claim("C.1", "sign", "higher", "-0.01", np.False_).met is False
    lines = report.markdown(rows).splitlines()
    assert lines[2] == "| table 6.3 | DNA | 0.135 | 0.0135 (-90%) | none | within 15% | **no** |"
    assert lines[3] == "| C.1 | sign | higher | +0.01 | none | as printed | yes |"


def test_agreement_counts_standard_errors():
    row = report.agreement("C", "S3", flat(0.30), flat(0.32, rays=100))
    assert row.ours == "2.0 standard errors"


def test_estimates_are_told_from_measurements():
    """Eumelanin is measured to 820 nm; keratin nowhere."""
    eumelanin = published_spectra()["eumelanin"]
    assert np.array_equal(absorbers.estimated(eumelanin), eumelanin.wavelengths > 820.0)
    assert absorbers.estimated(published_spectra()["keratin"]).all()


def test_the_same_seed_draws_the_same_noise():
    curve = np.full(5, 0.5)
    assert np.array_equal(noisy(curve, 1000, 3), noisy(curve, 1000, 3))


def test_what_cannot_be_drawn_is_refused_in_a_sentence(tmp_path):
    ended = subprocess.run(
        [sys.executable, "-m", "examples.figures", "A", "--rays", "0", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 2
    assert ended.stderr == "error: number of rays is 0; allowed is 1 to 100000000.\n"


@pytest.mark.slow
def test_a_group_with_few_rays_leaves_pictures_and_rows(tmp_path, monkeypatch):
    monkeypatch.setattr(melanin_forms, "WAVELENGTHS", melanin_forms.CHECKED)
    effort = Effort(rays=50)
    work = {absorbers: absorbers.tasks(effort), melanin_forms: melanin_forms.tasks(effort)}
    results = program.computed(work)
    rows = [row for group in work for row in group.draw(results[group], tmp_path)]
    made = {path.name for path in tmp_path.iterdir()}
    assert made == {f"{name}.png" for group in work for name in group.FIGURES}
    assert all((tmp_path / name).read_bytes().startswith(b"\x89PNG") for name in made)
    assert {row.where for row in rows} >= {"A.1", "5.3", "C.1", "C.2", "C.3", "C.4", "C.5"}


@pytest.mark.slow
def test_compression_and_sensitivity_draw_all_their_figures(tmp_path):
    """From made-up spectra of four components: eight give them back, PPCA beats PCA."""
    random = np.random.default_rng(9)
    shapes = np.abs(np.cos(np.outer(np.arange(4.0), np.linspace(0.0, 3.0, RANGE.size))))
    spectra = {
        name: Curve(RANGE, 0.2 * random.random(4) @ shapes, np.zeros(RANGE.size), 0)
        for name in specimen_database.database()
    }
    rows = compression.draw(spectra, tmp_path)
    exact = [row for row in rows if "8 components, maximum RMSE" in row.what]
    assert len(exact) == 3 and all(row.ours.startswith("0.0000 (-100%)") for row in exact)
    removed = {
        name: flat(0.2 if name == "all" else 0.4) for name in ("all", *sensitivity.MATERIALS)
    }
    checks = {f"{name} walked": flat(0.4, rays=100) for name in removed}
    rows = sensitivity.draw({**removed, **checks, "readings": []}, tmp_path)
    lighter = [row for row in rows if row.printed == "lighter without either"]
    assert len(lighter) == 3 and all(row.met for row in lighter)
    made = {path.name for path in tmp_path.iterdir()}
    assert made == {f"{name}.png" for name in (*compression.FIGURES, *sensitivity.FIGURES)}
