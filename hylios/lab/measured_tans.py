"""What was measured of people's redness and tans, row by row, and how far a model may be off.

`measured_tans.csv` beside this file has the rows with their sources. numpy and stdlib only.
"""

from dataclasses import dataclass

import numpy as np

from hylios.packaged import texts_of

ESTIMATES = ("C", "E", "L")
"""Qualities that are no measurement whose source was read."""


@dataclass(frozen=True)
class Row:
    """What was measured.

    Attributes
    ----------
    subject, case, condition : str
        What the row is of; a case is one of its subject's.
    measured, unit : str
        As told, and the unit of the model's value.
    low, high : float
        From where to where a model's value counts as met; infinite where there is no end.
    quality, source, remark : str
    """

    subject: str
    case: str
    condition: str
    measured: str
    unit: str
    low: float
    high: float
    quality: str
    source: str
    remark: str

    @property
    def is_estimate(self) -> bool:
        """Whether what was measured is itself an estimate."""
        return self.quality in ESTIMATES

    @property
    def is_judged(self) -> bool:
        """Whether there is an end at all."""
        return bool(np.isfinite(self.low) or np.isfinite(self.high))

    @property
    def is_of_doses(self) -> bool:
        """Whether the tolerance is of the ratio, as of doses."""
        return self.unit == "MMD" and self.case.startswith("dose")

    @property
    def middle(self) -> float:
        """The value wanted, where both ends are finite."""
        if self.is_of_doses:
            return float(np.sqrt(self.low * self.high))
        return 0.5 * (self.low + self.high)

    def off(self, value: float) -> float:
        """How far a value is off the middle, over what it may be."""
        if self.is_of_doses:
            return float(np.log(value / self.middle) / np.log(self.high / self.middle))
        return (value - self.middle) / (self.high - self.middle)

    def beyond(self, value: float) -> float:
        """How far a value lies beyond the ends, in its unit; 0 where it is met."""
        slack = 1e-9 * max(1.0, abs(value))
        over, under = value - self.high, value - self.low
        return over if over > slack else under if under < -slack else 0.0


def rows() -> tuple[Row, ...]:
    """All rows, in the file's order."""
    return tuple(
        Row(
            **{name: own[name] for name in ("subject", "case", "condition", "measured", "unit")},
            low=float(own["low"] or "-inf"),
            high=float(own["high"] or "inf"),
            **{name: own[name] for name in ("quality", "source", "remark")},
        )
        for own in texts_of("hylios.lab", "measured_tans.csv")
    )


def rows_of(subject: str) -> dict[str, Row]:
    """The rows of a subject, by case."""
    return {row.case: row for row in rows() if row.subject == subject}
