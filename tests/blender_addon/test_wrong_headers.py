"""Table files that are whole, with the right checksum, and say what no skin's table can."""

import bpy
import pytest
from scenes import apply, look, tan_object

from blender_addon.ui.skin import skin_lines
from hylios.table import CHECKSUM_ATTRIBUTE, HEADER_ATTRIBUTE
from hylios.table.exr_reader import parse
from hylios.table.stored import checksum

CHANGES = [
    ('"mmd_sed": 4.9', '"mmd_sed": -49'),
    ('"mmd_sed": 4.9', '"mmd_sed": NaN'),
    ('"mmd_sed": 4.9', '"mmd_sed": "4"'),
    ('"mmd_sed": 4.9', '"mmd_sed": [4]'),
    ('"mmd_sed": 4.9', '"mmd_sed": 9e9'),
    ('"med_sed": 2.9', '"med_sed": 0.0'),
    ('"specimen": "S3"', '"specimen": [33]'),
    ('"pigmentation": "intermediate"', '"pigmentation": "\\ud800abcdef"'),
    ('"values": [0.97, 0.9, 0.7]', '"values": [0.97, 0.9, 7.0]'),
    ('"values": [0.97, 0.9, 0.7]', '"values": "0.97, 0.9, 0.7"'),
]


def changed(content: bytes, former: str, new: str) -> bytes:
    """A table's file with a part of its header replaced by one of the same length."""
    picture = parse(content)
    header = picture.attributes[HEADER_ATTRIBUTE]
    former_bytes, new_bytes = former.encode(), new.encode()[: len(former)].ljust(len(former))
    assert header.count(former_bytes) == 1
    wrong = header.replace(former_bytes, new_bytes)
    fitting = checksum(wrong.decode(), picture.channels).encode()
    content = content.replace(header, wrong)
    return content.replace(picture.attributes[CHECKSUM_ATTRIBUTE], fitting)


@pytest.mark.parametrize(("former", "new"), CHANGES)
def test_apply_export_and_the_panel_refuse_it_in_a_sentence(table_path, tmp_path, former, new):
    body = tan_object(table_path)
    apply(body)
    before = look(body)
    body.skin_tan.exposures[0].unit = "SUN"  # needs all that a header says
    path = tmp_path / "wrong.exr"
    path.write_bytes(changed(table_path.read_bytes(), former, new))
    body.skin_tan.table_path = str(path)
    for operator in (apply, export_to(tmp_path / "sun.csv")):
        with pytest.raises(RuntimeError) as caught:
            operator()
        said = str(caught.value).strip()
        assert said.startswith("Error: ") and len(said.splitlines()) == 1
        assert "Traceback" not in said and said.isprintable()
    assert look(body) == before and not (tmp_path / "sun.csv").exists()
    assert skin_lines(body.skin_tan) == (("This is not a usable skin table",), "ERROR")


def export_to(path):
    return lambda: bpy.ops.skin_tan.export_schedule(filepath=str(path))


def test_the_same_file_unchanged_is_taken(table_path, tmp_path):
    body, path = tan_object(table_path), tmp_path / "same.exr"
    path.write_bytes(changed(table_path.read_bytes(), CHANGES[0][0], CHANGES[0][0]))
    body.skin_tan.table_path = str(path)
    assert apply(body) == {"FINISHED"}
