"""How long steps are that a tolerance chooses: the next one is to the last as the tolerance to the
error, to the power of one over the order, in every language.

The body is a symmetric top, whose steps of one size all have one error.
"""

import re
import subprocess
from math import log

import numpy as np
import pytest

import derive
from derive.problem.toml import problem_of
from tests.support.motions import LANGUAGES, follow, in_c, in_rust

MOMENTS = {"m": 1, "c": [0, 0, 0], "J": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}
TOP = {"name": "free", "group": "SO(3)", "body": {"given": MOMENTS}}
START = [1.0, 0, 0, 0, 1, 0, 0, 0, 1, 0.6, 0.4, 1.1]
ORDERS = {"gauss": (16, 0.8), "vern9": (9, 0.25)}
"""Of the error, and a step that is not too coarse and not exact."""
BEFORE = 5.0
"""When a step is as long as is wanted, or longer, after many of a larger tolerance."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("sizes")
    code = ("c", "python", "javascript", "rust", "cpp")
    derive.derive(problem_of(TOP)).emit(made, code, step=("gauss", "vern9"))
    return made


def boundary(below, low, high):
    """Where, between two numbers, what is so below is so no more, to a thousandth; ``below`` says
    it of several numbers at once."""
    while high > 1.001 * low:
        asked = low * (high / low) ** (np.arange(11) / 10)
        k = 1 + sum(below(asked[1:-1]))
        low, high = asked[k - 1], asked[k]
    return (low * high) ** 0.5


@pytest.mark.parametrize("step", ORDERS)
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_next_step_is_as_long_as_the_tolerance_says(folder, language, step):
    order, h = ORDERS[step]

    def last(runs):
        """The last step of each run: to h at a tolerance, then on."""
        calls = []
        for tol, *more in runs:
            times = [(BEFORE, 1e-3), *((BEFORE + t, tol) for t in (h, *more))]
            calls += [("begin", 0, 0), *((f"{step}_to", *x) for x in times)]
        places = follow(language, folder, "free", calls, START)
        each = len(calls) // len(runs)
        return np.array([place.h for place in places[each - 1 :: each]])

    def following(tol):
        """The longest step that is made at once after h."""

        def at_once(more):
            return abs(last([(tol, h + x) for x in more]) - more) < 1e-9

        return boundary(at_once, 0.7 * h, 1.3 * h)

    error = boundary(lambda tols: abs(last([(x,) for x in tols]) - h) > 1e-9, 1e-14, 1e-2)
    sizes = {part: following(part * error) for part in (1.1, 2.2)}
    for part, size in sizes.items():
        assert size / h == pytest.approx(0.9 * part ** (1 / order), rel=4e-3)
    assert log(sizes[2.2] / sizes[1.1]) / log(2) == pytest.approx(1 / order, rel=0.1)


SAYS = {
    "c": ("_steps.h", r"_gauss_step\([^;{]*\)\n\{\n", 'fprintf(stderr, "%.17g\\n", h);'),
    "rust": (".rs", r"fn gauss_step\(.*\{\n", 'eprintln!("{h:e}");'),
}
"""Where a language tries a step, and how it says of which size."""


def tried(language, folder):
    """The steps that are tried, of which one is too long for the tolerance by far, up to that after
    it."""
    derive.derive(problem_of(TOP)).emit(folder, ("c", "rust"), step="gauss")
    end, place, says = SAYS[language]
    path = folder / f"free{end}"
    text, found = re.subn(place, lambda x: f"{x[0]}{says}\n", path.read_text())
    assert found == 1
    path.write_text(f"#include <stdio.h>\n{text}" if language == "c" else text)
    program = {"c": in_c, "rust": in_rust}[language](folder, "free", ("-O2",), "double")
    given = "\n\n" + " ".join(map(str, START)) + "\ngauss_to 5 1e-3\ngauss_to 7 1e-15\n"
    done = subprocess.run(program, input=given, capture_output=True, text=True, check=True)
    sizes = [*map(float, done.stderr.split())]
    return sizes[: sizes.index(2.0) + 2]


def test_rust_tries_the_steps_of_c(tmp_path):
    """The first is a tenth of the size over the speed, others grow to four times that; then one is
    too long."""
    in_each = [tried(x, tmp_path) for x in SAYS]
    assert in_each[1] == pytest.approx(in_each[0], rel=1e-6)
    assert in_each[0][-1] < 0.3 * in_each[0][-2]
