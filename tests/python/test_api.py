"""The words of derive.python.api build what a file says, and a derivation does what it promises;
the examples in docstrings print what they say."""

import doctest
import importlib
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.code.emit import EmitError
from derive.motion.first_numbers import MotionError
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.schema.python_words import words
from tests.support.cached import ROOT
from tests.support.walks import own_verdicts


def pair(**more):
    body = derive.Points((1, [1, 0]), (2, [0, "a"]))
    forces = [derive.Spring(1, 2, "k"), derive.Gravity(0, -9.81)]
    return derive.Problem("pair", derive.SL(2), body, forces, {"a": 1.5, "k": 2.0}, **more)


def test_a_derivation(tmp_path):
    d = derive.derive(pair(title="A pair"))
    assert str(d).startswith("A pair — SL(2)")
    assert "θ" in str(d["motion"])
    assert "\\theta" in d["pair.motion"]._repr_markdown_()
    assert "$$" in d._repr_markdown_()
    assert "\\begin{document}" in d.latex()
    assert all(v.holds for v in d.check())
    files = d.emit(tmp_path, languages=["python"])
    assert list(files) == ["pair.py"]
    assert (tmp_path / "pair.py").read_text(encoding="utf-8") == files["pair.py"]


def test_the_same_as_a_file(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(
        """name = "pair"
group = "SL(2)"
parameters = { a = 1.5, k = 2.0 }
point = [{ mass = 1, at = [1, 0] }, { mass = 2, at = [0, "a"] }]
[[potential]]
kind = "spring"
between = [1, 2]
stiffness = "k"
[[potential]]
kind = "gravity"
g = [0, -9.81]
""",
        encoding="utf-8",
    )
    assert derive.derive(path).record == derive.derive(pair()).record


def test_groups_are_multiplied_and_bodies_joined():
    group = derive.SO(3) * derive.SE(3)
    body = derive.Points((1, (1, 0, 0)), (1, (0, 1, 0)), (1, (0, 0, 1), 2), (2, (1, 1, 0), 2))
    body += derive.Points((1, (0, 2, 0), 2))
    assert [x.block for x in derive.Problem("all", group, body).points] == [1, 1, 2, 2, 2]
    solid = derive.Solid("ball", 2, radius=1) + derive.Points((1, [0, 0, 2]))
    problem = derive.Problem("top", derive.SO(3), solid, [derive.Gravity(0, 0, -1)])
    assert str(derive.derive(problem)["motion"]).startswith("top.motion")
    for make in (derive.SAff, derive.GL, derive.Aff, derive.SE):
        assert make(3).name.endswith("(3)")


def test_errors_are_those_of_files():
    with pytest.raises(ProblemError, match="between"):
        derive.Problem("p", derive.SL(2), derive.Points((1, [1, 0])), [derive.Spring(1, 9, 1)])
    with pytest.raises(AttributeError):
        derive.nothing  # noqa: B018
    assert derive.ProblemError is ProblemError


def test_keys_of_a_file_are_keywords():
    body = derive.Points((1, [1, 0, 0]), (2, [0, 1, 0]), (1, [0, 0, 1]))
    for one, other in (
        (derive.Force("F", at=[0.5, 0.4, 0]), derive.Force("F", on=[0.5, 0.4, 0], frame="space")),
        (derive.Spring(between=[1, 2], stiffness=3), derive.Spring(1, 2, 3)),
        (
            derive.Spring(stiffness=2, at=[0, 0, 1], anchor=[0, 0, 0]),
            derive.Spring([0, 0, 1], [0, 0, 0], 2),
        ),
        (derive.Gravity([0, 0, -9.81]), derive.Gravity(0, 0, -9.81)),
        (derive.Gravity(g=[0, 0, -9.81]), derive.Gravity(0, 0, -9.81)),
    ):
        problems = (derive.Problem("p", "SO(3)", body, x) for x in (one, other))
        first, second = (derive.derive(p).record for p in problems)
        assert first == second
    for build, told in (
        (lambda: derive.Force("a", fram="body"), "did you mean 'frame'"),
        (lambda: derive.Spring(2, at=[0, 0, 1]), "'at' goes with the keys of a file"),
        (lambda: derive.Spring(1, 2), "'stiffness' is missing"),
        (lambda: derive.Attraction(2, center=[0]), "did you mean 'centre'"),
        (lambda: derive.Problem("p", "SO(3)", body, derive.Force("a")), "'on' or 'at' is missing"),
        (lambda: derive.Problem("p", "SO(3)", derive.Points(1)), "'at' is missing"),
    ):
        with pytest.raises(ProblemError, match=told):
            build()


@pytest.mark.parametrize(
    ("kind", "told", "call"),
    [
        (ProblemError, "unknown problem 'nosuch'", lambda d: derive.derive("nosuch")),
        (ProblemError, "no choice lang;", lambda d: derive.compile(d, lang="c")),
        (EmitError, "no language 'fortran'; there are c,", lambda d: d.emit(languages=["fortran"])),
        (EmitError, "did you mean 'c'", lambda d: d.emit(languages=["C"])),
        (EmitError, "did you mean 'languages'", lambda d: d.emit(lang=["c"])),
        (EmitError, "real must be one of", lambda d: d.emit(real="half")),
        (EmitError, "give prefix NAME", lambda d: d.emit(prefix="1")),
        (MotionError, "start: expected numbers by name", lambda d: d.simulate(1, start=[1, 2])),
        (MotionError, "start: expected numbers by name", lambda d: d.motion_page(1, start=[1])),
        (MotionError, "zeta_1: expected a number", lambda d: d.simulate(1, start={"zeta_1": "a"})),
        (MotionError, "exp: expected a list", lambda d: d.simulate(1, exp=1)),
        (MotionError, "t: expected a number", lambda d: d.simulate("1")),
        (MotionError, "give dt", lambda d: d.simulate(1, step="rk4")),
        (MotionError, "project takes it there", lambda d: d.simulate(1, start={"A_11": 2})),
        (
            ValueError,
            "without at_defaults parameters stay letters",
            lambda _: derive.first_integrals("so3", at_defaults=True, conditions=True),
        ),
        (MotionError, "vary: expected laws", lambda d: d.simulate(1, ensemble=2, vary=[1])),
    ],
)
def test_what_is_wrong_with_a_call_is_one_line(kind, told, call):
    """In the words of Python, without options of the command line."""
    with pytest.raises(kind, match=told) as found:
        call(derive.derive("top"))
    assert "\n" not in str(found.value)
    assert "--" not in str(found.value)


def test_dir_has_public_names_alone():
    assert {x for x in dir(derive) if not x.startswith("__")} == {*derive.__all__}


def test_a_tensor_of_inertia_in_place_of_the_moments():
    """I = (Tr J)1 − J about the origin: the same record either way."""
    J = [[2, 1, 0], [1, 3, 0], [0, 0, 4]]
    tensor = [[7, -1, 0], [-1, 6, 0], [0, 0, 5]]
    one, other = (
        derive.derive(derive.Problem("solid", "SO(3)", derive.Moments(m=1, c=[0, 0, 0], **given)))
        for given in ({"J": J}, {"I": tensor})
    )
    assert one.record.problem["body"] == other.record.problem["body"]


def test_damping_at_a_place_of_a_solid():
    """The drag −κv at r has the moment r ∧ Ā(−κv), as one that is given point by point."""
    body = derive.Points((2, [1, 0, 0]), (1, [0, 2, 0]), (3, [0, 0, 1]), (0, [1, 1, 1]))
    on = derive.derive(derive.Problem("a", "SE(3)", body, derive.Damping(2, on=[4])))
    at = derive.derive(derive.Problem("a", "SE(3)", body[:3], derive.Damping(2, at=[1, 1, 1])))
    assert all(v.holds for v in own_verdicts(at.record))
    assert on["motion"].equations == at["motion"].equations


def test_a_momentum_in_the_body_is_kept_where_the_velocity_is_that_in_space():
    """The symmetries are on the right; their values along a motion that turns and moves."""
    L = "zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 + zeta_1*zeta_2"
    data = {"name": "spatial", "group": "SO(3)", "lagrangian": {"L": L, "trivialisation": "right"}}
    d = derive.derive(problem_of(data))
    kept = d.symmetries()
    assert "right" in {x.symmetry.side for x in kept}
    run = d.simulate(2.0, start={"zeta_1": 1.0, "zeta_3": 0.4}, exp=(0.3, 0.2, 0.5), points=8)
    values = kept.values(run.t, run.states)
    assert np.ptp(run.states, axis=0).min() > 0.01
    assert np.ptp(values, axis=0).max() < 1e-7


def test_a_place_of_a_block():
    """Beside others it is the point with the same coordinates and the same block."""
    body = derive.Points((1, [1, 0]), (1, [0, 1]), (1, [1, 1], 2), (1, [0, 2], 2), (0, [2, 3], 2))
    forces = [
        (derive.Force("F", [2, 3], block=2), derive.Force("F", 5)),
        (derive.Damping(2, at=[2, 3], block=2), derive.Damping(2, on=[5])),
        (derive.Spring([2, 3], [0, 0], 4, block=2), derive.Spring(5, [0, 0], 4)),
    ]
    for at, on in forces:
        one = derive.Problem("p", derive.SE(2) * derive.SE(2), body[:4], [at])
        assert [x.block for x in one.places] == [2]
        other = derive.Problem("p", derive.SE(2) * derive.SE(2), body, [on])
        assert derive.derive(one)["motion"].equations == derive.derive(other)["motion"].equations
    with pytest.raises(ProblemError, match="either 'between' or an end"):
        derive.Problem("p", "SE(2)", body[:2], [derive.Spring(1, 2, 4, block=1)])


def test_every_word_is_a_public_name():
    space = {}
    exec("from derive import *", space)
    for name in {*words(), *derive.PLACES}:
        assert name in derive.__all__
        assert name in dir(derive)
        assert space[name] is getattr(derive, name)
    for name, kind in (("MotionError", MotionError), ("EmitError", EmitError)):
        assert getattr(derive, name) is kind
        assert issubclass(kind, derive.Refused)


def test_what_is_large_is_shown_in_one_line():
    d = derive.derive("two_tops")
    (point,) = derive.Points((1, [10**100, 0, 0]))
    for x in (d, d.problem, d.problem.group, d.record, d.symmetries(), derive.compile(d), point):
        assert len(repr(x)) < 80
        assert " at 0x" not in repr(x)
    assert repr(d.problem) == "<problem two_tops: SO(3) x SO(3)>"


@pytest.mark.parametrize(
    ("find", "said"),
    [
        (lambda: derive.first_integrals("euler_top", 2), "poisson"),
        (lambda: derive.derive("so3").symmetries(), "symmetries"),
        (lambda: derive.derive("lagrange_top").reduction(), "momentum_1"),
        (lambda: derive.derive("euler_top").equilibria(), "equilibrium_1"),
    ],
)
def test_what_a_search_found_shows_the_steps_that_tell_it(find, said):
    """From the first that tells it on, in each notation; and its record is checked."""
    found = find()
    label = f"{found.record.name}.{said}"
    before = [s.label for s in found.record.steps if s not in found.record.since(said)]
    assert before
    for text in (str(found), found.markdown(), found.latex()):
        plain = text.replace("\\_", "_")
        assert label in plain
        assert f"{before[-1]} " not in plain
    assert found._repr_markdown_() == found.markdown() != found.markdown("fr")
    assert all(v.holds for v in found.check(1))


WITH_EXAMPLES = [
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in sorted(Path(ROOT, "derive").rglob("*.py"))
    if ">>> " in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples_hold(name):
    done = doctest.testmod(importlib.import_module(name))
    assert done.attempted
    assert not done.failed
