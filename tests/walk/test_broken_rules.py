"""A rule of the engine that is wrong in form is an error that names the step."""

import sys

import pytest

from derive import pipeline
from derive.algebra import calculus
from derive.algebra.words import word
from derive.command.showing import load_problem
from derive.pipeline import general_road, walk
from derive.problem.problem import ProblemError
from derive.walk.chapter import WalkError, naming_steps
from derive.walk.spine import cartan
from derive.walk.spine.alphabet import Alphabet
from derive.walk.spine.kernel import restrict
from derive.walk.vectors import rotation


@pytest.fixture(autouse=True)
def afresh():
    """The road of any group is kept: neither a right one for these tests, nor a wrong one after."""
    pipeline.general_road.cache_clear()
    yield
    pipeline.general_road.cache_clear()


def forgetful(w, k, image):
    """The product rule, that forgets what stands after the letter."""
    return right_product(w[: k + 1], k, image)


right_product = calculus._apply_at
right_rule = cartan.body_rule


def unbarred(a, C):
    """The rule of what g leaves in the body, a bar forgotten."""
    right = right_rule(a, C)

    def rule(left, other):
        image = right(left, other)
        return image.bar if image is not None and left[0] in (a.N, a.F) else image

    return rule


@pytest.mark.parametrize("name", ["linear", "affine", "so3", "sl3"])
def test_a_product_rule_that_forgets_a_factor(name, monkeypatch):
    monkeypatch.setattr(calculus, "_apply_at", forgetful)
    action = "affine" if name == "affine" else "linear"
    where = r"lagrangian\.lagrangian, lagrangian\.velocities: ValueError"
    told(name, rf"step .*{action}\.velocity \(variation\), in {where}")


@pytest.mark.parametrize("name", ["affine", "se3"])
def test_a_body_rule_that_is_not_barred(name, monkeypatch):
    for module in sys.modules.values():
        if getattr(module, "body_rule", None) is right_rule:
            monkeypatch.setattr(module, "body_rule", unbarred)
    where = r"cartan\.trivialise, .*at_identity: V"
    told(name, rf"after the step affine\.trivialisation \(triv.*\), in {where}")


def test_a_letter_without_an_image(monkeypatch):
    """A bare KeyError on the road of one group, in words."""

    def absent(*given):
        return {}["w"]

    monkeypatch.setattr(rotation, "metrics", absent)
    told("so3", r"step so3\.energy \(identification\), in rotation\.energy_step: KeyError: 'w'")


def test_what_is_wrong_with_a_problem_is_no_error_of_the_engine():
    problem = load_problem("so3")
    with pytest.raises(ProblemError):
        failing(problem)


@naming_steps()
def failing(problem):
    raise ProblemError(problem.name)


def test_a_momentum_that_moves_with_the_group_is_not_restricted_in_silence():
    """Its variation would be lost: a gyroscopic term N̄A, say."""
    a = Alphabet("n", affine=False)
    form = general_road(affine=False)["momenta"].form
    values = {a.Pi.momentum: word(a.N).bar * word(a.A.position), a.Pi.force: word(a.N_body)}
    with pytest.raises(ValueError, match=r"Π has [AN], whose variation is not known"):
        restrict(form, values, a)


def told(name, where):
    """The message of a walk that breaks, and what broke it."""
    with pytest.raises(WalkError, match=where) as caught:
        walk(load_problem(name))
    assert isinstance(caught.value.__cause__, (ValueError, KeyError))
