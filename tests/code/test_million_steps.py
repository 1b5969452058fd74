"""A million steps of the emitted JavaScript's gauss: what they leave of the group, of the energy
and of the momenta."""

import json
import subprocess

import numpy as np
import pytest

import derive
from derive.problem.toml import problem_of
from tests.support.emitted import import_python
from tests.support.needs import need

HANGING = {
    "name": "hanging",
    "group": "SE(3)",
    "point": [
        {"mass": 1, "at": [1, 0.2, 0]},
        {"mass": 2, "at": [-0.5, 0.3, 0.4]},
        {"mass": 1, "at": [0.1, -1, 0.5]},
        {"mass": 1.5, "at": [0, 0.4, -0.8]},
    ],
    "potential": [
        {
            "kind": "spring",
            "at": [0.2, 0.3, 0.1],
            "anchor": [0, 0, 0],
            "stiffness": 40,
            "length": 0,
        },
        {"kind": "gravity", "g": [0, 0, -9.81]},
    ],
}
"""A body that swings and turns on a spring."""

ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
SWING = [0.3, -0.2, 0.1, 0.4, 0.2, -0.3, 0.1, 0.2]
CASES = {
    "so3": ("so3", [*ONE, 0.1, 0, 9], {}),
    "se3": (HANGING, [*ONE, 0, 0, -1, 0.3, 0.2, 8, 0.2, 0.1, 0], {}),
    "sl3": ("sl3", [*ONE, *SWING], {}),
    "sl3, tangent": ("sl3", [*ONE, *SWING], {"velocity": "tangent"}),
}
STEPS, TURNS = 1_000_000, {"sl3, tangent": 0.75}
"""How many; and the angle of each at the fastest rate of the first nine seconds, else 0.9: dA/dt
keeps nothing to rounding, and in steps of 0.9 the error of order 16 adds up to 9e-11 of the energy
and 4e-10 of the momenta."""

LONG = """
const k = m.constants(p), a = m.begin(0, x);
const times = (A, r) => [0, 3, 6].map((i) => A[i]*r[0] + A[i + 1]*r[1] + A[i + 2]*r[2]);
const cross = (a, b) => [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]];
const plus = (a, b) => a.map((v, i) => v + b[i]);
/* of points, the energy and the angular momentum about the vertical */
const told = (y) => {
    const at = (r) => plus(times(y, r), y.slice(9, 12));
    const speed = (r) => times(y, plus(y.slice(15), cross(y.slice(12, 15), r)));
    const turning = points.map(([mass, r]) => mass*cross(at(r), speed(r))[2]);
    return [m.energy(0, y, k), turning.reduce((sum, L) => sum + L)];
};
const kept = points.length ? (y) => told([...y]) : (y) => [...m.conserved(0, y, k)];
const names = points.length ? ["energy", "angular momentum"] : m.CONSERVED;
const first = kept(x), worst = first.map(() => 0);
const entries = [0, 1, 2];
const gram = (A, i, j) => A[i]*A[j] + A[3 + i]*A[3 + j] + A[6 + i]*A[6 + j] - (i === j ? 1 : 0);
const det = (A) => A[0]*(A[4]*A[8] - A[5]*A[7]) - A[1]*(A[3]*A[8] - A[5]*A[6])
    + A[2]*(A[3]*A[7] - A[4]*A[6]);
let off = 0, code = 0;
for (let i = 0; i < 100 && code === 0; ++i) {
    code = m.gauss(a, k, null, h, n/100);
    kept(a.x).forEach((v, j) => {
        worst[j] = Math.max(worst[j], Math.abs(v - first[j]));
    });
    const left = rigid
        ? entries.flatMap((i) => entries.map((j) => gram(a.x, i, j)))
        : [det(a.x) - 1];
    off = Math.max(off, ...left.map(Math.abs));
}
console.log(JSON.stringify([code, a.h, off, names, first, worst, [...a.x]]));
"""


@pytest.fixture(autouse=True)
def node():
    need("node")


def fastest(code, x, k):
    """The largest rate of the linearised equations along the motion."""
    m, found = code.begin(0.0, x), 0.0
    for _ in range(30):
        J = code.jacobian_raw(m.t, m.x, k)
        found = max(found, np.abs(np.linalg.eigvals(J).imag).max())
        assert code.gauss(m, k, None, 0.3) == code.OK
    return found


def followed(case, n, tmp_path):
    """The largest entry off the group, the changes of energy and momenta over n steps, relative,
    and how far the state is from where it began."""
    problem, x, options = CASES[case]
    d = derive.derive(problem_of(problem) if isinstance(problem, dict) else problem)
    options = {**options, "step": "gauss", "jacobian": "raw"}
    # the search of integrals takes a minute on SE(3) with springs
    d.emit(tmp_path, ("javascript", "python"), conserved=case != "se3", **options)
    name = d.problem.name
    code = import_python(name, tmp_path)
    p = [code.DEFAULTS[parameter] for parameter in code.PARAMETERS]
    if "velocity" in options:  # dA/dt at A = 1
        x = [*ONE, *np.einsum("a,aij->ij", SWING, code.BASIS).ravel()]
    h = TURNS.get(case, 0.9) / fastest(code, x, code.constants(p))
    points = [[y["mass"], y["at"]] for y in HANGING["point"]] if case == "se3" else []
    given = {"p": p, "x": x, "h": h, "n": n, "rigid": case in ("so3", "se3"), "points": points}
    lines = [f'import * as m from "./{name}.mjs";']
    lines += [f"const {letter} = {json.dumps(value)};" for letter, value in given.items()]
    (tmp_path / "main.mjs").write_text("\n".join([*lines, LONG]))
    done = subprocess.run(
        ["node", "main.mjs"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    status, last, off, names, first, worst, end = json.loads(done.stdout)
    assert (status, last) == (0, h)  # no step was made in halves
    momenta = [i for i, x in enumerate(names) if x != "energy"]
    energy = names.index("energy")
    size = max(abs(first[i]) for i in momenta)
    changes = worst[energy] / abs(first[energy]), max(worst[i] for i in momenta) / size
    print(f"{case}: {n} steps of {h:.4f} s, off {off:.1e}, energy and momenta {changes}")
    return off, *changes, np.abs(np.array(end) - x).max()


@pytest.mark.parametrize("case", CASES)
def test_some_steps_keep_what_many_do(case, tmp_path):
    off, energy, momenta, moved = followed(case, 2000, tmp_path)
    assert off < 1e-15
    assert energy < 1e-11
    assert momenta < 1e-11
    assert moved > 0.1


@pytest.mark.dist
@pytest.mark.parametrize("case", CASES)
def test_a_million_steps(case, tmp_path):
    off, energy, momenta, moved = followed(case, STEPS, tmp_path)
    assert off < 1e-15
    assert energy < 3e-11
    assert momenta < 1e-10
    assert moved > 0.1
