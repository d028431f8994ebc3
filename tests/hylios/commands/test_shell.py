"""The commands in a shell that closes streams, names files oddly and asks for too much."""

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from hylios.commands.cli import main

HYLIOS = f"{sys.executable} -m hylios.commands.cli"
SPECTRUM = "wavelength_nm,total\n400,0.2\n700,0.6\n"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "arm.csv").write_text(SPECTRUM)
    return tmp_path


def shell(folder, command, given=None, **variables):
    """What a shell's command ends with: status, standard output and error as bytes."""
    root = str(Path(__file__).parents[3])
    environment = {**os.environ, "PYTHONPATH": root, **variables}
    command = command.replace("hylios ", f"{HYLIOS} ", 1)
    return subprocess.run(
        ["sh", "-c", command],
        cwd=folder,
        capture_output=True,
        env=environment,
        input=given,
        timeout=120,
    )


def test_a_closed_standard_error_puts_no_notes_into_the_csv(folder):
    command = "hylios dose --sun 2025-06-21:12-13 --latitude 50"
    whole, without = shell(folder, command), shell(folder, f"{command} 2>&-")
    assert b"note:" in whole.stderr
    assert whole.stdout.startswith(b"hour,") and whole.stdout.count(b"\n") == 2
    assert (without.returncode, without.stdout) == (0, whole.stdout)


def test_a_closed_standard_output_is_one_sentence(folder):
    ended = shell(folder, "hylios tan --hours 2 >&-")
    assert ended.returncode == 2
    assert ended.stderr == b"error: standard output is closed; there is nowhere to print to.\n"
    assert shell(folder, "hylios tan --hours 2 >&- 2>&-").returncode == 2


def test_a_closed_standard_input_matters_only_where_it_is_read(folder):
    ended = shell(folder, "hylios plot - -o p.svg <&-")
    assert ended.returncode == 2
    assert ended.stderr == b"error: standard input cannot be read: it is closed.\n"
    ended = shell(folder, "hylios plot arm.csv -o p.svg <&-")
    assert (ended.returncode, ended.stdout) == (0, b"wrote p.svg: arm\n")


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "utf-8"])
def test_any_name_of_a_file_can_be_drawn_and_said(folder, encoding):
    for name in ("спектр".encode(), b"\xff", b"a\nb"):
        shutil.copyfile(folder / "arm.csv", os.path.join(os.fsencode(folder), name + b".csv"))
    command = "hylios plot *.csv -o p.svg"
    ended = shell(folder, command, PYTHONIOENCODING=encoding)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert ended.stdout.startswith(b"wrote p.svg: ") and ended.stdout.count(b"\n") == 1
    assert ended.stdout.count(b", ") == 3
    assert (folder / "p.svg").stat().st_size > 1000


def test_a_name_with_a_line_break_is_shown_on_one_line(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    assert main(["plot", "a\nb.csv", "-o", "p.svg"]) == 2
    assert capsys.readouterr().err == (
        "error: a\\nb.csv cannot be read: No such file or directory.\n"
    )
    assert main(["plot", "arm.csv", "-o", "a\nb.svg"]) == 0
    assert capsys.readouterr().out == "wrote a\\nb.svg: arm\n"


@pytest.mark.parametrize("command", ["plot arm.csv", "swatch arm.csv", "swatch"])
def test_an_empty_name_of_the_output_is_refused(folder, monkeypatch, capsys, command):
    monkeypatch.chdir(folder)
    with pytest.raises(SystemExit, match="2"):
        main([*command.split(), "-o", ""])
    assert capsys.readouterr().err == (
        "error: -o is empty; leave it out or give a value. `hylios --help` says more.\n"
    )


@pytest.mark.slow
def test_too_many_squares_are_refused_before_any_work(folder):
    ended = shell(folder, f"hylios swatch {'arm.csv ' * 300} --size 4096 -o s.png")
    assert ended.returncode == 2
    assert b"300 squares of 4096 pixels have 5033164800 in all; allowed are 67108864" in (
        ended.stderr
    )
    assert shell(folder, f"hylios swatch {'arm.csv ' * 300} --size 2 -o s.png").returncode == 0
    assert imread(folder / "s.png").shape[:2] == (2, 600)


def test_a_spectrum_at_the_ends_of_floating_point_is_refused(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    for row in ("1e308,0.5", "-1e308,0.5", "400,1e308", "400,-1e308"):
        (folder / "arm.csv").write_text(f"wavelength_nm,total\n{row}\n")
        assert main(["plot", "arm.csv", "-o", "p.svg"]) == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1 and "in line 2; allowed is" in said


def test_a_fifo_or_an_endless_file_is_refused_at_once(folder, monkeypatch, capsys):
    os.mkfifo(folder / "fifo")
    monkeypatch.chdir(folder)
    for name in ("fifo", "/dev/zero"):
        assert main(["plot", name, "-o", "p.svg"]) == 2
        assert "it is no regular file" in capsys.readouterr().err
    ended = shell(folder, "hylios plot - -o p.svg < /dev/zero")
    assert ended.returncode == 2
    assert b"standard input cannot be read: it has more than 16777216" in ended.stderr


def test_excels_padding_marks_and_utf_16_on_standard_input(folder, monkeypatch, capsys):
    """The same colour by path and by standard input, with and without a byte-order mark."""
    rows = [f"{400 + 10 * step},{0.2 + step / 75:.4f}" for step in range(31)]
    text = "\n".join(["wavelength_nm,total", *rows, ",", ","]) + "\n"
    ended = shell(folder, "hylios swatch - -o s.png", text.encode("utf-16"))
    assert ended.returncode == 0, ended.stderr
    said = {ended.stdout.decode().split()[-1]}
    monkeypatch.chdir(folder)
    for encoding in ("utf-8", "utf-8-sig", "utf-16"):
        (folder / "arm.csv").write_bytes(text.encode(encoding))
        for source in ("arm.csv", "-"):
            with (folder / "arm.csv").open() as standard_input:
                monkeypatch.setattr(sys, "stdin", standard_input)
                assert main(["swatch", source, "--force", "-o", "s.png"]) == 0
            said.add(capsys.readouterr().out.split()[-1])
    assert len(said) == 1
    pixel = np.round(255 * imread(folder / "s.png")[0, 0, :3]).astype(int)
    assert "#{:02x}{:02x}{:02x}".format(*pixel) in said


def test_a_colour_of_0_to_1_is_not_taken_for_one_of_0_to_255(capsys):
    assert main(["fit", "--srgb", "0.7,0.6,0.5"]) == 2
    said = capsys.readouterr()
    assert "a colour of 0 to 1 is given as 178.5,153,127.5." in said.err
    assert said.out == ""


def test_a_name_with_a_line_break_writes_no_line_of_a_fit(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    rows = "".join(f"{nm},0.3\n" for nm in range(400, 701, 50))
    name = "a\noxygenated_blood = 0.csv"
    (folder / name).write_text(f"wavelength_nm,total\n{rows}")
    assert main(["fit", "--free", "melanin", "--spectrum", name]) == 0
    text = capsys.readouterr().out
    assert text.startswith("# Fitted to a\\noxygenated_blood = 0, total, at 7 wavelengths")
    (folder / "own.toml").write_text(text)
    assert main(["specimen", "own.toml"]) == 0


@pytest.mark.parametrize(
    "arguments, name",
    [
        ("reflectance --specimen ''", "--specimen"),
        ("tan --sun 2025-06-21:10-12 --latitude 40 --start=", "--start"),
        ("plot '' -o p.svg", "an argument"),
        ("fit --spectrum ''", "--spectrum"),
        ("tan --dose ''", "--dose"),
    ],
)
def test_an_empty_text_is_refused_whatever_it_is_for(arguments, name, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(shlex.split(arguments))
    said = capsys.readouterr()
    sentence = f"error: {name} is empty; leave it out or give a value. `hylios --help` says more."
    assert (said.out, said.err) == ("", f"{sentence}\n")


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        ("tan --hours x", "argument --hours: expected a whole number, not 'x'. `hylios tan --h"),
        ("tan --hours 1_0", "argument --hours: expected a whole number, not '1_0'. `hylios tan"),
        ("tan --mmd 1_0", "argument --mmd: expected a number, not '1_0'. `hylios tan --help` s"),
        ("tan --skin X", "argument --skin: invalid choice: 'X'"),
        ("fit", "one of the arguments --spectrum --srgb is required. `hylios fit --help` says m"),
        ("tin", "argument COMMAND: invalid choice: 'tin'"),
        ("", "the following arguments are required: COMMAND. `hylios --help` says more.\n"),
    ],
)
def test_arguments_that_do_not_fit_are_one_sentence(arguments, sentence, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(shlex.split(arguments))
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert said.err.startswith(f"error: {sentence}")


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        ("tan --dose 0:1_0", "dose is '1_0'; expected a number."),
        ("tan --dose 0:", "a dose is '0:'; expected HOUR:SED"),
        ("dose --spectrum 0::60", "a spectral exposure is '0::60'; expected HOUR:FILE:SECONDS."),
        ("tan --own-spectrum keratin=", "a spectrum of your own is 'keratin='; expected NAME=VA"),
        ("reflectance --wavelengths 5_00", "wavelengths are '5_00'; expected FIRST:LAST:STEP"),
    ],
)
def test_parts_of_an_argument_are_as_people_write_them(arguments, sentence, capsys):
    assert main(shlex.split(arguments)) == 2
    assert capsys.readouterr().err.startswith(f"error: {sentence}")


@pytest.mark.slow
def test_a_full_standard_error_loses_no_csv(folder):
    command = "hylios dose --sun 2025-06-21:12-13 --latitude 50"
    whole, without = shell(folder, command), shell(folder, f"{command} 2>/dev/full")
    assert (without.returncode, without.stdout) == (0, whole.stdout)
    assert shell(folder, "hylios tan --dose x 2>/dev/full").returncode == 2
