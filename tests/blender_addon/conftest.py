"""Every test here starts from an empty scene with the add-on registered.

New materials are without relief and blotches, as the light model has skin.
"""

import pytest
from synthetic import former_table, smooth_table

import blender_addon
from lut_builder.exr_writer import write_table


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """A test fails where Blender has printed an error of the add-on instead of raising it.

    So it does with those of what follows a setting, of handlers and of timers.
    """
    report = yield
    printed = report.capstdout + report.capstderr
    has_error = "Traceback (most recent call last)" in printed
    is_provoked = item.get_closest_marker("provokes") is not None
    if report.when == "call" and report.passed and has_error and not is_provoked:
        report.outcome, report.longrepr = "failed", f"Blender printed an error:\n{printed}"
    return report


@pytest.fixture(autouse=True)
def empty_scene(monkeypatch):
    import bpy  # the tests of the model run without it

    from blender_addon.scene import materials

    monkeypatch.setattr(materials, "NEW_SKIN", dict.fromkeys(materials.NEW_SKIN, 0.0))

    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    blender_addon.register()
    yield
    blender_addon.unregister()


@pytest.fixture(scope="session")
def table():
    return smooth_table()


@pytest.fixture(scope="session")
def table_path(tmp_path_factory, table):
    path = tmp_path_factory.mktemp("tables") / "S3.exr"
    write_table(path, table)
    return path


@pytest.fixture(scope="session")
def former_path(tmp_path_factory):
    """A table of format 3."""
    path = tmp_path_factory.mktemp("tables") / "former.exr"
    write_table(path, former_table())
    return path
