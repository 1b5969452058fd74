"""to_matrix and from_matrix read back: no change of them passes."""

import pytest

from derive.validate.chart import Chart
from derive.validate.compare import Comparison
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import CodeError, Literals
from tests.support.code_mutations import mutants, statement
from tests.support.walks import record
from tests.validate.test_validation import SMALL, emitted

QUATERNION = {"attitude": "quaternion"}
OWN = ("to_matrix", "from_matrix")


def module(text):
    files, *_ = emitted("so3", **QUATERNION)
    return read("so3.c", files | {"so3.c": text}, "so3").module


@pytest.fixture(scope="module")
def compared():
    """A function of a text of C: does it hold at one exact point?"""
    claims = Claims(record("so3"), Chart(attitude="quaternion"), SMALL)
    point = claims.point("one point for all changes")

    def holds(text):
        try:
            found = Comparison(module(text), claims, Literals(()), point).compare_all()
        except CodeError:
            return False
        return {*OWN} <= {*found}

    return holds


@pytest.mark.no_cover
def test_every_change_is_refused(compared):
    text = emitted("so3", **QUATERNION)[0]["so3.c"]
    assert compared(text)
    own = [x for x in mutants(text, "c", module(text)) if x[0] in OWN]
    assert len(own) > 100
    passed = [x for x in own if compared(x[3])]
    assert [x[1:3] for x in passed if not may_differ(text, x[2])] == []
    assert len(passed) < len(own) / 8


def may_differ(text, place):
    """May a change here give the same? Of a number that is exactly 0 either sign will do, and all
    terms of the sum whose sign is asked for have the same."""
    line = text[text.rfind("\n", 0, place) + 1 : text.index("\n", place)]
    return "part_" in line or statement(text, place, "c") == "whole_product"


def test_a_condition_is_refused(compared):
    text = emitted("so3", **QUATERNION)[0]["so3.c"]
    start = text.index("void so3_from_matrix")
    first = "    out[0] = "
    changed = text[start:].replace(first, f"    if (R_11 > 1e30) {{ out[0] = 2.0; }}\n{first}", 1)
    assert not compared(text[:start] + changed)
