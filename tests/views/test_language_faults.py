"""What is wrong in the text of one language is noticed: the comparison sees every part of it."""

import re

import numpy as np
import pytest

from tests.support.languages import ONE_BUILD, Case, T, cvode
from tests.support.library import BUILDS, loaded
from tests.support.needs import need

SIZE = 6
"""Rows and columns of the jacobian of so3."""


@pytest.fixture(scope="module")
def so3():
    """The solid about a point in all languages, with all that it can be linearised in."""
    need("cc")
    return Case("so3", {"jacobian": ("state", "inputs", "parameters")})


def put(old, new):
    """A change: the first of one text in the place of another."""
    return lambda text: text.replace(old, new, 1)


def after(mark, change):
    """A change of what comes after a mark."""
    return lambda text: "".join([*(parts := text.partition(mark))[:2], change(parts[2])])


def swapped(a, b):
    """A change: one text for another everywhere, and that for this."""
    return lambda text: text.replace(a, "\0").replace(b, a).replace("\0", b)


def turned(text):
    """The entries of the first D, numbered from 0 by rows, at the places of the transpose."""
    found = iter(range(SIZE * SIZE))

    def place(m):
        k = next(found, None)
        return m[0] if k is None else f"D[{k % SIZE * SIZE + k // SIZE}] ="

    return re.sub(r"\bD\[\d+\] =", place, text)


def turned_from_1(text):
    """The same of entries D[i, j]."""
    return re.sub(r"D\[(\d), (\d)\] =", r"D[\2, \1] =", text, count=SIZE * SIZE)


LOOP = """    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Real kept = out.D[6 * i + j];
            out.D[6 * i + j] = out.D[6 * j + i];
            out.D[6 * j + i] = kept;
        }
    return out;"""
MESSAGES = swapped("the mass matrix is singular", "a parameter is not finite")
FAULTS = {
    "rust2021": {
        "jacobian": ("rs", after("pub fn jacobian(", turned)),
        "jacobian_inputs": ("rs", after("pub fn jacobian_inputs(", put("inv_I_12;", "inv_I_13;"))),
        "energy": ("rs", put("\n    h_tilde\n", "\n    -h_tilde\n")),
        "status": ("rs", swapped("Err(Refused::Singular)", "Err(Refused::NotFinite)")),
        "status, of a rod": ("rs", put("*margin <= 0.0", "*margin <= -1e300")),
        "constants": ("rs", put("\n        J_12,\n", "\n        -J_12,\n")),
        "rhs": ("rs", after("pub fn rhs(", put("= x[1]", "= x[2]"))),
    },
    "javascript": {
        "jacobian": ("mjs", after("function jacobian(", turned)),
        "energy": ("mjs", put("return h_tilde;", "return -h_tilde;")),
        "status": ("mjs", MESSAGES),
        "status, of a rod": ("mjs", put("margin <= 0", "margin <= -1e300")),
        "rhs_unforced": ("mjs", put("fill(0)", "fill(1)")),
    },
    "julia": {
        "jacobian": ("jl", after("function jacobian!(", turned_from_1)),
        "jacobian_parameters": ("jl", put("D[4, 9] =", "D[4, 9] = -1.0 -")),
        "energy": ("jl", put("return h_tilde", "return -h_tilde")),
        "status": ("jl", MESSAGES),
        "status, of a rod": ("jl", put("margin <= 0", "margin <= -1e300")),
        "rhs": ("jl", put("u = control(x, t)", "u = nothing")),
        "rhs_unforced": ("jl", put("_ -> zero(Float64)", "_ -> 1.0")),
    },
    "python": {
        "jacobian": ("py", put(":12], D", ":12], xp.matrix_transpose(D)")),
        "energy": ("py", put("return _evaluated(_energy", "return -_evaluated(_energy")),
        "status": ("py", MESSAGES),
        "status, of a rod": ("py", put("(x <= 0)", "(x <= -1e300)")),
        "jacobian_inputs": ("py", put("arrays(xp.zeros(batch), ", "arrays(xp.zeros(()), ")),
        "rhs_unforced": ("py", put("ZEROS = (0.0,)", "ZEROS = (1.0,)")),
    },
    "g++20": {
        "jacobian": ("hpp", after("Linearised jac", put("    return out;", LOOP))),
        "energy": ("hpp", put("return so3_energy", "return -so3_energy")),
        "energy, of spans": ("hpp", after("using Out", put("so3_energy", "-so3_energy"))),
        "status": ("hpp", put("k->data()) != 0", "k->data()) == 2")),
        "status, of spans": ("hpp", put("k.data()) == 0;", "k.data()) != 1;")),
    },
}  # fmt: skip
CASES = [(build, what) for build, faults in FAULTS.items() for what in faults]


def wrong(case, language, name, change):
    """The files of a language of which one is changed, by its name."""
    before = case.texts(language)[1][name]
    text = change(before)
    assert text != before
    return {name: text}


def test_every_language_that_is_built_has_faults():
    assert {BUILDS[build][0] for build in FAULTS} == {*ONE_BUILD} - {"c"}


@pytest.mark.parametrize("build", FAULTS)
def test_without_a_fault_they_agree(build, so3):
    so3.agrees(build)


@pytest.mark.parametrize(("build", "what"), CASES)
def test_a_fault_in_one_language_is_seen(build, what, so3):
    suffix, change = FAULTS[build][what]
    changed = wrong(so3, BUILDS[build][0], f"so3.{suffix}", change)
    with pytest.raises(AssertionError, match=rf"\('so3', '{what.partition(',')[0]}'"):
        so3.agrees(build, **changed)


IN_C = {
    "jacobian": after("void so3_jacobian(", turned),
    "energy": put("return h_tilde;", "return -h_tilde;"),
    "status": swapped("return so3_SINGULAR;", "return so3_NOT_FINITE;"),
}


@pytest.mark.parametrize("what", IN_C)
def test_a_fault_in_the_c_is_seen(what, so3):
    with pytest.raises(AssertionError, match=rf"\('so3', '{what}'"):
        so3.agrees("c", **wrong(so3, "c", "so3.c", IN_C[what]))


STRIDES = {"": None, "inputs": ("u[2*n + s]", "u[2*n]"), "state": ("x[9*n + s]", "x[9*n + 0]")}


@pytest.mark.parametrize("fault", STRIDES)
def test_batches_of_c_are_their_states(fault, so3):
    texts = so3.texts("c")[1]
    texts |= wrong(so3, "c", "so3.c", put(*STRIDES[fault])) if fault else {}
    library, rng = loaded("c", "so3", texts), np.random.default_rng(8)
    x, u, (_, k) = rng.normal(size=(12, 5)), rng.normal(size=(3, 5)), library.constants(so3.p)
    single = [library.rhs(T, *row, k, v) for *row, v in zip(x.T, u.T, strict=True)]
    assert np.allclose(library.rhs_batch(T, x, k, u).T, single, rtol=1e-14) == (not fault)


@pytest.mark.parametrize("fault", ["", "with->k, with->u"])
def test_the_field_of_cvode_is_that_of_c(fault, so3):
    change = put(fault, "with->k, with->k")
    changed = wrong(so3, "cvode", "so3_cvode.h", change) if fault else {}
    assert np.allclose(cvode(so3, **changed), so3.reference["rhs"], rtol=1e-14) == (not fault)
