"""to_matrix and from_matrix: a state with a quaternion, and the same with its matrix."""

import json
import subprocess
from itertools import product

import numpy as np
import pytest

import derive
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.oracles.sampling import quaternion
from tests.support.emitted import import_python
from tests.support.needs import need

AXES = [v for v in product((-1.0, 0.0, 1.0), repeat=3) if any(v)]
ANGLES = (0.0, 1e-9, 0.1, 1.0, 2.0, 3.0, np.pi - 1e-7, np.pi)


def rotation(axis, angle):
    """Rodrigues' formula."""
    e = np.array(axis) / np.linalg.norm(axis)
    K = np.cross(np.eye(3), e).T
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def turns():
    """Rotations about axes in all directions, also by half a turn, exact and nearly so, and some
    at random."""
    for axis in AXES:
        for angle in ANGLES:
            yield rotation(axis, angle)
    for signs in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1)):
        yield np.diag(signs).astype(float)
    yield np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
    rng = np.random.default_rng(2)
    for _ in range(200):
        yield rotation(rng.normal(size=3), rng.uniform(0, np.pi))


@pytest.fixture(scope="module")
def states():
    """The states of SE(3) at all these turns, with matrices, (n, 18)."""
    rng = np.random.default_rng(1)
    return np.array([[*A.ravel(), *rng.normal(size=9)] for A in turns()])


@pytest.fixture(scope="module")
def compiled():
    return derive.compile("se3", attitude="quaternion")


def test_there_and_back_at_every_turn(states, compiled):
    found = np.array([compiled.from_matrix(z) for z in states])
    assert (found[:, 0] >= 0).all()
    assert np.abs(np.linalg.norm(found[:, :4], axis=1) - 1).max() < 4e-16
    back = np.array([compiled.to_matrix(x) for x in found])
    assert np.abs(back - states)[:, :9].max() < 2e-15
    assert np.array_equal(back[:, 9:], states[:, 9:])


def test_it_is_the_quaternion_of_the_rotation(states, compiled):
    """Beside that of an oracle; of half a turn, where both signs are, up to it."""
    for z in states:
        found, expected = compiled.from_matrix(z)[:4], quaternion(z[:9].reshape(3, 3))
        assert min(np.abs(found - s * expected).max() for s in (1, -1)) < 1e-7


def test_a_matrix_that_is_off_gives_a_unit_quaternion_near_it(states, compiled):
    rng = np.random.default_rng(5)
    for z in states[::7]:
        off = z + 1e-6 * rng.normal(size=z.shape)
        x = compiled.from_matrix(off)
        assert abs(np.linalg.norm(x[:4]) - 1) < 4e-16
        assert np.abs(compiled.to_matrix(x) - off)[:9].max() < 2e-5


def test_python_does_as_c_also_with_many(states, compiled, tmp_path):
    derive.derive("se3").emit(tmp_path, ("python",), attitude="quaternion")
    m = import_python("se3", tmp_path)
    plain = derive.compile("se3")
    assert plain.STATE == m.MATRIX_STATE
    many = m.from_matrix(states)
    assert many.shape == (len(states), 13)
    in_c = np.array([compiled.from_matrix(z) for z in states])
    # at half a turn a rounding more or less is another sign
    same = np.abs(np.abs(many) - np.abs(in_c))
    assert same.max() < 1e-15
    clear = in_c[:, 0] > 1e-12
    assert np.abs(many - in_c)[clear].max() < 1e-15
    assert np.abs(m.to_matrix(many) - states).max() < 2e-15
    assert np.array_equal(m.from_matrix(states[40]), many[40])
    with pytest.raises(ValueError, match="z has 13 numbers, not 18"):
        m.from_matrix(many)


def test_javascript_does_as_c(states, compiled, tmp_path):
    need("node")
    derive.derive("se3").emit(tmp_path, ("javascript",), attitude="quaternion")
    script = 'import * as m from "./se3.mjs";\nconst states = ' + json.dumps(states.tolist())
    script += """;
    const there = states.map((z) => [...m.from_matrix(z)]);
    console.log(JSON.stringify([m.MATRIX_STATE, there, there.map((x) => [...m.to_matrix(x)])]));
    """
    (tmp_path / "main.mjs").write_text(script)
    done = subprocess.run(["node", "main.mjs"], cwd=tmp_path, capture_output=True, text=True)
    names, there, back = json.loads(done.stdout)
    assert tuple(names) == derive.compile("se3").STATE
    assert np.abs(np.array(back) - states).max() < 2e-15
    in_c = np.array([compiled.from_matrix(z) for z in states])
    assert np.abs(np.abs(there) - np.abs(in_c)).max() < 1e-15


@pytest.mark.parametrize("name", ["so3", "se3"])
def test_the_motion_by_a_quaternion_is_that_by_matrices(name):
    """From one state with a matrix, to the same one."""
    plain = derive.compile(name, step="gauss")
    turned = derive.compile(name, step="gauss", attitude="quaternion")
    rng = np.random.default_rng(3)
    for A in (np.eye(3), np.diag([1.0, -1, -1]), rotation([1, 2, -1], 2.5)):
        z = np.array([*A.ravel(), *rng.normal(size=len(plain.STATE) - 9)])
        rates = plain.rhs(0.0, z)
        x = turned.from_matrix(z)
        assert np.abs(turned.rhs(0.0, x)[4:] - rates[9:]).max() < 1e-13 * np.abs(rates).max()
        there = plain.begin(z).move_to(2.0, tol=1e-14).x
        found = turned.to_matrix(turned.begin(x).move_to(2.0, tol=1e-14).x)
        assert np.abs(there - z).max() > 0.1
        assert np.abs(found - there).max() < 1e-12 * max(1.0, np.abs(there).max())


def test_without_a_quaternion_there_are_none():
    f = derive.compile("so3")
    with pytest.raises(ValueError, match="attitude='quaternion'"):
        f.to_matrix(np.zeros(12))


MIXED = [
    [[0, 0, 0, 1], [0] * 4, [0] * 4, [0] * 4],
    [[0] * 4, [0, 0, -2, 0], [0, 2, 0, 0], [0] * 4],
    [[0, 0, 1, 0], [0] * 4, [-1, 0, 0, 0], [0] * 4],
    [[0] * 4, [0, 0, 0, 1], [0] * 4, [0] * 4],
    [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1], [0] * 4],
    [[0] * 4, [0] * 4, [0, 0, 0, 1], [0] * 4],
]
"""A basis of se(3) of one's own, a screw in it."""
OPERATOR = np.diag([2.0, 3, 2.5, 1, 2, 3]) + 0.4 * np.eye(6, k=4)
L = "zeta_1^2 + 2*zeta_2^2 + 3/2*zeta_3^2 + zeta_4^2 + zeta_5^2/2 + 3*zeta_6^2 + zeta_1*zeta_5/3"
STATED = {
    "expression": ("SE(3)", derive.Lagrangian(f"{L} - 2*T_3 - A_33*T_1")),
    "operator": ("SE(3)", derive.Inertia((OPERATOR + OPERATOR.T) / 2)),
    "basis": (derive.Group("Own", MIXED, "affine"), derive.Lagrangian(f"{L} - T_3 - A_33*T_1")),
}


@pytest.mark.parametrize("name", STATED)
def test_a_lagrangian_of_ones_own(name, tmp_path):
    """In a quaternion it has the motion that it has in matrices, and equals the record."""
    group, lagrangian = STATED[name]
    problem = derive.Problem("own", group, lagrangian, [derive.Covector("u")])
    record = derive.derive(problem)
    plain = derive.compile(record, step="gauss")
    turned = derive.compile(record, step="gauss", attitude="quaternion")
    rng = np.random.default_rng(5)
    x = np.concatenate([quaternion(rotation([1, 2, 3], 1.0)), rng.normal(size=9)])
    ends = []
    for f, at in ((plain, turned.to_matrix(x)), (turned, x)):
        f.u = 0.1 * np.arange(6)
        ends.append(f.begin(at).move_to(2.0, 1e-12).x)
    assert len(turned.STATE) == 13
    assert np.abs(turned.to_matrix(ends[1]) - ends[0]).max() < 1e-11
    assert np.abs(turned.to_matrix(ends[1]) - turned.to_matrix(x)).max() > 0.1


@pytest.mark.parametrize("name", STATED)
def test_a_lagrangian_of_ones_own_equals_the_record(name):
    group, lagrangian = STATED[name]
    d = derive.derive(derive.Problem("own", group, lagrangian, [derive.Covector("u")]))
    options = {"attitude": "quaternion", "momenta": True, "jacobian": ("state", "inputs")}
    files = d.emit(languages=("python",), **options)
    reports = [*EmittedFiles(files, "own", Chart("row", "quaternion", "body")).reports(d.record)]
    assert all(report.holds for report in reports)
    assert "to_matrix, from_matrix, momentum, velocity, momentum_rhs" in reports[0].text
