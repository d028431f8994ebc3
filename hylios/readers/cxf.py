"""Reflectance spectra in CxF3 files (ISO 17972-1), X-Rite's XML: every object is a sample.

A spectrum gives its first wavelength, `StartWL`, and values from 0 to 1; the step is that of the
`WavelengthRange` in the colour specification that it names. A file without a step is refused, for
10 nm is usual but no rule.

The standard library's expat parses it as events, so that no more is kept than spectra. A document
type, and with it entities, is refused. Weighed in place of this: colour-cxf, which builds the whole
schema and needs xsdata, a package more in the wheel that Blender carries.
"""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from xml.parsers import expat

import numpy as np

from hylios.errors import InputError, shown
from hylios.readers.layout import finite_number
from hylios.readers.quantities import REFLECTANCE, WAVELENGTH
from hylios.readers.samples import the_sample
from hylios.readers.table import Table

NAMESPACE = "http://colorexchangeformat.com/CxF3-core"
OBJECT = ["CxF", "Resources", "ObjectCollection", "Object"]
SPECTRUM = [*OBJECT, "ColorValues", "ReflectanceSpectrum"]
SPECIFICATION = ["CxF", "Resources", "ColorSpecificationCollection", "ColorSpecification"]
RANGE = [*SPECIFICATION, "MeasurementSpec", "WavelengthRange"]
BEGINNING = re.compile(r"\s*(<!--(?:(?!-->).)*-->\s*)*<(\?xml|([\w.-]+:)?CxF)[\s>]", re.DOTALL)
LINES_OF_BEGINNING = 20


@dataclass(frozen=True)
class Element:
    """An element's attributes and the line in which it starts."""

    line: int
    attributes: Mapping[str, str]

    def number(self, name: str) -> float | None:
        """An attribute, None where it is not there; InputError where it is no number."""
        text = self.attributes.get(name)
        return None if text is None else finite_number(text.strip(), self.line)


@dataclass(frozen=True)
class Spectrum:
    """A spectrum as it is written, and the object that it is of."""

    element: Element
    sample: Element
    text: str

    @property
    def specification(self) -> str:
        """Id of its colour specification."""
        return self.element.attributes.get("ColorSpecification", "")

    @property
    def names(self) -> list[str]:
        """What it may be called; the last ones tell the spectra of one object apart."""
        attributes = self.sample.attributes
        names = [attributes[key] for key in ("Name", "Id") if attributes.get(key)]
        return [*names, *(f"{name}/{self.specification}" for name in names)]


def is_cxf(lines: Sequence[str]) -> bool:
    """Whether lines begin as XML or CxF does."""
    return bool(BEGINNING.match("\n".join([*lines[:LINES_OF_BEGINNING], ""])))


def cxf_table(lines: Sequence[str], name: str, sample: str | None = None) -> Table:
    """Wavelengths and reflectance of an object.

    Parameters
    ----------
    sample : str, optional
        The object's Name or Id; needed where the file has several spectra. Where an object has
        several, under M0 and M1 for one, it is `NAME/SPECIFICATION`.

    Raises
    ------
    InputError
        If there is no such spectrum, its wavelengths are not told, or the file is no CxF3.
    """
    try:
        spectra, ranges = _parsed("\n".join(lines))
        names = [spectrum.names for spectrum in spectra]
        titles = [called[0] if called else "" for called in names]
        counts = Counter(titles)
        labels = [
            title if counts[title] == 1 or not title else f"{title}/{spectrum.specification}"
            for title, spectrum in zip(titles, spectra, strict=True)
        ]
        spectrum = the_sample(spectra, names, labels, sample)
        wavelengths, values = _arrays(spectrum, ranges.get(spectrum.specification))
    except InputError as error:
        raise InputError(f"{name} cannot be read: {error}.") from error
    numbers = {WAVELENGTH.name: wavelengths, REFLECTANCE.name: values}
    return Table(name, numbers, {}, np.full(wavelengths.size, spectrum.element.line))


def _parsed(text: str) -> tuple[list[Spectrum], dict[str, Element]]:
    """The spectra of all objects, and wavelength ranges by the Id of their specification."""
    parser = expat.ParserCreate(namespace_separator="}")
    path: list[str] = []
    spectra: list[Spectrum] = []
    ranges: dict[str, Element] = {}
    sample = specification = spectrum = Element(0, {})
    words: list[str] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal sample, specification, spectrum
        path.append(tag.removeprefix(NAMESPACE + "}"))
        if path[0] != "CxF":
            raise InputError(f"it is XML of {shown(tag[:60])!r}; allowed is CxF3")
        element = Element(parser.CurrentLineNumber, attributes)
        if path == OBJECT:
            sample = element
        elif path == SPECTRUM:
            spectrum = element
            words.clear()
        elif path == SPECIFICATION:
            specification = element
        elif path == RANGE:
            identity = specification.attributes.get("Id", "")
            if identity in ranges:
                raise InputError(
                    f"line {element.line} has a second WavelengthRange of the specification "
                    f"{shown(identity[:40])!r}; allowed is one"
                )
            ranges[identity] = element

    def end(_: str) -> None:
        if path == SPECTRUM:
            spectra.append(Spectrum(spectrum, sample, "".join(words)))
        path.pop()

    def characters(part: str) -> None:
        if path == SPECTRUM:
            words.append(part)

    def document_type(*_) -> None:
        raise InputError(
            f"line {parser.CurrentLineNumber} has a document type; CxF3 has none, and entities "
            "are not read"
        )

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler = characters
    parser.StartDoctypeDeclHandler = document_type
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise InputError(
            f"line {error.lineno} is no XML: {expat.ErrorString(error.code)}"
        ) from None
    return spectra, ranges


def _arrays(spectrum: Spectrum, grid: Element | None) -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths in nm and reflectance of a spectrum whose specification has some grid."""
    elements = [spectrum.element] if grid is None else [spectrum.element, grid]
    first = _told("StartWL", elements, spectrum)
    step = _told("Increment", elements, spectrum)
    if step <= 0.0:
        raise InputError(
            f"line {elements[-1].line} has an Increment of {step:g}; allowed is more than 0 nm"
        )
    line = spectrum.element.line
    values = np.array([finite_number(word, line) for word in spectrum.text.split()])
    count = spectrum.element.number("NumPoints")
    if count is not None and count != values.size:
        raise InputError(f"line {line} has NumPoints of {count:g} and {values.size} values")
    return first + step * np.arange(values.size), values


def _told(name: str, elements: Sequence[Element], spectrum: Spectrum) -> float:
    """What a spectrum and its specification's range say of its wavelengths, if they agree."""
    numbers = [(element.line, element.number(name)) for element in elements]
    told = [(line, number) for line, number in numbers if number is not None]
    if not told:
        raise InputError(
            f"line {spectrum.element.line} has a spectrum without {name}, and its specification "
            f"{shown(spectrum.specification[:40])!r} has no WavelengthRange with one"
        )
    if len({number for _, number in told}) > 1:
        (line, number), (other, differing) = told
        raise InputError(
            f"line {line} has {name} {number:g} and line {other} {differing:g}; allowed is one"
        )
    return told[0][1]
