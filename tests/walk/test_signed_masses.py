"""Masses that may be negative: what a walk says then, and which bodies ``constants`` takes."""

import json
import re
from contextlib import suppress
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from derive.check.checker import check
from derive.pipeline import general_road, walk
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record import prose
from derive.record.as_json import from_json, to_json
from derive.record.mass_signs import SUPPOSED
from derive.record.record import ANY_GROUP, OF_MASSES
from derive.record.sentence import CONDITIONS, Sentence
from derive.views.language import language
from derive.views.text import text
from tests.support.corpus import SIGNED as BODIES_OF_ANY_SIGN
from tests.support.corpus import of_masses as problem
from tests.support.corpus import points, record, simplex
from tests.support.library import ONE_BUILD, emission, library, module_of
from tests.support.walks import repeated

BOOST = {"name": "Boost", "action": "linear", "basis": [[[0, 1], [1, 0]]]}
FLAT = {  # SL(2) beside an axis that stays
    "name": "Flat",
    "action": "linear",
    "basis": [
        [[1, 0, 0], [0, -1, 0], [0, 0, 0]],
        [[0, 1, 0], [0, 0, 0], [0, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [0, 0, 0]],
    ],
}
ROD = {  # stretches and shears of a line, which is all that a rod has
    "name": "Shears",
    "action": "linear",
    "basis": [[[1, 0], [0, 0]], [[0, 0], [1, 0]]],
}


CLAIMS = re.compile(
    r"masses are positive|positive masses|square of a norm|not all on|span the space|"
    r"in one hyperplane|leaves every mass|: the tensor|As the (metric|tensor)|: the kernel|"
    r"As m > 0|η′ gives ẇ;"
)
"""What is said of positive masses alone."""
PAIRS = [
    (prose.message(key.removesuffix("_signed")), prose.message(key))
    for key in prose.sentences()
    if key.endswith("_signed")
]
POSITIVE, SIGNED = (frozenset(words) for words in zip(*PAIRS, strict=True))


@cache
def walked(name, *, signed):
    if signed:
        return record(f"signed {name}")
    return walk(problem(*BODIES_OF_ANY_SIGN[name]))


def messages(x):
    yield x.message
    for _, y in x.places:
        if isinstance(y, Sentence):
            yield from messages(y)


def said(d):
    return {m for step in d.steps for x in step.prose for m in messages(x)}


@pytest.mark.parametrize("name", repeated(BODIES_OF_ANY_SIGN, 2))
def test_no_hypothesis_that_does_not_hold(name):
    d = walked(name, signed=True)
    words = " ".join(text(d).split())
    for key, (places, _) in prose.sentences().items():
        if key.startswith("unaligned."):  # nothing of masses, but of places
            words = words.replace(places, "")
    assert not CLAIMS.search(words)
    assert "wherever" in words.lower()
    assert not said(d) & POSITIVE
    assert said(d) & SIGNED <= set(language("fr").messages)
    assert not of_masses(d)


@pytest.mark.parametrize("name", BODIES_OF_ANY_SIGN)
def test_the_equations_and_all_other_words_are_the_same(name):
    plain, signed = (walked(name, signed=x) for x in (False, True))
    assert CLAIMS.search(" ".join(text(plain).split()))
    assert [s.equations for s in plain.steps] == [s.equations for s in signed.steps]
    assert said(plain) - POSITIVE - SIGNED == said(signed) - POSITIVE - SIGNED
    assert of_masses(plain)
    others = [[x for x in s.hypotheses if x.property not in OF_MASSES] for s in plain.steps]
    assert others == [[*s.hypotheses] for s in signed.steps]


def test_every_message_is_said_somewhere():
    plain = set().union(*(said(walked(name, signed=False)) for name in BODIES_OF_ANY_SIGN))
    signed = set().union(*(said(walked(name, signed=True)) for name in BODIES_OF_ANY_SIGN))
    assert plain >= POSITIVE
    assert signed >= SIGNED


def test_the_checker_refuses_a_claim_of_positive_masses():
    """The ordinary hypotheses and sentences under the problem of any masses."""
    plain, signed = (walked("SAff(2)", signed=x) for x in (False, True))
    forged = from_json(to_json(replace(plain, problem=signed.problem)))
    found = {v.label: v for v in check(forged)}
    assert {x for x, v in found.items() if not v.holds} == of_masses(plain)
    assert found["affine.pullback"].reason == SUPPOSED


def of_masses(d):
    """The steps that suppose positive masses, in a hypothesis or in a sentence."""
    supposed = {s.label for s in d.steps if any(x.property in OF_MASSES for x in s.hypotheses)}
    told = {s.label for s in d.steps for x in s.claims if f"{x.kind}_signed" in CONDITIONS}
    return supposed | told


@pytest.mark.parametrize("name", ["moments", "moments of SE(3)"])
def test_moments_of_positive_masses_are_none_of_any_masses(name):
    plain, signed = (walked(name, signed=x) for x in (False, True))
    assert "hole.body" in of_masses(plain)
    found = {v.label: v for v in check(replace(plain, problem=signed.problem))}
    assert {x for x, v in found.items() if not v.holds} == of_masses(plain)


def negative(body):
    """A record of negative masses that does not say so."""
    d = walk(problem_of({"name": "hole", "group": "SL(2)", **body}, negative_mass=True))
    kept = {k: v for k, v in d.problem.items() if k != "masses"}
    steps = (s for s in d.steps if s.scope != ANY_GROUP)
    return replace(d, problem=kept, steps=(*general_road(affine=False)["steps"], *steps))


GIVEN = {"given": {"m": 1, "c": [0, 0], "J": [[1, 0], [0, -2]]}}


@pytest.mark.parametrize("body", [points((1, [1, 0]), (-2, [0, 1])), {"body": GIVEN}])
def test_numbers_tell_it_where_the_record_does_not(body):
    assert any(v.reason == SUPPOSED for v in check(negative(body)))


def test_the_key_has_one_value():
    d = walked("SL(2)", signed=True)
    forged = replace(d, problem=d.problem | {"masses": "positive"})
    assert all(v.holds for v in check(d))
    plain = replace(walked("SL(2)", signed=False), problem=forged.problem)
    assert any("key 'masses'" in v.reason for v in check(plain))


# -- constants ----------------------------------------------------------------------------------


def taken(m, p):
    with suppress(ValueError):
        return bool(m.constants(p) is not None)
    return False


HOLE = points((1, [1, 0]), (-2, [0, 1]))
"""At A = diag(2^¼, 2^−¼) the metric of SL(2) is degenerate along diag(1, −1)."""


@pytest.mark.parametrize("mass", ["number", "parameter"])
@pytest.mark.parametrize("build", ONE_BUILD.values())
def test_the_counterexample_is_refused(build, mass):
    body = HOLE if mass == "number" else points((1, [1, 0]), ("q", [0, 1]))
    data = {"name": "hole", "group": "SL(2)", **body}
    data |= {"parameters": {"q": -2}} if mass == "parameter" else {}
    made = library(build, problem_of(data, negative_mass=True))
    assert made.constants(np.full(made.sizes["PARAMETERS"], -2.0))[0] == 1


PLANE = points(("q", [1, 0, 0]), (1, [0, 1, 0]), (2, [1, 1, 0]), (1, [-1, 2, 0]))
BODIES = {
    # the q that make a good body, and those that make none
    "disc": ("SO(3)", PLANE, [1, 1e-3], [-9]),
    "hole in a body that turns": ("SO(3)", simplex(3), [1, 0, -0.5], [-30]),
    "J indefinite, I positive": (
        "SO(3)",
        points((5, [1, 0, 0]), (4, [0, 1, 0]), ("q", [0, 0, 1])),
        [1, 0, -1, -3.9],
        [-4.1],
    ),
    "free, J_c indefinite": ("SE(3)", simplex(3), [1, -0.5], [-30]),
    "free, without mass": ("SE(2)", points(("q", [0, 0]), (1, [1, 0]), (1, [-1, 0])), [1], [-3]),
    "GL(2)": ("GL(2)", simplex(2), [1, 0, -0.5], [-30]),
    "SAff(2)": ("SAff(2)", simplex(2), [1, 0, -0.5], [-30]),
    "SO(4)": ("SO(4)", simplex(4), [1, 0, -0.5], [-30]),
    "Sp(4)": ("Sp(4)", simplex(4), [1, 0, -0.5], [-30]),
    "UT(3)": ("UT(3)", simplex(3), [1, 0, -0.5], [-30]),
    "Sim(3)": ("Sim(3)", simplex(3), [1, 0, -0.5], [-30]),
    "boost": (BOOST, points((1.5, [1, 1]), ("q", [1, -1])), [1, 1e-6, 0], [-0.1, -0.5]),
    "flat": (FLAT, PLANE, [1, 1e-3, 0], [-9]),
    "rod": (ROD, points((1, [1, 0]), ("q", [2, 0])), [1, 0], [-1]),
    "product": (
        "SL(2) x SO(2)",
        {
            "point": [
                {"mass": "q", "at": [1, 0], "block": 1},
                {"mass": 2, "at": [0, 1], "block": 1},
                {"mass": 1, "at": [0, 1], "block": 2},
            ]
        },
        [1, 1e-3],
        [-1],
    ),
}


FRAMED = ("free, J_c indefinite", "SAff(2)", "GL(2)", "J indefinite, I positive")
FORMS = [(name, "given") for name in BODIES] + [(name, "principal") for name in FRAMED]


@pytest.mark.parametrize(("name", "frame"), FORMS)
def test_constants_tell_good_bodies(name, frame):
    """By value: the problem has a positive parameter, and takes any number for it."""
    group, body, good, bad = BODIES[name]
    m = module_of(problem(group, body, default=1), frame=frame)
    assert [taken(m, [q]) for q in good] == [True] * len(good)
    assert [taken(m, [q]) for q in bad] == [False] * len(bad)


def test_the_metric_at_1_where_masses_may_be_negative():
    """The boost of an indefinite J: good at 1, not everywhere, and the header says so."""
    body = BODIES["boost"][1]
    for default, signed in ((0.5, False), (-0.5, True)):
        p = problem(BOOST, body, default=default, negative_mass=signed)
        assert taken(module_of(p), [-0.5]) == signed
        assert taken(module_of(p), [-1.5]) is False
        text = emission(p, ("python",))[1]["hole.py"]
        assert ("tests the metric at g = 1" in text) == signed


def test_moments_of_numbers_need_no_check_at_run_time():
    """A small hole in a body of numbers leaves J positive, which suffices everywhere."""
    data = {"name": "hole", "group": BOOST, **points((2, [1, 0]), (2, [0, 1]), (-1, [1, 0]))}
    p = problem_of(data, negative_mass=True)
    assert taken(module_of(p), [])
    assert "g = 1" not in emission(p, ("python",))[1]["hole.py"]


SPHERE = {"kind": "ball", "density": 1, "radius": 1}


def solids(shift):
    hollow = {"kind": "ball", "density": -1, "radius": "1/2", "shift": shift}
    return {"name": "hole", "group": "SE(3)", "solid": [SPHERE, hollow]}


def test_a_hole_is_inside_of_a_solid():
    assert problem_of(solids([0, 0, 0.5]))
    with pytest.raises(ProblemError, match="a hole inside of others"):
        problem_of(solids([9, 0, 0]))
    assert problem_of(solids([9, 0, 0]), negative_mass=True).signed


@pytest.mark.parametrize("group", ["SE(3)", "Aff(3)"])
def test_no_mass_has_no_centre(group):
    axes = [([1, 0, 0], 2), ([0, 1, 0], -2), ([0, 0, 1], 1), ([1, 1, 0], -2), ([0, 1, 1], 1)]
    body = points(*((m, r) for r, m in axes))
    with pytest.raises(ProblemError, match=r"mass is 0|is degenerate"):
        problem_of({"name": "none", "group": group, **body}, negative_mass=True)


def test_a_degenerate_metric_is_not_said_to_move_nothing():
    pair = points((1, [1, 0, 0]), (-1, [0, 1, 0]))
    with pytest.raises(ProblemError, match=r"\(0, 0, 1\) has no kinetic energy .* degenerate"):
        problem_of({"name": "pair", "group": "SO(3)", **pair}, negative_mass=True)


def test_a_metric_may_be_degenerate_where_no_moment_is_0():
    """A boost of (1, 0) and of (0, 1), whose kinetic energies are opposite."""
    pair = points((1, [1, 0]), (-1, [0, 1]))
    with pytest.raises(ProblemError, match="degenerate"):
        problem_of({"name": "pair", "group": BOOST, **pair}, negative_mass=True)


@pytest.mark.parametrize("mass", [["mul", -1, 2], ["div", -4, 2], ["mul", -1, ["par", "a"]]])
def test_masses_that_are_expressions_are_seen_to_be_negative(mass):
    data = json.loads(to_json(walked("SL(2)", signed=True)))
    del data["problem"]["masses"]
    data["problem"]["parameters"]["a"] = {"default": 2, "unit": "", "meaning": ""}
    data["problem"]["body"]["points"][0]["mass"] = mass
    step = next(x for x in data["steps"] if x["label"] == "linear.pullback")
    step["hypotheses"].append({"is": "positive", "of": ["at", "m", "i"]})
    found = {v.label: v for v in check(from_json(json.dumps(data)), 1)}
    assert SUPPOSED in found["linear.pullback"].reason
