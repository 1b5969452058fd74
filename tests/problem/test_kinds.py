"""Each kind of potential, by the problems of its page in docs/potentials: walked, checked, read; a
spring whose ends meet, where its natural length is a parameter that is 0: the force is −kd."""

import json
import tomllib
from functools import cache

import numpy as np
import pytest

from derive import derive
from derive.pipeline import walk
from derive.problem.principal import frame_of, principal
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.programs import program
from derive.python import api
from derive.python.api import SE, Moments, Problem, Table
from derive.record.as_json import from_json, to_data
from derive.record.record import RecordError
from derive.record.vocabulary import (
    DISPLACEMENTS,
    OF_POTENTIALS,
    PRODUCTS,
    ROTATIONS,
    VOCABULARY,
    add_letters,
)
from derive.schema.potential_kinds import kinds
from derive.schema.python_words import words
from derive.validate.chart import Chart
from derive.validate.compare import compare
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import DiffersError
from derive.views.language import language
from derive.views.outline import system
from tests.support.kinds import PAGES, examples, pages
from tests.support.library import ONE_BUILD, derived, emission, library, module_of
from tests.support.walks import own_verdicts


def test_each_kind_has_a_page_and_an_example():
    pages = {p.stem for p in PAGES.glob("*.md")}
    assert pages == {*kinds()}
    used = {(name.split()[0], p.kind) for name, x in examples().items() for p in x.potentials}
    assert {(kind, kind) for kind in kinds()} <= used


@pytest.mark.parametrize("kind", kinds())
def test_the_page_names_every_key(kind):
    text = (PAGES / f"{kind}.md").read_text(encoding="utf-8")
    assert all(f"`{key}`" in text for key in kinds()[kind].names())


@pytest.mark.parametrize("name", examples())
def test_an_example_holds(name):
    d = derive(examples()[name])
    assert [v.label for v in own_verdicts(d.record) if not v.holds] == []
    assert from_json(json.dumps(to_data(d.record))) == d.record
    files = d.emit()
    assert len(files) == 3
    for tongue in ("en", "fr"):
        assert "{" not in system(d.record, language(tongue))


@pytest.mark.parametrize("name", examples())
def test_a_record_of_another_form_is_refused(name):
    """Each key of each potential left out, of another type, or another name."""
    data = to_data(walk(examples()[name]))
    refused = 0
    for k, p in enumerate(data["problem"]["potentials"]):
        for key in p:
            rest = {x: y for x, y in p.items() if x != key}
            for other in (rest, rest | {key: {"no": 1}}, rest | {key + "_": p[key]}):
                changed = json.loads(json.dumps(data))
                changed["problem"]["potentials"][k] = other
                with pytest.raises(RecordError, match=rf"potential {k + 1}"):
                    from_json(json.dumps(changed))
                refused += 1
    assert refused


@pytest.mark.parametrize("kind", kinds())
def test_a_key_that_is_almost_right_is_named(kind):
    key = kinds()[kind].names()[0]
    wrong = Table("potential", kind=kind, **{key + "s": 1})
    with pytest.raises(ProblemError, match=rf"potential 1: unknown key '{key}s'; did you mean"):
        Problem("b", SE(3), Moments(), [wrong])


@pytest.mark.parametrize("name", examples())
def test_in_the_principal_frame_or_refused(name):
    problem = examples()[name]
    refused = [p.unturned for p in problem.potentials if p.unturned]
    if refused or not frame_of(problem.group):
        with pytest.raises(
            ProblemError, match=refused[0] if frame_of(problem.group) else "no prin"
        ):
            principal(problem)
    else:
        record = walk(principal(problem))
        assert all(v.holds for v in own_verdicts(record))


@pytest.mark.parametrize("kind", [x for x, own in kinds().items() if own.alone])
def test_one_alone(kind):
    problem = examples()[f"{kind} 1"]
    text = pages()[f"{kind} 1"]
    second = text[text.index("[[potential]]") :]
    assert len(problem.potentials) == 1
    with pytest.raises(ProblemError, match=f"potential 2: a second {kind}"):
        problem_of(tomllib.loads(text + second))


@pytest.mark.parametrize("word", sorted({*words()} - {"Moments", "Solid"}))
def test_the_keys_of_a_file_are_keywords_of_a_word(word):
    """Each alone builds a table with that key: what else it needs, its reader says."""
    for key in words()[word].names():
        built = getattr(api, word)(**{key: [1]})
        (table,) = built if isinstance(built, list) else [built]
        assert [1] in table.fields.values()
    with pytest.raises(ProblemError, match=f"{word}: unknown 'nonsense'.*; it takes"):
        getattr(api, word)(nonsense=1)
    with pytest.raises(ProblemError, match=f"{word}: (it takes|.* goes with)"):
        getattr(api, word)(*range(20), **{words()[word].names()[0]: 1})


LETTERS = [x for kind in kinds() for x in OF_POTENTIALS.get(kind, ())]


def test_no_kind_takes_a_letter_that_has_a_meaning():
    """Neither one of the paper, nor one of another kind, nor one of a kind of group."""
    own = VOCABULARY["m"]
    for taken in ("Z", LETTERS[0]):
        with pytest.raises(ValueError, match=f"the letter {taken} has a meaning: "):
            add_letters(dict(VOCABULARY), {taken: own})
    known = dict(VOCABULARY)
    add_letters(known, {"Q_A": own})
    with pytest.raises(ValueError, match=f"the letter Q_A has a meaning: {own.meaning}"):
        add_letters(known, {"Q_A": own})
    assert {*OF_POTENTIALS} <= {*kinds()}
    assert not {*LETTERS} & {*ROTATIONS, *DISPLACEMENTS, *PRODUCTS}


PLACES = ((1, [1, 0, 0.5]), (2, [0, 1, 0]), (0.5, [0, 0.3, 1]), (0.7, [0.1, 0.3, -1]))
TIED = {"kind": "spring", "on": 1, "anchor": [1, 0, 0.5], "stiffness": "k"}
GROUPS = ("SE(3)", "SL(3)", "SAff(3)")


@cache
def tied(group, length):
    """For a natural length that is a parameter l, or 0 in the file."""
    data = {"name": "tied", "group": group, "parameters": {"k": 2.0} | ({"l": 0} if length else {})}
    data["point"] = [{"mass": m, "at": at} for m, at in PLACES]
    return problem_of(data | {"potential": [TIED | {"length": "l" if length else 0}]})


def states(m):
    """At g = 1 the ends meet; then near and far from there; ζ is any."""
    rng = np.random.default_rng(2)
    x = np.array([float(name in ("A_11", "A_22", "A_33")) for name in m.STATE])
    free = [i for i, name in enumerate(m.STATE) if name[0] not in "AT"]
    x[free] = rng.normal(size=len(free))
    beside = np.array([float(name[0] in "AT") for name in m.STATE]) * rng.normal(size=len(x))
    return [x + size * beside for size in (0, 1e-9, 1e-3, 0.5)]


@pytest.mark.parametrize("group", GROUPS)
def test_length_0_is_that_of_a_linear_spring(group):
    m = module_of(tied(group, True), jacobian=("state", "parameters"))
    plain = module_of(tied(group, False), jacobian=("state",))
    k, k_plain = m.constants([2.0, 0.0]), plain.constants([2.0])
    for x in states(m):
        dx, D = m.jacobian(0, x, k)
        expected, D_plain = plain.jacobian(0, x, k_plain)
        assert np.allclose(dx, expected, rtol=1e-13, atol=1e-13)
        assert np.allclose(D, D_plain, rtol=1e-12, atol=1e-12)
        assert np.allclose(m.rhs(0, x, k), dx, rtol=1e-13, atol=1e-13)
        assert np.isclose(m.energy(0, x, k), plain.energy(0, x, k_plain), rtol=1e-13)
        assert np.isfinite(m.jacobian_parameters(0, x, np.array([2.0, 0.0]))).all()
    many = np.array(states(m))
    assert np.allclose(m.rhs(0, many, k), [m.rhs(0, x, k) for x in many], rtol=1e-14, atol=1e-14)
    lengths = m.constants(np.array([[2.0, 0.0], [2.0, 0.3]]))
    assert np.allclose(lengths[0], k, rtol=1e-15)
    assert np.allclose(lengths[1], m.constants([2.0, 0.3]), rtol=1e-15)


def test_the_slope_by_a_length_of_0():
    """Away from distance 0 it is that of any length; by steps to both sides."""
    m = module_of(tied("SE(3)", True), jacobian=("parameters",))
    x, h = states(m)[-1], 1e-6
    D = m.jacobian_parameters(0, x, np.array([2.0, 0.0]))
    ends = [m.rhs(0, x, m.constants([2.0, s * h])) for s in (1, -1)]
    slope = (ends[0] - ends[1])[-6:] / (2 * h)
    assert np.allclose(D[-6:, list(m.PARAMETERS).index("l")], slope, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("group", GROUPS)
def test_a_length_has_no_direction_at_distance_0(group):
    m = module_of(tied(group, True))
    k = m.constants([2.0, 0.5])
    there, near, *_ = states(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        assert np.isnan(m.rhs(0, there, k)).any()
    assert np.isfinite(m.rhs(0, near, k)).all()
    texts = emission(tied(group, True), ("c",))[1]
    header = " ".join(texts["tied.h"].replace(" * ", " ").split())
    assert "Where the ends of a spring meet, its natural length must be 0" in header
    assert "natural length" not in emission("so3", ("c",))[1]["so3.h"]


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("build", [x for x in ONE_BUILD.values() if x != "python"])
def test_in_other_languages(build, real):
    m, made = module_of(tied("SE(3)", True)), library(build, tied("SE(3)", True), real=real)
    status, k = made.constants(np.array([2.0, 0.0]))
    rhs = next(x for x in made.calls if x.name == "rhs")
    assert status == 0
    for x in states(m):
        values = made.values(t=0.0, p=np.array([2.0, 0.0]), k=k, u=np.zeros(0), x=x)
        expected = m.rhs(0, x, m.constants([2.0, 0.0]))
        for found in made.shown(rhs, values, False):
            close = {"double": 1e-13, "float": 1e-5}[real]
            assert np.allclose(found, expected, rtol=close, atol=close)


FAULTS = {
    "another length": ("1e-37*(l == 0)", "(l == 0)", "k_l/sqrt", "(k_l + slack_l)/sqrt"),
    "without it": ("", "", "k_l/sqrt", "(k_l + k_*slack_l)/sqrt"),
}


@pytest.mark.parametrize("case", FAULTS)
def test_what_holds_for_other_lengths_alone_is_refused(case):
    """Code that is right at random lengths and wrong at 0."""
    d = derived(tied("SE(3)", True))
    files = d.emit(None, ["c"])
    claims = Claims(d.record, Chart(), 2**64)
    numbers = program(d.problem, d.record).numbers()
    assert compare(read("tied.c", files, "tied").module, claims, numbers).points >= 2
    old, new, before, after = FAULTS[case]
    source = files["tied.c"]
    assert old in source
    start = source.index("void tied_rhs(")
    assert before in source[start:]
    wrong = source[:start].replace(old, new) + source[start:].replace(f"{before}", after, 2)
    with pytest.raises(DiffersError):
        compare(read("tied.c", {**files, "tied.c": wrong}, "tied").module, claims, numbers)
