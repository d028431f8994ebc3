"""Tables: which states they span, building, the file, the command."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest

from hylios.commands.shell import chosen_tanning_skin
from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.skin.specimen import SPECIMENS
from hylios.table import (
    HEADER_ATTRIBUTE,
    described_dynamics,
    from_stored,
    melanin_dynamics,
    read_table,
    skin_of,
    to_stored,
)
from hylios.tanning import PIGMENTATIONS, Exposures, simulate
from lut_builder.assemble import build
from lut_builder.axes import choose_axes, reachable_states, untanned_state
from lut_builder.check import check
from lut_builder.cli import main, parser
from lut_builder.exr_writer import write_table
from lut_builder.settings import PRESETS, Settings

TINY = Settings(knots=(3, 2), colour_wavelengths=4, profile_error=0.05, profile_wavelengths=4)

COLOURS = replace(TINY, bands=(), profile_error=0.0)


@pytest.fixture(scope="module")
def tiny():
    return build(Skin.of(SPECIMENS["S3"], "intermediate", 2.89, 1.7), TINY, seed=1)


@pytest.mark.parametrize(
    ("name", "pigmentation"), [("S1", "low"), ("S3", "intermediate"), ("S4", "high")]
)
def test_three_axes_span_the_states_that_can_be_reached(name, pigmentation):
    """Schedules and times other than those that chose the axes: 0.015 rms in the logarithm is
    left over three axes, and no state lies far beyond the knots."""
    skin = Skin.of(SPECIMENS[name], pigmentation)
    axes = choose_axes(skin, (9, 3, 3))
    states = reachable_states(skin, 100, seed=99)
    coordinates = axes.coordinates(states)
    left = np.log(states / axes.states(coordinates))
    assert np.sqrt((left**2).sum(axis=1).mean()) < 0.015
    for axis, knots in enumerate(axes.knots):
        over = np.maximum(coordinates[:, axis] - knots[-1], knots[0] - coordinates[:, axis])
        assert over.max() < 0.03


@pytest.mark.parametrize("knots", [(1,), (2, 2), (7, 3, 1), (9, 3, 2, 2)])
def test_the_untanned_skin_is_a_knot(knots):
    skin = Skin.of(SPECIMENS["S3"])
    axes = choose_axes(skin, knots)
    assert axes.shape == knots
    untanned = untanned_state(skin)
    states = axes.knot_states().reshape(-1, 4)
    assert np.abs(states - untanned).max(axis=1).min() < 1e-12
    assert all(np.all(np.diff(each) > 0) for each in axes.knots)


def test_reachable_states_are_those_that_the_issue_of_a_tan_can_be():
    states = reachable_states(Skin.of(SPECIMENS["S3"], "low"), 50, seed=4)
    assert states.min() > 0
    assert states[:, :3].sum(axis=1).max() < 2.2
    assert states[:, 3].max() < 1.25 + 1e-9


def test_a_tan_is_darker_in_every_colour_and_in_the_ultraviolet(tiny):
    history = simulate(
        Exposures([0], [30.0]), PIGMENTATIONS["intermediate"], mmd=2.89, med=1.7, hours=240
    )
    before, after = (tiny.lookup(history.states[hour]) for hour in (0, 240))
    for plane in ("subsurface_colour", "total_colour"):
        assert np.all(after[plane] < before[plane])
    assert after["band_reflectance"][0] < before["band_reflectance"][0]


def test_surface_light_is_what_total_has_more_than_subsurface(tiny):
    surface = tiny.planes["total_colour"] - tiny.planes["subsurface_colour"]
    assert np.all((surface > 0.03) & (surface < 0.06))


def test_same_seed_same_table_whatever_the_threads(tiny):
    for threads in (1, 2):
        again = build(skin_of(tiny.provenance), TINY, seed=1, threads=threads)
        assert to_stored(again).checksum == to_stored(tiny).checksum
    other = build(skin_of(tiny.provenance), TINY, seed=2)
    assert not np.array_equal(other.planes["profile_width"], tiny.planes["profile_width"])
    assert np.array_equal(other.planes["total_colour"], tiny.planes["total_colour"])


def test_a_file_holds_the_table_and_says_what_it_is(tiny, tmp_path):
    path = tmp_path / "skin.exr"
    write_table(path, tiny)
    again = read_table(path)
    for name, values in tiny.planes.items():
        assert np.array_equal(again.planes[name], values.astype(np.float32))
    assert again.provenance == tiny.provenance
    assert b"capDate\0string\0\x13" not in path.read_bytes()
    image = oiio.ImageInput.open(str(path))
    described = json.loads(image.spec().getattribute(HEADER_ATTRIBUTE))["provenance"]
    for key in ("specimen", "settings", "solver", "seed", "software", "absorptance", "bands_nm"):
        assert key in described
    assert any("ESTIMATE" in line for line in described["estimated_figures"])
    assert os.listdir(tmp_path) == ["skin.exr"]


def test_what_is_no_table_is_refused(tiny, tmp_path):
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_table(tmp_path / "none.exr")
    text = tmp_path / "text.exr"
    text.write_text("not an image")
    with pytest.raises(InputError, match="it is not an OpenEXR file"):
        read_table(text)
    picture = tmp_path / "picture.exr"
    oiio.ImageBuf(oiio.ImageSpec(4, 4, 3, oiio.FLOAT)).write(str(picture))
    with pytest.raises(InputError, match="not a skin tan table"):
        read_table(picture)
    write_table(text, tiny)
    cut = text.read_bytes()
    for size in (6, 40, 300, len(cut) // 2, len(cut) - 20):
        text.write_bytes(cut[:size])
        with pytest.raises(InputError):
            read_table(text)


def test_a_table_that_cannot_be_written_leaves_nothing(tiny, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_table(tmp_path / "no" / "skin.exr", tiny)
    folder = tmp_path / "skin.exr"
    folder.mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        write_table(folder, tiny)
    assert os.listdir(tmp_path) == ["skin.exr"]


def test_check_finds_a_table_right_and_a_wrong_one_wrong(tiny):
    honest = check(tiny, count=6, seed=5)
    assert honest.differences.shape == (6,)
    assert honest.noise is None and honest.noise_share == 0.0
    assert len(set(np.round(honest.differences, 6))) == 6
    darker = {name: 0.8 * values for name, values in tiny.planes.items()}
    found = check(replace(tiny, planes=darker), count=6, seed=5)
    assert found.differences.min() > honest.differences.mean()


def test_both_ways_of_checking_say_the_same(tiny):
    """The solver and the random walk at the same states; the difference is the walk's noise. The
    mean of so few squares exceeds nine times what noise alone explains in less than one of 1000."""
    solved, walked = (check(tiny, count=4, seed=5, rays=rays) for rays in (0, 4000))
    assert np.array_equal(solved.states, walked.states)
    apart = np.mean((walked.differences - solved.differences) ** 2)
    assert 0.0 < apart < 9.0 * np.mean(walked.noise**2)
    assert walked.noise_share > 0.0


def test_checked_states_are_no_knots(tiny):
    states = check(tiny, count=40, seed=2).states
    knots = np.log(tiny.axes.knot_states().reshape(-1, 4))
    apart = np.abs(np.log(states)[:, None] - knots).max(axis=2).min(axis=1)
    assert apart.min() > 1e-6


def test_a_header_spells_out_how_its_skin_tans(tiny):
    """The numbers count, not the set's name; without them, as in the first tables, the name."""
    skin = Skin.of(
        SPECIMENS["S3"], "low", tanning={"basale_extra_production": 0.05}, untanned="own"
    )
    table = build(skin, COLOURS, seed=1)
    again = from_stored(to_stored(table))
    assert skin_of(again.provenance) == skin
    assert again.provenance["skin"] is None
    assert "scaled by m_i(t)/m_i(0)" in again.provenance["untanned_state"]
    named = {key: each for key, each in tiny.provenance.items() if key != "melanin_dynamics"}
    assert skin_of(named) == skin_of(tiny.provenance)
    assert melanin_dynamics({"pigmentation": "high"}) == PIGMENTATIONS["high"]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"transfer": [0.1, 0.1]}, r"the table's transfer is \[0.1, 0.1\]; expected 3 numbers."),
        ({"transfer": 0.1}, "the table's transfer is 0.1; expected 3 numbers."),
        ({"transfer": [0.1, "x", 0.1]}, "expected 3 numbers."),
        ({"production": [0.1, True, 0.1]}, "expected 3 numbers."),
        ({"melanin_decay": None}, "the table's melanin_decay is None; expected a number."),
        ({"melanin_decay": [0.9]}, "expected a number."),
        ({"melanin_decay": float("nan")}, "the table's melanin_decay is nan; expected a number."),
        ({"melanin_decay": 10**400}, "expected a number."),
        ({"melanin_decay": 2.0}, "melanin_decay is 2; allowed is 0 to 1."),
        ({"surplus": 1.0}, "the table's melanin dynamics need the rates production, transfer"),
    ],
)
def test_dynamics_that_are_none_are_refused(change, sentence):
    usual = described_dynamics(PIGMENTATIONS["low"])
    with pytest.raises(InputError, match=sentence):
        melanin_dynamics({"pigmentation": "low", "melanin_dynamics": {**usual, **change}})


def test_a_layer_without_melanin_has_no_axes():
    skin = Skin.of(SPECIMENS["S3"], "low", tanning={"basale_transfer": 0.0})
    with pytest.raises(InputError, match="melanin without sun is .* more than 0 in each"):
        choose_axes(skin, (3, 2))


def test_skin_that_makes_no_melanin_varies_in_thickness_alone():
    skin = phototype("I").skin
    axes = choose_axes(skin, (5, 3, 2))
    assert axes.shape == (5, 1, 1)
    assert np.abs(axes.basis[:, 0]) == pytest.approx([0.0, 0.0, 0.0, 1.0], abs=1e-9)
    states = axes.knot_states()
    assert np.ptp(states[..., :3], axis=0).max() < 1e-9
    assert states[..., 3].min() == 1.0


@pytest.mark.parametrize(
    ("asked", "name", "tanning"),
    [
        ("--skin V", "V", "V"),
        ("--specimen IV", "IV", "IV"),
        ("--skin III --mmd 7 --set papillary_blood=1", None, "III"),
        ("--specimen S4 --pigmentation high --untanned own", None, None),
    ],
)
def test_a_table_of_a_type(tmp_path, asked, name, tanning):
    path = tmp_path / "t.exr"
    quick = f"--knots 2 --wavelengths 4 --no-profile -o {path}"
    assert main(["build", *asked.split(), *quick.split()]) == 0
    table = read_table(path)
    assert table.provenance["skin"] == name
    skin = skin_of(table.provenance)
    if name is not None:
        assert skin == phototype(name).skin
        assert table.provenance["specimen"] == name
    elif tanning is not None:
        assert skin.dynamics == phototype(tanning).skin.dynamics
        assert skin.mmd == 7.0
        assert table.provenance["specimen"].startswith("III with papillary_blood=1.0")
    else:
        assert skin == Skin.of(SPECIMENS["S4"], untanned="own")


def test_a_types_own_ability_gives_way_to_what_is_set():
    """A single rate replaces the type's; a set named replaces them all."""
    low = PIGMENTATIONS["low"]
    for more, dynamics in (
        ("--tanning basale_extra_production=0.0858", replace(low, extra_production=(0.0858, 0, 0))),
        ("--pigmentation low", low),
        ("--pigmentation high", PIGMENTATIONS["high"]),
    ):
        asked = parser().parse_args(["build", "--skin", "IV", *more.split(), "-o", "t.exr"])
        assert chosen_tanning_skin(asked).dynamics == dynamics


def test_the_command_builds_describes_and_checks(tmp_path, capsys):
    path = tmp_path / "s3.exr"
    arguments = f"build --specimen S3 --preset preview --knots 3,2 -o {path}".split()
    assert main(arguments) == 0
    progress = capsys.readouterr()
    assert f"wrote {path}" in progress.out
    assert "100%" in progress.err
    before = path.read_bytes()
    assert main(arguments) == 2
    assert "exists already; --force replaces it" in capsys.readouterr().err
    assert path.read_bytes() == before
    assert main([*arguments, "--force"]) == 0
    assert path.read_bytes() == before
    capsys.readouterr()
    assert main(["info", str(path)]) == 0
    described = capsys.readouterr().out
    for word in (
        "specimen: S3",
        "pigmentation: low",
        f"nodes: {PRESETS['preview'].nodes}",
        "ESTIMATE",
        "axis 2",
    ):
        assert word in described
    assert "profile_error: " in described and ", mean " in described
    assert main(["check", str(path), "--states", "2"]) == 0
    checked = capsys.readouterr().out
    assert "mean CIEDE2000 between table and model:" in checked
    assert "noise" not in checked
    assert main(["check", str(path), "--states", "2", "--rays", "200"]) == 0
    assert "share of the mean squared difference that noise explains:" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("build --specimen S9 -o {}/t.exr", "there is no specimen 'S9'"),
        ("build --knots 3,x -o {}/t.exr", "number of knots is 'x'; expected a number."),
        ("build --knots 1.9 -o {}/t.exr", "number of knots is 1.9; allowed are whole numbers"),
        ("build --knots nan -o {}/t.exr", "number of knots is nan"),
        ("build --knots= -o {}/t.exr", "number of knots is ''; expected a number."),
        ("build --threads -1 -o {}/t.exr", "number of threads is -1"),
        ("build --seed -1 -o {}/t.exr", "seed is -1"),
        ("build -o {}/t.png", "must end in .exr"),
        ("build -o /proc/t.exr", "cannot be written"),
        ("check {}/none.exr --seed -1", "seed is -1"),
        ("check {}/none.exr --threads 0", "number of threads is 0"),
        ("build --knots 3,3,3,3,3 -o {}/t.exr", "number of axes is 5; allowed is 1 to 4."),
        ("build --knots 100,100,100 -o {}/t.exr", "number of states is 1e+06; allowed is 1 to"),
        ("build --wavelengths 3 -o {}/t.exr", "number of wavelengths is 3; allowed is 4 to 16."),
        ("build --bands , -o {}/t.exr", "a table without the visible has no band"),
        ("build --bands blue -o {}/t.exr", "band is 'blue'; expected a number."),
        ("build --bands visible,200 -o {}/t.exr", "band is 200 nm; allowed is 250 to 2500 nm."),
        ("build --bands nan -o {}/t.exr", "band is nan nm"),
        ("build --bands 365,365.0 -o {}/t.exr", "bands are 365, 365 nm; allowed is each once."),
        ("build --profile-error 1 -o {}/t.exr", "error of the profile is 1; allowed is 0.0005 to"),
        ("build --nodes 5 -o {}/t.exr", "number of nodes is 5; allowed is 6 to 200."),
        ("build --schedule {}/none.csv -o {}/t.exr", "none.csv cannot be read: No such file"),
        ("check {}/none.exr --states 0", "number of states is 0; allowed is 1 to 10000."),
        ("check {}/none.exr --rays 1", "number of rays is 1; allowed is 100 to 1000000000."),
        ("build --mmd 0 -o {}/t.exr", "MMD is 0 SED"),
        ("build --skin I --specimen S3 -o {}/t.exr", "both the skin type I and the specimen S3"),
        ("build --tanning production=1 -o {}/t.exr", "there is no rate 'production' of tanning"),
        ("build --tanning melanin_decay=x -o {}/t.exr", "melanin_decay is 'x'; expected a number"),
        ("build --tanning melanin_decay -o {}/t.exr", "a rate of tanning is 'melanin_decay'"),
        ("build -o {}/no/t.exr", "cannot be written: No such file or directory"),
        ("info {}/none.exr", "cannot be read"),
        ("check {}/none.exr", "cannot be read"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(tmp_path, capsys, arguments, sentence):
    assert main(arguments.format(*[tmp_path] * 2).split()) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1
    assert os.listdir(tmp_path) == []


def test_ctrl_c_ends_a_build_promptly_and_leaves_nothing(tmp_path):
    """A real signal in the middle of a build that would take minutes."""
    command = [sys.executable, "-m", "lut_builder.cli", "build", "--profile-error", "0.0005"]
    with subprocess.Popen(
        [*command, "-o", str(tmp_path / "t.exr")], stderr=subprocess.PIPE, text=True
    ) as building:
        while building.stderr.read(1) != "%":
            pass
        time.sleep(3.0)  # until it is in the middle of the walks
        building.send_signal(signal.SIGINT)
        sent = time.monotonic()
        _, said = building.communicate(timeout=30)
    assert time.monotonic() - sent < 10.0
    assert building.returncode == 130
    assert said.endswith("cancelled\n")
    assert os.listdir(tmp_path) == []


def test_a_full_disk_leaves_the_former_table(tiny, tmp_path):
    """A limit on the size of files stands in for the disk."""
    path = tmp_path / "t.exr"
    write_table(path, tiny)
    before = path.read_bytes()
    code = (
        "import resource, signal, sys; from pathlib import Path\n"
        "from hylios.errors import InputError\n"
        "from hylios.table import read_table\n"
        "from lut_builder.exr_writer import write_table\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        f"path = Path({str(path)!r}); table = read_table(path)\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({len(before) - 100},) * 2)\n"
        "try: write_table(path, table)\n"
        "except InputError as error: sys.exit(str(error))"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "cannot be written" in ended.stderr
    assert ended.stderr.count("\n") == 1
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["t.exr"]


def test_a_table_says_what_was_changed(tmp_path):
    path = tmp_path / "t.exr"
    own = tmp_path / "keratin.csv"
    own.write_text("250,0\n2500,0\n")
    arguments = "build --knots 1 --wavelengths 4 --no-profile --set papillary_blood=0.5"
    arguments += f" --reading floor=mirrored --own-spectrum keratin={own} -o {path}"
    assert main(arguments.split()) == 0
    made = read_table(path).provenance
    assert made["specimen"] == "S3 with papillary_blood=0.5"
    assert made["readings"]["floor"] == "mirrored"
    assert made["own_figures"] == {"keratin": str(own)}
    assert not any(line.startswith("keratin") for line in made["estimated_figures"])
    assert not any("action" in line for line in made["estimated_figures"])


def test_presets_of_the_command_are_those_of_the_builder():
    for preset in PRESETS:
        assert parser().parse_args(["build", "--preset", preset, "-o", "t.exr"]).preset == preset
