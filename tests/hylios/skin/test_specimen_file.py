"""Specimens in TOML files and the command that prints them."""

import os
import tomllib
import tracemalloc
from dataclasses import asdict, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.commands.cli import main
from hylios.errors import InputError
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import ARRANGEMENTS, SPECIMENS, parameters, with_values
from hylios.skin.specimen_file import read_specimen, specimen_toml

S3 = SPECIMENS["S3"]
NAMES = st.text(min_size=1).filter(str.isprintable)


@pytest.fixture
def written(tmp_path):
    """Write a text into a file and return its path."""

    def write(text, name="ada.toml"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_the_thesis_s_specimens_come_back(written, name):
    assert read_specimen(written(specimen_toml(SPECIMENS[name]))) == SPECIMENS[name]


@settings(max_examples=100)
@given(
    name=NAMES,
    arrangement=st.sampled_from(ARRANGEMENTS),
    values=st.fixed_dictionaries(
        {
            parameter.name: st.floats(parameter.metadata["low"], parameter.metadata["high"])
            for parameter in parameters()
            if not parameter.name.endswith(("melanosomes", "melanin", "axis"))
        }
    ),
)
def test_any_possible_specimen_comes_back_exactly(tmp_path_factory, name, arrangement, values):
    held = replace(S3, name=name, melanosome_arrangement=arrangement, **values)
    path = tmp_path_factory.mktemp("toml") / "held.toml"
    path.write_text(specimen_toml(held), encoding="utf-8")
    assert read_specimen(path, allow_unphysical=True) == held


def test_numbers_of_every_kind_are_written_so_that_toml_reads_them():
    whole = replace(S3, corneum_water=30, blood_beta_carotene=1e-300, sulfhemoglobin=-0.0)
    read = tomllib.loads(specimen_toml(whole))
    assert {name: read[name] for name in asdict(whole)} == asdict(whole)


def test_a_file_may_start_from_a_specimen_and_change_some_values(written):
    made = read_specimen(written('base = "S3"\npapillary_blood = 1\n'))
    assert made == with_values(S3, {"papillary_blood": 1.0})
    named = read_specimen(written('name = "Ada"\nbase = "S4"\n'))
    assert named == replace(SPECIMENS["S4"], name="Ada")


def test_a_file_without_a_base_has_the_file_s_name_and_the_usual_values_of_table_6_2(written):
    lines = specimen_toml(S3).splitlines()
    table_6_1 = [line for line in lines if "refractive" not in line and not line.startswith("name")]
    assert read_specimen(written("\n".join(table_6_1))) == replace(S3, name="ada")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "the specimen lacks melanosome_arrangement, surface_fold_aspect_ratio"),
        ('base = "S9"', "there is no specimen 'S9'; there are S1"),
        ("base = 3", "there is no specimen '3'"),
        ('base = ["S3"]', "there is no specimen"),
        ('base = "S3"\nblood = 1', "there is no parameter 'blood'; there are name"),
        ('base = "S3"\n[papillary]\nblood = 1', "there is no parameter 'papillary'"),
        ('base = "S3"\npapillary_blood = "1"', "papillary_blood is '1'; expected a number."),
        ('base = "S3"\npapillary_blood = [1]', "papillary_blood is '[1]'; expected a number."),
        ('base = "S3"\npapillary_blood = true', "papillary_blood is 'True'; expected a number."),
        ('base = "S3"\npapillary_blood.a = 1', "expected a number."),
        ('base = "S3"\npapillary_blood = 1979-05-27', "papillary_blood is '1979-05-27'"),
        ('base = "S3"\npapillary_blood = nan', "papillary_blood is nan %; physiological is 0.08"),
        ('base = "S3"\npapillary_blood = 50', "physiological is 0.08 to 4 %, allowed is 0 to 100"),
        (f'base = "S3"\npapillary_blood = 1{"0" * 400}', "papillary_blood is too large; expected"),
        (f'base = "S3"\npapillary_blood = 1{"0" * 5000}', "cannot be read: "),
        ('base = "S3"\nname = 3', "name is 3; allowed is printable text."),
        ('base = "S3"\nname = "a\\nb"', "allowed is printable text."),
        ('base = "S3"\nmelanosome_arrangement = 1', "melanosome_arrangement is 1; allowed is"),
        ('base = "S3"\nbase = "S3"', "cannot be read: Cannot overwrite a value"),
        ("papillary_blood 1", "cannot be read: "),
        ("a = " + "[" * 100_000, "cannot be read: "),
        (b"\xff\xfe", "cannot be read: 'utf-8' codec"),
    ],
)
def test_a_bad_file_is_one_sentence_and_status_2(written, capsys, text, sentence):
    assert main(["specimen", str(written(text))]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert "ada.toml" in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""


def test_a_key_of_many_parts_takes_little_memory(written):
    """One of 20,000 parts took 1.6 GB; what is still read has 500 on each of 60 lines."""
    with pytest.raises(InputError, match="line 1 has 40003 characters; allowed are up to 1000"):
        read_specimen(written(".".join(["a"] * 20_000) + " = 1"))
    with pytest.raises(InputError, match="ada.toml cannot be read: it has more than 65536 bytes"):
        read_specimen(written("# long\n" * 10_000))
    most = "\n".join(f"b{line}." + ".".join(["a"] * 490) + " = 1" for line in range(60))
    tracemalloc.start()
    with pytest.raises(InputError, match="there is no parameter 'b0'"):
        read_specimen(written(most))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 100e6


def test_remarks_cannot_set_a_parameter(written):
    """A file's name with a line break, as `fit` tells what it was fitted to."""
    text = specimen_toml(S3, ["Fitted to a\nbasale_thickness = 1\x1b[2J.csv.", "Two of two."])
    assert text.splitlines()[:2] == [
        "# Fitted to a\\nbasale_thickness = 1\\x1b[2J.csv.",
        "# Two of two.",
    ]
    assert read_specimen(written(text)) == S3


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    path = tmp_path / "pipe.toml"
    os.mkfifo(path)
    with pytest.raises(InputError, match="pipe.toml cannot be read: it is no regular file"):
        read_specimen(path)


def test_a_folder_is_refused(tmp_path):
    folder = tmp_path / "folder.toml"
    folder.mkdir()
    with pytest.raises(InputError, match="folder.toml cannot be read: it is no regular file"):
        read_specimen(folder)


def test_the_command_lists_every_parameter_with_its_range_and_source(capsys):
    assert main(["specimen", "S1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    rows = {line.split()[0]: line for line in lines if line and not line.startswith(" ")}
    for name, usual in PHYSIOLOGY.items():
        assert f"{usual.low:g} to {usual.high:g}  " in rows[name]
        assert f"{usual.cited}" in rows[name]
    assert rows["blood_beta_carotene"].split()[1:3] == ["7e-05", "mg/mL"]
    assert "table 6.1 [56, 90]" in rows["papillary_blood"]
    columns = {line.index("0.08 to 4") for line in lines if "0.08 to 4  " in line}
    assert columns == {lines[0].index("physiological")}
    note = rows["papillary_blood"].split("(")[1].split(")")[0]
    assert any(line.startswith(f"({note}) 0.08 % in a forearm") for line in lines)


def test_the_command_tells_what_was_set_and_what_is_unphysical(capsys):
    arguments = "specimen S1 --set papillary_blood=0 --set corneum_water=36 --allow-unphysical"
    assert main(arguments.split()) == 0
    rows = {line.split(" ")[0]: line for line in capsys.readouterr().out.splitlines()}
    assert "0.08 to 4, outside" in rows["papillary_blood"]
    assert "given" in rows["papillary_blood"]
    assert "given" in rows["corneum_water"]
    assert "outside" not in rows["corneum_water"]
    assert "table 6.1" in rows["reticular_blood"]


def test_what_the_command_prints_as_toml_every_command_reads(written, capsys):
    usual = ["reflectance", "--wavelengths", "500", "--rays", "500"]
    assert main(["specimen", "S4", "--set", "papillary_blood=0.5", "--toml"]) == 0
    path = str(written(capsys.readouterr().out))
    outputs = []
    for specimen in (["S4", "--set", "papillary_blood=0.5"], [path]):
        assert main([*usual, "--specimen", *specimen]) == 0
        outputs.append(capsys.readouterr().out)
    assert outputs[0] == outputs[1]
    assert main(["specimen", path, "--toml"]) == 0
    assert main(["specimen", path, "--set", "papillary_blood=9", "--toml"]) == 2


def test_an_unphysical_file_needs_the_option(written, capsys):
    path = written('base = "S3"\npapillary_blood = 0\n')
    assert main(["specimen", str(path)]) == 2
    said = capsys.readouterr().err
    assert "ada.toml cannot be used: papillary_blood is 0 %" in said
    assert "allowed is 0 to 100 % with --allow-unphysical." in said
    with pytest.raises(InputError, match="allowed is 0 to 100 % with allow_unphysical."):
        read_specimen(path)
    assert main(["specimen", str(path), "--allow-unphysical"]) == 0
