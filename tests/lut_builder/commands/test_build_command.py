"""`lut-builder build`, `info` and `check` in a shell."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import OpenImageIO as oiio  # noqa: N813
import pytest

from hylios.commands.skin_arguments import chosen_tanning_skin
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.skin.specimen import SPECIMENS
from hylios.table import (
    CHECKSUM_ATTRIBUTE,
    HEADER_ATTRIBUTE,
    StoredTable,
    read_table,
    skin_of,
    to_stored,
)
from hylios.table.stored import checksum
from hylios.tanning import PIGMENTATIONS
from lut_builder.cli import main, parser
from lut_builder.exr_writer import write_table
from lut_builder.settings import PRESETS


@pytest.mark.parametrize(
    ("options", "name", "tanning"),
    [
        ("--skin V", "V", "V"),
        ("--specimen IV", "IV", "IV"),
        ("--skin III --mmd 7 --set papillary_blood=1", None, "III"),
        ("--specimen S4 --pigmentation high --untanned own", None, None),
    ],
)
def test_a_table_of_a_type(tmp_path, options, name, tanning):
    path = tmp_path / "t.exr"
    quick = f"--knots 2 --wavelengths 4 --no-profile -o {path}"
    assert main(["build", *options.split(), *quick.split()]) == 0
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
        arguments = parser().parse_args(["build", "--skin", "IV", *more.split(), "-o", "t.exr"])
        assert chosen_tanning_skin(arguments).dynamics == dynamics


def test_the_command_builds_describes_and_checks(tmp_path, capsys):
    path = tmp_path / "s3.exr"
    arguments = (
        f"build --specimen S3 --preset preview --knots 3 --profile-error 0.1 -o {path}".split()
    )
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
        "axis 1",
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
        ("build --knots 9,,2 -o {}/t.exr", "number of knots is ''; expected a number."),
        ("build --threads -1 -o {}/t.exr", "number of threads is -1"),
        ("build --seed -1 -o {}/t.exr", "seed is -1"),
        ("build -o {}/t.png", "must end in .exr"),
        ("build -o {}/", "must end in .exr"),
        ("build -o /proc/t.exr", "cannot be written"),
        ("check {}/none.exr --seed -1", "seed is -1"),
        ("check {}/none.exr --threads 0", "number of threads is 0"),
        ("build --knots 3,3,3,3,3 -o {}/t.exr", "number of axes is 5; allowed is 1 to 4."),
        ("build --knots 100,100,100 -o {}/t.exr", "number of states is 1e+06; allowed is 1 to"),
        ("build --wavelengths 3 -o {}/t.exr", "number of wavelengths is 3; allowed is 4 to 20."),
        ("build --bands , -o {}/t.exr", "a table without the visible has no band"),
        ("build --bands blue -o {}/t.exr", "band is 'blue'; expected a number."),
        ("build --bands visible,200 -o {}/t.exr", "band is 200 nm; allowed is 250 to 2500 nm."),
        ("build --bands nan -o {}/t.exr", "band is nan nm"),
        ("build --bands 365,365.0 -o {}/t.exr", "bands are 365, 365 nm; allowed is no band twice."),
        ("build --profile-error 1 -o {}/t.exr", "error of the profile is 1; allowed is 0.0005 to"),
        ("build --front {}/f.csv -o {}/t.exr", "f.csv without --max-delta-e or --max-seconds"),
        ("build --preset preview --max-seconds 9 -o {}/t.exr", "preset is preview beside a limit"),
        ("build --no-profile --profile-error .1 -o {}/t.exr", "both --no-profile and --profile-e"),
        ("build --bands 365 --illuminant A -o {}/t.exr", "--illuminant is A for a table without"),
        ("trade --quick", "--quick is given without -o; it is for measuring."),
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
        _, said = building.communicate(timeout=60)
    assert building.returncode == 130
    assert said.endswith("cancelled\n")
    assert os.listdir(tmp_path) == []


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


def test_an_output_without_a_name_is_one_sentence(capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["build", "-o", ""])
    assert capsys.readouterr().err.startswith("error: -o is empty; leave it out or give a value.")


def test_a_name_that_is_not_utf_8_is_written_and_told(tmp_path, capsys):
    path = tmp_path / os.fsdecode(b"caf\xe9.exr")
    assert (
        main(
            [*"build --knots 1 --wavelengths 4 --no-profile --bands visible -o".split(), str(path)]
        )
        == 0
    )
    assert read_table(path).axes.shape == (1, 1, 1, 1)
    assert os.listdir(tmp_path) == [path.name]


def test_what_a_table_says_reaches_no_terminal_raw(small, tmp_path, capsys):
    """Texts that do not print are refused when read; others are printed as they are."""
    path = tmp_path / "t.exr"
    write_table(path, replace(small, provenance={**small.provenance, "note": "caf\u00e9 [31m"}))
    assert main(["info", str(path)]) == 0
    assert "note: caf\u00e9 [31m" in capsys.readouterr().out
    stored = to_stored(small)
    header = stored.header.replace('"solver": "', '"solver": "\\u001b[31m')
    data = write_raw(path, StoredTable(stored.channels, header, checksum(header, stored.channels)))
    assert b"\\u001b[31m" in data
    assert main(["info", str(path)]) == 2
    said = capsys.readouterr()
    assert r"'\x1b[31madding" in said.err and "\x1b" not in said.err + said.out


def write_raw(path, stored):
    """Write a header that `write_table` would refuse, of the same length in the file as another."""
    image = oiio.ImageBuf(str(path))
    image.read(force=True)
    image.specmod().attribute(HEADER_ATTRIBUTE, stored.header)
    image.specmod().attribute(CHECKSUM_ATTRIBUTE, stored.checksum)
    assert image.write(str(path)), image.geterror()
    return path.read_bytes()
