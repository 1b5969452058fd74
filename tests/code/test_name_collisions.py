"""A parameter may be called as anything is that stands in the emitted text of a language.

The words are read from the text itself, comments and strings as well; each is refused as a name
with a reason, or the code that has it gives the numbers of the same problem under plain names.
"""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from derive import SE, SL, Gravity, Moments, Points, Potential, Problem, Spring, derive
from derive.code.collisions import identifiers, without_collisions
from derive.code.languages import LANGUAGES
from derive.code.statements import Statements
from derive.pipeline import program
from derive.problem.problem import ProblemError
from tests.support.emitted import compile_c, import_python
from tests.support.languages import BUILDS, REFERENCE, Emitted, agree, built, known
from tests.support.needs import CC, needs

LINEARISED = ("state", "inputs", "parameters")
pytestmark = pytest.mark.no_cover
PARTS = 2
"""One problem has not room for all of them."""
PLACES = ([1, 0], ["1/3", 1], [-1, "1/4"])


@cache
def words(language, *, framed=False):
    """What stands in the files of a language, and the same with an underscore, as names go."""
    chosen = {"frame": "principal", "jacobian": LINEARISED[:2]} if framed else {}
    made = derive("so3").emit(None, (language,), **({"jacobian": LINEARISED} | chosen))
    found = sorted(set(re.findall(r"[A-Za-z][A-Za-z0-9_]{0,30}", "\n".join(made.values()))))
    both = [w for x in found for w in ((x,) if re.search(r"\d", x) else (x, x + "_"))]
    return [w for w in both if accepted(w)]


@cache
def refusal(name):
    """Why it may not be a parameter."""
    try:
        points, value = Points((name, [1, 0]), (1, [0, 1])), {name: 1}
        Problem("named", SE(2), points, Potential(f"{name}*r1_x"), value)
        spring = Spring([1, 0, 0], [1, 2, 0], name)
        Problem("named", SL(3), Moments(), spring, value)
    except ProblemError as error:
        return str(error)
    return None


def accepted(name):
    """Whether it may be a parameter; a refusal says what the name is."""
    reason = refusal(name)
    assert repr(name) in (reason or repr(name))
    return not reason


def problem(names, own="worded"):
    """Names that stand in masses and in a potential, so in every function."""
    terms = [f"{w}*r{1 + i % 3}_x^{2 - (i % 7 > 0)}" for i, w in enumerate(names)]
    forces = [Potential("+".join(["r1_y^2", *terms[i::9]])) for i in range(9)]
    masses = ["3" + "".join(f"+{w}" for w in names[i::3]) for i in range(3)]
    values = {w: round(0.7 + 0.01 * (i % 40), 2) for i, w in enumerate(names)}
    return Problem(own, SE(2), Points(*zip(masses, PLACES, strict=True)), forces, values)


def of_springs(names, own="worded"):
    """The same where the principal frame can be: names in masses and in stiffnesses."""
    sums = [f"1{''.join(f'+{w}^2' for w in names[i::3])}" for i in range(3)]
    at = [[1, 0, 0], ["1/3", 1, 0], [-1, "1/4", 1]]
    forces = [Gravity(0, 0, "-2"), *(Spring(at[i], [1, 2, i], k) for i, k in enumerate(sums))]
    masses = [*zip(sums, at, strict=True), (2, [0, -1, "1/2"])]
    values = {w: round(0.7 + 0.01 * (i % 40), 2) for i, w in enumerate(names)}
    return Problem(own, SL(3), Points(*masses), forces, values)


def plain(names):
    """As many names that no language has."""
    return [f"quantity_{i}_q" for i in range(len(names))]


@needs("cc")
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("build", built(but=REFERENCE))
def test_in_a_language(build, part, tmp_path):
    language, _, program = BUILDS[build]
    known(build, program)
    names = words(language)[part::PARTS]
    assert len(names) > 50
    worded, neutral = (
        Emitted(own, problem(used, own), tmp_path, (*REFERENCE, language), {})
        for own, used in (("worded", names), ("neutral", plain(names)))
    )
    worded.reference = neutral.reference
    agree(build, tmp_path, [worded], tolerance=1e-13)


@needs("cc")
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("framed", [False, True], ids=["given", "principal"])
@pytest.mark.parametrize("language", ["c", "python"])
def test_in_c_and_in_python(language, framed, part, tmp_path):
    """One body, and in Python a batch of bodies; also what finds the principal frame."""
    names = words(language, framed=framed)[part::PARTS]
    make, frame = (of_springs, "principal") if framed else (problem, "given")
    for own, used in (("worded", names), ("neutral", plain(names))):
        derive(make(used, own)).emit(tmp_path, ("c", "python"), frame=frame)
    ours, theirs = import_python("worded", tmp_path), import_python("neutral", tmp_path)
    assert tuple(names) == ours.PARAMETERS
    library = compile_c(CC, "neutral", tmp_path, tmp_path)
    rng = np.random.default_rng(5)
    p = np.array([theirs.DEFAULTS[x] for x in theirs.PARAMETERS])
    p = p * rng.uniform(0.9, 1.1, (3, len(p)))
    x = rng.normal(size=len(theirs.STATE))
    expected = []
    for one in p:
        status, k = library.constants(one)
        assert status == 0
        expected.append([*library.rhs(0.3, x, k), library.energy(0.3, x, k)])
    if language == "c":
        worded = compile_c(CC, "worded", tmp_path, tmp_path)
        ks = [worded.constants(one)[1] for one in p]
        found = [[*worded.rhs(0.3, x, k), worded.energy(0.3, x, k)] for k in ks]
    else:
        k = ours.constants(p)
        found = np.concatenate(
            [ours.rhs(0.3, np.tile(x, (3, 1)), k), ours.energy(0.3, x, k)[:, None]], axis=-1
        )
        assert np.allclose(ours.rhs(0.3, x, ours.constants(p[1])), found[1, :-1], 1e-12, 1e-12)
    scale = np.abs(expected).max()
    assert np.abs(np.array(found) - expected).max() < 1e-12 * scale


FORTRAN = replace(
    LANGUAGES["julia"],
    name="fortran",
    comment=("! ", "! ", ""),
    parenthesised=False,
    continued=" &",
    reserved="allocate where",
    caseless=True,
)
"""What an entry can say of a language with comments, words and lines of its own, without case."""


def made(named):
    d = derive(named)
    return program(d.problem, d.record)


def names_in(p):
    """What the functions of a program load and compute, each once."""
    own = (x for f in p.all_functions() for x in f.loads if x.array != "t")
    values = (v for f in p.all_functions() for s in f.sections for v in s.values)
    return [*dict.fromkeys(x.name for x in (*own, *values))]


def test_names_without_case_and_words_of_one_language():
    p = made(problem(["Ka", "ka", "Allocate", "allocate_", "pure"]))
    words = identifiers('x = PURE ! where not "string"\n', FORTRAN)
    assert words == {"x", "PURE", "allocate", "where"}
    own, apart = names_in(p), names_in(without_collisions(p, words, caseless=True))
    assert len({x.lower() for x in own}) < len(own)
    assert len({x.lower() for x in apart}) == len(apart) == len(own)
    assert not {x.lower() for x in apart} & {x.lower() for x in words}
    assert names_in(without_collisions(p, words)) == own  # none of these in so many letters


def test_a_line_that_goes_on_says_so():
    p = made("se3")
    sizes = {"x": len(p.state), "k": len(p.constants), "u": len(p.inputs), "p": len(p.parameters)}
    text = Statements(FORTRAN, "double", sizes).function(p.functions["rhs"])
    rows = [x.split("\n") for s in text["sections"] for x in s["statements"]] + [
        x.split("\n") for x in text["outputs"]
    ]
    assert any(len(x) > 1 for x in rows)
    assert all(line.endswith(" &") for x in rows for line in x[:-1])
    assert not any(x[-1].endswith("&") for x in rows)
    assert all(line.startswith("! ") for s in text["sections"] for line in s["comment"])
