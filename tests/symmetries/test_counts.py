"""How many symmetries there are: what mechanics says of each problem, and the cocycles."""

from collections import Counter

import pytest

from derive.command.showing import derive, ready_made
from derive.language.expression import parse
from derive.language.show import show
from derive.language.tree import add
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.sentence import english
from derive.search.symmetries import search
from derive.search.symmetries.scalar_lagrangian import ParameterValues
from derive.search.symmetries.search import quotients_of
from derive.searches import symmetries
from tests.support.symmetric import FILES, found
from tests.support.walks import FLUIDS, problem, record

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
        symmetries(*derive(name))


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
