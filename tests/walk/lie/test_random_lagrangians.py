"""Random Lagrangians on random groups, on both sides: the record holds, the code agrees."""

import os
import re

import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from derive.code.assemble import assemble
from derive.code.emit import emit
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from tests.support.walks import own_verdicts
from tests.walk.lie.test_expressed import held, states

pytestmark = pytest.mark.no_cover
EXAMPLES = int(os.environ.get("EXAMPLES", "12"))
GROUPS = {  # with d, and the entries of g that a term may have
    "SO(3)": (3, ["A_11", "A_23", "A_32"]),
    "SL(2)": (3, ["A_11", "A_12", "A_22"]),
    "SE(2)": (3, ["A_12", "T_1", "T_2"]),
    "UT(3)": (3, ["A_12", "A_23"]),
    "GL(2)": (4, ["A_12", "A_21"]),
    "SO(2) x SE(2)": (4, ["A1_12", "A2_11", "T2_2"]),
}
OWN = {
    "name": "Turned",
    "basis": [
        [[0, 1, 0], [-1, 0, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 1], [-1, -1, 0]],
        [[0, 0, -1], [0, 0, 1], [1, -1, 0]],
    ],
}
"""so(3) in a basis of one's own."""


@st.composite
def lagrangians(draw):
    """The data of a file: a definite square, and terms of all kinds."""
    name = draw(st.sampled_from([*GROUPS, "Turned"]))
    d, entries = GROUPS.get(name, (3, ["A_13", "A_21"]))
    zeta = [f"zeta_{a}" for a in range(1, d + 1)]
    atom = st.sampled_from([*entries, "t", "a", "b"])
    terms = [f"{k}*({x})^2/2" for k, x in zip("3579", zeta, strict=False)]
    for _ in range(draw(st.integers(1, 4))):
        factors = [draw(atom)]
        factors += draw(st.lists(st.sampled_from(zeta), max_size=2))
        factors += draw(st.lists(atom, max_size=1))
        kind = draw(
            st.sampled_from(["{}", "sin({})", "({})^2", "sqrt(9 + ({})^2)", "exp(-({})^2)"])
        )
        terms.append(f"{draw(st.integers(1, 5))}*{kind.format('*'.join(factors))}/10")
    table = {"L": " + ".join(terms), "trivialisation": draw(st.sampled_from(["left", "right"]))}
    data = {"name": "test", "group": OWN if name == "Turned" else name, "lagrangian": table}
    used = {x: 0.5 + 0.3 * k for k, x in enumerate("ab") if re.search(rf"\b{x}\b", table["L"])}
    if draw(st.booleans()):
        data["input"] = [{"name": "u", "kind": "covector"}]
    return data | {"parameters": used}


def said(data, group):
    """The same ℓ as a function, read by Python alone."""
    text = data["lagrangian"]["L"].replace("^", "**")
    several = len(group.places) > 1

    def lagrangian(t, g, zeta):
        names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
        for k, (offset, factor) in enumerate(group.places, 1):
            mark, span = str(k) if several else "", range(factor.n)
            names |= {
                f"A{mark}_{i + 1}{j + 1}": g[offset + i, offset + j] for i in span for j in span
            }
            if factor.affine:
                names |= {f"T{mark}_{i + 1}": g[offset + i, offset + factor.n] for i in span}
        functions = {x: getattr(jnp, x) for x in ("sin", "sqrt", "exp")}
        return eval(text, functions, names | {"t": t} | data["parameters"])

    return lagrangian


@settings(
    max_examples=EXAMPLES,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=[*HealthCheck],
)
@given(data=lagrangians())
def test_holds_and_agrees(data):
    try:
        problem = problem_of(data)
    except ProblemError as error:
        assume("is singular" not in str(error))
        raise
    record = walk(problem)
    again = from_json(to_json(record))
    assert again == record
    verdicts = own_verdicts(again)
    assert [f"{v.label}: {v.reason}" for v in verdicts if not v.holds] == []
    assert max(v.bound for v in verdicts) < 1e-30
    space = {}
    files = emit(assemble(record, problem.group), record, ("python",), "test")
    exec(compile(files["test.py"], "test.py", "exec"), space)
    found = type("found", (), {k: staticmethod(v) if callable(v) else v for k, v in space.items()})
    rng, right = np.random.default_rng(3), data["lagrangian"]["trivialisation"] == "right"
    for g, zeta in states(problem.group, space["BASIS"], rng, 2):
        g = g / 1.0
        if np.abs(g).max() > 20:
            continue
        u = rng.normal(size=len(space["INPUTS"]))
        held(found, problem.group, said(data, problem.group), 0.3, g, zeta, u, right=right)
