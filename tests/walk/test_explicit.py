"""The answer: equations in coordinates with a problem's own numbers, beside other roads."""

import pytest

from derive.language.show import show
from derive.pipeline import walk
from derive.problem.toml import problem_of
from tests.support.walks import record as ready


def answer(d):
    return d[f"{d.name}.explicit"]


def told(d):
    return [f"{show(e.lhs)} = {show(e.rhs)}" for e in answer(d).equations]


def said(d):
    return " ".join(s.message for s in answer(d).prose)


def test_a_nut_on_a_screw_falls_with_a_constant():
    """m(1 + h²) ζ̇ = −m g h for h = 1/10."""
    assert told(ready("screw")) == ["ζ̇₁ = −10/101 g"]
    assert "affine functions of the time" in said(ready("screw"))


@pytest.mark.parametrize(
    "U", ["(a + r1_x)^60", "a*" + "*".join(f"(r{i}_x + {i})" for i in range(1, 40))]
)
def test_what_is_too_long_is_not_multiplied_out(U):
    """Else there are more terms than memory; left out as any long answer."""
    data = {"name": "p", "group": "SO(3)", "parameters": {"a": 1.0}}
    data["point"] = [{"mass": i, "at": [i, 1, i * i % 9]} for i in range(1, 41)]
    d = walk(problem_of(data | {"potential": [{"kind": "expression", "U": U}]}))
    assert "p.explicit" not in {s.label for s in d.steps}
