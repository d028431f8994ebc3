"""Results computed in a thread before they are needed."""

import threading
import time

from blender_addon.model.ahead import Ahead
from hylios.errors import InputError


def until_done(ahead: Ahead, *arguments) -> None:
    # A thread that ends leaves threading.enumerate() before it stops being alive: ask, don't join.
    end = time.monotonic() + 60.0
    while not ahead.is_at_hand(*arguments):
        assert time.monotonic() < end
        time.sleep(0.001)


def test_one_call_after_the_other():
    gate, called = threading.Event(), []

    def slow(number):
        assert gate.wait(60.0)
        called.append(number)

    ahead = Ahead(slow)
    assert not ahead.is_at_hand(1)
    assert not ahead.is_at_hand(2) and not called
    gate.set()
    until_done(ahead, 1)
    assert not ahead.is_at_hand(2)
    until_done(ahead, 2)
    assert called == [1, 2]


def test_what_is_refused_is_at_hand(capfd):
    """And stays so beside another call, which would never get its result otherwise."""

    def odd(number):
        if number % 2 == 0:
            raise InputError("no.")
        return number

    ahead = Ahead(odd)
    assert not ahead.is_at_hand(2)
    until_done(ahead, 2)
    assert not ahead.is_at_hand(1)
    assert ahead.is_at_hand(2)
    until_done(ahead, 1)
    assert ahead.is_refused(2) and not ahead.is_refused(1)
    assert not capfd.readouterr().err


def test_a_result_is_taken_once_by_whom_it_is_for():
    ahead = Ahead(lambda owner, number: number + 1)
    assert not ahead.is_at_hand("a", 1)
    until_done(ahead, "a", 1)
    assert ahead.taken("b") is None
    assert ahead.taken("a") == (("a", 1), 2)
    assert ahead.taken("a") is None
