"""Integrals on many groups, on both sides: what is found is kept, by the checker's own road."""

import pytest

from derive.algebra.families import group as named
from derive.check.checker import Checker
from tests.support.lagrangians import first_integrals, lagrangian, squares
from tests.support.walks import SEED, repeated

GROUPS = ("SE(2)", "SL(2)", "GL(2)", "SAff(2)", "Sim(2)", "UT(3)", "UT(4)", "SU(2)", "SE(3)")
FACTORS = (3, 5, 11, 13, 19, 29)


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("name", repeated(GROUPS))
def test_what_is_found_is_kept(name, side):
    d = named(name).dimension
    L = f"{squares(*FACTORS[:d])} + zeta_1*zeta_{d}/7 + zeta_2/3 - 3*A_21 + 2*A_11^2"
    found = first_integrals(lagrangian(L, name, side=side), 3)
    checker = Checker(found.record.problem, SEED)
    labels = [s.label for s in found.record.steps]
    new = found.record.steps[labels.index("x.poisson") :]
    assert [v.reason for v in map(checker.check, new) if not v.holds] == []
    assert len(new) >= 2


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_rank_of_the_poisson_tensor(side):
    """On se(3)* the Casimirs are |p|² and ⟨ℓ, p⟩; on so(5)* there are two, of degrees 2 and 4."""
    found = first_integrals(lagrangian(squares(*FACTORS), "SE(3)", side=side), 2)
    assert (len(found.casimirs), found.rank) == (2, 4)
    short, whole = (
        first_integrals(lagrangian(squares(*range(2, 12)), "SO(5)", side=side), n) for n in (3, 4)
    )
    assert (len(short.casimirs), short.found.proved.proved) == (1, False)
    assert (len(whole.casimirs), whole.rank, whole.found.proved.proved) == (2, 8, True)
