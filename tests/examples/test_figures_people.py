"""The page of people's redness and tans beside the model."""

import re
import sys
from pathlib import Path

import pytest

from examples.figures import __main__ as program
from examples.figures import measured_tans, people_page
from examples.figures.measured_tans import Beside
from hylios.lab.measured_tans import Row, rows

PAGE = Path(__file__).parents[2] / "docs" / "people.md"


def beside(thesis, measured, low=4.0, high=7.0, quality="A", subject="tan"):
    row = Row(subject, "a* of it", "seen", "5", "days", low, high, quality, "Us 2020", "why")
    return Beside(row, {"thesis": thesis, "measured": measured})


def test_a_value_beyond_the_tolerance_is_bold_and_an_estimate_marked():
    lines = people_page.table(
        [
            beside(8.5333, 5.0),
            beside(150.0, None, quality="C"),
            beside(5.0, 5.0, float("-inf"), float("inf")),
        ]
    ).splitlines()[2:]
    assert lines == [
        r"| a\* of it: seen | 5 | **8.53 (+1.5)** | 5 | days | A. Us 2020 (why) |",
        r"| a\* of it: seen | **ESTIMATE** 5 | **150 (+143)** | none | days | C. Us 2020 (why) |",
        r"| a\* of it: seen | 5 | 5 | 5 | days | A. Us 2020 (why) |",
    ]


def test_names_lead_to_it():
    assert measured_tans in program.groups_with(["people"])
    assert program.groups_with(["people.tans"]) == [measured_tans]


def test_the_page_has_every_row():
    lines = PAGE.read_text(encoding="utf-8").replace("\\*", "*").splitlines()
    for row in rows():
        line = next(line for line in lines if f"| {row.case}: {row.condition} |" in line)
        assert row.source in line and ("**ESTIMATE**" in line) == row.is_estimate


@pytest.mark.slow
def test_the_page_is_what_the_command_writes(tmp_path, monkeypatch, capsys):
    page = tmp_path / "people.md"
    arguments = ["figures", "people.tans", "--out", str(tmp_path), "--page", str(page)]
    monkeypatch.setattr(sys, "argv", arguments)
    assert program.main() == 0
    capsys.readouterr()
    new, old = (path.read_text(encoding="utf-8") for path in (page, PAGE))
    parts = re.compile(r"(?<![\w.])[+-]?\d+\.?\d*(?:e[+-]\d+)?")
    assert parts.sub("#", new) == parts.sub("#", old)
    numbers = [[float(text) for text in parts.findall(own)] for own in (new, old)]
    assert numbers[0] == pytest.approx(numbers[1], rel=0.02, abs=0.02)
    assert len(list((tmp_path / "people").glob("*.png"))) == len(measured_tans.PICTURES)
