"""Spectra as instruments of several detectors, and exchange formats in XML, hold them."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.commands.notes import note_omissions
from hylios.errors import InputError
from hylios.readers.cgats import cgats_table
from hylios.readers.cxf import NAMESPACE, cxf_table, is_cxf
from hylios.readers.quantities import Quantity
from hylios.readers.spectrum import read_spectrum, read_transmittance
from hylios.readers.table import table_of

SVC_HEAD = """\
/*** Spectra Vista SIG Data ***/
name= arm.sig
factors= 1.000, 1.000, 1.000 [Overlap: Preserve, Matching Type: None]
data=
"""


def svc(*wavelengths):
    """A .sig file whose reflectance is 0, 0.1, 0.2 and so on in percent."""
    rows = (f"{nm}  99999.99  1.00  {rank / 10}\n" for rank, nm in enumerate(wavelengths))
    return SVC_HEAD + "".join(rows)


def spectrum_of(tmp_path, text, column="total"):
    path = tmp_path / "arm.txt"
    path.write_text(text)
    return read_spectrum(path, column)


def test_overlapping_detectors_are_cut_where_the_next_one_begins(tmp_path):
    wavelengths = (400.0, 960.5, 985.2, 1012.0, 971.1, 990.0, 1890.0, 1911.5, 1895.0, 2500.0)
    spectrum = spectrum_of(tmp_path, svc(*wavelengths))
    assert spectrum.wavelengths.tolist() == [400.0, 960.5, 971.1, 990.0, 1890.0, 1895.0, 2500.0]
    ranks = np.array([0, 1, 4, 5, 6, 8, 9])
    assert spectrum.reflectance == pytest.approx(ranks / 1000.0, rel=1e-12)
    assert spectrum.notes == (
        "two detectors overlap from 971.1 to 1012 nm; there the second one's values are taken",
        "two detectors overlap from 1895 to 1911.5 nm; there the second one's values are taken",
    )


def test_a_wavelength_that_both_detectors_hold_is_the_second_ones(tmp_path):
    spectrum = spectrum_of(tmp_path, svc(900.0, 1000.0, 1000.0, 1010.0))
    assert spectrum.wavelengths.tolist() == [900.0, 1000.0, 1010.0]
    assert spectrum.reflectance == pytest.approx([0.0, 0.002, 0.003])


@pytest.mark.parametrize(
    ("wavelengths", "line"),
    [
        ((400.0, 500.0, 450.0, 600.0), 7),
        ((400.0, 990.0, 500.0, 1000.0), 7),
        ((400.0, 1010.0, 990.0, 1020.0, 1000.0), 7),
        ((400.0, 1900.0, 980.0, 1200.0), 7),
        ((400.0, 1010.0, 990.0, 1400.0, 1300.0), 7),
    ],
)
def test_other_steps_back_are_refused(tmp_path, wavelengths, line):
    with pytest.raises(InputError, match=f"in line {line}; allowed are values in ascending"):
        spectrum_of(tmp_path, svc(*wavelengths))


def test_a_shell_says_what_was_left_out(tmp_path, capsys):
    note_omissions([spectrum_of(tmp_path, svc(380.0, 780.0, 1000.0, 990.0, 1100.0))])
    assert "note: arm: two detectors overlap from 990 to 1000 nm" in capsys.readouterr().err


def cxf(objects, specifications="", declaration='<?xml version="1.0" encoding="UTF-8"?>\n'):
    return (
        f'{declaration}<cc:CxF xmlns:cc="{NAMESPACE}">\n<cc:Resources><cc:ObjectCollection>\n'
        f"{objects}</cc:ObjectCollection>\n<cc:ColorSpecificationCollection>\n{specifications}"
        "</cc:ColorSpecificationCollection></cc:Resources></cc:CxF>\n"
    )


def cxf_object(name, *spectra, identity="c1"):
    return (
        f'<cc:Object ObjectType="Standard" Name="{name}" Id="{identity}"><cc:ColorValues>\n'
        + "".join(spectra)
        + "</cc:ColorValues></cc:Object>\n"
    )


def cxf_spectrum(values="0.25 0.5", start='StartWL="400"', specification="S1"):
    return (
        f'<cc:ReflectanceSpectrum {start} ColorSpecification="{specification}">'
        f"{values}</cc:ReflectanceSpectrum>\n"
    )


def cxf_range(identity="S1", told='StartWL="400" Increment="100"'):
    return (
        f'<cc:ColorSpecification Id="{identity}"><cc:MeasurementSpec>\n'
        "<cc:MeasurementType>Spectrum_Reflectance</cc:MeasurementType>\n"
        f"<cc:WavelengthRange {told}/></cc:MeasurementSpec></cc:ColorSpecification>\n"
    )


ONE = cxf(cxf_object("inner arm", cxf_spectrum()), cxf_range())


@pytest.mark.parametrize(
    "text",
    [
        ONE,
        ONE.replace("cc:", "").replace("xmlns:cc", "xmlns"),
        ONE.replace("\n", "\r\n"),
        ONE.replace("0.25 0.5", "\n  2.5e-1\n\t.5\n"),
        ONE.partition("\n")[2],
        "\n<!-- by somebody -->\n" + ONE.partition("\n")[2].replace("<cc:CxF", "<cc:CxF ", 1),
        cxf(cxf_object("a", cxf_spectrum(start="")), cxf_range()),
        cxf(cxf_object("a", cxf_spectrum()), cxf_range(told='Increment="100.0"')),
        cxf(cxf_object("a", cxf_spectrum(start='StartWL="400" Increment="100" NumPoints="2"'))),
        ONE.replace("UTF-8", "UTF-16"),
    ],
)
def test_one_spectrum_in_cxf(tmp_path, text):
    spectrum = spectrum_of(tmp_path, text)
    assert spectrum.wavelengths.tolist() == [400.0, 500.0]
    assert spectrum.reflectance.tolist() == [0.25, 0.5]


def test_an_object_of_several_is_told_by_its_name(tmp_path):
    objects = (
        cxf_object("inner arm", cxf_spectrum()),
        cxf_object("cheek", cxf_spectrum("0.3 0.6"), identity="c2"),
        cxf_object("chart", cxf_spectrum("1 2"), cxf_spectrum("3 4", specification="S2"),
                   identity="c3"),
        cxf_object("only a colour", identity="c4"),
    )  # fmt: skip
    text = cxf("".join(objects), cxf_range() + cxf_range("S2", 'StartWL="400" Increment="20"'))
    for name in ("cheek", "c2", "cheek/S1"):
        assert spectrum_of(tmp_path, text, name).reflectance.tolist() == [0.3, 0.6]
    table = cxf_table(text.split("\n"), "x.cxf", "chart/S2")
    assert table.numbers["wavelength_nm"].tolist() == [400.0, 420.0]
    assert table.numbers["total"].tolist() == [3.0, 4.0]
    there = "there are inner arm, cheek, chart/S1, chart/S2"
    for name, sentence in (
        ("total", f"it has several samples; {there}"),
        ("nose", f"it has not one sample 'nose'; {there}"),
        ("chart", f"it has not one sample 'chart'; {there}"),
    ):
        with pytest.raises(InputError, match=re.escape(sentence)):
            spectrum_of(tmp_path, text, name)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (cxf(cxf_object("a", cxf_spectrum())), "line 5 has a spectrum without Increment, and its"),
        (cxf(cxf_object("a", cxf_spectrum(start="")), cxf_range(told="")), "without StartWL"),
        (cxf(cxf_object("a", cxf_spectrum()), cxf_range("S2")), "specification 'S1' has no"),
        (ONE.replace('"400" C', '"380" C'), "line 5 has StartWL 380 and line 11 400; allowed is"),
        (ONE.replace('"100"', '"0"'), "line 11 has an Increment of 0; allowed is more than 0 nm"),
        (ONE.replace('"100"', '"10,0"'), "line 11 has '10,0'; expected a number"),
        (ONE.replace("0.25", "0,25"), "line 5 has '0,25'; expected a number"),
        (ONE.replace("0.25", "nan"), "line 5 has 'nan'; expected a number"),
        (ONE.replace("0.25", "25"), "has a total of 25 in line 5; allowed is 0 to 1"),
        (ONE.replace("0.25 0.5", " "), "has no rows"),
        (ONE.replace('"400" C', '"0.4" C', 1).replace('"400" I', '"0.4" I'), "100 to 100000 nm"),
        (ONE.replace('WL="400" C', 'WL="400" NumPoints="31" C'), "NumPoints of 31 and 2 values"),
        (cxf(cxf_object("a", cxf_spectrum()), 2 * cxf_range()), "line 14 has a second Wavelength"),
        (cxf(""), "it has no sample; there are none"),
        (ONE.replace("CxF3-core", "v2"), "allowed is CxF3"),
        ("<?xml version='1.0'?>\n<html/>", "it is XML of 'html'; allowed is CxF3"),
        (ONE.replace("</cc:Object>", ""), "line 7 is no XML: mismatched tag"),
        (ONE[:-20], "is no XML: "),
        (ONE.replace("0.25", "&x;"), "line 5 is no XML: undefined entity"),
        (
            ONE.replace("<cc:CxF", '<!DOCTYPE x [<!ENTITY x "0.25">]>\n<cc:CxF', 1),
            "line 2 has a document type; CxF3 has none, and entities are not read",
        ),
    ],
)
def test_cxf_that_does_not_say_what_it_holds_is_refused(tmp_path, text, sentence):
    with pytest.raises(InputError) as caught:
        spectrum_of(tmp_path, text)
    assert sentence in str(caught.value)
    assert str(caught.value).count("\n") == 0


VALUES = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=40)


@settings(max_examples=100)
@given(VALUES, st.integers(300, 500), st.integers(1, 20), st.sampled_from([" ", "\n", "\t "]))
def test_cxf_and_cgats_read_as_they_were_written(values, start, step, blank):
    words = [repr(value) for value in values]
    text = cxf(
        cxf_object("a", cxf_spectrum(blank.join(words), f'StartWL="{start}"')),
        cxf_range(told=f'Increment="{step}"'),
    )
    fields = " ".join(f"nm{start + step * place}" for place in range(len(values)))
    cgats = f"BEGIN_DATA_FORMAT\n{fields}\nEND_DATA_FORMAT\nBEGIN_DATA\n{' '.join(words)}\nEND_DATA"
    for table in (cxf_table(text.split("\n"), "x"), cgats_table(cgats.split("\n"), "x")):
        expected = [start + step * place for place in range(len(values))]
        assert table.numbers["wavelength_nm"].tolist() == expected
        assert table.numbers["total"].tolist() == values


def test_only_text_may_follow_the_numbers():
    columns = (Quantity("hour"), Quantity("first_sed"))

    def hours(text):
        read = table_of(text.split("\n"), "x.csv", columns, as_pair=columns)
        return read.numbers["hour"].tolist()

    for head in ("hour,first_sed\n1,2\n3,4\n", "1,2\n3,4\n"):
        for below in (
            "",
            "\n",
            "\nlog\nof, commas\n",
            ",\n\nlog\n\nmore\n",
            ",,\nlog,,\n,,\nmore,,",
        ):
            assert hours(head + below) == [1.0, 3.0]
        for below in (
            "log\n",
            "\n5,6x\n",
            "\nlog\n5,6\n",
            "\nx,6\n",
            "\nlog\n\nhour,first_sed\n5,6\n",
            "\n<5,<6\n",
            "\n,nan\n",
            "\nlog, 7\n",
        ):
            with pytest.raises(InputError, match=r"line \d"):
                hours(head + below)
    assert hours(head + "\n5,6") == [1.0, 3.0, 5.0]
    with pytest.raises(InputError, match="hour in line 3 is 'x'"):
        hours("hour,first_sed\n\nx,y\n")


def test_a_log_below_a_sunscreens_numbers_is_passed_over(tmp_path):
    path = tmp_path / "film.csv"
    path.write_text(
        "Film,\nWavelength (nm),Abs,\n310.0,1.0,\n300.0,2.0,\n\nFilm\nX Mode  Nanometers\n"
    )
    wavelengths, transmittance = read_transmittance(path)
    assert wavelengths.tolist() == [300.0, 310.0]
    assert transmittance == pytest.approx([0.01, 0.1])


def test_a_file_of_many_objects_is_read_in_proportion_to_their_number():
    """Labels were counted once for each label, which took minutes for 16 MB."""
    objects = "".join(cxf_object(f"patch {place}", cxf_spectrum()) for place in range(20_000))
    text = cxf(objects, cxf_range())
    assert cxf_table(text.split("\n"), "x.cxf", "patch 19999").numbers["total"].tolist() == [
        0.25,
        0.5,
    ]


def test_comments_above_are_passed_over_in_proportion_to_their_number():
    comments = "<!-- by somebody -->" * 2000
    assert is_cxf([comments + "<CxF>"])
    assert not is_cxf([comments + "text"])
