"""The tables that come with the add-on, and what is remembered of files."""

import pytest

from blender_addon.model import catalogue, summary
from hylios.errors import InputError


@pytest.fixture
def folder(tmp_path):
    """Two shipped tables, one of them cut short."""
    for name in ("III", "VI"):
        content = (catalogue.FOLDER / f"{name}.exr").read_bytes()
        (tmp_path / f"{name}.exr").write_bytes(content[: 3000 if name == "VI" else None])
    return tmp_path


def test_a_damaged_table_does_not_hide_the_others(folder):
    third, sixth = catalogue.shipped_tables(folder)
    assert (third.name, third.problem) == ("III", "")
    assert sixth.name == "VI" and "it is cut short or damaged" in sixth.problem
    assert summary.of_table(third.path)[0].startswith("Tans from")
    with pytest.raises(InputError, match="cut short or damaged"):
        summary.of_table(sixth.path)


def test_all_shipped_tables_can_be_used():
    assert [table.name for table in catalogue.SHIPPED][:6] == list(catalogue.TYPES)
    assert not any(table.problem for table in catalogue.SHIPPED)


def test_a_file_is_read_again_when_it_has_changed(folder, monkeypatch):
    """Not before, be it a table or not."""
    reads = []

    def read(path, function=catalogue.read_table):
        reads.append(path)
        return function(path)

    monkeypatch.setattr(catalogue, "read_table", read)
    path = folder / "VI.exr"
    for _ in range(3):
        with pytest.raises(InputError, match="cut short or damaged"):
            catalogue.provenance(path)
    assert len(reads) == 1
    path.write_bytes((catalogue.FOLDER / "VI.exr").read_bytes())
    for _ in range(3):
        assert catalogue.provenance(path)["specimen"] == "VI"
        assert catalogue.table(path).provenance["specimen"] == "VI"
    assert len(reads) == 2


@pytest.mark.parametrize("name", ["absent.exr", "a" * 300, "nul\0.exr"])
def test_files_that_cannot_be(tmp_path, name):
    with pytest.raises(InputError, match="cannot be read"):
        catalogue.table(tmp_path / name)


def test_a_skin_that_is_not_shipped():
    with pytest.raises(InputError, match="Skin is 'VII'; this add-on comes with I, II, III"):
        catalogue.shipped_path("VII")
