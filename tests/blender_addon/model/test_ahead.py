"""Results computed in a thread before they are needed."""

import threading

from blender_addon.model.ahead import THREAD, Ahead
from hylios.errors import InputError


def until_done(ahead: Ahead, *arguments) -> None:
    for thread in threading.enumerate():
        if thread.name == THREAD:
            thread.join(5.0)
    assert ahead.is_at_hand(*arguments)


def test_one_call_after_the_other():
    gate, called = threading.Event(), []

    def slow(number):
        assert gate.wait(5.0)
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
    def refused(_):
        raise InputError("no.")

    ahead = Ahead(refused)
    assert not ahead.is_at_hand(1)
    until_done(ahead, 1)
    assert not capfd.readouterr().err
