"""The principal frame: the same motion as in the frame that is given, with fewer operations."""

import numpy as np
import pytest

from derive import derive
from derive.code.emit import EmitError
from derive.code.languages import LANGUAGES
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.principal import principal
from derive.problem.toml import problem_of
from derive.programs import program
from tests.code.test_forms import given, started
from tests.support.library import STRICT, built, emission, library, module_of
from tests.support.needs import CC, needs, present
from tests.support.states import state
from tests.support.walks import own_verdicts


def both(problem):
    """The modules in the given frame and in the principal one."""
    return module_of(problem), module_of(problem, frame="principal")


def refused(problem, p, why):
    """What C tells of parameters that Python refuses with some words."""
    with pytest.raises(ValueError, match=why):
        module_of(problem, frame="principal").constants(p)
    if present("cc"):
        return library("c", problem, frame="principal").constants(p)[0]
    return {"singular": 1, "not finite": 2}[why]


@pytest.mark.parametrize("name", ["SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)"])
def test_the_frame_is_principal(name):
    """In the new parameters J is diagonal, c = 0 where there are translations: few numbers."""
    framed = principal(given(name))
    body = framed.body
    assert all(x == 0 for i, row in enumerate(body.given.J) for j, x in enumerate(row) if i != j)
    if framed.affine:
        assert body.given.c == (0, 0, 0)


@pytest.mark.parametrize("name", ["SO(3)", "SL(3)", "SAff(3)", "SE(2)", "comet"])
def test_the_problem_in_the_frame_is_checked_like_any_other(name):
    record = walk(principal(given(name)))
    assert all(v.holds for v in own_verdicts(record))


@pytest.mark.parametrize(
    ("name", "given", "framed"), [("p1", 91, 45), ("p2", 169, 102), ("p3", 196, 145)]
)
def test_what_the_frame_saves(name, given, framed):
    """An upper bound on the operations of rhs, as measured when this was written."""
    d = derive(f"benchmarks/problems/{name}.toml")
    for frame, most in (("given", given), ("principal", framed)):
        found = program(d.problem, d.record, Options(frame=frame))
        assert sum(found.functions["rhs"].operations().values()) <= most


def test_bodies_without_a_frame_are_refused_by_the_code():
    """All mass on a line: no moment about it."""
    code, p = module_of("so3"), started("so3", {}, 1)[0]
    r = np.array([0.3, -2.0, 0.7])
    at = {name: i for i, name in enumerate(code.PARAMETERS)}
    for i in range(3):
        for j in range(i, 3):
            p[at[f"J_{i + 1}{j + 1}"]] = r[i] * r[j]
    assert refused("so3", p, "singular") == 1


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("name", ["SO(3)", "SL(3)", "GL(3)"])
def test_numbers_that_are_not_finite_are_refused(name, bad):
    """Also where they only tell the frame: a stiffness, gravity."""
    for which in ("k", "g"):
        p = started(name, {}, 1)[0]
        p[module_of(given(name)).PARAMETERS.index(which)] = bad
        assert refused(given(name), p, "not finite") == 2


@pytest.mark.parametrize("gravity", [0.0, 1e-9, 1e200])
def test_gravity_of_any_size(gravity):
    p = problem_of(
        {
            "name": "top",
            "group": "SO(3)",
            "parameters": {"g": 1.0},
            "body": {"given": {"m": 1, "c": [0, 0, 1], "J": [[2, 0, 0], [0, 1, 0], [0, 0, 4]]}},
            "potential": [{"kind": "gravity", "g": ["g", "2*g", "-g"]}],
        }
    )
    plain, framed = both(p)
    _, x, *_ = state(plain)
    k0, k = plain.constants({"g": gravity}), framed.constants({"g": gravity})
    expected = framed.into_frame(plain.rhs(0.0, x, k0), k)
    found = framed.rhs(0.0, framed.into_frame(x, k), k)
    assert np.allclose(found, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


def test_equal_moments_have_a_frame_as_well():
    """A ball: every axis is principal, and rounding may choose any."""
    p = problem_of(
        {
            "name": "ball",
            "group": "SE(3)",
            "body": {"solid": "ball", "density": 2, "radius": 1},
            "potential": [{"kind": "gravity", "g": [1, 2, 3]}],
        }
    )
    plain, framed = both(p)
    q, x, *_ = state(plain)
    k, k0 = framed.constants(q), plain.constants(q)
    found = framed.rhs(0.0, framed.into_frame(x, k), k)
    assert np.allclose(found, framed.into_frame(plain.rhs(0.0, x, k0), k), atol=1e-12)


def test_a_batch_of_bodies():
    framed = module_of(given("SE(3)"), frame="principal")
    rows = [started("SE(3)", {}, seed) for seed in range(1, 5)]
    p, x = (np.array([row[i] for row in rows]) for i in (0, 1))
    p[:, 0] *= np.arange(1, 5)
    k = framed.constants(p)
    for i in range(4):
        alone = framed.constants(p[i])
        one = framed.rhs(0.0, framed.into_frame(x[i], alone), alone)
        many = framed.rhs(0.0, framed.into_frame(x, k), k)[i]
        assert np.allclose(
            framed.out_of_frame(one, alone), framed.out_of_frame(many, k[i]), atol=1e-11
        )


@pytest.mark.parametrize("name", [name for name, x in LANGUAGES.items() if not x.framed])
def test_some_languages_have_no_frame(name):
    with pytest.raises(EmitError, match=f"not in {name}"):
        derive("so3").emit(None, (name,), frame="principal")


@needs("cc")
@pytest.mark.parametrize("form", ["source", "header"])
def test_floats_for_small_machines(form):
    """Without a double where a float will do."""
    name, texts = emission(given("SE(3)"), ("c",), frame="principal", real="float", form=form)
    texts["use.c"] = f'#include "{name}.h"\nint main(void) {{ return 0; }}\n'
    sources = [x for x in texts if x.endswith(".c")]
    flags = (*STRICT, "-Wdouble-promotion", "-Wshadow", "-Wno-unused-function")
    built([(CC, "-std=c99", *flags, *sources, "-o", "out", "-lm")], texts)
