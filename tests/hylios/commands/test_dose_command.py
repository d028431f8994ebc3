"""Exposures of all kinds through the shell: `hylios dose` and `hylios tan`."""

import csv
import io
from datetime import date

import numpy as np
import pytest

from hylios.adding.absorptance import tabulated
from hylios.commands.cli import main
from hylios.skin.specimen import SPECIMENS
from hylios.spectra import published_spectra, with_own_spectrum
from hylios.sun.action_spectra import (
    ERYTHEMA,
)
from hylios.sun.doses import Doses, of_sun
from hylios.sun.protection import water
from hylios.sun.sky import ClearSky
from hylios.tissue import Model

SUMMER = date(2025, 6, 21)


COLUMNS = ("erythemal", "melanogenesis", "thickening")


def every(doses: Doses):
    return np.array([doses.erythemal, doses.melanogenesis, doses.thickening])


def run(arguments, capsys):
    assert main(arguments.split()) == 0
    printed = capsys.readouterr()
    return list(csv.DictReader(io.StringIO(printed.out))), printed.err


def test_doses_of_all_kinds_together(capsys, tmp_path):
    lamp = tmp_path / "a:lamp.csv"
    lamp.write_text("wavelength_nm,irradiance_w_m2_nm\n297,0\n298,1\n299,0\n")
    rows, notes = run(
        f"dose --mmd 4 --med 2 --dose 90:30 --dose 0:6SED --dose 24:2.5mmd --uv-index 5:10:1 "
        "--dose 91:1.5MED "
        f"--tanning-action parrish --spectrum 6:{lamp}:200 --sun 2025-06-22:10-11:30 "
        "--sun 2025-06-21:12-13 --latitude 40",
        capsys,
    )
    assert [int(row["hour"]) for row in rows] == [0, 5, 6, 12, 24, 34, 35, 90, 91]
    sed = {int(row["hour"]): float(row["melanogenesis_sed"]) for row in rows}
    assert [sed[hour] for hour in (0, 5, 24, 90, 91)] == pytest.approx([6.0, 9.0, 10.0, 30.0, 3.0])
    assert sed[6] == pytest.approx(2.0, rel=1e-2)
    for row in rows:
        assert float(row["mmd_multiple"]) == pytest.approx(float(row["melanogenesis_sed"]) / 4.0)
        assert float(row["med_multiple"]) == pytest.approx(float(row["thickening_sed"]) / 2.0)
    assert "melanogenesis_action, 250 to 2500 nm: PROVISIONAL" in notes


def test_doses_in_sed_say_nothing_of_estimates(capsys):
    rows, notes = run("dose --dose 0:3 --uv-index 3:5:1", capsys)
    assert notes == ""
    assert "uva_j_cm2" not in rows[0]


def test_estimates_that_count_are_marked_and_those_that_hardly_do_are_one_line(capsys):
    """Of options that are given, once; a cloud cover of 0 is none."""
    command = "dose --sun 2025-06-21:12-13 --latitude 40 --cloud 0"
    (row,), notes = run(command, capsys)
    assert notes.startswith("note: of what absorbs in skin it is an ESTIMATE: carboxyhemoglobin")
    assert notes.count("\n") == 1
    assert 5.0 < float(row["uva_j_cm2"]) < 25.0
    more = "--cloud 0.5 --ground snow --glass car --water 1 --spf 30 --sunscreen-amount 1 --upf 5"
    _, notes = run(f"{command} --altitude 500 {more}", capsys)
    for part in (
        "a cloud cover stands for an average",
        "that snow reflects 0.8 is an ESTIMATE: measured is 0.6 to 0.9",
        "where a window pane begins",
        "water other than a metre",
        "a sunscreen of an SPF lets all",
        "that a film of sunscreen protects",
        "cloth of a UPF",
        "that haze thins out",
    ):
        assert notes.count(f"note: {part}") == 1
    assert run("dose --dose 0:3 --glass window", capsys)[1].count("ESTIMATE") == 1


def test_a_day_above_4_med_blisters(capsys):
    """Two exposures of a day count together, those of two days apart."""
    for command in ("dose", "tan --hours 30"):
        _, notes = run(f"{command} --med 2 --dose 1:4 --dose 26:4 --dose 30:4.1", capsys)
        assert notes.startswith("note: above 4 MED, first on day 1: skin blisters in life, which")
        assert notes.count("\n") == 1
        assert run(f"{command} --dose 1:4MED --dose 26:3MED", capsys)[1] == ""


def test_an_action_spectrum_of_ones_own(capsys, tmp_path):
    """Given erythema's, melanin counts as the thickness does, and nothing is provisional."""
    own = tmp_path / "own.csv"
    spectrum = published_spectra()[ERYTHEMA]
    rows = zip(spectrum.wavelengths, spectrum.values, strict=True)
    own.write_text("".join(f"{nanometres},{value}\n" for nanometres, value in rows))
    command = "dose --sun 2025-06-21:12-13 --latitude 40 --own-spectrum melanogenesis_action="
    (row,), notes = run(command + str(own), capsys)
    assert row["melanogenesis_sed"] == row["thickening_sed"]
    assert "PROVISIONAL" not in notes


def test_light_tans_as_it_burns_or_by_the_theses_spectrum(capsys):
    """An hour at noon in June: the usual one as a meter shows it, nothing provisional; the other
    three times that."""
    command = "dose --sun 2025-06-21:12-13 --latitude 40"
    (row,), notes = run(command, capsys)
    assert row["melanogenesis_sed"] == row["thickening_sed"]
    assert "PROVISIONAL" not in notes
    (other,), notes = run(f"{command} --tanning-action parrish", capsys)
    assert 2.5 < float(other["melanogenesis_sed"]) / float(row["erythemal_sed"]) < 3.5
    assert "PROVISIONAL" in notes
    assert other["thickening_sed"] == row["thickening_sed"]


def test_a_clock_and_a_start(capsys):
    command = "dose --sun 2025-06-21:12-13 --latitude 48 --longitude 11 --utc-offset 2 "
    (row,), _ = run(command + "--start 2025-06-20", capsys)
    assert row["hour"] == "36"
    (noon,), _ = run("dose --sun 2025-06-21:12-13 --latitude 48", capsys)
    assert float(row["erythemal_sed"]) < float(noon["erythemal_sed"])


def test_the_air_and_the_absorptance_on_the_command_line(capsys, tmp_path):
    """Options of the sky, and a reading and a spectrum of one's own, as in the functions."""
    command = "dose --sun 2025-06-21:12-13 --latitude 40 "
    (row,), _ = run(f"{command} --ozone 400 --altitude 2000 --aerosol 0.3 --albedo 0.8", capsys)
    sky = ClearSky(400.0, 2000.0, 0.3, 0.8)
    expected = of_sun(SUMMER, 12.0, 13.0, 40.0, tabulated(SPECIMENS["S3"]), sky=sky)
    assert [float(row[f"{name}_sed"]) for name in COLUMNS] == pytest.approx(every(expected)[:, 0])
    own = tmp_path / "dna.csv"
    own.write_text("250,0\n2500,0\n")
    more = f"--figure dna={own} --reading colloidal_melanin=solid"
    (row,), _ = run(f"{command} {more}", capsys)
    spectra = with_own_spectrum(published_spectra(), "dna", own)
    skin = tabulated(SPECIMENS["S3"], Model(spectra, {"colloidal_melanin": "solid"}))
    expected = of_sun(SUMMER, 12.0, 13.0, 40.0, skin)
    assert [float(row[f"{name}_sed"]) for name in COLUMNS] == pytest.approx(every(expected)[:, 0])
    usual = of_sun(SUMMER, 12.0, 13.0, 40.0, tabulated(SPECIMENS["S3"]))
    assert expected.thickening[0] != pytest.approx(usual.thickening[0], rel=1e-3)


def test_protection_on_the_command_line(capsys, tmp_path):
    command = "dose --sun 2025-06-21:12-13 --dose 0:8 --latitude 40 "
    bare, _ = run(command, capsys)
    film = tmp_path / "film.csv"
    film.write_text("wavelength_nm,absorbance\n290,1\n400,1\n")
    for more, factor in (
        ("--spf 16 --sunscreen-amount 0.5", 2.0),
        ("--upf 15 --water 0", 15.0),
        (f"--sunscreen {film}", 10.0),
        (f"--sunscreen {film} --sunscreen-amount 1 --upf 10", 10.0**1.5),
    ):
        rows, notes = run(command + more, capsys)
        for row, usual in zip(rows, bare, strict=True):
            for name in ("erythemal_sed", "melanogenesis_sed", "thickening_sed"):
                assert float(row[name]) == pytest.approx(float(usual[name]) / factor, rel=1e-6)
    assert "film.csv at 1 mg/cm^2 is an SPF of 3.16" in notes


def test_ground_cloud_glass_and_water_on_the_command_line(capsys):
    """Snow as its albedo; an overcast sky .31; a window and water as their functions have them."""
    command = "dose --sun 2025-06-21:12-13 --latitude 40 "

    def sed(more):
        (row,), _ = run(command + more, capsys)
        return [float(row[f"{name}_sed"]) for name in COLUMNS]

    bare = np.array(sed(""))
    assert sed("--ground snow") == sed("--albedo 0.8")
    assert sed("--cloud 1") == pytest.approx(0.31 * bare)
    assert np.all(sed("--glass window") < 0.15 * bare)
    assert np.all(sed("--water 1") < 0.65 * bare)
    skin = tabulated(SPECIMENS["S3"])
    expected = of_sun(SUMMER, 12.0, 13.0, 40.0, skin, cloud=0.5, protection=water(2.0))
    assert sed("--cloud 0.5 --water 2") == pytest.approx(every(expected)[:, 0])


def test_tan_takes_what_dose_prints(capsys):
    """The same doses, by sun and as numbers, thickness included where the spectra agree."""
    by_sun, _ = run("tan --sun 2025-06-21:12-13 --latitude 40 --hours 300", capsys)
    (dose,), _ = run("dose --sun 2025-06-21:12-13 --latitude 40", capsys)
    plain, _ = run(f"tan --dose 12:{dose['melanogenesis_sed']} --hours 300", capsys)
    assert float(by_sun[-1]["total"]) > 1.05
    assert float(by_sun[-1]["total"]) == pytest.approx(float(plain[-1]["total"]), abs=1e-8)


def test_melanin_that_is_set_counts_for_the_minimal_doses(capsys):
    """3.2 of the specimen that is asked for, be it named or not."""
    command = "dose --dose 0:1 --set basale_melanosomes=20 "
    (named,), _ = run(command + "--specimen S3", capsys)
    (usual,), _ = run("dose --dose 0:1 --specimen S3", capsys)
    assert run(command, capsys)[0] == [named]
    assert float(named["mmd_multiple"]) < 0.8 * float(usual["mmd_multiple"])


def test_tan_by_multiples(capsys):
    multiple, _ = run("tan --dose 0:2.5MMD --mmd 4 --hours 200", capsys)
    plain, _ = run("tan --dose 0:10 --mmd 4 --hours 200", capsys)
    assert multiple == plain


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--dose 30", "a dose is '30'; expected HOUR:SED"),
        ("--dose 0:30MET", "dose is '30MET'; expected a number"),
        ("--dose -1:2", "an hour of exposure is -1; allowed is 0 to 878400"),
        ("--sun 2025-06-21:10-16 --latitude 40 --altitude -1e9", "altitude is -1e+09 m; allowed"),
        ("--dose 0:MMD", "dose is ''; expected a number"),
        ("--dose x:3", "hour of a dose is 'x'"),
        ("--dose 0:nanMMD", "dose is nan SED; allowed is 0 to 1e+12 SED"),
        ("--dose 0.5:3", "an hour of exposure is"),
        ("--dose 0:3 --mmd 0", "MMD is 0 SED"),
        ("--dose 0:3 --med nan", "MED is nan SED"),
        ("--uv-index 0:10", "an exposure by UV index is '0:10'; expected HOUR:INDEX:HOURS"),
        ("--uv-index 0:-1:1", "UV index is -1; allowed is 0 to 50"),
        ("--uv-index 0:1:-1", "duration is -1 hours"),
        ("--uv-index=-1:1:1", "an hour of exposure is"),
        ("--sun 2025-06-21:10-16", "--sun needs --latitude"),
        ("--latitude 40", "--latitude is given without --sun"),
        ("--start 2025-06-21", "--start is given without --sun"),
        ("--dose 0:3 --ozone 300", "--ozone is given without --sun"),
        ("--sun 2025-06-21:10-16 --latitude 40 --start 1900-01-01", "of exposure is 1099858;"),
        ("--sun 2025-06-31:10-16 --latitude 40", "a date is '2025-06-31'"),
        ("--sun 2025-06-21 --latitude 40", "expected DATE:FROM-TO"),
        ("--sun 2025-06-21:10 --latitude 40", "expected DATE:FROM-TO"),
        ("--sun 2025-06-21:16-10 --latitude 40", "sun is given from 16 to 10 h"),
        ("--sun 2025-06-21:10-16:75 --latitude 40", "minute of sun is 75"),
        ("--sun 2025-06-21:10-x --latitude 40", "hour of sun is 'x'"),
        ("--sun 2025-06-21:10-26 --latitude 40", "hour of sun is 26; allowed is 0 to 24"),
        ("--sun 1800-06-21:10-16 --latitude 40", "year of the sun is 1800"),
        ("--sun 2025-06-21:10-16 --latitude 91", "latitude is 91 degrees"),
        ("--sun 2025-06-21:10-16 --latitude 40 --ozone 0", "ozone column is 0 Dobson units"),
        ("--sun 2025-06-21:10-16 --latitude 40 --start 2025-07-01", "lies before hour 0"),
        ("--sun 2025-06-21:10-16 --latitude 40 --utc-offset 2", "given without --longitude"),
        ("--sun 2025-06-21:10-16 --latitude 40 --specimen S7", "there is no specimen 'S7'"),
        ("--spectrum 0:/none.csv:60", "/none.csv cannot be read: No such file"),
        ("--spectrum 0:60", "expected HOUR:FILE:SECONDS"),
        ("--sun 2025-06-21:10-16 --latitude 40 --cloud 2", "cloud cover is 2; allowed is 0 to 1"),
        ("--sun 2025-06-21:10-16 --latitude 40 --ground snow --albedo 0.1", "give only one"),
        ("--dose 0:3 --ground snow", "--ground is given without --sun"),
        ("--dose 0:3 --water -1", "depth of water is -1 m"),
        ("--dose 0:3 --spf 0", "SPF is 0; allowed is 1 to 10000"),
        ("--dose 0:3 --upf -1", "UPF is -1"),
        ("--dose 0:3 --spf 30 --sunscreen-amount -1", "amount of sunscreen is -1 mg/cm^2"),
        ("--dose 0:3 --sunscreen-amount 1", "given without --spf or --sunscreen"),
        ("--dose 0:3 --sunscreen /none.csv", "/none.csv cannot be read: No such file"),
        ("--dose 0:3 --spf 30 --sunscreen /none.csv", "give only one"),
    ],
)
@pytest.mark.parametrize("command", ["dose", "tan"])
def test_bad_exposures_are_one_sentence_and_status_2(capsys, command, arguments, sentence):
    assert main([command, *arguments.split()]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("wavelength_nm,power\n300,1\n310,1\n", "has no column irradiance_w_m2_nm"),
        ("310,1\n300,1\n305,1\n", "in ascending or in descending order"),
        ("2800,1e-40\n4000,1e-9\n", "has light at 2800 to 4000 nm; none of it lies in 280 to 400"),
        ("200,0\n250,0\n", "has light at 200 to 250 nm; none of it lies in 280 to 400 nm"),
        ("250,1\n300,1\n", "has light at 250 nm"),
        ("300,1\n310,-1\n", "-1 in line 2; allowed is 0 to"),
        ("300,1\n", "at least two wavelengths"),
        ("300,1e308\n310,1e308\n", "1e+308 in line 1; allowed is 0 to 1e+12"),
        ("", "it is empty"),
        ("wavelength_nm,irradiance_w_m2_nm\n", "has no rows; needed is one or more wavelength_nm"),
    ],
)
def test_a_bad_file_of_a_lamp_is_one_sentence(capsys, tmp_path, text, sentence):
    file = tmp_path / "lamp.csv"
    file.write_text(text)
    assert main(["dose", "--spectrum", f"0:{file}:60"]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.err.count("\n") == 1


def test_a_bad_file_of_a_sunscreen_is_one_sentence(capsys, tmp_path):
    file = tmp_path / "film.csv"
    file.write_text("wavelength_nm,blue\n290,0.1\n400,0.1\n")
    assert main(["dose", "--dose", "0:30", "--sunscreen", str(file)]) == 2
    assert "has no column transmittance" in capsys.readouterr().err
