"""The emitted JavaScript's gauss: beside the Python of runs, forward and back, its order, its
speed, and what it says where a motion ends."""

import json
import subprocess

import numpy as np
import pytest

import derive
from derive.code.emit import EmitError, emit
from derive.code.options import Options
from derive.motion.method import Method
from derive.motion.simulate import run
from derive.pipeline import motion_of, program
from tests.oracles import free_top
from tests.support.needs import need

NAMES = ("top", "so3", "se3", "sl3", "so4", "kirchhoff", "zeitlin", "euler_poisson", "two_tops")
NUMBERS = {
    "top": {"zeta_3": 100.0, "zeta_1": 1.0},
    "zeitlin": {"re_1_0": 1.0, "re_2_1": 0.5, "im_0_1": 0.25},
}


@pytest.fixture(scope="module", autouse=True)
def node():
    need("node")


def emitted(d, **chosen):
    p = program(d.problem, d.record, Options(step="gauss", **chosen))
    (source,) = emit(
        p, d.record, ("javascript",), d.problem.name, Options(step="gauss", **chosen)
    ).values()
    return source


def printed(tmp_path, source, script, **values):
    """What a script prints as JSON, ``m`` being the module."""
    (tmp_path / "module.mjs").write_text(source)
    given = "".join(f"const {name} = {json.dumps(x)};\n" for name, x in values.items())
    whole = f'import * as m from "./module.mjs";\n{given}{script}'
    (tmp_path / "main.mjs").write_text(whole)
    done = subprocess.run(["node", "main.mjs"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


THERE_AND_BACK = """
const k = m.constants(p), a = m.begin(0, x);
const there = m.gauss(a, k, null, h, n), state = [...a.x], time = a.t;
const back = m.gauss(a, k, null, -h, n);
console.log(JSON.stringify([there, time, state, back, a.t, [...a.x]]));
"""


@pytest.mark.parametrize("name", NAMES)
def test_it_is_the_motion_of_a_run_and_goes_back(name, tmp_path):
    d = derive.derive(name)
    code = motion_of(d.problem, d.record)
    turning = [x for x in code.program.state if x[0] in "zwg"]
    given = NUMBERS.get(name, {x: 0.3 + 0.1 * k for k, x in enumerate(turning)})
    h, n = (0.004 if name == "top" else 0.02), 50
    expected = run(code, d.problem, Method(dt=h), h * n, 1, given=given)
    p, x = [*expected.facts["parameters"].values()], expected.states[0]
    there, time, state, back, again, start = printed(
        tmp_path, emitted(d), THERE_AND_BACK, p=p, x=x.tolist(), h=h, n=n
    )
    assert (there, back) == (0, 0)
    assert (time, again) == pytest.approx((h * n, 0), abs=1e-15)
    size = max(1.0, np.abs(x).max())
    assert np.abs(np.array(state) - expected.states[-1]).max() < 1e-13 * size
    assert np.abs(expected.states[-1] - x).max() > 0.01
    assert np.abs(np.array(start) - x).max() < 1e-12 * size


TO = """
const k = m.constants(p);
const at = (h, n) => { const a = m.begin(0, x); m.gauss(a, k, null, h, n); return [...a.x]; };
const a = m.begin(0, x), states = [];
m.gauss_to(a, k, null, 11, 1e-14);
const t = [0.1, 0.5, 0.9].map((part) => a.t - part*a.h);
const inside = t.map((time) => [...m.dense(a, time)]);
const ends = [[...m.dense(a, a.t)], [...a.x]];
const held = m.begin(0, x);
const codes = [m.gauss_to(held, k, null, 12, 1e-9), m.gauss_to(held, k, null, 3, 1e-9)];
console.log(JSON.stringify({ t, inside, ends, coarse: at(3, 4), fine: at(2, 6), codes,
    last: [held.t, [...held.x]] }));
"""


def test_its_order_its_dense_output_and_a_tolerance(tmp_path):
    """Of a free top, by elliptic functions."""
    moments = (1.25, 2.0, 2.75)
    body = '[body]\ngiven = { m = 1, c = [0, 0, 0], J = [["7/4", 0, 0], [0, 1, 0], [0, 0, "1/4"]] }'
    (tmp_path / "free.toml").write_text(f'name = "free"\ngroup = "SO(3)"\n{body}\n')

    def exact(t):
        A, W = free_top.motion(t, moments, 1.0, 2.2)
        return np.concatenate([A.ravel(), W])

    d = derive.derive(tmp_path / "free.toml")
    found = printed(tmp_path, emitted(d), TO, p=[], x=exact(0.0).tolist())
    errors = [np.abs(np.array(found[x]) - exact(12.0)).max() for x in ("coarse", "fine")]
    assert errors[1] > 1e-13
    assert 14 < np.log(errors[0] / errors[1]) / np.log(3 / 2) < 19
    for t, state in zip(found["t"], found["inside"], strict=True):
        assert np.abs(np.array(state) - exact(t)).max() < 1e-8
    assert found["ends"][0] == found["ends"][1]
    assert found["codes"] == [0, 0]
    t, state = found["last"]
    assert t == 3
    assert np.abs(np.array(state) - exact(3.0)).max() < 1e-9


ENDS = """
const k = m.constants(p), a = m.begin(0, x), c = m.begin(0, x);
const codes = [m.gauss_to(a, k, null, 1, 1e-9)];
c.x[0] = NaN;
codes.push(m.gauss_to(c, k, null, 1, 1e-9), m.NOT_FINITE, m.NOT_CONVERGED);
console.log(JSON.stringify([codes, a.t, a.x.every(Number.isFinite)]));
"""


def test_a_collision_is_told_where_it_is(tmp_path):
    """The masses fall from rest to the centre that they stand about."""
    d = derive.derive("comet")
    p = [*d.simulate(1.0, points=1).facts["parameters"].values()]
    x = [1, 0, 0, 0, 1, 0, 0, 0, 1, *(0,) * 9]
    codes, a, finite = printed(tmp_path, emitted(d), ENDS, p=p, x=x)
    assert codes == [3, 2, 2, 3]
    assert finite
    assert a == pytest.approx(0.06471, abs=1e-4)


LONG = """
const k = m.constants(p), a = m.begin(0, x);
const code = m.gauss(a, k, null, 0.05, 20000);
console.log(JSON.stringify([code, m.defect(a.x), m.energy(0, a.x, k) - m.energy(0, x, k)]));
"""


@pytest.mark.parametrize("velocity", ["body", "tangent"])
def test_a_long_run_stays_on_the_group(velocity, tmp_path):
    """The state of tangent velocities drifts off det A = 1 by itself."""
    d = derive.derive("sl3")
    x = [1, 0, 0, 0, 1, 0, 0, 0, 1, *([1, 0, 0, 0, 0, 0, 0, 0] if velocity == "body" else [])]
    x += [] if velocity == "body" else [1, 0, 0, 0, 0, 0, 0, 0, -1]
    p = [*d.simulate(1e-3, points=1).facts["parameters"].values()]
    code, defect, change = printed(tmp_path, emitted(d, velocity=velocity), LONG, p=p, x=x)
    assert code == 0
    assert defect < 1e-14
    assert abs(change) < 1e-11


INPUTS = """
const k = m.constants(p), a = m.begin(0, x), b = m.begin(0, x);
b.inputs = () => u;
m.gauss(a, k, u, 0.1, 10);
m.gauss(b, k, null, 0.1, 10);
console.log(JSON.stringify([[...a.x], [...b.x]]));
"""


def test_inputs_are_held_or_a_function(tmp_path):
    d = derive.derive("se3")
    run = d.simulate(1.0, dt=0.1, start={"u_1": 2.0}, points=1)
    p, u = ([*run.facts[x].values()] for x in ("parameters", "inputs"))
    x = run.states[0].tolist()
    held, asked = printed(tmp_path, emitted(d), INPUTS, p=p, x=x, u=u)
    assert held == asked
    assert np.abs(np.array(held) - run.states[-1]).max() < 1e-13 * np.abs(held).max()


SPEED = """
const k = m.constants(p), seconds = 20;
const runs = [0, 1, 2, 3].map(() => {
    const a = m.begin(0, x), before = performance.now();
    m.gauss_to(a, k, null, seconds, 1e-9);
    return 1000*seconds/(performance.now() - before);
});
console.log(JSON.stringify(Math.max(...runs)));
"""


def test_a_fast_top_is_fifty_times_as_fast_as_it_is(tmp_path):
    """300 rad/s; here it is 150 to 300 times."""
    d = derive.derive("top")
    run = d.simulate(1e-3, start={"zeta_3": 300.0}, exp=(0.3, 0, 0), points=1)
    p, x = [*run.facts["parameters"].values()], run.states[0].tolist()
    assert printed(tmp_path, emitted(d), SPEED, p=p, x=x) > 50


def test_it_is_of_doubles():
    with pytest.raises(EmitError, match="leave out --real float"):
        emitted(derive.derive("so3"), real="float")
