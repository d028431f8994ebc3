"""`lut-builder trade`, and tables chosen by the front."""

import json
import signal
import subprocess
import sys
import time
from dataclasses import asdict, replace

import pytest
from matplotlib.image import imread

from hylios.table import read_table
from lut_builder.cli import main
from lut_builder.settings import PRESETS, Settings
from lut_builder.trade.pareto import front
from lut_builder.trade.points import Point, read_points, shipped_points, write_points


def test_a_limit_chooses_the_table_that_is_built(tmp_path, capsys):
    """And other arguments still change it."""
    path, out = tmp_path / "front.csv", tmp_path / "t.exr"
    base = Settings((2,), 4, profile_error=0.0, nodes=14)
    points = [
        Point(base, 0.1, 0.0, 1.0, 0.5, 0.9, 0.01),
        Point(replace(base, knots=(3,), interpolation="linear"), 1.0, 0.0, 1.0, 0.05, 0.1, 0.01),
    ]
    write_points(path, points, [])
    always = ["--no-profile", "--front", str(path), "--force", "-o", str(out)]
    for limit, number in (("--max-delta-e=0.2", 1), ("--max-seconds=1.2", 0)):
        assert main(["build", limit, "--bands", "visible", "--threads", "1", *always]) == 0
        made = replace(points[number].settings, bands=())
        assert read_table(out).provenance["settings"] == json.loads(json.dumps(asdict(made)))
        assert "chosen: knots " in capsys.readouterr().out
    assert main(["build", "--max-delta-e", "0.01", *always]) == 2
    assert main(["build", "--max-delta-e", "nan", *always]) == 2
    with pytest.raises(SystemExit):
        main(["build", "--max-delta-e", "1", "--max-seconds", "1", *always])


def test_the_shipped_front_is_shown_at_once(capsys):
    assert main(["trade"]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert len(shown) == len(shipped_points())
    assert {name for name in PRESETS if any(f"({name})" in line for line in shown)} == set(PRESETS)
    assert main(["trade", "--also", "VI"]) == 2
    assert "--also VI is given without -o" in capsys.readouterr().err
    assert main(["trade", "--max-seconds", "1e6"]) == 0
    assert "chosen:" in capsys.readouterr().out


def test_a_trade_replaces_nothing_unasked(tmp_path, capsys):
    (tmp_path / "a_parts.csv").write_text("mine")
    assert main(["trade", "--quick", "-o", str(tmp_path / "a.png")]) == 2
    assert "a_parts.csv" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["a_parts.csv"]


@pytest.mark.slow
def test_a_trade_is_written_and_can_be_chosen_from(tmp_path, capsys):
    picture = tmp_path / "t.png"
    arguments = ["trade", "--specimen", "S3", "--also", "VI", "--quick", "-o", str(picture)]
    assert main([*arguments, "--max-delta-e", "50"]) == 0
    assert "chosen: knots" in capsys.readouterr().out
    assert imread(picture).shape[2] in (3, 4)
    assert front(read_points(tmp_path / "t.csv")) == read_points(tmp_path / "t.csv")
    parts = (tmp_path / "t_parts.csv").read_text()
    assert "skin: S3, pigmentation low; VI, pigmentation high" in parts
    assert "components, PPCA" in parts


@pytest.mark.slow
def test_an_interrupted_trade_leaves_nothing(tmp_path):
    command = [sys.executable, "-m", "lut_builder.cli", "trade", "-o", str(tmp_path / "t.png")]
    process = subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    assert process.stderr is not None
    seen = b""
    while b"time against error" not in seen:
        seen += process.stderr.read(1)
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    _, rest = process.communicate(timeout=60)
    assert process.returncode == 130
    assert rest.splitlines()[-1].endswith(b"cancelled")
    assert list(tmp_path.iterdir()) == []
