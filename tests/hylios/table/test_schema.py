"""What a table's header may say: refused in one sentence where it does not fit, and shown nowhere
raw."""

import copy
import json
from pathlib import Path

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.phototypes import phototype
from hylios.sun.action_spectra import Absorptance
from hylios.table import (
    MEANINGS,
    SkinTable,
    StateAxes,
    StoredTable,
    absorptance,
    from_stored,
    minimal_doses,
    own_spectra,
    read_table,
    skin_of,
    to_stored,
)
from hylios.table.kinds import brief
from hylios.table.stored import checksum

SHIPPED = sorted((Path(__file__).parents[3] / "blender_addon" / "tables").glob("*.exr"))
FORMAT_3 = Path(__file__).parents[2] / "data" / "III_format_3.exr"
ESCAPE = "\x1b]0;owned\x07"
SURROGATE = "\udc80"


@pytest.fixture(scope="module")
def shipped():
    """A table that was shipped, of format 3."""
    return read_table(FORMAT_3)


@pytest.fixture(scope="module")
def stored(shipped):
    return to_stored(shipped)


def with_provenance(stored: StoredTable, **changes) -> StoredTable:
    """A table whose writer meant its provenance to be so: the checksum fits."""
    header = json.loads(stored.header)
    header["provenance"].update(changes)
    text = json.dumps(header)
    return StoredTable(stored.channels, text, checksum(text, stored.channels))


UNFIT = [
    ({"mmd_sed": 10**400}, "the table's header.provenance.mmd_sed is 1000"),
    ({"mmd_sed": "nan"}, "the table's mmd_sed is 'nan'; expected a number, 0.01 to 1000 SED."),
    ({"mmd_sed": -1}, "the table's mmd_sed is -1; expected a number, 0.01 to 1000 SED."),
    ({"mmd_sed": [4.0]}, "the table's mmd_sed is [4.0]; expected a number"),
    ({"mmd_sed": True}, "the table's mmd_sed is True; expected a number"),
    ({"med_sed": None}, "the table's med_sed is None; expected a number"),
    ({"specimen": SURROGATE}, r"specimen is '\udc80'; expected characters that print."),
    ({"specimen": ESCAPE}, r"specimen is '\x1b]0;owned\x07'; expected characters that print."),
    ({"specimen": ["S3"]}, "the table's specimen is ['S3']; expected a text."),
    ({"specimen": "x" * 10_001}, "expected at most 10000 characters."),
    ({"new": ESCAPE}, r"provenance.new is '\x1b]0;owned\x07'; expected characters that print."),
    ({ESCAPE: 1}, r"key is '\x1b]0;owned\x07'; expected characters that print."),
    ({"new": [{"deep": [SURROGATE]}]}, r"expected characters that print."),
    ({"specimen_parameters": []}, "the table's specimen_parameters is []; expected an object."),
    ({"specimen_parameters": {}}, "the table's specimen_parameters has no name."),
    ({"untanned_state": "as it pleases"}, "untanned_state is 'as it pleases'; allowed are melanin"),
    ({"pigmentation": "foo"}, "the table's pigmentation is 'foo'; allowed are low, intermediate"),
    ({"melanin_dynamics": {}}, "the table's melanin dynamics need the rates production, transfer"),
    ({"melanin_dynamics": 5}, "the table's melanin dynamics need the rates production, transfer"),
    ({"settings": None}, "the table's settings is None; expected an object."),
    ({"settings": {"knots": 5}}, "the table's settings.knots is 5; expected a list of 1 to 4."),
    ({"settings": {"bands": [1.0]}}, "settings.bands[0] is 1.0; expected a number, 250 to 2500 nm"),
    ({"own_figures": {"water": 5}}, "the table's own_figures.water is 5; expected a text."),
    ({"own_figures": "/dev/zero"}, "the table's own_figures is '/dev/zero'; expected an object."),
    ({"estimated_figures": "water"}, "estimated_figures is 'water'; expected a list of 0 to 1000"),
    ({"absorptance": {"values": [1]}}, "the table's absorptance has no wavelengths_nm."),
    (
        {"absorptance": {"wavelengths_nm": [280, 400], "values": [0.5, 7.0]}},
        "the table's absorptance cannot be used: ",
    ),
    ({"seed": 0.5}, "the table's seed is 0.5; expected a whole number, 0 to 4294967295."),
    ({"states_computed": -1}, "the table's states_computed is -1; expected a whole number"),
]


@pytest.mark.parametrize(("changes", "sentence"), UNFIT)
def test_a_provenance_that_does_not_fit_is_refused_when_read_and_when_written(
    shipped, stored, changes, sentence
):
    for use in (
        lambda: from_stored(with_provenance(stored, **changes)),
        lambda: to_stored(SkinTable(shipped.axes, shipped.planes, shipped.provenance | changes)),
    ):
        with pytest.raises(InputError) as refusal:
            use()
        said = str(refusal.value)
        assert sentence.replace("header.", "") in said.replace("header.", "")
        assert said.isprintable() and said.isascii() and len(said) < 400


@pytest.mark.parametrize(
    "change",
    [
        lambda specimen: specimen.pop("papillary_blood"),
        lambda specimen: specimen.update(feathers=1.0),
        lambda specimen: specimen.update(papillary_blood="much"),
        lambda specimen: specimen.update(papillary_blood=[0.5]),
        lambda specimen: specimen.update(papillary_blood=101.0),
        lambda specimen: specimen.update(melanosome_arrangement="in rows"),
    ],
)
def test_a_specimen_that_is_none_is_refused_when_read(stored, change):
    parameters = copy.deepcopy(json.loads(stored.header)["provenance"]["specimen_parameters"])
    change(parameters)
    with pytest.raises(InputError, match="the table's specimen_parameters (has|is)"):
        from_stored(with_provenance(stored, specimen_parameters=parameters))


@pytest.mark.parametrize(
    ("plane", "wrong"),
    [
        ("subsurface_colour", -0.01),
        ("subsurface_colour", 1.51),
        ("total_colour", 1e30),
        ("band_reflectance", -1.0),
        ("profile_width", -1.0),
        ("profile_error", -1.0),
    ],
)
def test_numbers_outside_what_a_plane_can_mean_are_neither_read_nor_written(
    shipped, stored, plane, wrong
):
    values = shipped.planes[plane].copy()
    values[0, 0, 0, 0, 0] = wrong
    sentence = f"the table's plane {plane} has a number of {wrong:g}; allowed is 0 to "
    with pytest.raises(InputError, match=sentence.replace("+", r"\+")):
        to_stored(SkinTable(shipped.axes, shipped.planes | {plane: values}, shipped.provenance))
    name = next(name for name in stored.channels if name.startswith(plane))
    pixels = stored.channels[name].copy()
    pixels[0, 0] = wrong
    channels = {**stored.channels, name: pixels}
    with pytest.raises(InputError, match=sentence.replace("+", r"\+")):
        from_stored(StoredTable(channels, stored.header, checksum(stored.header, channels)))


@pytest.mark.parametrize("depth", [30, 900])
def test_what_is_nested_too_deep_is_refused(stored, depth):
    nested = 1
    for _ in range(depth):
        nested = [nested]
    with pytest.raises(InputError, match="nested more than 20 deep"):
        from_stored(with_provenance(stored, new=nested))


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_the_shipped_tables_say_all_of_their_skin(path):
    provenance = read_table(path).provenance
    skin = skin_of(provenance)
    assert skin.specimen.name == path.stem
    if provenance["skin"] is not None:
        usual = phototype(path.stem).skin
        assert (skin.specimen, skin.dynamics) == (usual.specimen, usual.dynamics)
        assert (skin.mmd, skin.med) == pytest.approx((usual.mmd, usual.med), rel=1e-12)
    assert (minimal_doses(provenance).mmd, minimal_doses(provenance).med) == (skin.mmd, skin.med)
    told = absorptance(provenance)
    assert isinstance(told, Absorptance) and told.at(np.array([300.0])) > 0.5
    assert own_spectra(provenance) == {}


def test_what_a_provenance_does_not_say_is_one_sentence():
    for read, sentence in (
        (skin_of, "the table does not say its mmd sed."),
        (minimal_doses, "the table does not say its mmd sed."),
        (absorptance, "does not say what its skin absorbs in the ultraviolet"),
    ):
        with pytest.raises(InputError, match=sentence):
            read({})
    with pytest.raises(InputError, match="mmd_sed is nan; expected a number, 0.01 to 1000 SED"):
        minimal_doses({"mmd_sed": float("nan"), "med_sed": 3.0})


def test_own_spectra_are_told_by_name_and_digest():
    told = {"own_figures": {"water": "/dev/zero", "keratin": "k.csv"}}
    assert own_spectra(told) == {"water": None, "keratin": None}
    assert own_spectra(told | {"own_spectra_sha256": {"water": "ab"}})["water"] == "ab"


def test_keys_of_a_later_builder_are_read(stored):
    later = {"weather": ["fine", 1.5, None, {"wind": True}]}
    assert from_stored(with_provenance(stored, **later)).provenance["weather"] == later["weather"]


def test_what_is_shown_prints():
    assert brief({"a": ESCAPE}, 100) == r"{'a': '\x1b]0;owned\x07'}"
    assert brief("x" * 99) == "'" + "x" * 39 + "..."
    assert brief(10**5000) == "int"


def test_axes_of_one_knot_are_enough():
    axes = StateAxes(np.array([0.5, 0.3, 0.2, 1.0]), np.eye(4)[:, :1], (np.zeros(1),))
    planes = {
        name: np.zeros((1, len(meaning.components) or 1)) for name, meaning in MEANINGS.items()
    }
    again = from_stored(to_stored(SkinTable(axes, planes, {"bands_nm": [365.0]})))
    assert list(again.planes) == list(MEANINGS)
