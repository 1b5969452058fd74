"""How many symmetries there are: what mechanics says of each problem, and the cocycles; a false one
is refused; what relabellings of a body keep is called circulation everywhere: Υ = Āα − ᾱA."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

import derive
from derive import Problem, Solid
from derive.check.checker import Checker
from derive.command.showing import ready_made
from derive.language.expression import parse
from derive.language.show import show
from derive.language.tree import add, mul
from derive.motion.emitted_code import KEPT
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.record import Equation
from derive.record.sentence import english
from derive.search.symmetries import search
from derive.search.symmetries.scalar_lagrangian import ParameterValues
from derive.search.symmetries.search import quotients_of
from derive.searches import conserved_quantities, symmetries
from tests.support.symmetric import FILES, found
from tests.support.walks import FLUIDS, SEED, problem, record

SPACE = {"time": 1, "translation_space": 3, "rotation_space": 3, "boost": 3}
"""Galilei's group, with the time."""

RELABELLED = {"time": 1, "rotation_space": 3, "deformation_body": 3}
"""Of an ellipsoid: the linear maps of its body that keep its moments."""

COUNTS = {
    "free": SPACE,
    "cone": SPACE | {"rotation_body": 1},
    "spiral": {"time": 1, "deformation_space": 1},
    "ball": SPACE | {"rotation_body": 1, "displacement_body": 2},
    "long_numbers": SPACE,
    "planet": {"time": 1, "rotation_alone": 3},
    "spatial": {
        **{"time": 1, "rotation_space": 3, "translation_body": 3, "rotation_body": 3, "moving": 3},
    },
    "drop": RELABELLED | {"rotation_space": 1},
    "roots": RELABELLED,
    "turned": RELABELLED,
    "driven": {"rotation_body": 1, "both": 1},
    "none": {},
    "landau": {"time": 1, "translation_space": 3, "boost": 1, "rotation_alone": 1},
}
READY = {
    "charged_body": {"time": 1, "rotation_space": 1},
    "comet": {"time": 1, "rotation_space": 3},
    "coupled": {"time": 1, "rotation_space": 3, "rotation_body": 2},
    "ellipsoid": {"time": 1, "rotation_space": 1},
    "euler_top": {"time": 1, "rotation_space": 3},
    "kovalevskaya_top": {"time": 1, "rotation_space": 1},
    "lagrange_top": {"time": 1, "rotation_space": 1, "rotation_body": 1},
    "manakov": {"time": 1, "rotation_space": 6},
    "pendulum": {"time": 1},
    "rod": SPACE | {"rotation_space": 1},
    "spherical_pendulum": {"time": 1, "rotation_space": 1},
    "dirichlet": RELABELLED,
    "gas_cloud": RELABELLED,
    "riemann_ellipsoid": RELABELLED,
    "gl3": {"time": 1, "rotation_space": 3, "deformation_body": 1},
    "gyrostat": {"time": 1, "rotation_space": 1},
    "hammer": SPACE | {"rotation_space": 1},
    "heisenberg": {"time": 1, "deformation_space": 2, "moving": 2},
    "hung_bar": {"time": 1},
    "kirchhoff": {"time": 1, "translation_space": 3, "rotation_space": 3},
    "saff3": SPACE | {"rotation_space": 1},
    "screw": {"time": 1, "displacement_space": 1, "moving": 1},
    "se3": SPACE | {"rotation_space": 1},
    "sim3": SPACE,
    "sl3": {"time": 1, "rotation_space": 3},
    "so3": {"time": 1, "rotation_space": 1},
    "so4": {"time": 1, "rotation_space": 3},
    "sp4": {"time": 1, "rotation_space": 4},
    "su2": {"time": 1, "rotation_space": 3, "rotation_body": 3},
    "top": {"time": 1, "rotation_space": 1, "rotation_body": 1},
    "two_tops": {"time": 1, "rotation_space": 3},
}
REFUSED = {
    "euler_poisson": "no element",
    "zeitlin": "not written for the torus",
    "jelly": "damping",
    "linear": "any group",
    "affine": "any group",
    **dict.fromkeys(FLUIDS, "no matrices"),
    "imu": "no Lagrangian",
}


def kinds(result):
    return Counter(x.kind for x in result.found.symmetries)


def test_every_ready_made_problem_is_here():
    assert {*READY, *REFUSED} == {*ready_made()}
    assert {*COUNTS} == {*FILES}


@pytest.mark.parametrize("name", COUNTS)
def test_counts(name):
    assert kinds(found(name)) == Counter(COUNTS[name])


@pytest.mark.parametrize("name", READY)
def test_counts_of_ready_made_problems(name):
    assert kinds(symmetries(problem(name), record(name))) == Counter(READY[name])


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_lagrangian_is_refused(name):
    with pytest.raises(ProblemError, match=REFUSED[name]):
        symmetries(problem(name), record(name))


def test_the_mass_is_the_cocycle_of_boosts_and_translations():
    result = found("free").found
    central = [(result.symmetries[x.first], result.symmetries[x.second], x) for x in result.central]
    assert [(a.kind, b.kind, show(x.number)) for a, b, x in central] == [
        ("boost", "translation_space", "m")
    ] * 3


def test_so_it_is_of_what_relabels_a_body():
    """On the right, where the fields are those of the body."""
    result = found("spatial").found
    central = [(result.symmetries[x.first].kind, show(x.number)) for x in result.central]
    assert central == [("moving", "2")] * 3


def test_a_magnetic_field_is_the_cocycle_of_translations():
    result = found("landau").found
    pairs = {(x.first, x.second): show(x.number) for x in result.central}
    kinds = {k: x.kind for k, x in enumerate(result.symmetries)}
    assert sorted((kinds[i], kinds[j], x) for (i, j), x in pairs.items()) == [
        ("boost", "translation_space", "m"),
        ("translation_space", "translation_space", "k"),
    ]


@pytest.mark.parametrize("name", ["spherical_pendulum", "lagrange_top"])
def test_what_is_divided_out_is_told(name):
    """Along null directions any function times a field is a symmetry, by which 0 is kept."""
    (step,) = [
        s
        for s in symmetries(problem(name), record(name)).record.steps
        if s.label == f"{name}.symmetries"
    ]
    said = english(step.prose)
    singular = name == "spherical_pendulum"
    assert ("modulo those along which L̃ has no kinetic energy" in said) == singular
    assert ("the quantity that they give is 0" in said) == singular
    assert "X₀" not in said


def test_a_root_without_values_is_named():
    given = {"L": "zeta_1^2 + zeta_2^2 + zeta_3^2 + sqrt(-A_11^2)*zeta_1"}
    unreal = problem_of({"name": "unreal", "group": "SO(3)", "lagrangian": given})
    with pytest.raises(ProblemError, match=r"at which √\(−A_11²\)|at which √\(−A₁₁²\)"):
        symmetries(unreal, walk(unreal))


def test_products_of_roots_of_numbers_are_kept():
    """√2·√3 = √6 for the roots that are taken modulo a prime, whatever the signs."""
    values = ParameterValues(parse("sqrt(2)*sqrt(3) - sqrt(6)"))
    for p in values.primes:
        drawn = {x: int(v[0]) for x, v in values.drawn(1, p, 1).items()}
        assert values.at(parse("sqrt(2)*sqrt(3) - sqrt(6)"), drawn, p) == 0


@pytest.mark.parametrize("name", ["screw", "hammer"])
def test_a_guess_is_taken_only_where_it_is_so_for_another_prime(name, monkeypatch):
    """Though a false one comes first, for each coefficient that is guessed."""
    guessed = []

    def with_false_ones(*given):
        for above, below in quotients_of(*given):
            guessed.append(above)
            yield from ((add(above, below), below), (above, add(below, 1)), (above, below))

    right = symmetries(problem(name), record(name)).found.symmetries
    monkeypatch.setattr(search, "quotients_of", with_false_ones)
    assert symmetries(problem(name), record(name)).found.symmetries == right
    assert guessed


def test_a_group_without_exact_elements_is_refused():
    cubic = {"name": "Own", "basis": [[[0, 0, 2], [1, 0, 0], [0, 1, 0]]]}
    own = problem_of({"name": "own", "group": cubic, "lagrangian": {"L": "zeta_1^2/2"}})
    with pytest.raises(ProblemError, match="no exact elements"):
        symmetries(own, walk(own))


def refused(step, **changes):
    """The verdict on a changed step."""
    checker = Checker(found("free").record.problem, SEED)
    assert checker.check(step).holds
    return checker.check(replace(step, **changes))


AN_ENTRY = ("entry", "A", 1, 1)


def boost():
    """The first step of a boost."""
    kinds = [x.kind for x in found("free").found.symmetries]
    return found("free").record[f"conserved_{kinds.index('boost') + 1}"]


def test_another_field_is_refused():
    step = boost()
    time, moved = step.given
    other = Equation("δA", mul(2, moved.rhs))
    assert not refused(step, given=(time, other)).holds
    skew = Equation("δA", mul("A", "A"))
    equations = tuple(skew if e == moved else e for e in step.equations)
    assert "tangent" in refused(step, given=(time, skew), equations=equations).reason


@pytest.mark.parametrize("k", range(2, 5))
def test_another_equation_is_refused(k):
    step = boost()
    e = step.equations[k]
    inside = e.lhs[2] if k == 4 else None
    wrong = replace(e, rhs=add(e.rhs, AN_ENTRY)) if e.rhs != 0 else None
    if wrong is None:
        wrong = replace(e, lhs=("call", "d/dt", add(inside, AN_ENTRY)))
    equations = (*step.equations[:k], wrong, *step.equations[k + 1 :])
    assert not refused(step, equations=equations).holds


def test_the_cocycle_is_refused_where_it_is_another():
    record = found("free").record
    step = next(s for s in record.steps if "_and_" in s.label)
    wrong = replace(step.equations[-1], rhs=mul(2, step.equations[-1].rhs))
    assert not refused(step, equations=(*step.equations[:-1], wrong)).holds


def test_a_field_is_of_t_and_A_alone():
    step = boost()
    time, _ = step.given
    other = Equation("δA", mul("A", "Z"))
    assert "function of t and A" in refused(step, given=(time, other)).reason


LETTERS = {"a": 2.0, "b": 3.0, "c": 5.0}
BODIES = {
    "three_axes": ("SL(3)", [2, 3, 5]),
    "letters": ("SL(3)", ["a", "b", "c"]),
    "turns_about_the_first": ("SL(3)", ["c", "a", "a"]),
    "turns_about_the_last": ("GL(3)", [2, 2, 5]),
    "ball": ("SL(3)", ["a", "a", "a"]),
    "in_space": ("SAff(3)", [2, "b", 5]),
}


def body(name):
    group, axes = BODIES[name]
    known = {x: LETTERS[x] for x in axes if x in LETTERS}
    return Problem(name, group, Solid("ellipsoid", 1, semi_axes=axes), parameters=known)


@pytest.mark.parametrize("own", ["dirichlet", *BODIES])
def test_it_is_the_circulation_about_each_axis_of_the_body(own):
    own = body(own) if own in BODIES else own
    code = derive.compile(own, conserved=True)
    basis = np.array(derive.derive(own).problem.group.in_user_basis.basis, float)
    rng, ratios = np.random.default_rng(3), []
    for _ in range(2):
        A = np.eye(3) + 0.2 * rng.normal(size=(3, 3))
        A *= np.sign(np.linalg.det(A)) / np.cbrt(abs(np.linalg.det(A)))
        zeta = rng.normal(size=len(basis))
        alpha = A @ np.tensordot(zeta, basis, 1)[:3, :3]
        Y = A.T @ alpha - alpha.T @ A
        place = rng.normal(size=len(code.STATE) - 9 - len(basis))
        kept = code.conserved(0, np.concatenate([A.ravel(), place, zeta]))
        found = dict(zip(code.CONSERVED, kept, strict=True))
        told = [found.pop(f"circulation_{k}") for k in (1, 2, 3)]
        ratios.append(np.divide(told, [Y[2, 1], Y[0, 2], Y[1, 0]]))
        assert not any("body" in x for x in found)
    assert (ratios[0] > 0).all()
    assert ratios[1] == pytest.approx(ratios[0], rel=1e-10)


def test_one_name_in_columns_and_in_words():
    names = [*conserved_quantities(problem("riemann_ellipsoid"), record("riemann_ellipsoid"))]
    run = derive.derive("riemann_ellipsoid").simulate(0.1, points=2)
    columns = [x.name for x in run.columns]
    kept = [x for x in names if x.startswith("circulation")]
    assert kept == ["circulation_3", "circulation_2", "circulation_1"]
    assert [*reversed(kept)] == [x for x in columns if x.startswith("circulation")]
    assert KEPT["circulation"] == "circulation in the body"


def test_a_turn_of_a_body_that_keeps_its_shape_is_an_angular_momentum():
    names = conserved_quantities(problem("lagrange_top"), record("lagrange_top"))
    assert [*names] == ["energy", "angular_momentum_3", "body_angular_momentum_3"]


def test_what_no_points_are_relabelled_by_is_no_circulation():
    """Half of Tr Z², by which SL(2) moves no points: it is left alone by all of the group."""
    killing = derive.Lagrangian("zeta_1^2 + zeta_2*zeta_3")
    own = derive.derive(Problem("killing", "SL(2)", killing))
    assert "deformation_body" in {x.kind for x in own.symmetries()}
    names = conserved_quantities(own.problem, own.record)
    assert not any(x.startswith("circulation") for x in names)
    assert any(x.startswith("body_deformation_momentum") for x in names)
