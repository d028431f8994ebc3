"""The page of docs that sets people's redness and tans beside the model's, row by row."""

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from shutil import copyfile
from textwrap import fill

from examples.figures.measured_tans import FIGURES, PICTURES, Beside
from hylios.files import written_beside
from hylios.tanning import KINETICS

HEAD = """\
# People's redness and tans beside the model

What was measured on people after ultraviolet, row by row, and what the model makes of it: redness,
tans by the [two kinetics](skin_types.md), immediate darkening, thickness and peeling. `make figures
FIGURES=people PAGE=docs/people.md` computes all of it anew and writes this page; the rows are in
`hylios/lab/measured_tans.csv`, and a test says which are not met.

No full text was read: quality A is a number or a statement in the source's abstract, B what its
words say or what follows from it. **ESTIMATE** marks C (from memory or second hand), E (a guess)
and L (health pages for everyone): no measurement. The model's redness is an estimate but for the
rows to which it was fitted. So is a tan between those rows to which its kinetics was.

A model's number in bold is beyond the tolerance, by what stands in brackets; tolerances are this
project's where the row says "within". With "none" the model has nothing to say of it, or it was
not computed. Numbers that depend on the skin are of type II (redness) and III, unless a row names
others.
"""

SHOWN = {
    "redness": ("redness", "a* of type II over eight days after 1, 2, 4 and 8 MED"),
    "tan": ("melanin", "Melanin over half a year by both kinetics, beside people"),
    "immediate darkening": None,
    "thickness and peeling": None,
}
"""Picture under a subject's heading, and what it shows."""

WORDS = {
    "redness": "Redness does not depend on the kinetics, but for the tan that is seen with it.",
    "tan": "Grey is when people's tan is darkest, and when it is gone; dots are 5 %.",
    "immediate darkening": "UVA darkens the melanin that is there. Both kinetics are alike in it.",
    "thickness and peeling": "Thickness is the thesis's (table 6.6); peeling is an ESTIMATE.",
}


def write(path: Path, beside: Sequence[Beside], pictures: Path) -> None:
    """Write the page, and its pictures in a folder beside it."""
    folder = path.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    for name in PICTURES:
        with written_beside(folder / f"{name}.png") as file:
            copyfile(pictures / f"{FIGURES[0]}_{name}.png", file)
    types = _image(
        folder.name, "types", "Skin types I to VI over the days of a burn and of two weeks"
    )
    parts = [HEAD, _summary(beside), types]
    for subject, own in groupby(beside, key=lambda one: one.row.subject):
        parts += [f"## {subject.capitalize()}", WORDS[subject]]
        shown = SHOWN[subject]
        if shown:
            parts.append(_image(folder.name, *shown))
        parts.append(table(list(own)))
    with written_beside(path) as file:
        file.write_text("\n\n".join(part.strip() for part in parts) + "\n", encoding="utf-8")


def _image(folder: str, name: str, shows: str) -> str:
    return f"```{{image}} {folder}/{name}.png\n:alt: {shows}.\n:width: 100%\n```"


def _summary(beside: Sequence[Beside]) -> str:
    met = {
        name: [own.is_met(name) for own in beside if own.is_met(name) is not None]
        for name in KINETICS
    }
    fitted = sum(own.row.remark.startswith(("fitted", "set", "limits")) for own in beside)
    without = sum(own.is_met("measured") is None for own in beside)
    guessed = [own.is_met("measured") for own in beside if own.row.is_estimate]
    judged = [met for met in guessed if met is not None]
    text = (
        f"Of {len(met['measured'])} rows that can be judged the measured kinetics meets "
        f"{sum(met['measured'])} and the thesis's {sum(met['thesis'])}; {len(judged)} rows are an "
        f"ESTIMATE, and the measured kinetics meets {sum(judged)} of them. {fitted} rows were "
        f"fitted or set something, as the last column says. {without} more rows are "
        "not judged."
    )
    return fill(text, 100)


def table(beside: Sequence[Beside]) -> str:
    """Rows of measurements as a table."""
    lines = [
        "| what | people | thesis | measured kinetics | unit | quality, source |",
        "|---|---|---|---|---|---|",
    ]
    for own in beside:
        row = own.row
        people = f"**ESTIMATE** {row.measured}" if row.is_estimate else row.measured
        remark = f" ({row.remark})" if row.remark else ""
        cells = (
            _plain(f"{row.case}: {row.condition}"),
            people or "seen",
            *(_cell(own, name) for name in KINETICS),
            _plain(row.unit),
            _plain(f"{row.quality}. {row.source}{remark}"),
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def _plain(text: str) -> str:
    """Text whose stars are stars."""
    return text.replace("*", "\\*")


def _cell(own: Beside, kinetics: str) -> str:
    told = own.told(kinetics)
    return f"**{told}**" if own.is_met(kinetics) is False else told
