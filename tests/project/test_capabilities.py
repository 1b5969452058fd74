"""No capability is lost by accident, and each new one is listed."""

from tests.support.capabilities import LISTED, listed


def test_what_the_program_can_do_is_what_is_listed():
    before = LISTED.read_text(encoding="utf-8").splitlines()
    now = listed()
    assert not {*before} - {*now}, "lost; where that is meant: python -m tests.support.capabilities"
    assert not {*now} - {*before}, "new: python -m tests.support.capabilities"
