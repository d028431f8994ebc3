"""Exposures to CSV and back, and CSV as people write it."""

import string
from types import SimpleNamespace

import numpy as np
import pytest

from blender_addon.model.exposures_csv import (
    AMOUNTS,
    CHOICES,
    TITLES,
    exposures_text,
    read_exposures,
)
from hylios.errors import InputError
from hylios.history import schedule_text
from hylios.tanning import Exposures

NAMES = (
    "",
    "Beach, day 1",
    'the "big" one',
    "#1",
    "Été; Süden",
    "1,5",
    " = 3 ",
    "naïve\nline",
    "x",
)


def random_exposure(random) -> SimpleNamespace:
    def between(low, high):
        return float(np.float32(random.uniform(low, high)))

    letters = "".join(random.choice(list(string.printable), 12))
    return SimpleNamespace(
        day=between(0.0, 366.0),
        unit=str(random.choice(["SED", "MMD", "UV_INDEX", "SUN"])),
        dose=between(0.0, 1000.0),
        multiple=between(0.0, 100.0),
        uv_index=between(0.0, 16.0),
        duration=between(0.0, 48.0),
        latitude=between(-90.0, 90.0),
        month=int(random.integers(1, 13)),
        day_of_month=int(random.integers(1, 29)),
        from_hour=between(0.0, 12.0),
        to_hour=between(12.0, 24.0),
        sunscreen=bool(random.random() < 0.5),
        spf=between(1.0, 60.0),
        sunscreen_amount=between(0.0, 3.0),
        altitude=between(-500.0, 9000.0),
        cloud=between(0.0, 100.0),
        ground=str(random.choice(["USUAL", "SNOW", "GRASS"])),
        through=str(random.choice(["AIR", "WINDOW", "LAMINATED", "WATER"])),
        depth=between(0.0, 100.0),
        enabled=bool(random.random() < 0.8),
        name=str(random.choice([*NAMES, letters])),
    )


def that_count(exposure) -> dict:
    """The settings that count, as a file gives them back."""
    names: dict[str, tuple[str, ...]] = {
        "SUN": (
            *("latitude", "month", "day_of_month", "from_hour", "to_hour"),
            *("altitude", "cloud", "ground", "through"),
        ),
        "UV_INDEX": ("duration",),
    }
    wanted = ["day", "unit", "enabled", *names.get(exposure.unit, ())]
    if exposure.unit in AMOUNTS:
        wanted.append(AMOUNTS[exposure.unit][0])
    if exposure.unit == "SUN" and exposure.through == "WATER":
        wanted.append("depth")
    if exposure.sunscreen:
        wanted += ["sunscreen", "spf", "sunscreen_amount"]
    told = {name: getattr(exposure, name) for name in wanted}
    name = " ".join("".join(c if c.isprintable() else " " for c in exposure.name).split())
    return {**told, "name": name} if name else told


def as_kept(settings: dict) -> dict:
    """As Blender keeps them, in single precision."""
    return {
        name: float(np.float32(value)) if isinstance(value, float) else value
        for name, value in settings.items()
    }


@pytest.mark.parametrize("seed", range(25))
def test_what_is_written_comes_back(seed, tmp_path):
    random = np.random.default_rng(seed)
    exposures = [random_exposure(random) for _ in range(random.integers(1, 8))]
    path = tmp_path / "exposures.csv"
    path.write_text(exposures_text(exposures), encoding="utf-8")
    read = read_exposures(path)
    assert [as_kept(own) for own in read.exposures] == [that_count(own) for own in exposures]
    assert not read.remarks


def read(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "mine.csv"
    path.write_bytes(text.encode(encoding))
    return list(read_exposures(path).exposures)


def test_days_and_sed_are_enough(tmp_path):
    expected = [{"day": 0.0, "unit": "SED", "dose": 6.5}, {"day": 1.5, "unit": "SED", "dose": 8.0}]
    assert read(tmp_path, "day,SED\n0,6.5\n1.5,8\n") == expected
    assert read(tmp_path, "\ufeffDay;SED;note\r\n0;6,5;noon\r\n1,5;8;\r\n;;\r\n") == expected
    assert read(tmp_path, "day\tdose\n0\t6.5\n1.5\t8\n", "utf-16") == expected


def test_a_spreadsheet_with_a_decimal_comma_and_empty_cells(tmp_path):
    text = (
        "# our holiday\n"
        "day;amount;unit;hours;spf;on;name;latitude;month;day_of_month;from_hour;to_hour\n"
        "0;2,5;Tanning doses;;;;First day;;;;;\n"
        "1;8;UV index;1,5;30;no;;;;;;\n"
        "2;;Sun;;;x;;36,5;8;2;10;14,5\n"
    )
    first, second, third = read(tmp_path, text)
    assert first == {
        "day": 0.0, "unit": "MMD", "multiple": 2.5, "enabled": True, "name": "First day"
    }  # fmt: skip
    assert second == {
        "day": 1.0, "unit": "UV_INDEX", "uv_index": 8.0, "duration": 1.5, "spf": 30.0,
        "sunscreen": True, "enabled": False,
    }  # fmt: skip
    assert third == {
        "day": 2.0, "unit": "SUN", "latitude": 36.5, "month": 8, "day_of_month": 2,
        "from_hour": 10.0, "to_hour": 14.5, "enabled": True,
    }  # fmt: skip


def test_a_file_of_a_version_that_knew_only_clear_skies(tmp_path):
    """Its columns are those of now, less the later ones; a name may hold what separates cells."""
    path = tmp_path / "former.csv"
    path.write_text(
        "day,amount,unit,hours,latitude,month,day_of_month,from_hour,to_hour,spf,mg_cm2,on,name\n"
        "2,,SUN,,36.5,8,2,10,12.5,,,yes,Été; Süden\n"
    )
    (told,) = read_exposures(path).exposures
    assert (told["name"], told["latitude"]) == ("Été; Süden", 36.5)
    assert not {"altitude", "cloud", "ground", "through", "depth"} & set(told)


def test_an_exported_schedule(tmp_path):
    told = {"scene": "Body", "skin": "III", "days": 30.0, "mmd": 5.0, "med": 3.0}
    path = tmp_path / "sun.csv"
    path.write_text(schedule_text(Exposures([0, 36], [6.0, 9.5]), **told), encoding="utf-8")
    alike = read_exposures(path)
    assert alike.exposures == (
        {"day": 0.0, "unit": "SED", "dose": 6.0},
        {"day": 1.5, "unit": "SED", "dose": 9.5},
    )
    assert not alike.remarks
    path.write_text(schedule_text(Exposures([0], [6.0], [2.0]), **told), encoding="utf-8")
    assert "thickens more" in read_exposures(path).remarks[0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("day,SED\n0,-1\n", "SED of -1 in line 2; allowed is 0 to 1000"),
        ("day,SED\n400,1\n", "day of 400 in line 2; allowed is 0 to 366"),
        ("day,note\n1,x\n", "has no column amount or SED; needed is one of them"),
        ("SED\n1\n2\n", "day"),
        ("day,amount,unit\n0,1,Gy\n", "in line 2 'Gy' as unit; allowed are sed, mmd"),
        ("day,amount,unit\n0,,MMD\n", "in line 2 no amount; allowed is 0 to 100"),
        ("day,amount,unit\n0,x,MMD\n", "in line 2 'x' as amount; allowed is 0 to 100"),
        ("day,amount,spf\n0,1,0.5\n", "in line 2 '0.5' as spf; allowed is 1 to 1000"),
        ("day,amount,on\n0,1,maybe\n", "in line 2 'maybe' as on; allowed are yes, on"),
        ("day,SED\n", "holds no time in the sun"),
        (exposures_text([]), "holds no time in the sun"),
        (
            "day,unit,amount,month,day_of_month\n0,sed,1,2,30\n1,sun,,2,30\n",
            "3 no such sun: day of the month is 30, which month 2 lacks; allowed is 1 to 29",
        ),
        (
            "day,unit,amount,from_hour,to_hour\n0,sun,,12,10\n",
            "2 no such sun: sun is given from 12 to 10 h; allowed is an end after its start",
        ),
        (
            "day,amount,unit,month\n0,,sun,6.5\n",
            "'6.5' as month; allowed is whole numbers from 1 to 12",
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_told_in_a_sentence(tmp_path, text, sentence):
    with pytest.raises(InputError, match=sentence) as told:
        read(tmp_path, text)
    assert "\n" not in str(told.value) and "mine.csv" in str(told.value)


def test_no_file(tmp_path):
    with pytest.raises(InputError, match=r"absent\.csv"):
        read_exposures(tmp_path / "absent.csv")


def test_every_column_has_a_setting():
    assert set(that_count(random_exposure(np.random.default_rng(0)))) <= {
        "day", "unit", "enabled", "name", "sunscreen", *CHOICES,
        *(setting for setting, _, _ in TITLES.values()),
        *(setting for setting, _ in AMOUNTS.values()),
    }  # fmt: skip
