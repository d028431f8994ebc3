"""Reflectance spectra in CGATS files (ISO 28178 and its forerunners): every row is a sample.

A row has a field for every wavelength, called SPECTRAL_NM400, SPEC_400, NM400, R_400 or the like;
or it has pairs, SPECTRAL_NM beside SPECTRAL_PCT or SPECTRAL_DEC. `SPECTRAL_NORM` says what counts
as 1.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.layout import finite_number
from hylios.readers.quantities import REFLECTANCE, WAVELENGTH
from hylios.readers.samples import the_sample
from hylios.readers.table import Table

TOKEN = re.compile(r'"[^"]*"|[^\s"]+')
FIELD = re.compile(
    r"(?:SPECTRAL_NM_?|SPECTRAL_|SPECTRUM_|SPEC_|NM_?|R_)(\d{3,4}(?:\.\d+)?)(?:_?NM)?",
    re.IGNORECASE,
)
SAMPLE_NAMES = ("SAMPLE_NAME", "SAMPLE_ID", "SAMPLEID", "SAMPLE_LOC")
TYPES = ("MEAS_TYPE", "SPECT_TYPE", "MEASUREMENT_TYPE")
"""Keywords that say what was measured."""

PAIRED = {"SPECTRAL_PCT": 100.0, "SPECTRAL_DEC": 1.0}


@dataclass(frozen=True)
class Sample:
    """A row: the line it stands in and its values by field, of fields that come often all."""

    line: int
    cells: tuple[str, ...]


def is_cgats(lines: Sequence[str]) -> bool:
    """Whether lines are a CGATS file's: it says where its fields and its data begin."""
    words = {line.strip().upper() for line in lines}
    return {"BEGIN_DATA_FORMAT", "BEGIN_DATA"} <= words


def cgats_table(lines: Sequence[str], name: str, sample: str | None = None) -> Table:
    """Wavelengths and reflectance of a sample.

    Parameters
    ----------
    sample : str, optional
        Its name or number; needed where the file has several.

    Raises
    ------
    InputError
        If there is no such sample, it has no spectrum, or the file is not as it should be.
    """
    try:
        lines = _first_table(lines)
        _require_reflectance(lines)
        fields = tuple(_words(lines, "BEGIN_DATA_FORMAT", "END_DATA_FORMAT"))
        row = _row(fields, _samples(lines, len(fields)), sample)
        wavelengths, values = _spectrum(fields, row, _norm(lines))
    except InputError as error:
        raise InputError(f"{name} cannot be read: {error}.") from error
    numbers = {WAVELENGTH.name: wavelengths, REFLECTANCE.name: values}
    return Table(name, numbers, {}, np.full(wavelengths.size, row.line))


def _first_table(lines: Sequence[str]) -> Sequence[str]:
    """Lines up to where the first table's data end; InputError where another has spectra too."""
    marks = [line.strip().upper() for line in lines]
    if "END_DATA" not in marks:
        return lines
    end = marks.index("END_DATA") + 1
    for number, mark in enumerate(marks[end:], start=end + 1):
        if any(FIELD.fullmatch(word) or word in PAIRED for word in TOKEN.findall(mark)):
            raise InputError(f"line {number} begins a second table of spectra; allowed is one")
    return lines[:end]


def _require_reflectance(lines: Sequence[str]) -> None:
    """Raise InputError where a keyword says that something else was measured."""
    for number, line in enumerate(lines, start=1):
        words = [word.strip('"') for word in TOKEN.findall(line)]
        if len(words) < 2:
            continue
        said = " ".join(words[1:])
        is_other = words[0].upper() in TYPES and "REFLECT" not in said.upper()
        if is_other or (words[0].upper() == "DEVICE_CLASS" and said.upper() == "DISPLAY"):
            raise InputError(
                f"line {number} has {words[0]} {shown(said[:40])!r}; allowed is reflectance"
            )


def _between(lines: Sequence[str], begin: str, end: str) -> list[tuple[int, str]]:
    """Numbered lines between two marks."""
    marks = [line.strip().upper() for line in lines]
    if begin not in marks or end not in marks[marks.index(begin) :]:
        raise InputError(f"it is a CGATS file without {begin} and {end}")
    first = marks.index(begin) + 1
    last = marks.index(end, first)
    return [(number + 1, lines[number]) for number in range(first, last)]


def _words(lines: Sequence[str], begin: str, end: str) -> list[str]:
    return [
        word.strip('"') for _, line in _between(lines, begin, end) for word in TOKEN.findall(line)
    ]


def _samples(lines: Sequence[str], count: int) -> list[Sample]:
    samples = []
    for number, line in _between(lines, "BEGIN_DATA", "END_DATA"):
        cells = tuple(word.strip('"') for word in TOKEN.findall(line))
        if not cells:
            continue
        if len(cells) != count:
            raise InputError(f"line {number} has {len(cells)} cells and the header has {count}")
        samples.append(Sample(number, cells))
    return samples


def _row(fields: tuple[str, ...], samples: Sequence[Sample], sample: str | None) -> Sample:
    """The only sample, or the one of a name."""
    places = [place for place, field in enumerate(fields) if field.upper() in SAMPLE_NAMES]
    names = [[row.cells[place] for place in places] for row in samples]
    labels = [row.cells[places[-1]] if places else str(row.line) for row in samples]
    return the_sample(samples, names, labels, sample)


def _norm(lines: Sequence[str]) -> float:
    for number, line in enumerate(lines, start=1):
        words = [word.strip('"') for word in TOKEN.findall(line)]
        if words and words[0].upper() == "SPECTRAL_NORM":
            norm = finite_number(words[1] if len(words) == 2 else "", number)
            if norm not in (1.0, 100.0):
                raise InputError(
                    f"line {number} has a SPECTRAL_NORM of {norm:g}; allowed is 1 or 100"
                )
            return norm
    return 1.0


def _spectrum(fields: tuple[str, ...], row: Sample, norm: float) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths in nm and reflectance of a sample."""
    matches = [FIELD.fullmatch(field) for field in fields]
    if any(matches):
        wavelengths = [float(match[1]) for match in matches if match]
        values = [
            finite_number(cell, row.line) / norm
            for cell, match in zip(row.cells, matches, strict=True)
            if match
        ]
        return np.array(wavelengths), np.array(values)
    upper = [field.upper() for field in fields]
    pairs = [
        (
            finite_number(row.cells[place], row.line),
            finite_number(row.cells[place + 1], row.line) / per,
        )
        for place, field in enumerate(upper[:-1])
        if field == "SPECTRAL_NM" and (per := PAIRED.get(upper[place + 1]))
    ]
    if not pairs:
        raise InputError("it is a CGATS file without fields of a spectrum, such as SPECTRAL_NM400")
    wavelengths, values = np.array(pairs).T
    return wavelengths, values
