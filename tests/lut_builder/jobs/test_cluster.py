"""The same work on a Dask cluster: a scheduler and workers of their own processes, on loopback."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from interruptions import environment, units_in
from toy_work import command, die, fail, walks

import hylios
from hylios.errors import InputError
from lut_builder.jobs import cluster
from lut_builder.jobs.cluster import on_cluster
from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.software import software_digest
from lut_builder.jobs.units import Unit, perform, unpacked

pytest.importorskip("distributed")


class Cluster:
    """A scheduler that lacks this project, as any Dask scheduler does, and workers at will."""

    def __init__(self, folder):
        self.folder, self.processes = folder, []
        told = folder / "scheduler.json"
        place = ["--host", "127.0.0.1", "--port", "0", "--scheduler-file", told]
        self.scheduler = self.start("scheduler", *place, "--no-jupyter", path="")
        self.address = waited_for(lambda: json.loads(told.read_text())["address"])

    def worker(self, path=None, nanny="--no-nanny"):
        """A worker of one thread; `path` is where it finds modules, other than ours if given."""
        own = self.folder / f"worker-{len(self.processes)}"
        return self.start(
            "worker", self.address, nanny, "--nthreads", 1, "--local-directory", own,
            "--host", "127.0.0.1", path=path,
        )  # fmt: skip

    def start(self, kind, *arguments, path=None):
        settings = environment() if path is None else {**os.environ, "PYTHONPATH": str(path)}
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", kind, *map(str, arguments), "--no-dashboard"],
            cwd=self.folder,
            env=settings,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.processes.append(process)
        return process


def waited_for(read):
    """What a function gives once it fails no longer."""
    until = time.monotonic() + 60.0
    while True:
        try:
            return read()
        except (OSError, ValueError):
            assert time.monotonic() < until
            time.sleep(0.05)


@pytest.fixture
def started(tmp_path, monkeypatch):
    """A cluster without workers."""
    monkeypatch.setattr(cluster, "PATIENCE", 60.0)  # a busy machine starts a worker in 10 s
    (tmp_path / "cluster").mkdir()
    running = Cluster(tmp_path / "cluster")
    yield running
    for process in reversed(running.processes):
        # A nanny told so ends its worker too.
        process.terminate()
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def one_walk(address):
    """Names of what a worker gives for one unit, once there is a worker."""
    return list(run_units(walks(1), None, software_digest(), on_cluster(address)))


def made(target, *arguments):
    return subprocess.run(
        command(target, *arguments), env=environment(), capture_output=True, text=True, timeout=120
    )


@pytest.mark.slow
def test_two_workers_make_the_same_bytes_though_one_is_killed(started, tmp_path):
    lost, _ = started.worker(), started.worker()
    assert one_walk(started.address) == ["walk-0"]
    local, spread = tmp_path / "local.bin", tmp_path / "spread.bin"
    assert made(local, "--count", 40).returncode == 0
    arguments = ["--count", 40, "--pause", 0.1, "--dask", started.address]
    with subprocess.Popen(
        command(spread, *arguments), env=environment(), stderr=subprocess.PIPE, text=True
    ) as running:
        while units_in(tmp_path / "spread.bin.unfinished") < 8 and running.poll() is None:
            time.sleep(0.01)
        lost.kill()
        assert running.poll() is None
        _, said = running.communicate(timeout=120)
    assert running.returncode == 0, said
    assert "walks, 40 of 40 100%" in said
    assert spread.read_bytes() == local.read_bytes()
    assert sorted(os.listdir(tmp_path)) == ["cluster", "local.bin", "spread.bin"]


@pytest.mark.slow
def test_ctrl_c_takes_the_units_back_and_local_processes_can_go_on(started, tmp_path):
    started.worker()
    assert one_walk(started.address) == ["walk-0"]
    target, folder = tmp_path / "t.bin", tmp_path / "t.bin.unfinished"
    with subprocess.Popen(
        command(target, "--pause", 1.0, "--dask", started.address),
        env=environment(),
        stderr=subprocess.PIPE,
        text=True,
    ) as running:
        while units_in(folder) < 2 and running.poll() is None:
            time.sleep(0.01)
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "Traceback" not in said
    assert said.endswith(f"kept in {folder}: give --resume to go on with it.\n")
    # The worker is free: its queue of nearly 30 seconds is gone.
    before = time.monotonic()
    assert one_walk(started.address) == ["walk-0"]
    assert time.monotonic() - before < 20.0
    assert made(target, "--resume").returncode == 0
    assert made(tmp_path / "whole.bin").returncode == 0
    assert target.read_bytes() == (tmp_path / "whole.bin").read_bytes()


def test_an_exception_of_a_unit_is_raised_and_a_lost_scheduler_is_one_sentence(started):
    started.worker()
    units = [Unit("a", fail, ("InputError",)), *walks(2)]
    with pytest.raises(InputError, match="^it is 7.$"):
        run_units(units, None, software_digest(), on_cluster(started.address))
    with pytest.raises(ZeroDivisionError):
        unit = Unit("a", fail, ("ZeroDivisionError",))
        run_units([unit], None, software_digest(), on_cluster(started.address))
    spread = on_cluster(started.address)(walks(30, pause=0.3), software_digest())
    next(spread)
    started.scheduler.kill()
    with pytest.raises(InputError, match=f"the Dask scheduler {started.address} was lost."):
        list(spread)


@pytest.mark.slow
def test_a_unit_that_brings_workers_down_is_one_sentence(started, tmp_path):
    """A nanny starts the worker again each time; what was done by then stays."""
    started.worker(nanny="--nanny")
    units = [*walks(3), Unit("z", die, (), size=0.1)]
    with pytest.raises(InputError, match="brought down one Dask worker of tcp://127"):
        run_units(units, tmp_path, software_digest(), on_cluster(started.address))


def test_a_worker_with_other_software_is_one_sentence(started, tmp_path):
    root = Path(hylios.__file__).parent.parent
    for package in ("hylios", "lut_builder"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(root / package, tmp_path / "other" / package, ignore=ignored)
    with (tmp_path / "other" / "hylios" / "errors.py").open("a") as file:
        file.write("\n")
    spread = on_cluster(started.address)
    for path in (tmp_path / "other", ""):
        worker = started.worker(path)
        with pytest.raises(InputError, match="the Dask worker .* lacks this project or"):
            run_units(walks(2), None, software_digest(), spread)
        worker.kill()
        worker.wait()


def test_a_worker_is_asked_again_with_each_unit(monkeypatch):
    """It may have come after the others were asked."""
    unit = walks(1)[0]
    local = perform(unit, software_digest())
    assert cluster._perform_here(unit, software_digest()) == local
    assert unpacked(local).keys() == run_units([unit], None, "1", in_threads(1))["walk-0"].keys()
    import distributed

    monkeypatch.setattr(distributed, "get_worker", lambda: type("", (), {"address": "tcp://w:1"}))
    with pytest.raises(InputError, match="the Dask worker tcp://w:1 lacks"):
        cluster._perform_here(unit, "other")


def test_a_cluster_without_workers_is_one_sentence(started, monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with pytest.raises(InputError, match=f"^the Dask scheduler {started.address} has no workers.$"):
        run_units(walks(1), None, "1", on_cluster(started.address))


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("nonsense", "is 'nonsense'; expected is tcp://HOST:PORT."),
        ("http://a:1", "expected is tcp://HOST:PORT."),
        ("tcp://127.0.0.1", "expected is tcp://HOST:PORT."),
        ("tcp://127.0.0.1:99999", "cannot be reached: Port out of range"),
    ],
)
def test_an_address_that_is_none_is_one_sentence(address, sentence):
    with pytest.raises(InputError) as raised:
        run_units(walks(1), None, "1", on_cluster(address))
    assert sentence in str(raised.value)


def test_a_scheduler_that_is_not_there_is_one_sentence(monkeypatch):
    """Nothing listens; something else listens and never answers."""
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with socket.create_server(("127.0.0.1", 0)) as other:
        address = f"tcp://127.0.0.1:{other.getsockname()[1]}"
        with pytest.raises(InputError, match=f"{address} does not answer."):
            run_units(walks(1), None, "1", on_cluster(address))
    with pytest.raises(InputError, match=f"{address} cannot be reached: .*refused."):
        run_units(walks(1), None, "1", on_cluster(address))


def test_without_distributed_it_is_one_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match="needs the package distributed: pip install"):
        run_units(walks(1), None, "1", on_cluster("tcp://127.0.0.1:1"))
