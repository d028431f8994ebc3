"""How a provenance says that a skin makes melanin."""

import pytest

from hylios.errors import InputError
from hylios.skin.phototypes import named_specimen, skin_type
from hylios.table import described_dynamics, melanin_dynamics, melanin_kinetics
from hylios.tanning import PIGMENTATIONS


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"transfer": [0.1, 0.1]}, r"the table's transfer is \[0.1, 0.1\]; expected 3 numbers."),
        ({"transfer": 0.1}, "the table's transfer is 0.1; expected 3 numbers."),
        ({"transfer": [0.1, "x", 0.1]}, "expected 3 numbers."),
        ({"production": [0.1, True, 0.1]}, "expected 3 numbers."),
        ({"melanin_decay": None}, "the table's melanin_decay is None; expected a number."),
        ({"melanin_decay": [0.9]}, "expected a number."),
        ({"melanin_decay": float("nan")}, "the table's melanin_decay is nan; expected a number."),
        ({"melanin_decay": 10**400}, "expected a number."),
        ({"melanin_decay": 2.0}, "melanin_decay is 2; allowed is 0 to 1."),
        ({"surplus": 1.0}, "the table's melanin dynamics need the rates production, transfer"),
    ],
)
def test_dynamics_that_are_none_are_refused(change, sentence):
    usual = described_dynamics(PIGMENTATIONS["low"])
    with pytest.raises(InputError, match=sentence):
        melanin_dynamics({"pigmentation": "low", "melanin_dynamics": {**usual, **change}})


def test_a_table_tells_both_kinetics():
    skin = skin_type("V")
    provenance = {
        "specimen_parameters": vars(named_specimen("V")),
        "pigmentation": "intermediate",
        "mmd_sed": skin.mmd,
        "med_sed": skin.med,
        "untanned_state": "melanin of each layer by the tanning set's steady state (5.16)",
    }
    assert melanin_kinetics(provenance) == skin.dynamics
    measured = skin_type("V", kinetics="measured").melanin_kinetics
    assert melanin_kinetics(provenance, "measured") == measured
    with pytest.raises(InputError, match="kinetics are 'none'"):
        melanin_kinetics(provenance, "none")
