"""Equations as they are printed."""

import pytest

from derive.language.read import FormulaError
from derive.record.record import Equation, stated


def test_equations_are_stated_as_printed():
    assert stated("Z = A⁻¹α,  Z̄ = −Z", for_all=("α",)) == [
        Equation("Z", ("mul", ("inv", "A"), "α"), ("α",)),
        Equation(("T", "Z"), ("mul", -1, "Z"), ("α",)),
    ]
    assert stated("p̃(δA, 0) = k", "k") == [Equation(("call", "p̃", "δA", 0), ("par", "k"))]


def test_what_is_no_equation():
    with pytest.raises(FormulaError, match="the end is expected at =c"):
        stated("a = b = c")
    with pytest.raises(FormulaError, match="no equation"):
        stated("a + b")
