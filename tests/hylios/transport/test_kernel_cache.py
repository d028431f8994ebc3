"""Kernels run whatever has become of the folder in which numba keeps them."""

import os
import shutil
import subprocess
import sys

import pytest
from numba.core import config

from hylios.commands.cli import main
from hylios.transport import kernel_cache
from hylios.transport.compiling import digest_of_sources, kernel


def doubling():
    """A kernel as a new process would make it."""

    @kernel
    def make(sources):
        def double(number):
            _ = sources
            return 2.0 * number

        return double

    return make


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where kernels are kept, with one in it."""
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    kernel_cache._note_once.cache_clear()
    assert doubling()(2.0) == 4.0
    return tmp_path


def hits(dispatcher):
    return sum(dispatcher.stats.cache_hits.values())


def test_a_kept_kernel_is_not_compiled_anew(folder, capfd):
    kept = doubling()
    assert kept(3.0) == 6.0
    assert hits(kept) == 1
    assert capfd.readouterr().err == ""


def truncate(path, size=0):
    os.truncate(path, size)


def fill_with_garbage(path):
    path.write_bytes(b"\x93garbage" * 40)


def cut_the_end(path):
    os.truncate(path, path.stat().st_size - 1)


def flip_a_bit_in_the_middle(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


DAMAGES = {
    "index emptied": ("*.nbi", truncate),
    "index of garbage": ("*.nbi", fill_with_garbage),
    "index cut": ("*.nbi", cut_the_end),
    "code emptied": ("*.nbc", truncate),
    "code of garbage": ("*.nbc", fill_with_garbage),
    "code cut": ("*.nbc", cut_the_end),
    "code changed": ("*.nbc", flip_a_bit_in_the_middle),
}


@pytest.mark.parametrize(("files", "damage"), DAMAGES.values(), ids=DAMAGES)
def test_damaged_files_are_made_anew_and_that_is_said_once(folder, files, damage, capfd):
    (path,) = folder.rglob(files)
    damage(path)
    for _ in range(2):
        damaged = doubling()
        assert damaged(3.0) == 6.0
    assert hits(damaged) == 1  # the second finds what the first wrote
    said = capfd.readouterr().err
    assert said.count("note: ") == 1 == said.count("\n")
    assert str(path.parent) in said and "it is compiled anew" in said


def test_code_that_has_gone_is_compiled_anew(folder, capfd):
    (path,) = folder.rglob("*.nbc")
    path.unlink()
    assert doubling()(3.0) == 6.0
    assert path.is_file()
    assert capfd.readouterr().err == ""


def test_a_folder_may_vanish_before_a_kernel_is_kept(folder, capfd):
    made = doubling()
    shutil.rmtree(folder)
    assert made(3.0) == 6.0
    assert list(folder.rglob("*.nbi")) and capfd.readouterr().err == ""


def test_a_folder_that_cannot_be_written_is_said_once(folder, capfd):
    made = [doubling(), doubling()]
    shutil.rmtree(folder)
    folder.write_text("a file in its place")
    assert [double(3.0) for double in made] == [6.0, 6.0]
    said = capfd.readouterr().err
    assert said.count("note: ") == said.count("\n") == 1
    assert "Not a directory" in said


def test_without_standard_error_nothing_is_said(folder, capfd, monkeypatch):
    (path,) = folder.rglob("*.nbi")
    truncate(path)
    monkeypatch.setattr(sys, "stderr", None)
    assert doubling()(3.0) == 6.0
    assert capfd.readouterr() == ("", "")


@pytest.mark.slow
def test_a_command_gives_the_same_csv_where_nothing_can_be_written(tmp_path, capsys):
    """No file may grow there: what a full disk does, without one."""
    arguments = ["reflectance", "--wavelengths", "550", "--rays", "100"]
    command = "import sys; from hylios.commands.cli import main; sys.exit(main())"
    limited = ["sh", "-c", 'ulimit -f 0; exec "$@"', "-", sys.executable, "-c", command]
    without = subprocess.run(
        [*limited, *arguments],
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert without.returncode == 0, without.stderr
    assert without.stderr.count("it is compiled anew") == 1
    assert main(arguments) == 0
    assert without.stdout == capsys.readouterr().out != ""


def test_a_change_in_any_source_changes_the_kernels(tmp_path):
    digests = [digest_of_sources(tmp_path)]
    for content in ("a = 1", "a = 2"):
        (tmp_path / "rules.py").write_text(content)
        digest_of_sources.cache_clear()
        digests.append(digest_of_sources(tmp_path))
    digest_of_sources.cache_clear()
    assert len(set(digests)) == 3
