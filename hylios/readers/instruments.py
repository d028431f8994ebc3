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


def without_instruments_words(lines: Sequence[str]) -> tuple[Sequence[str], tuple[str, ...]]:
    """The lines of a table with an instrument's own words for a header put in ours, and notes.

    Notes say what of the data was left out.

    Raises
    ------
    InputError
        If an ASD's file says that it holds something else than reflectance, or if an SVC's has no
        data.
    """
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
    for number, line in enumerate(lines):
        if "spectrum file is" in line.casefold() and "reflectance" not in line.casefold():
            raise InputError(
                f"line {number + 1} says {shown(line.strip()[:60])!r}; allowed is reflectance data"
            )
        if re.match(r"wavelength[\t ,;]", line, re.IGNORECASE):
            separator = line[len("wavelength")]
            titles = ASD_TITLES.replace("\t", separator)
            return [*["#"] * number, titles, *lines[number + 1 :]]
    raise InputError("it is a spectrum of ASD without a column of wavelengths")
