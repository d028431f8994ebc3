"""Spectra in files of people, programs and instruments."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.readers.spectrum import (
    read_irradiance,
    read_spectra,
    read_spectrum,
    read_transmittance,
    read_values,
)


@pytest.fixture
def file(tmp_path):
    """Writes a file of some text and returns its path."""

    def write(text, name="arm.csv"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


SVC = """\
/*** Spectra Vista SIG Data ***/
name= arm.sig
instrument= HI: 1122015 (HR-1024i)
units= Radiance, Radiance
factors= 1.007, 1.000, 0.996 [Overlap: Remove @ 990,1900, Matching Type: None]
data=
400.0  99999.99  25000.00  25.00
500.0  99999.99  50000.00  50.00
"""
ASD = """\

Text conversion of header file C:\\spectra\\arm.asd
-----------------------------------------------
The instrument number was 6345/1
New ASD spectrum file: Program version = 6.00  file version =  5.00
Spectrum saved: 05/04/2012 at 12:11:52
Spectrum file is reflectance data
Wavelength\tarm.asd.mn
400\t0.25
500\t0.5
"""
SED = """\
Comment: arm
Version: 2.2
Columns [5]:
Data:
Chan.#\tWvl\tNorm. DN (Ref.)\tNorm. DN (Target)\tReflect. %
0\t400.0\t1.0E4\t2.5E3\t25.00
1\t500.0\t1.0E4\t5.0E3\t50.00
"""
CGATS = """\
CGATS.17
ORIGINATOR "somebody"
{norm}
BEGIN_DATA_FORMAT
SAMPLE_ID SAMPLE_NAME {fields}
END_DATA_FORMAT
NUMBER_OF_SETS 1
BEGIN_DATA
1 "inner arm" {values}
END_DATA
"""
CARY = """\
Sample1,
Wavelength (nm),%R,
500.0,50.0,
400.0,25.0,

Sample1
Collection Time: 5/3/2021 2:31:44 PM
Operator Name:   ( Not Entered )
Parameter List :
 X Mode                             Nanometers
 Start (nm)                         500.0
 Stop (nm)                          400.0

<End of method>
"""
OCEAN = """\
SpectraSuite Data File
++++++++++++++++++++++++++++++++++++
Integration Time (usec): 100000 (USB4F00000)
Number of Pixels in Processed Spectrum: 2
>>>>>Begin Processed Spectral Data<<<<<
400,0\t0,25
500,0\t0,50
>>>>>End Processed Spectral Data<<<<<
"""


@pytest.mark.parametrize(
    "text",
    [
        "wavelength_nm,total\n400,0.25\n500,0.5\n",
        "wavelength_nm,total\n500,0.5\n400,0.25\n",
        "Wavelength [nm];Reflectance [%]\n400;25,0\n500;50,0\n",
        "Wellenlänge (nm);R (%)\n400;25,0\n500;50,0\n".encode("cp1252"),
        "nm\t%R\n500\t50\n400\t25\n",
        "Wavelength\tReflectance\nnm\t%\n400\t25\n500\t50\n",
        "Sample1,\nWavelength (nm),%R,\n500.0,50.0,\n400.0,25.0,\n",
        "wavelength (um),reflectance\n0.4,0.25\n0.5,0.5\n",
        "wavelength (angstrom),reflectance\n4000,0.25\n5000,0.5\n",
        "# wavelength_nm,total_percent\n400,25\n500,50\n",
        "# wavelength,total\n# nm,%\n# of an arm\n400,25\n500,50\n",
        "# of an arm\n400,0.25\n500,0.5\n",
        "Wavelength (A\u030a),Reflectance\n4000,0.25\n5000,0.5\n",
        "Wavelength [nm],R\n[nm],[%]\n400,25\n500,50\n",
        SVC,
        ASD,
        SED,
        OCEAN,
        CARY,
        CARY.replace("R,\n", "R\n").replace("0,\n", "0\n"),
        CARY.replace(",", "\t"),
        CGATS.format(norm="", fields="SPECTRAL_NM400 SPECTRAL_NM500", values="0.25 0.5"),
        CGATS.format(norm='SPECTRAL_NORM "100"', fields="SPEC_400 SPEC_500", values="25 50"),
        CGATS.format(norm="", fields="nm400 nm500", values="0.25 0.5"),
        CGATS.format(
            norm="",
            fields="SPECTRAL_NM SPECTRAL_PCT SPECTRAL_NM SPECTRAL_PCT",
            values="500 50.0 400 25.0",
        ),
    ],
)
def test_one_spectrum_in_many_layouts(file, text):
    spectrum = read_spectrum(file(text))
    assert spectrum.name == "arm"
    assert spectrum.wavelengths.tolist() == [400.0, 500.0]
    assert spectrum.reflectance.tolist() == [0.25, 0.5]
    assert spectrum.standard_error is None


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "arm.csv cannot be read: it is empty."),
        ("wavelength_nm\n400\n", "it has no column total"),
        ("a,total\n400,0.1\n", "it has no column wavelength_nm"),
        ("wavelength_nm,absorbance\n400,0.1\n", "it has no column total"),
        ("wavelength_nm,total\n", "needed is one or more wavelength_nm"),
        ("wavelength_nm,total\n500,0.1\n400,0.2\n450,0.2\n", "has a wavelength_nm of 450 after"),
        ("wavelength_nm,total\n400,x\n", "total in line 2 is 'x'; expected a number"),
        ("wavelength_nm,total\n400\n", "line 2 has 1 cells and the header has 2"),
        ("wavelength_nm,total\n400,nan\n", "allowed are finite numbers"),
        ("wavelength_nm,total\n400,45.2\n", "allowed is 0 to 1, or percent where the column is"),
        ("wavelength_nm,total,standard_error\n400,0.1,-1\n", "standard_error of -1 in line 2"),
        ("wavelength_nm,total\n400,0.2\n500,-0.1\n", "has a total of -0.1 in line 3"),
        ("wavelength_nm,total\n0.4,0.2\n", "allowed is 100 to 100000 nm; other units are read"),
        ("wavelength_nm,total\n1e308,0.2\n", "has a wavelength_nm of 1e+308 in line 2"),
        ("wavelength (eV),total\n3,0.2\n", "the column 'wavelength (eV)' is in ev; allowed is"),
        ("wavelength_nm,R,refl\n400,0.2,0.3\n", "the column total is there twice, as 'R' and"),
        ("wavelength_nm,total,total\n400,.2,.1\n", "the column total is there twice"),
        (ASD.replace("is reflectance", "is raw"), "allowed is reflectance data"),
        (SVC.replace("500.0", "399.0").replace("25.00\n", "25.00\n410 1 1 1\n"), "in line 9"),
        (SVC.replace("data=", "date="), "a spectrum of SVC without a line data="),
        (CGATS.format(norm="", fields="LAB_L", values="50"), "without fields of a spectrum"),
        (CGATS.format(norm="", fields="nm400", values="0,5"), "line 9 has '0,5'; expected a"),
        (CGATS.format(norm="", fields="nm400", values=".5 .5"), "line 9 has 4 cells and the"),
        (CGATS.format(norm="SPECTRAL_NORM 7", fields="nm400", values=".5"), "allowed is 1 or 100"),
    ],
)
def test_a_file_that_is_no_spectrum_is_refused(file, text, sentence):
    with pytest.raises(InputError) as caught:
        read_spectrum(file(text))
    assert sentence in str(caught.value)
    assert str(caught.value).count("\n") == 0


def test_decimal_commas_cannot_pass_for_a_standard_error(file):
    """400,0,2133 below three titles is .2133; read as it stands it would be black."""
    rows = "".join(f"{400 + 10 * step},0,{2000 + 133 * step}\n" for step in range(9))
    with pytest.raises(
        InputError, match="line 2 may be numbers with a decimal comma or with none; write"
    ):
        read_spectrum(file("wavelength_nm,total,standard_error\n" + rows))


def test_a_sample_of_several_is_told_by_its_name(file):
    one = CGATS.format(norm="", fields="nm400 nm500", values="0.25 0.5")
    path = file(one.replace("END_DATA\n", '2 "cheek" 0.3 0.6\nEND_DATA\n'))
    path.write_text(path.read_text().replace('_FORMAT\n2 "cheek" 0.3 0.6\n', "_FORMAT\n"))
    assert read_spectrum(path, "cheek").reflectance.tolist() == [0.3, 0.6]
    assert read_spectrum(path, "1").reflectance.tolist() == [0.25, 0.5]
    with pytest.raises(InputError, match="it has several samples; there are inner arm, cheek"):
        read_spectrum(path)
    with pytest.raises(InputError, match="it has not one sample 'nose'"):
        read_spectrum(path, "nose")


def test_another_column_is_told_by_its_name(file):
    path = file("wavelength_nm,total,Cheek (%)\n400,0.2,25\n500,0.3,50\n")
    assert read_spectrum(path, "Cheek").reflectance.tolist() == [0.25, 0.5]
    assert read_spectrum(path).reflectance.tolist() == [0.2, 0.3]


def test_spectra_of_files_of_one_name_are_named_by_their_paths(file):
    text = "wavelength_nm,total\n400,0.25\n"
    paths = [file(text), file(text, "other/arm.csv")]
    assert [spectrum.name for spectrum in read_spectra(paths)] == [str(path) for path in paths]


def test_a_name_is_shown_on_one_line(file):
    text = "wavelength_nm,total\n400,0.25\n"
    assert read_spectrum(file(text, "a\nb\x1b.csv")).name == "a\\nb\\x1b"
    assert read_spectrum(file(text, "a\udcff.csv")).name == "a\\udcff"


@pytest.mark.parametrize(
    ("title", "factor"),
    [
        ("irradiance_w_m2_nm", 1.0),
        ("Irradiance (W/m^2/nm)", 1.0),
        ("Spectral irradiance [mW m-2 nm-1]", 1e-3),
        ("irradiance (µW/cm²/nm)", 1e-2),
    ],
)
def test_a_lamp_may_be_in_several_units(file, title, factor):
    wavelengths, irradiance = read_irradiance(file(f"Wavelength (nm),{title}\n300,2\n310,4\n"))
    assert wavelengths.tolist() == [300.0, 310.0]
    assert irradiance == pytest.approx(factor * np.array([2.0, 4.0]), rel=1e-12)


def test_an_irradiance_without_a_unit_is_refused(file):
    with pytest.raises(InputError, match="the column 'Irradiance' is in no unit; allowed is w/m2"):
        read_irradiance(file("nm,Irradiance\n300,2\n"))


def test_a_sunscreen_is_given_by_transmittance_or_absorbance(file):
    for text in ("nm,T\n300,0.01\n310,0.1\n", "nm;%T\n310;10\n300;1\n", "nm,Abs\n300,2\n310,1\n"):
        wavelengths, transmittance = read_transmittance(file(text))
        assert wavelengths.tolist() == [300.0, 310.0]
        assert transmittance == pytest.approx([0.01, 0.1], rel=1e-12)
    with pytest.raises(InputError, match="has no column transmittance"):
        read_transmittance(file("nm,total\n300,2\n"))


def test_two_columns_of_an_absorber(file):
    for text in ("400,5\n500,7\n", "nm;value\n500;7,0\n400;5,0\n", "nm,Keratin\n400,5\n500,7\n"):
        wavelengths, values = read_values(file(text), "keratin", 0.0, 1e9)
        assert (wavelengths.tolist(), values.tolist()) == ([400.0, 500.0], [5.0, 7.0])
    with pytest.raises(InputError, match=r"has a value of 1e\+308 in line 1; allowed is 0 to 1e"):
        read_values(file("400,1e308\n"), "keratin", 0.0, 1e9)


@pytest.mark.parametrize(
    "head",
    [
        "lam,absorbance\n",
        "# lam,absorbance\n",
        "Lambda (nm);A\n",
        "wavenumber,absorbance\n(1/cm),(AU)\n",
        "lam,absorbance\n---,---\n",
        "lam nm absorbance\n",
        "# absorbance of a film\n",
        "# lam,absorbance\n# of a film\n",
    ],
)
def test_numbers_below_titles_of_something_else_are_not_taken(file, head):
    path = file(head + "300,0.5\n310,0.1\n")
    for read in (read_transmittance, read_spectrum):
        with pytest.raises(
            InputError, match="line 1 (has the t|says)|it has no column|line 2 has 1"
        ):
            read(path)


def test_what_is_understood_is_told_with_the_line(file):
    with pytest.raises(InputError) as caught:
        read_transmittance(file("\nlam,absorbance\n300,0.5\n"))
    assert "line 2 has the titles 'lam', 'absorbance'; understood are wavelength_nm (" in str(
        caught.value
    )


@pytest.mark.parametrize(
    "text",
    [
        "# wavelength_nm,absorbance\n300,2\n310,1\n",
        "# wavelength absorbance\n300 2\n310 1\n",
        "Wavelength,Absorbance\n(nm),(AU)\n300,2\n310,1\n",
        "Wavelength nm,Absorbance (mAU)\n300,2000\n310,1000\n",
    ],
)
def test_an_absorbance_is_read_as_one(file, text):
    assert read_transmittance(file(text))[1] == pytest.approx([0.01, 0.1], rel=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "wavelength_nm,total,x\n400,1,0\n500,0,3\n",
        "wavelength_nm,total,standard_error,n\n400,0,0,2\n500,0,0,3\n",
        "wavelength_nm,transmittance,x\n400,0,25\n500,0,31\n",
    ],
)
def test_commas_that_may_be_decimal_ones_are_refused(file, text):
    read = read_transmittance if "transmittance" in text else read_spectrum
    with pytest.raises(InputError, match="line 2 may be numbers with a decimal comma or with none"):
        read(file(text))
    assert read_spectrum(file("wavelength_nm,total\n400,1\n")).reflectance.tolist() == [1.0]
    zeros = "wavelength_nm,total,standard_error\n400,0,0\n"
    assert read_spectrum(file(zeros)).reflectance.tolist() == [0.0]
    with pytest.raises(InputError, match="line 2 has 3 cells and the header has 2"):
        read_spectrum(file("wavelength_nm,total,\n400,0,2\n"))


@pytest.mark.parametrize(
    ("titles", "sentence"),
    [
        ("wavelength_nm,total,Total", "is there twice, as 'total' and 'Total'"),
        ("wavelength_nm,reflectance,total", "is there twice, as 'reflectance' and 'total'"),
        ("wavelength (um),total,wavelength_nm", "as 'wavelength (um)' and 'wavelength_nm'"),
        ("Wavelength,R,G,B", "the column 'R' is beside G and B"),
    ],
)
def test_of_two_columns_that_serve_none_is_taken(file, titles, sentence):
    path = file(f"{titles}\n400,0.25,0.5,0.1\n"[: None if titles.count(",") > 2 else -5] + "\n")
    with pytest.raises(InputError, match=sentence.replace("(", r"\(").replace(")", r"\)")):
        read_spectrum(path)
    if "wavelength_nm," in titles:
        assert read_spectrum(path, "total").reflectance[0] in (0.25, 0.5)
        other = next(title for title in titles.split(",")[1:] if title != "total")
        assert read_spectrum(path, other).reflectance != read_spectrum(path, "total").reflectance


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("nm,irradiance_w_m2_nm\n300,-1\n", "has a irradiance_w_m2_nm of -1 in line 2; allowed"),
        ("nm,Irradiance (W/cm2/nm)\n300,1e308\n", "in line 2 is 1e308; allowed are finite numb"),
        ("nm,Irradiance (MW/m2/nm)\n300,1\n", "is in MW/m2/nm; allowed is w/m2/nm"),
        ("Wavelength [um],Irradiance\nnm,uW/cm2/nm\n300,1\n", "line 2 has the unit 'nm' below"),
        ("Lambda nm,Irrad mW\n300,1\n", "it has no column irradiance_w_m2_nm"),
    ],
)
def test_a_lamp_that_is_not_understood_is_refused(file, text, sentence):
    with pytest.raises(InputError) as caught:
        read_irradiance(file(text))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("##TITLE=x\n##JCAMP-DX=4.24\n##YUNITS=ABSORBANCE\n400, 0.5\n", "line 2 is JCAMP-DX's"),
        ("##YUNITS=REFLECTANCE\n400 0.5\n", "line 1 is JCAMP-DX's, which is not read"),
        (ASD.replace("Spectrum file is reflectance data", ""), "ASD that does not say of what"),
        (ASD.replace("\tarm", "\tlog 1/R arm"), "log 1/R arm.asd.mn'; allowed is reflectance"),
    ],
)
def test_an_instruments_file_of_something_else_is_refused(file, text, sentence):
    for read in (read_spectrum, read_transmittance):
        with pytest.raises(InputError) as caught:
            read(file(text))
        assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("keyword", "is_read"),
    [
        ('MEAS_TYPE "EMISSION"', False),
        ('SPECT_TYPE "TRANSMISSIVE"', False),
        ('MEASUREMENT_TYPE "TRANSMITTANCE"', False),
        ('DEVICE_CLASS "DISPLAY"', False),
        ('MEAS_TYPE "REFLECTIVE"', True),
        ('KEYWORD "MEAS_TYPE"', True),
    ],
)
def test_a_cgats_file_says_what_was_measured(file, keyword, is_read):
    path = file(CGATS.format(norm=keyword, fields="nm400 nm500", values="0.25 0.5"))
    if is_read:
        assert read_spectrum(path).reflectance.tolist() == [0.25, 0.5]
    else:
        with pytest.raises(InputError, match="line 3 has .*; allowed is reflectance"):
            read_spectrum(path)


def test_a_second_tables_norm_is_not_the_firsts(file):
    first = CGATS.format(norm="", fields="nm400", values="0.25")
    second = CGATS.format(norm="SPECTRAL_NORM 100", fields="nm400", values="25")
    with pytest.raises(InputError, match="line 15 begins a second table of spectra"):
        read_spectrum(file(first + second))
    tail = "SPECTRAL_NORM 100\n"
    assert read_spectrum(file(first + tail)).reflectance.tolist() == [0.25]
