"""The checker can fail: whatever is made wrong in a record, by rule, is not read or not held."""

from itertools import islice

import pytest

from tests.support.corpus import record
from tests.support.record_mutations import corruptions
from tests.support.refusals import (
    TABLE,
    givens,
    hypotheses,
    quantifiers,
    symbols_listed,
    uses_of_symbols,
)

pytestmark = pytest.mark.no_cover
SHARES = {hypotheses: 2, givens: 2, quantifiers: 1, uses_of_symbols: 1, symbols_listed: 2}
"""Of how many cases each has its share of the changes of a record: of others, of ten."""


def shown(what, name, share):
    """The kind of change and the road are the kind of a case, of which one at least is run."""
    road, _, problem = name.partition(" ")
    return f"{what} of {road}: {problem} {share}"


CASES = [
    pytest.param(changes, name, share, id=shown(changes.__name__, name, share))
    for changes, names in TABLE.items()
    for name in names
    for share in range(SHARES.get(changes, 10))
]


@pytest.mark.parametrize(("changes", "name", "share"), CASES)
def test_none_is_held(changes, name, share):
    found = islice(changes(name), share, None, SHARES.get(changes, 10))
    assert [what for what, held in found if held()] == []


@pytest.mark.parametrize("changes", TABLE)
def test_there_is_what_is_changed(changes):
    found = {repr(what) for name in TABLE[changes] for what, _ in islice(changes(name), 40)}
    assert len(found) > 10


def test_equations_are_changed_in_every_way():
    steps = record("ready so3").steps
    kinds = {kind for s in steps for e in s.equations for kind, _ in corruptions(e)}
    assert kinds == {"sign", "factor", "term", "bar", "zero"}
