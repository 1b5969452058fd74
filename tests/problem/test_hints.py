"""What a file or a command that is almost right means is said; of the doubtful it is warned;
moments in axes of their own."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import derive
from derive import SE, SL, Inertia, Lagrangian, Moments, Points, Problem
from derive.command.cli import COMMANDS, main
from derive.language.values import approximate
from derive.motion.emitted_code import Column
from derive.motion.run import Run, written
from derive.problem.problem import ProblemError, data
from derive.problem.toml import doubts, load, problem_of
from derive.python.api import Table

HEAD = 'name = "good"\ngroup = "SO(3)"\n'
POINTS = "".join(f"[[point]]\nmass = 1\nat = {[int(i == j) for j in range(3)]}\n" for i in range(3))
PLACES = [(1, [1, 0, 0]), (1, [0, 1, 0]), (1, [0, 0, 1])]


def test_check_goes_on_behind_what_it_cannot_read(tmp_path, capsys):
    bad = tmp_path / "bad.toml"
    bad.write_text('name = "bad"\n')
    assert main(["check", str(bad), "missing.json", "linear"]) == 2
    out, err = capsys.readouterr()
    assert "linear: " in out
    lines = [x for x in err.splitlines() if x.startswith("derive: ")]
    assert [f"{bad}: " in lines[0], "missing.json: No such file" in lines[1]] == [True, True]


STOPPED = """
import gc, sys
from time import process_time
import derive.command.showing
from derive.command.cli import main

def unhurried(problems):  # a list may be done before the clock of the machine ticks
    until = process_time() + 0.1
    while process_time() < until:
        pass
    return ""

derive.command.showing.listing = unhurried
gc.disable()  # what is raised while it collects is dropped, and raised again later
sys.exit(main([*sys.argv[1:], "--seconds", "0.0001"]))
"""
"""In a process of its own: where an import is stopped, a library stays half done."""


@pytest.mark.parametrize("command", [x for x in COMMANDS if x != "lecture"])
def test_every_command_may_be_stopped(command, tmp_path):
    """But a lecture, whose --seconds ends each search on a problem, which it then says."""
    needed = {
        "notes": ["so3", "--out", str(tmp_path / "n.html")],
        "build": ["--out", str(tmp_path)],
        "simulate": ["so3", "--t", "1", "--set", "zeta_1=1"],
        "compare": ["so3", "--with", "users.py"],
        "plot": [str(tmp_path / "run.csv"), "--out", str(tmp_path / "run.svg")],
    }
    columns = Column("t", "time"), Column("A_11", "state")
    run = written(Run(columns, np.zeros((2, 2))), "run.csv")
    (tmp_path / "run.csv").write_bytes(run)
    needed |= {x: ["so3"] for x in ("walk", "emit", "check", "symmetries")}
    needed |= {"trim": ["so3", "--at", "zeta_1=1"]}
    needed |= {x: ["gyrostat"] for x in ("integrals", "equilibria", "reduction")}
    words = [sys.executable, "-c", STOPPED, command, *needed.get(command, [])]
    untraced = {x: y for x, y in os.environ.items() if x != "COVERAGE_PROCESS_CONFIG"}
    done = subprocess.run(words, env=untraced, capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stdout) == (2, "")
    assert "stopped after 0.0001 s of processor time" in done.stderr


MASS = 2.5
S = np.array([0.3, -0.2, 0.7])
I_C = np.array([[1.1, 0.1, -0.2], [0.1, 1.3, 0.05], [-0.2, 0.05, 1.7]])
VALUES = {"m": MASS} | {f"s{i}": x for i, x in enumerate(S)}
VALUES |= {f"i{i}{j}": I_C[i, j] for i in range(3) for j in range(i, 3)}
ROWS = [[f"i{min(i, j)}{max(i, j)}" for j in range(3)] for i in range(3)]


@pytest.mark.parametrize("symbolic", [False, True])
@pytest.mark.parametrize("first", ["c", "centre"])
@pytest.mark.parametrize("second", ["I_centre", "I", "J"])
def test_moments_as_they_are_given(symbolic, first, second):
    """J about the origin, by Steiner's theorem in floating-point numbers."""
    J = np.trace(I_C) / 2 * np.eye(3) - I_C + MASS * np.outer(S, S)
    about = {"I": np.trace(J) * np.eye(3) - J, "J": J, "I_centre": I_C}[second]
    values = VALUES | {name: about[int(name[1]), int(name[2])] for name in VALUES if name[0] == "i"}

    def written(name):
        return name if symbolic else repr(float(values[name]))

    tensor = [[written(x) for x in row] for row in ROWS]
    place = [f"s{i}" if first == "centre" else f"m*s{i}" for i in range(3)]
    if not symbolic:
        place = [repr(float(x)) for x in (S if first == "centre" else MASS * S)]
    given = {"m": written("m"), first: place, second: tensor}
    problem = Problem("b", SE(3), Moments(**given), parameters=values if symbolic else {})
    body = problem.body
    found = np.array([[approximate(x, values) for x in row] for row in body.given.J])
    assert np.allclose(found, J, rtol=1e-14, atol=1e-15)
    assert np.allclose([approximate(x, values) for x in body.given.c], MASS * S, rtol=1e-15)


FAR = [10.0, 0.0, 0.0]
"""A centre of mass far outside the radius of gyration, as a part has in its assembly."""


def test_numbers_of_a_drawing_program(tmp_path, capsys):
    """Given as c and I they are of no masses: refused in numbers, warned of as defaults."""
    with pytest.raises(ProblemError, match="then write centre and I_centre"):
        Problem("b", SE(3), Moments(m=2, c=FAR, I=I_C))
    assert Problem("b", SE(3), Moments(m=2, centre=FAR, I_centre=I_C)).body.given.c[0] == 20
    path = tmp_path / "part.toml"
    rows = I_C.tolist()
    for key, tensor, warned in (("c", "I", True), ("centre", "I_centre", False)):
        path.write_text(
            f'name = "part"\ngroup = "SE(3)"\n[parameters]\nm = 2\nfar = {FAR[0]}\n[body]\n'
            f'given = {{ m = "m", {key} = ["far", 0, 0], {tensor} = {rows} }}\n'
        )
        assert main(["walk", str(path)]) == 0
        told = capsys.readouterr().err
        assert bool(re.search("warning: .*part.toml: body: no masses", told)) == warned
        assert ("then write centre and I_centre" in told) == warned


def plate(seed, digits):
    """m, the centre and I about it, of points in a plane, with so many digits."""
    rng = np.random.default_rng(seed)
    points = (
        rng.normal(size=(6, 3))
        @ np.diag([1.0, 0.6, 0.0])
        @ np.linalg.qr(rng.normal(size=(3, 3)))[0]
    )
    points += rng.normal(size=3)
    masses = rng.uniform(0.1, 1, size=6)
    m = masses.sum()
    r = points - (centre := masses @ points / m)
    J = np.einsum("i,ij,ik->jk", masses, r, r)
    tensor = np.trace(J) * np.eye(3) - J
    return m, *([[float(f"{y:.{digits}g}") for y in np.ravel(x)]] for x in (centre, tensor))


@pytest.mark.parametrize("digits", [4, 16])
@pytest.mark.parametrize("symbolic", [False, True])
def test_flat_bodies_in_few_digits_are_bodies(digits, symbolic):
    """None of them is told to be of no masses, whether its numbers are written or are defaults."""
    for seed in range(12):
        m, (centre,), (tensor,) = plate(seed, digits)
        values = {f"i{j}{k}": tensor[3 * j + k] for j in range(3) for k in range(j, 3)}
        rows = [[f"i{min(j, k)}{max(j, k)}" for k in range(3)] for j in range(3)]
        if not symbolic:
            rows, values = [[values[x] for x in row] for row in rows], {}
        body = Moments(m=m, centre=centre, I_centre=rows)
        assert not [*doubts(Problem("plate", SE(3), body, parameters=values), {})]


@pytest.mark.parametrize("n", [2, 4])
def test_moments_are_turned_in_every_dimension(n):
    """By an exchange of the first two axes, one of them with the other sign."""
    R, J = np.eye(n, dtype=int), np.diag([*range(1, n + 1)])
    R[:2, :2] = [[0, -1], [1, 0]]
    body = Moments(m=1, c=[0] * n, J=J.tolist(), rotation=R.tolist())
    found = Problem("body", f"SO({n})", body).body.given.J
    assert np.array(found, float).tolist() == (R @ J @ R.T).tolist()


def test_the_moment_of_inertia_in_the_plane_is_a_number():
    """2 about the centre, 2 + 3 · 4 about the origin, and of a motion no more is needed."""
    found = Problem("disc", SE(2), Moments(m=3, centre=[2, 0], I_centre=2)).body.given
    assert found.J[0][0] + found.J[1][1] == 14
    with pytest.raises(ProblemError, match="give J, the matrix of moments"):
        Problem("disc", SL(2), Moments(m=3, c=[0, 0], I=2))


@pytest.mark.parametrize("yaw", [[0, 0, 1], 1])
def test_a_start_by_angles(yaw, tmp_path, capsys):
    path = tmp_path / "good.toml"
    path.write_text(f"{HEAD}{POINTS}[initial]\nyaw = {yaw}\n")
    assert main(["walk", str(path)]) == (2 if isinstance(yaw, list) else 0)
    assert "a motion starts turned by 'rpy', 'quaternion' or 'exp' in" in capsys.readouterr().err


IMPOSSIBLE = "no masses have these moments: J − c c̄/m must be positive"


@pytest.mark.parametrize(
    ("group", "moments", "told"),
    [
        ("SE(3)", {"c": [0, 0, 0], "I": np.diag([0.33, 0.21, 1.0])}, "1 is above 0.54"),
        # far from the origin, and said as it must be: nothing else to write
        ("SE(3)", {"centre": FAR, "I_centre": np.diag([0.33, 0.21, 1.0])}, "1 is above 0.54"),
        ("SE(3)", {"centre": FAR, "I_centre": np.diag([0.5, 0.5, 1.003])}, "1.003 is above 1"),
        ("SO(3)", {"c": [0, 0, 0], "I": np.diag([-1e-4, 1, 1])}, "1 is above 0.9999"),
        # stretched along an axis, a body has kinetic energy by that moment alone
        ("SL(3)", {"c": [0, 0, 0], "J": np.diag([1, 1, -1e-4])}, "2 is above 1.9998"),
        ("SE(2)", {"c": [0, 0], "J": np.diag([1, -0.25])}, "eigenvalue -0.25"),
    ],
)
def test_impossible_moments_with_their_numbers(group, moments, told, tmp_path, capsys):
    with pytest.raises(ProblemError, match=IMPOSSIBLE) as caught:
        Problem("b", group, Moments(m=2, **moments))
    assert told in str(caught.value)
    assert "I_centre" not in str(caught.value)
    (first, c), (second, tensor) = moments.items()
    least = tensor[-1][-1] if tensor[0][0] > 0 else tensor[0][0]
    rows = [[("x" if x == least else float(x)) for x in row] for row in np.asarray(tensor)]
    with pytest.warns(UserWarning, match=IMPOSSIBLE) as warned:
        problem = Problem(
            "b", group, Moments(m=2, **{first: c, second: rows}), parameters={"x": least}
        )
    (doubt,) = doubts(problem, {})
    assert [str(x.message) for x in warned] == [f"b: {doubt}"]
    assert warned[0].filename == __file__
    assert IMPOSSIBLE in doubt
    assert told in doubt
    assert not [*doubts(problem, {"x": 0.5})]


def test_every_command_tells_impossible_moments(tmp_path, capsys):
    path = tmp_path / "part.toml"
    path.write_text(
        'name = "part"\ngroup = "SO(3)"\n[parameters]\nC = 0.4\n[body]\n'
        'given = { m = 2, c = [0, 0, 0], I = [[0.33, 0, 0], [0, 0.21, 0], [0, 0, "C"]] }\n'
    )
    simulate = ["simulate", str(path), "--t", "0.1", "--dt", "0.1", "--step", "rk4"]
    assert main(simulate) == 0
    assert IMPOSSIBLE not in capsys.readouterr().err
    assert main([*simulate, "--set", "C=1"]) == 0
    assert IMPOSSIBLE in capsys.readouterr().err
    path.write_text(path.read_text().replace("0.4", "1"))
    for command in (
        ["check"],
        ["integrals"],
        ["equilibria"],
        ["walk", "--discrete"],
        ["reduction"],
    ):
        assert main([command[0], str(path), *command[1:]]) == 0
        assert IMPOSSIBLE in capsys.readouterr().err


def test_a_centre_that_is_too_long(tmp_path):
    """Named by its key: to carry it to the origin would multiply all its terms."""
    names = [f"{x}{i}" for x in "ab" for i in range(9)]
    text = f"name = 'far'\ngroup = 'SE(3)'\n[body]\ngiven = {{ m = '{'+'.join(names[:9])}', "
    text += f"centre = ['{'+'.join(names[9:])}', 0, 0], I_centre = [[2,0,0],[0,2.5,0],[0,0,3]] }}\n"
    text += "[parameters]\n" + "".join(f"{x} = 1.0\n" for x in names)
    path = tmp_path / "long.toml"
    path.write_text(text)
    with pytest.raises(ProblemError, match="body, given: centre or I_centre is too long"):
        load(path)


def test_one_point_or_a_list_of_them():
    """The same wherever points are named."""
    force = {"kind": "force", "name": "f"}
    for key, fields in (("damping", {"coefficient": 1}), ("input", force)):
        given = [Table(key, **fields, on=x) for x in (2, [2])]
        one, listed = (Problem("b", "SE(3)", Points(*PLACES), [x]) for x in given)
        assert data(one) == data(listed)


@pytest.mark.parametrize(
    ("L", "told"),
    [
        ("(1 - t/9)*zeta_1^2 + zeta_2^2 + zeta_3^2", True),
        ("cos(t)^2*zeta_1*zeta_2 + zeta_1^2 + zeta_2^2 + zeta_3^2", True),
        ("zeta_1^2 + zeta_2^2 + zeta_3^2 + t*zeta_1 - t^2*A_33", False),
        ("(1 + t - t)*zeta_1^2 + zeta_2^2 + zeta_3^2", False),
    ],
)
def test_a_mass_that_depends_on_the_time(L, told):
    """It is said that this is no rocket; not of potentials and gyroscopic terms in time."""
    found = [*doubts(Problem("b", "SO(3)", Lagrangian(L)), {})]
    assert bool(found) == told
    assert all("a rocket has m dv/dt = F + dm/dt c" in x for x in found)


@pytest.mark.parametrize(
    ("diagonal", "told"),
    [((1, 2, "3 - a"), True), ((1, 2, 3), False), ((1, 2, "b"), False), ((0, 1, 1), False)],
)
def test_a_kinetic_energy_that_is_negative_somewhere(diagonal, told):
    """By the defaults: a mass that was added with the wrong sign, say; nothing of what has none."""
    rows = [[x if i == k else 0 for i in range(3)] for k, x in enumerate(diagonal)]
    known = {"a": 5.0, "b": {}}
    parameters = {name: x for name, x in known.items() if any(name in str(d) for d in diagonal)}
    found = [*doubts(Problem("b", "SO(3)", Inertia(rows), parameters=parameters), {})]
    words = "the kinetic energy is negative in some direction: its matrix has the eigenvalue -2"
    assert found == [words] * told


@pytest.mark.parametrize(("diagonal", "told"), [(("a", 2, 3), True), ((0, "b", "b"), False)])
def test_a_kinetic_energy_that_is_0_for_some_numbers_alone(diagonal, told):
    """A parameter that is 0 by default, not a direction in which nothing ever moves."""
    rows = [[x if i == k else 0 for i in range(3)] for k, x in enumerate(diagonal)]
    known = {x: y for x, y in {"a": 0.0, "b": 1.0}.items() if x in diagonal}
    found = [*doubts(Problem("b", "SO(3)", Inertia(rows), parameters=known), {})]
    words = "the kinetic energy is 0 in some direction for the values of the parameters"
    assert found == [words] * told


TENSOR = [[0.5, 0.02, 0], [0.02, 0.6, 0], [0, 0, 0.8]]
TURNS = {
    "rpy": ({"rpy": [0.3, -0.2, 0.7]}, Rotation.from_euler("xyz", [0.3, -0.2, 0.7])),
    "yaw alone": ({"rpy": [0, 0, 0.5]}, Rotation.from_euler("z", 0.5)),
    "a quaternion": ({"quaternion": [1, 2, 3, 4]}, Rotation.from_quat([2, 3, 4, 1])),
    "an axis": (
        {"rotation": {"axis": [0, 0, 1], "angle": 0.5}},
        Rotation.from_rotvec([0, 0, 0.5]),
    ),
}


@pytest.mark.parametrize("name", TURNS)
def test_a_tensor_in_axes_that_are_turned(name):
    said, R = TURNS[name]
    given = {"m": 2, "centre": [0, 0, 0], "I_centre": TENSOR, **said}
    problem = problem_of({"name": "b", "group": "SE(3)", "body": {"given": given}})
    f = derive.compile(derive.derive(problem))
    zeta = np.array([1.0, 2.0, 3.0])
    x = np.concatenate([np.eye(3).ravel(), np.zeros(3), zeta, np.zeros(3)])
    inertia = R.as_matrix() @ TENSOR @ R.as_matrix().T
    wanted = np.linalg.solve(inertia, np.cross(inertia @ zeta, zeta))
    assert np.allclose(f.rhs(0.0, x)[12:15], wanted, rtol=0, atol=1e-14)


@pytest.mark.parametrize("said", [{"rpy": [0, 0, 1]}, {"rotation": {"axis": [0, 0, 1]}}])
def test_in_the_plane_a_rotation_is_rows(said):
    given = {"m": 1, "centre": [0, 0], "J": [[1, 0], [0, 2]], **said}
    told = r"'(rpy|axis)' is of R\^3; give rotation = \[\[c, -s\], \[s, c\]\] with numbers"
    with pytest.raises(ProblemError, match=told):
        problem_of({"name": "b", "group": "SE(2)", "body": {"given": given}})


def test_velocities_of_translation_have_two_names_beside_a_lagrangian():
    """w_1 is zeta_4 of SE(3), zeta_2 of SE(2), unless an input is called so."""

    def told(group, x, **more):
        L = " + ".join(f"{k}*zeta_{k}^2" for k in range(1, 7 if group == "SE(3)" else 4))
        output = [{"name": "fast", "y": [f"{x} + t"]}]
        head = {"name": "told", "group": group, "lagrangian": {"L": L}, "output": output}
        return problem_of(head | more)

    for group, w, zeta in ("SE(3)", "w_2", "zeta_5"), ("SE(2)", "w_2", "zeta_3"):
        assert told(group, w).outputs == told(group, zeta).outputs
    started = told("SE(3)", "w_1", initial={"w_3": 2})
    assert [*started.initial.numbers] == ["zeta_6"]
    with pytest.raises(ProblemError, match="the same number as zeta_6"):
        told("SE(3)", "w_1", initial={"w_3": 2, "zeta_6": 1})
    wind = {"input": [{"name": "w_2", "kind": "scalar"}]}
    push = {"force": [{"name": "push", "covector": ["w_2", 0, 0, 0, 0, 0]}]}
    assert told("SE(3)", "w_2", **wind, **push).outputs != told("SE(3)", "zeta_5").outputs
