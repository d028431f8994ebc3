"""The command `hylios`, as a shell sees it."""

import csv
import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hylios.commands.cli import main


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_reflectance_is_a_spectrum_on_standard_output(capsys):
    arguments = ["reflectance", "--specimen", "S3", "--set", "papillary_blood=0.5"]
    arguments += ["--wavelengths", "400:700:100", "--angle", "8", "--rays", "2000", "--seed", "1"]
    assert main(arguments) == 0
    printed = capsys.readouterr()
    header = "wavelength_nm,total,surface,subsurface,absorptance,standard_error"
    assert printed.out.splitlines()[0] == header
    table = rows(printed.out)
    assert [float(row["wavelength_nm"]) for row in table] == [400.0, 500.0, 600.0, 700.0]
    for row in table:
        values = {name: float(text) for name, text in row.items()}
        assert values["total"] == pytest.approx(values["surface"] + values["subsurface"])
        assert values["total"] + values["absorptance"] == pytest.approx(1.0)
    assert "ESTIMATE" in printed.err
    main(arguments)
    assert capsys.readouterr().out == printed.out


def test_a_parameter_and_a_reading_change_the_spectrum(capsys):
    usual = ["reflectance", "--wavelengths", "550", "--rays", "4000"]
    outputs = []
    bloody = ["--set", "papillary_blood=60", "--allow-unphysical"]
    for more in ([], bloody, ["--reading", "rayleigh=every_collision"]):
        assert main([*usual, *more]) == 0
        outputs.append(float(rows(capsys.readouterr().out)[0]["total"]))
    assert outputs[1] < outputs[0] - 0.05
    assert outputs[2] > outputs[0] + 0.05


def test_tan_takes_a_med_and_steps(capsys):
    """Thickness alone follows the MED; lines come by the step, halves of an hour between."""
    command = "tan --dose 0:10 --mmd 5 --hours 24 "
    outputs = []
    for more in ("--med 3", "--med 50", "--med 3 --step 1/2", "--med 3 --step 12"):
        assert main((command + more).split()) == 0
        outputs.append(rows(capsys.readouterr().out))
    usual, hardy, halves, longer = outputs
    assert [row["total"] for row in usual] == [row["total"] for row in hardy]
    assert float(usual[-1]["thickness"]) > 1.05 and float(hardy[-1]["thickness"]) == 1.0
    assert halves[::2] == usual and halves[1]["hour"] == "0.5"
    assert [row["hour"] for row in longer] == ["0", "12", "24"]


def test_tan_by_the_kinetics_measured_in_people(capsys):
    """Half an MMD tans a little there, and not at all by the thesis."""
    command = "tan --skin V --dose 0:0.5MMD --hours 120 --step 24".split()
    last = []
    for more in ([], ["--kinetics", "measured"]):
        assert main([*command, *more]) == 0
        last.append(rows(capsys.readouterr().out)[-1])
    assert float(last[0]["total"]) == 1.0 and float(last[1]["basale"]) > 0.535
    assert float(last[1]["total"]) > 1.005 and last[0]["thickness"] == last[1]["thickness"]


def test_tan_prints_the_blood_of_a_burn(capsys):
    """All else stays; 1 MED of type II is 1.8 times the blood a day later, less on tanned skin."""
    command = "tan --skin II --dose 0:2.77 --hours 24 --step 24".split()
    assert main(command) == 0
    usual = rows(capsys.readouterr().out)
    assert main([*command, "--erythema"]) == 0
    told = capsys.readouterr()
    burnt = rows(told.out)
    assert [{**row, "blood": own["blood"]} for row, own in zip(usual, burnt, strict=True)] == burnt
    assert burnt[0]["blood"] == "1" and float(burnt[1]["blood"]) == pytest.approx(1.8, abs=0.05)
    assert "redness is an estimate" in told.err


@pytest.mark.parametrize("name", ["S4", "VI", "III"])
def test_a_specimen_written_to_a_file_tans_as_by_its_name(capsys, tmp_path, name):
    assert main(["specimen", name, "--toml"]) == 0
    file = tmp_path / "own.toml"
    file.write_text(capsys.readouterr().out)
    outputs = []
    for specimen in (name, str(file)):
        assert main(["tan", "--specimen", specimen, "--dose", "0:30", "--hours", "48"]) == 0
        outputs.append(rows(capsys.readouterr().out))
    assert outputs[0] == outputs[1]


def test_a_file_that_no_command_takes_as_it_is_says_so(capsys):
    assert main("specimen VI --region moles --toml".split()) == 0
    assert "only --allow-unphysical reads this specimen again" in capsys.readouterr().err
    assert main("specimen VI --region cheeks --toml".split()) == 0
    assert "unphysical" not in capsys.readouterr().err


def test_rates_of_the_thesis_are_not_of_the_measured_kinetics(capsys):
    told = "tan --skin III --dose 0:3MMD --kinetics measured --hours 9"
    assert main([*told.split(), "--tanning", "energy_decay=0.5"]) == 2
    assert "--tanning energy_decay=0.5 sets a rate of the thesis's kinetics" in (
        capsys.readouterr().err
    )
    assert main(told.split()) == 0
    assert "the measured kinetics is fitted" in capsys.readouterr().err


def test_tan_prints_every_hour(capsys):
    arguments = ["tan", "--pigmentation", "intermediate", "--dose", "0:30", "--mmd", "2.89"]
    assert main([*arguments, "--med", "1.7", "--hours", "240"]) == 0
    table = rows(capsys.readouterr().out)
    assert list(table[0]) == ["hour", "basale", "spinosum", "granulosum", "total", "thickness"]
    assert len(table) == 241
    assert float(table[0]["total"]) == pytest.approx(1.0)
    assert float(table[228]["total"]) == pytest.approx(1.90, abs=0.005)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("reflectance --specimen S7", "there is no specimen 'S7'; there are S1, S2, S3, S4, I,"),
        ("reflectance --set blood=1", "there is no parameter 'blood'"),
        ("reflectance --set papillary_blood", "expected NAME=VALUE"),
        ("reflectance --set papillary_blood=x", "papillary_blood is 'x'; expected a number."),
        ("reflectance --set papillary_blood=120", "allowed is 0 to 100 %"),
        ("reflectance --set papillary_blood=5", "physiological is 0.08 to 4 %, allowed is 0 to"),
        ("reflectance --set papillary_blood=120 --allow-unphysical", "; allowed is 0 to 100 %."),
        ("reflectance --set name=Ada", "the name of a specimen is no parameter"),
        ("reflectance --specimen none.toml", "none.toml cannot be read: No such file"),
        ("specimen S7", "there is no specimen 'S7'; there are S1, S2, S3, S4, I,"),
        ("specimen --set basale_thickness=", "'basale_thickness='; expected NAME=VALUE."),
        ("reflectance --wavelengths 700:400:5", "expected FIRST:LAST:STEP"),
        ("reflectance --wavelengths 200", "allowed is 250 to 2500 nm"),
        ("reflectance --angle 91", "allowed is 0 to 89.99 degrees"),
        ("reflectance --threads 0", "number of threads is 0"),
        ("reflectance --wavelengths nan", "wavelength nan nm is outside the spectrum"),
        ("reflectance --wavelengths 400,700:100", "expected FIRST:LAST:STEP"),
        ("reflectance --set melanosome_arrangement=odd", "allowed is individual, complexes"),
        ("reflectance --set papillary_blood=nan", "papillary_blood is nan %"),
        ("reflectance --rays 0", "number of rays is 0"),
        ("reflectance --seed -1", "seed is -1"),
        (
            "reflectance --own-spectrum keratin=/none.csv",
            "/none.csv cannot be read: No such file",
        ),
        ("tan --dose 30", "expected HOUR:SED"),
        ("tan --dose 0:-3", "dose is -3 SED; allowed is 0 to"),
        ("tan --dose 0.5:3", "an hour of exposure is"),
        ("tan --dose 0:1 --mmd 0", "MMD is 0 SED"),
        ("tan --hours -1", "number of hours is -1"),
        ("tan --step 0", "step is 0.0 hours; allowed is 1 to 24 in whole numbers, or 1 divided"),
        ("tan --step 1/0", "step is nan hours"),
        ("tan --step 1/7/2", "step is '7/2'; expected a number"),
        ("tan --dose inf:30", "an hour of exposure is"),
        ("tan --dose 1e19:30", "an hour of exposure is"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(capsys, arguments, sentence):
    assert main(arguments.split()) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""


def test_a_closed_pipe_ends_quietly():
    command = f"{sys.executable} -m hylios.commands.cli tan --hours 20000 | head -n 1"
    ended = subprocess.run(command, shell=True, capture_output=True, text=True)
    assert ended.stdout.startswith("hour,")
    assert ended.stderr == ""


def test_the_tanning_command_needs_no_numba():
    code = (
        "import sys; sys.modules['numba'] = None; sys.modules['colour'] = None;"
        "from hylios.commands.cli import main; sys.exit(main(['tan', '--hours', '1']))"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == 0


def test_total_of_the_steady_state_is_one(capsys):
    assert main(["tan", "--hours", "48"]) == 0
    totals = [float(row["total"]) for row in rows(capsys.readouterr().out)]
    assert np.allclose(totals, 1.0, atol=1e-9)


def test_the_arrangement_of_melanosomes_can_be_set(capsys):
    arguments = ["reflectance", "--wavelengths", "500", "--rays", "500"]
    arguments += ["--set", "melanosome_arrangement=compact_complexes"]
    assert main(arguments) == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk_is_one_sentence():
    command = f"{sys.executable} -m hylios.commands.cli tan --hours 20000 > /dev/full"
    ended = subprocess.run(command, shell=True, capture_output=True, text=True)
    assert ended.returncode == 2
    assert ended.stderr == "error: [Errno 28] No space left on device.\n"
