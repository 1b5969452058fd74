"""The faults by hand are of the files as they are, and name tests that there are."""

import pytest

from tests.support.faults import FAULTS, ROOT, changed


@pytest.mark.parametrize("fault", FAULTS, ids=lambda x: x["name"])
def test_a_fault_can_be_made(fault):
    assert changed(fault) != (ROOT / fault["file"]).read_text(encoding="utf-8")
    assert all((ROOT / "tests" / x).exists() for x in fault["tests"])
    assert [x["name"] for x in FAULTS].count(fault["name"]) == 1
