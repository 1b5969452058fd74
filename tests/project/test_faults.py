"""The faults by hand are of the files as they are; what is listed of tests names tests that are."""

import re
from unicodedata import normalize

import pytest

from tests.support.faults import FAULTS, ROOT, changed
from tests.support.thorough import KEPT


@pytest.mark.parametrize("fault", FAULTS, ids=lambda x: x["name"])
def test_a_fault_can_be_made(fault):
    assert changed(fault) != (ROOT / fault["file"]).read_text(encoding="utf-8")
    assert all((ROOT / "tests" / x).exists() for x in fault["tests"])
    assert [x["name"] for x in FAULTS].count(fault["name"]) == 1


@pytest.mark.parametrize("name", KEPT)
def test_what_takes_long_is_a_test(name):
    file, test = name.split("::")
    text = normalize("NFKC", (ROOT / "tests" / file).read_text(encoding="utf-8"))  # as Python's
    assert re.search(rf"^def {test}\(", text, re.M)
