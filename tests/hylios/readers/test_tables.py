"""Tables of text: whatever way one is written, it reads as what was written or not at all."""

import codecs
import io
import os
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.readers import text
from hylios.readers.quantities import Quantity, named
from hylios.readers.table import Table, read_table, table_of

COLUMNS = tuple(Quantity(name) for name in ("hour", "first_sed", "second_sed"))
PAIR = (Quantity("hour"), Quantity("first_sed"))
NUMBERS = st.one_of(
    st.integers(0, 5000).map(float),
    st.floats(1e-6, 1e4, allow_nan=False),
    st.integers(0, 9_999_999).map(lambda whole: whole / 1000.0),
)


@st.composite
def written(draw):
    """Numbers (N, 2 or 3) and a table of them in one of many layouts, as bytes."""
    width = draw(st.sampled_from([2, 3]))
    values = np.array(draw(st.lists(st.lists(NUMBERS, min_size=width, max_size=width), min_size=1)))
    separator = draw(st.sampled_from(["\t", ";", ",", ", ", " ", "   "]))
    mark = draw(st.sampled_from(".,"))
    spelled = draw(st.sampled_from([repr, "{:.3f}".format, "{:.12g}".format]))
    values = np.array([[float(spelled(value)) for value in row] for row in values.tolist()])
    quoted = draw(st.booleans())
    rows = [[spelled(value).replace(".", mark) for value in row] for row in values.tolist()]
    titles = [column.name for column in COLUMNS[:width]]
    has_header = draw(st.booleans())
    cells = [titles, *rows] if has_header else rows
    lines = [separator.join(f'"{cell}"' if quoted else cell for cell in row) for row in cells]
    above = draw(st.lists(st.sampled_from(["# note", "Instrument: X", "", "-----"]), max_size=3))
    below = draw(st.lists(st.sampled_from(["", separator.strip(" ") * (width - 1)]), max_size=2))
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    encoding, bom = draw(
        st.sampled_from(
            [
                ("utf-8", b""),
                ("utf-8", codecs.BOM_UTF8),
                ("utf-16-le", codecs.BOM_UTF16_LE),
                ("utf-16-be", codecs.BOM_UTF16_BE),
                ("utf-16-le", b""),
                ("utf-32-le", codecs.BOM_UTF32_LE),
            ]
        )
    )
    whole = end.join([*above, *lines, *below]) + end
    return values, bom + whole.encode(encoding)


@settings(max_examples=600)
@given(written())
def test_a_table_reads_as_it_was_written_or_is_refused(tmp_path_factory, table):
    values, data = table
    path = tmp_path_factory.getbasetemp() / "table.csv"
    path.write_bytes(data)
    needed = COLUMNS[: values.shape[1]]
    try:
        read = read_table(path, needed, as_pair=PAIR)
    except InputError as error:
        assert str(error).count("\n") == 0 and str(error).endswith(".")
        return
    for column, expected in zip(needed, values.T, strict=True):
        assert read.numbers[column.name].tolist() == expected.tolist()


def table(lines: str, needed=PAIR, **more) -> Table:
    return table_of(lines.split("\n"), "x.csv", needed, as_pair=PAIR, **more)


@pytest.mark.parametrize(
    "lines",
    [
        "hour,first_sed\n1,0.5\n2,0.25",
        "hour;first_sed\n1;0,5\n2;0,25",
        "hour\tfirst_sed\n1\t0,5\n2\t0,25",
        "hour first_sed\n1   0.5\n 2 0.25",
        "1,0.5\n2,0.25",
        "1;0,5\n2;0,25",
        '"hour","first_sed"\n"1","0,5"\n"2","0,25"',
        "first_sed, hour\n0.5, 1\n0.25, 2",
        "# a note\n\nhour,first_sed\n#1,7\n1,0.5\n,\n2,0.25\n,\n,\n",
        "hour,first_sed,,\n1,0.5,,\n2,0.25,,",
        "hour,first_sed\n1,0.5,\n2,0.25,",
        "Made by X\nof day 1, at noon\nhour,first_sed,remark\n1,0.5,a\n2,0.25,",
        "Made by X\n>>>>>Begin Data<<<<<\n1\t0.5\n2\t0.25\n>>>>>End Data<<<<<\nmore",
        "hour,first_sed\n+1,.5\n2.0,25e-2",
        "Hour,First_SED\n1,.5\n2.0,.25",
        "# hour,first_sed\n1,.5\n2.0,.25",
        "# first_sed hour\n.5 1\n.25 2",
        "BEGIN_DATA\n1,.5\n2.0,.25\nEND_DATA\nmore",
        "hour,first_sed\n1,.5\n2.0,.25\nEND_DATA\n",
    ],
)
def test_layouts_that_mean_one_thing_are_read(lines):
    read = table(lines)
    assert read.numbers["hour"].tolist() == [1.0, 2.0]
    assert read.numbers["first_sed"].tolist() == [0.5, 0.25]


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        ("", "x.csv cannot be read: it is empty."),
        ("hour\n1", "it has no column first_sed; needed is hour,first_sed, and there is 'hour'."),
        ("hour,b\n1,2", "it has no column first_sed; needed is hour,first_sed, and there is"),
        ("a,b\n1,2,3", "it has no column hour"),
        ("1,2,3\n4,5,6", "it has no column hour"),
        ("hour,first_sed\n0,28,5\n48,12,25", "line 2 has 3 cells and the header has 2; a comma"),
        ("hour,first_sed\n\n1", "line 3 has 1 cells and the header has 2"),
        ("hour,first_sed,hour\n1,2,3", "the column hour is there twice, as 'hour' and 'hour'"),
        ("hour,first_sed\n1,", "first_sed in line 2 is empty; expected a number"),
        ("hour,first_sed\n1,x", "first_sed in line 2 is 'x'; expected a number"),
        ("hour,first_sed\n1,1_0", "first_sed in line 2 is '1_0'; expected a number"),
        ("hour,first_sed\n1,٤", "expected a number"),
        ("hour,first_sed\n1,nan", "first_sed in line 2 is nan; allowed are finite numbers"),
        ("hour,first_sed\n1,1e999", "first_sed in line 2 is 1e999; allowed are finite numbers"),
        ("hour;first_sed\n1;2,5\n2;3.5", "line 2 has the number '2,5' and line 3 '3.5'; allowed"),
        ("hour;first_sed\n1;1.234,5", "expected a number"),
        ('hour,first_sed\n1,"1,234"', "whose comma may mark decimals or thousands"),
        ('hour,first_sed\n1,"2', "line 2 has a quote that does not end"),
        ("1,2\n3,4,5", "line 2 has 3 cells and line 1 has 2"),
        ("hour,first_sed\n1,2\nEND_DATA\n3,4", "line 3 has 1 cells and the header has 2"),
        ("hour,first_sed\n1,2" + 131_073 * "1", "line 2: field larger than field limit"),
        ("1,0.2O\n2,0.21", "line 1 is neither a header nor a row of numbers"),
        ("1,5\nhour,first_sed\n2,6", "line 1 is neither a header nor a row of numbers"),
        ("hour;first_sed\n1,2\n3,4", "line 2 has 1 cells"),
    ],
)
def test_what_can_be_misread_is_refused_with_the_line(lines, sentence):
    with pytest.raises(InputError) as caught:
        table(lines)
    assert sentence in str(caught.value)
    assert str(caught.value).startswith("x.csv cannot be read: ")
    assert str(caught.value).count("\n") == 0


def test_a_control_character_is_not_shown_raw():
    with pytest.raises(InputError) as caught:
        table("hour,first_sed\n1,\x1b[31m")
    assert "\x1b" not in str(caught.value)


def test_what_is_in_range_and_in_order():
    read = table("hour,first_sed\n3,0.5\n2,0.75\n1,1.5")
    assert read.in_order("hour").numbers["first_sed"].tolist() == [1.5, 0.75, 0.5]
    with pytest.raises(InputError, match="x.csv has a first_sed of 1.5 in line 4; allowed is 0 to"):
        read.in_order("hour").require_range("first_sed", 0.0, 1.0)
    for lines in ("hour,first_sed\n1,0\n1,0", "hour,first_sed\n1,0\n3,0\n2,0", "hour,first_sed"):
        with pytest.raises(InputError, match="order|no rows"):
            table(lines).in_order("hour")


@pytest.mark.parametrize(
    ("title", "name", "unit"),
    [
        ("Wavelength [nm]", "wavelength", "nm"),
        ("wavelength_nm", "wavelength", "nm"),
        ("λ/nm", "λ", "nm"),
        ("Wavelength (µm)", "wavelength", "um"),
        ("Wavelength (Ångström)", "wavelength", "å"),
        ("%R", "r", "%"),
        ("Reflect. %", "reflect", "%"),
        ("total_percent", "total", "%"),
        ("Irradiance [W m^-2 nm^-1]", "irradiance", "w/m2/nm"),
        ("Irradiance (µW/cm²/nm)", "irradiance", "uw/cm2/nm"),
        ("Irradiance (W/(m^2 nm))", "irradiance", "w/m2/nm"),
        ("standard_error", "standard_error", ""),
    ],
)
def test_titles_have_a_name_and_a_unit(title, name, unit):
    assert named(title) == (name, unit)


def test_only_regular_files_are_opened(tmp_path):
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    for path in (fifo, Path("/dev/zero"), tmp_path):
        with pytest.raises(InputError, match="it is no regular file"):
            text.lines_of(path)
    with pytest.raises(InputError, match="cannot be read: No such file or directory"):
        text.lines_of(tmp_path / "none")
    with pytest.raises(InputError, match="cannot be read"):
        text.lines_of(Path("a\0b"))


def test_a_large_file_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(text, "MOST_BYTES", 10)
    path = tmp_path / "large.csv"
    path.write_text("12345678901")
    with pytest.raises(InputError, match="it has more than 10 bytes"):
        text.lines_of(path)


@pytest.mark.parametrize("data", [b"\x00\x01\x02\x00", b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR"])
def test_what_is_no_text_is_refused(tmp_path, data):
    path = tmp_path / "x.csv"
    path.write_bytes(data)
    with pytest.raises(InputError, match="cannot be read"):
        read_table(path, PAIR, as_pair=PAIR)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "cp1252"])
def test_standard_input_is_decoded_as_a_file_is(monkeypatch, encoding):
    data = "Größe,hour,first_sed\nµ,1,0.5\n".encode(encoding)
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    read = read_table(Path("-"), PAIR)
    assert read.name == "standard input"
    assert read.numbers["first_sed"].tolist() == [0.5]


def test_a_closed_standard_input_is_a_sentence(monkeypatch):
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(InputError, match="standard input cannot be read: it is closed"):
        read_table(Path("-"), PAIR)
