"""Steps of gauss that are too coarse for its iteration, by Newton's method: --jacobian raw."""

import numpy as np
import pytest

import derive
from tests.support.emitted import import_python
from tests.support.motions import LANGUAGES, follow

HEAVY = np.array([1.0, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 9])
"""A state of the heavy top."""

STIFF = """
name = "stiff"
group = "SE(3)"
[parameters]
k = 1e6
[[point]]
mass = 1
at = [1, 0, 0]
[[point]]
mass = 1
at = [-1, 0, 0]
[[point]]
mass = 2
at = [0, 1, 0.5]
[[potential]]
kind = "spring"
at = [0, 1, 0]
anchor = [0, 1, 0]
stiffness = "k"
length = 0
[[potential]]
kind = "gravity"
g = [0, 0, -9.81]
"""


SPIN = np.array([0.1, 0.2, 0.5])
HANGING = np.array(
    [1.0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -4 * 9.81 / 1e6, *SPIN, *-np.cross(SPIN, [0, 1, 0])]
)
"""A body that hangs by a point on a spring of more than 500 rad/s."""


def emitted(tmp_path, name, *languages, problem=None, **options):
    derive.derive(problem or name).emit(tmp_path, languages, step="gauss", **options)
    return tmp_path


@pytest.fixture(scope="module")
def stiff(tmp_path_factory):
    """The folders of its code, with Newton's method and without; where it is at t = 2."""
    folder = tmp_path_factory.mktemp("stiff")
    (folder / "stiff.toml").write_text(STIFF)
    found = []
    for choices in ({"jacobian": "raw"}, {}):
        within = folder / str(len(choices))
        within.mkdir()
        derive.derive(folder / "stiff.toml").emit(
            within, ("c", "cpp", "python", "javascript", "rust"), step="gauss", **choices
        )
        found.append(within)
    (exact,) = follow("c", found[1], "stiff", [("gauss_to", 2.0, 1e-12)], HANGING, [1e6])
    return *found, exact.x


CALLS = [("gauss", 0.05, 40), ("dense", 1.97, 0), ("begin", 0, 0), ("gauss_to", 2.0, 1e-9)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_stiff_spring_in_every_language(language, stiff):
    """In steps of 0.05 s, some 28 rad of the spring, none of them made in halves."""
    newton, plain, exact = stiff
    steps, inside, _, adaptive = follow(language, newton, "stiff", CALLS, HANGING, [1e6])
    assert (steps.status, steps.h) == (0, 0.05)
    # the spring's own oscillation, of 1e-5, is not resolved: its phase is any
    assert np.abs(steps.x - exact)[:9].max() < 3e-5
    assert adaptive.status == 0
    assert np.abs(adaptive.x - exact).max() < 1e-6
    in_c = follow("c", newton, "stiff", CALLS, HANGING, [1e6])
    assert np.abs(steps.x - in_c[0].x).max() < 1e-10  # rounding, times the stiffness
    assert np.abs(inside.x - in_c[1].x).max() < 1e-10  # rounding, times the stiffness
    (halved,) = follow(language, plain, "stiff", CALLS[:1], HANGING, [1e6])
    assert halved.status == 0
    assert halved.h < 0.05


@pytest.mark.parametrize("language", LANGUAGES)
def test_both_ways_to_solve_for_the_stages_agree(language, tmp_path):
    """Newton's method where the iteration, in halves, converges too; then the iteration again."""
    p, u = [0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81], [0.1, 0, 0.2]
    calls = [("gauss", 0.7, 1), ("gauss", 0.05, 3)]
    emitted(tmp_path, "so3", "c", language, jacobian="raw")
    coarse, fine = follow(language, tmp_path, "so3", calls, HEAVY, p, u)
    assert coarse.h == 0.7
    same = [x.x for x in follow("c", tmp_path, "so3", calls, HEAVY, p, u)]
    assert np.abs(coarse.x - same[0]).max() < 1e-13
    assert np.abs(fine.x - same[1]).max() < 1e-13
    (tmp_path / "plain").mkdir()
    emitted(tmp_path / "plain", "so3", "c", language)
    (halved,) = follow(language, tmp_path / "plain", "so3", calls[:1], HEAVY, p, u)
    assert halved.h < 0.7


def test_python_takes_inputs_as_a_function(tmp_path):
    """The derivative has those at the begin of a step, the equations those at each stage."""
    emitted(tmp_path, "so3", "python", jacobian="raw")
    m = import_python("so3", tmp_path)
    k = m.constants([0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81])
    ends = []
    for h, n in ((0.7, 1), (0.07, 10)):
        motion = m.begin(0.0, HEAVY)
        assert m.gauss(motion, k, lambda t, x: [np.cos(t), 0.1 * t, -x[9]], h, n) == m.OK
        ends.append(motion.x)
        assert motion.h == h
    assert np.abs(ends[0] - ends[1]).max() < 1e-3
