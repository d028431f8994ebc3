"""The model against what was measured of people's redness and tans, row by row."""

import numpy as np
import pytest

from hylios.lab.measured_tans import Row, rows, rows_of
from hylios.lab.redness_of_people import after, farthest
from hylios.lab.tans_of_people import values_of_people
from hylios.skin.phototypes import PHOTOTYPES

VALUES = values_of_people()

NEITHER = {
    "blood 8 to 72 h after 1 MED",
    "fading",
    "peak of small doses",
    "narrowband MED",
    "broadband peak",
    "highest a* of type III",
    "peaks of flow",
    "a* after 8 MED",
    "darkest after UVA and UVB, days",
    "gone after 12 of UVA, days",
    "b* after two weeks of sun",
    "fall of L* at the threshold",
    "three daily doses of 1.5 MED",
    "15.7 MED in three weeks",
    "ultraviolet let through",
}
MISSED = {
    "measured": NEITHER | {"gone after narrowband, days"},
    "thesis": NEITHER
    | {
        "dose of 6 in 3 weeks, of one MMD",
        "dose of 12 in 3 weeks, of one MMD",
        "sum of 6 in 3 weeks, in MMD",
        "sum of 12 in 3 weeks, in MMD",
        "darkest after 2 MED, days",
        "darkest after narrowband, days",
        "gone after 2 MED, days",
        "gone after the last of 6, days",
        "gone after the last of 12, days",
        "half of the most by one dose, MMD",
        "tan of half an MMD",
        "gain independent of the skin",
        "fall of L* by one MMD",
        "a* of tanned light skin",
        "a* of tanned dark skin",
    },
}
"""Cases that a kinetics does not meet; the page of measured people says by how much."""

SPOKEN_OF = [row for row in rows() if row.is_judged and row.case in VALUES[row.subject]]
TESTED = [("measured", row) for row in SPOKEN_OF]
TESTED += [("thesis", row) for row in SPOKEN_OF if row.subject == "tan"]


@pytest.mark.parametrize(
    ("kinetics", "row"), TESTED, ids=lambda part: part if isinstance(part, str) else part.case
)
def test_as_measured(kinetics, row):
    value = VALUES[row.subject][row.case](kinetics)
    missed = row.case in MISSED[kinetics]
    assert (row.beyond(value) != 0.0) == missed, f"{value:g} {row.unit}, {row.low} to {row.high}"


def test_every_row_has_a_source_and_every_value_a_row():
    every = rows()
    cases = {(row.subject, row.case) for row in every}
    assert len(cases) == len(every) > 70
    assert {(subject, case) for subject, own in VALUES.items() for case in own} <= cases
    for row in every:
        assert row.measured or not row.is_judged
        assert row.source and row.quality in set("ABCEL") and row.low <= row.high
        assert row.is_judged or row.remark
    assert {row.quality for row in every if row.is_estimate} == {"C", "E", "L"}


def test_what_is_beyond_an_end():
    row = Row("tan", "x", "", "5", "days", 4.0, 7.0, "A", "", "")
    assert row.beyond(3.5) == -0.5 and row.beyond(7.25) == 0.25 and row.beyond(4.0) == 0.0
    assert row.middle == 5.5 and row.off(7.0) == 1.0 and row.off(5.5) == 0.0
    dose = rows_of("tan")["dose of 6 in 3 weeks, of one MMD"]
    assert dose.middle == pytest.approx(0.5, abs=1e-4)
    assert dose.off(0.575) == pytest.approx(1.0) and dose.off(dose.low) == pytest.approx(-1.0)


def test_redness_is_later_with_dose_and_gone_before_it_begins():
    hours = [int(after("II", dose, "thesis").blood.argmax()) for dose in (0.25, 1.0, 2.0, 8.0)]
    assert np.all(np.diff(hours) > 0) and hours[0] >= 8 and hours[-1] <= 24
    for dose in (0.5, 1.0):
        assert after("II", dose, "thesis").at(1)[1] < 0.5
    assert after("II", 2.0, "thesis").at(4)[1] > 2.0
    assert after("II", 8.0, "thesis").at(192)[1] > 1.5


def test_types_redden_in_their_order_and_lose_yellow():
    rises = [after(name, 2.0, "measured").at(24)[1] for name in PHOTOTYPES]
    assert np.all(np.diff(rises) < 0.0)
    for name in PHOTOTYPES[:4]:
        lightness, red, yellow = after(name, 1.0, "measured").at(24)
        assert lightness < -0.5 and red > 1.0 and yellow < -0.1


def test_the_farthest_is_the_worst():
    assert farthest([1.0, 4.0, -3.0], 0.0) == 4.0 and farthest([1.0, 4.0], 5.0) == 1.0
