"""--state moving: the same numbers as of the whole state, without the entries that never vary."""

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from tests.oracles.general import expm
from tests.support.needs import need

QUICK = ("-std=c99", "-O1", "-fPIC", "-shared")
SHIFTS = [[[0] * 3 + [int(k == i)] for k in range(4)] for i in range(3)]
TURN = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]
PLANE = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
POINTS = [{"mass": 1.5, "at": [1, 0.5, 0, 1]}, {"mass": 0.5, "at": [0, 1, 2, 1]}]
SPRING = {
    "kind": "spring",
    "at": [1, 0.5, 0, 1],
    "anchor": [1, 0, 3, 1],
    "stiffness": 2,
    "length": 0.5,
}
PROBLEMS = {
    "shifts": {"group": {"name": "R3", "basis": SHIFTS}, "point": POINTS, "potential": [SPRING]},
    "crane": {
        "group": {"name": "Crane", "basis": [TURN, SHIFTS[2]]},
        "point": POINTS,
        "potential": [SPRING],
    },
    "engel": {
        "group": "UT(4)",
        "lagrangian": {
            "L": "(" + " + ".join(f"zeta_{a}^2" for a in range(1, 7)) + ")/2 - A_13*A_24 - A_14^2"
        },
    },
    "pair": {
        "group": "SE(2) x UT(3)",
        "point": [{"mass": 1, "at": [1, 0], "block": 1}, {"mass": 2, "at": [0, 1], "block": 1}]
        + [{"mass": 1, "at": [0, 2 - k, k - 1], "block": 2} for k in (1, 2)]
        + [{"mass": 3, "at": [1, 1, 1], "block": 2}],
    },
    "turned": {
        "group": {
            "name": "T3",
            "action": "affine",
            "basis": [[[*row, 0] for row in PLANE] + [[0] * 4], *SHIFTS],
        },
        "point": [{"mass": 1, "at": [1, 0, 0]}, {"mass": 2, "at": [0, 1, 1]}],
        "potential": [{"kind": "gravity", "g": [0, 1, -9]}],
    },
    "screw": "screw",
    "heisenberg": "heisenberg",
}
FORMS = {
    "plain": {},
    "columns": {"layout": "col"},
    "tangent": {"velocity": "tangent"},
}
LEFT = {"shifts": 6, "crane": 7, "engel": 12, "turned": 11, "screw": 6, "heisenberg": 6}


def problem(name):
    given = PROBLEMS[name]
    return given if isinstance(given, str) else problem_of({"name": name, **given})


def states(full, group, count=4):
    """States of the group, by exponentials: (count, N_STATE)."""
    rng, basis = np.random.default_rng(2), np.array(group.basis, float)
    found = []
    for _ in range(count):
        a, b, z = rng.normal(size=(3, len(basis)))
        g = expm(np.tensordot(a, basis, 1)) @ expm(np.tensordot(b, basis, 1))
        found.append(full(g, z, np.tensordot(z, basis, 1)))
    return found


def placed(f, group):
    """The function that has the numbers of the state by the names that it has."""
    several = len(group.places) > 1

    def entry(name, g):
        letter, _, index = name.partition("_")
        k = int(letter[1:]) - 1 if several else 0
        offset, factor = group.places[k]
        i, *rest = map(int, index)
        column = rest[0] - 1 if letter[0] == "A" else factor.n
        return g[offset + i - 1, offset + column]

    def state(g, z, Z):
        rate, found = g @ Z, []
        w = iter(z[len(z) - sum(x[0] == "w" for x in f.STATE) :])
        for name in f.STATE:
            if name.startswith("zeta"):
                found.append(z[int(name.removeprefix("zeta_")) - 1])
            elif name[0] == "w":
                found.append(next(w))
            elif name.endswith("_dot"):
                found.append(entry(name.removesuffix("_dot"), rate))
            else:
                found.append(entry(name, g))
        return np.array(found)

    return state


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", PROBLEMS)
def test_it_is_the_whole_state_without_what_never_varies(name, form):
    need("cc")
    d, options = (
        derive.derive(problem(name)),
        {"conserved": True, "jacobian": ("raw",), "flags": QUICK, **FORMS[form]},
    )
    whole, moving = (derive.compile(d, state=x, **options) for x in ("whole", "moving"))
    group = d.problem.group
    at = [whole.STATE.index(x) for x in moving.STATE]
    assert at == sorted(at)
    drawn = states(placed(whole, group), group)
    still = [k for k in range(len(whole.STATE)) if k not in at]
    assert np.ptp(np.array(drawn)[:, still], axis=0).max(initial=0) < 1e-12
    assert np.ptp(np.array(drawn)[:, at], axis=0).min() > 1e-6
    if form == "plain" and name in LEFT:
        assert len(at) == LEFT[name]
    for x in drawn:
        dx = whole.rhs(0.5, x)
        assert np.allclose(moving.rhs(0.5, x[at]), dx[at], rtol=1e-13, atol=1e-13)
        assert np.abs(dx[still]).max(initial=0) < 1e-12
        assert np.isclose(moving.energy(0.5, x[at]), whole.energy(0.5, x), rtol=1e-13, atol=1e-13)
        found = moving.conserved(0.5, x[at]), whole.conserved(0.5, x)
        assert np.allclose(*found, rtol=1e-12, atol=1e-12)


def test_a_step_moves_it_as_the_whole(tmp_path):
    need("cc")
    d = derive.derive(problem("crane"))
    whole, moving = (
        derive.compile(d, state=x, step=("gauss", "vern9")) for x in ("whole", "moving")
    )
    at = [whole.STATE.index(x) for x in moving.STATE]
    (x, *_) = states(placed(whole, d.problem.group), d.problem.group)
    found = []
    for f, y in ((whole, x), (moving, x[at])):
        motion = f.begin(y)
        motion.move_to(2.0, 1e-12)
        found.append(motion.x)
    assert np.allclose(found[0][at], found[1], rtol=0, atol=1e-10)


def test_the_header_and_the_names_say_what_is_there(tmp_path, capsys):
    words = ["emit", "screw", "--state", "moving", "--out", str(tmp_path), "--validate"]
    assert main([*words, "--lang", "c", "--lang", "python"]) == 0
    assert capsys.readouterr().err.count("equal the record") == 2
    text = " ".join((tmp_path / "screw.h").read_text().replace("\n *", " ").split())
    assert "never vary: A_13, A_23, A_31, A_32, T_1, T_2 = 0; A_33 = 1." in text
    assert "x = (A_11, A_12, A_21, A_22, T_3, zeta_1)" in text
    assert 'STATE = ( "A_11", "A_12", "A_21", "A_22", "T_3", "zeta_1", )' in " ".join(
        (tmp_path / "screw.py").read_text().split()
    )
