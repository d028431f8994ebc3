"""Tables of instruments whose layout says what they hold: SVC, ASD.

Written after what other programs expect of such files, and tried on samples that we made.

The detectors of an SVC overlap where its header says `Overlap: Preserve`, and its wavelengths step
back. There the earlier detector is cut where the next one begins, since its sensitivity ends there;
SVC's own `Overlap: Remove` cuts in the same region, at a wavelength that the operator sets. Levels
are not matched, which is the operator's choice too. Both seams lie beyond what is visible.
"""

import re
from collections.abc import Sequence

from hylios.errors import InputError, shown
from hylios.readers.layout import NUMBER

SVC_MARK = "/*** Spectra Vista"
SVC_TITLES = "wavelength_nm reference target reflectance_percent"
"""Titles of a .sig file's columns below `data=`; reflectance is in percent of the reference."""

SEAMS = ((900.0, 1100.0), (1700.0, 2000.0))
"""Wavelengths in nm between which the detectors of an SVC take over from each other."""

ASD_MARK = "Text conversion of header file"
ASD_TITLES = "wavelength_nm\treflectance"
ASD_OTHERS = re.compile(r"log\s*\(?1|1/r|derivative|radiance|transmittance|absorb", re.IGNORECASE)
"""What titles of an ASD's columns say that hold something else than reflectance."""

JCAMP = re.compile(r"\s*##\s*(JCAMP.?DX|[XY]UNITS)\s*=", re.IGNORECASE)


def without_instruments_words(lines: Sequence[str]) -> tuple[Sequence[str], tuple[str, ...]]:
    """The lines of a table with an instrument's own words for a header put in ours, and notes.

    Notes say what of the data was left out.

    Raises
    ------
    InputError
        If a file is JCAMP-DX's, if an ASD's does not say that it holds reflectance, or if an
        SVC's has no data.
    """
    for number, line in enumerate(lines, start=1):
        if JCAMP.match(line):
            raise InputError(f"line {number} is JCAMP-DX's, which is not read; export a table")
    head = [line.strip() for line in lines[:3]]
    if any(line.startswith(SVC_MARK) for line in head):
        return _of_svc(lines)
    if any(line.startswith(ASD_MARK) for line in head):
        return _of_asd(lines), ()
    return lines, ()


def _of_svc(lines: Sequence[str]) -> tuple[list[str], tuple[str, ...]]:
    for number, line in enumerate(lines):
        if line.replace(" ", "").casefold() == "data=":
            rows, notes = _without_overlap(lines[number + 1 :])
            return [*["#"] * number, SVC_TITLES, *rows], notes
    raise InputError("it is a spectrum of SVC without a line data=")


def _without_overlap(rows: Sequence[str]) -> tuple[list[str], tuple[str, ...]]:
    """Rows without those of a detector from where the next one begins, and what was cut.

    A step back that is at no seam, or a second one at a seam, stays: it is refused later.
    """
    wavelengths = [_first_number(row) for row in rows]
    kept, notes, seams = list(rows), [], list(SEAMS)
    before = -1
    for row, begin in enumerate(wavelengths):
        if begin is None:
            continue
        last = wavelengths[before] if before >= 0 else None
        before = row
        if last is None or begin > last:
            continue
        seam = next((seam for seam in seams if seam[0] <= begin <= last <= seam[1]), None)
        if seam is None:
            return list(rows), ()
        seams.remove(seam)
        for earlier in range(row):
            wavelength = wavelengths[earlier]
            if wavelength is not None and wavelength >= begin:
                kept[earlier] = "#"
        notes.append(
            f"two detectors overlap from {begin:g} to {last:g} nm; there the second one's "
            "values are taken"
        )
    return kept, tuple(notes)


def _first_number(row: str) -> float | None:
    cell = next(iter(row.split()), "").replace(",", ".")
    return float(cell) if NUMBER.fullmatch(cell) else None


def _of_asd(lines: Sequence[str]) -> list[str]:
    says_reflectance = False
    for number, line in enumerate(lines):
        is_header = re.match(r"wavelength[\t ,;]", line, re.IGNORECASE)
        says = "spectrum file is" in line.casefold()
        says_other = says and "reflectance" not in line.casefold()
        if says_other or ((says or is_header) and ASD_OTHERS.search(line)):
            raise InputError(
                f"line {number + 1} says {shown(line.strip()[:60])!r}; allowed is reflectance data"
            )
        says_reflectance |= says
        if is_header:
            if not says_reflectance:
                raise InputError(
                    "it is a spectrum of ASD that does not say of what; needed is a line "
                    "'Spectrum file is reflectance data'"
                )
            separator = line[len("wavelength")]
            titles = ASD_TITLES.replace("\t", separator)
            return [*["#"] * number, titles, *lines[number + 1 :]]
    raise InputError("it is a spectrum of ASD without a column of wavelengths")
