"""Files of instruments whose layout says what they hold: SVC, ASD, CGATS.

Written after what other programs expect of such files, and tried on samples that we made.
"""

import re
from collections.abc import Sequence

from hylios.errors import InputError, shown

SVC_MARK = "/*** Spectra Vista"
SVC_TITLES = "wavelength_nm reference target reflectance_percent"
"""Of the columns of a .sig file below `data=`; its reflectance is in percent of the reference."""

ASD_MARK = "Text conversion of header file"
ASD_TITLES = "wavelength_nm\treflectance"


def without_instruments_words(lines: Sequence[str]) -> Sequence[str]:
    """The lines of a table, where an instrument's own words for a header are put in ours.

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
        return _of_asd(lines)
    return lines


def _of_svc(lines: Sequence[str]) -> list[str]:
    for number, line in enumerate(lines):
        if line.replace(" ", "").casefold() == "data=":
            return [*["#"] * number, SVC_TITLES, *lines[number + 1 :]]
    raise InputError("it is a spectrum of SVC without a line data=")


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
