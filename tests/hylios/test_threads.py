"""Work shared among threads in its order, and linear algebra in one."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.threads import in_order, in_threads, loaded_libraries, one_thread, thread_count


def test_all_cores_by_default():
    assert thread_count(None) == thread_count(0) == os.cpu_count()
    assert thread_count(3) == 3
    for wrong in (-1, 1025):
        with pytest.raises(InputError, match="number of threads is"):
            thread_count(wrong)


def test_results_come_in_the_order_of_tasks():
    def slowest_first(number):
        time.sleep(0.02 * (4 - number))
        return number

    assert list(in_order(slowest_first, range(5), 4)) == [0, 1, 2, 3, 4]
    assert sorted(in_threads(slowest_first, iter(range(5)), 2)) == [0, 1, 2, 3, 4]


def test_an_error_drops_the_tasks_that_wait():
    started = []

    def fail(number):
        started.append(number)
        raise KeyError(number)

    with pytest.raises(KeyError):
        list(in_threads(fail, iter(range(1000)), 2))
    assert len(started) < 10


LIMITED = """
from threading import Barrier, Thread
import scipy.linalg
from hylios.threads import loaded_libraries, one_thread

def get():
    return [get() for get, _ in loaded_libraries()]

before = get()
assert len(before) == 2 and min(before) > 1, before
barrier, seen = Barrier(2), []

def leave_in_turn(first):
    with one_thread():
        barrier.wait()
        if first:
            return
        other.join()
        seen.append(get())

other = Thread(target=leave_in_turn, args=[True])
last = Thread(target=leave_in_turn, args=[False])
other.start(), last.start(), other.join(), last.join()
assert seen == [[1, 1]], seen
try:
    with one_thread():
        raise KeyError
except KeyError:
    pass
assert get() == before, get()
"""


@pytest.mark.skipif(not loaded_libraries(), reason="numpy here comes without OpenBLAS")
def test_threads_are_limited_until_the_last_user_leaves():
    done = subprocess.run(
        [sys.executable, "-c", LIMITED],
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "2"},
    )
    assert done.returncode == 0, done.stderr


def test_numpy_without_openblas_is_left_alone(monkeypatch):
    monkeypatch.setattr("hylios.threads.loaded_libraries", tuple)
    with one_thread():
        assert np.linalg.inv(2.0 * np.eye(2))[0, 0] == 0.5
