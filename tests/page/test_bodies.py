"""What a page draws: the shapes of bodies and where they are, what is in front, what moves; the
vectors of the equations that are seen on a body: their numbers, by mechanics of points."""

import json

import numpy as np
import pytest

import derive
from derive.code.emit import emit
from derive.code.options import Options
from derive.command.showing import ready_made
from derive.language.values import approximate
from derive.problem.fields import state_names
from derive.problem.toml import problem_of
from derive.programs import motion_of, moving_program
from derive.views.arrows import arrows, drawn, legend, with_arrows
from derive.views.figure.drawn_body import ExpressionValues
from derive.views.language import language
from derive.views.page.moving_body import moving_body
from derive.walk.spine.head import problem_data
from tests.support import library
from tests.support.in_node import printed
from tests.support.motion_pages import body_of, scripts
from tests.support.walks import derived


def drawn_of(name):
    """What is drawn of a ready-made problem."""
    return body_of(derived(name))


def test_what_is_drawn():
    top = drawn_of("top")
    assert top["parts"][0]["solids"][0]["shape"] == "cone"
    assert top["parts"][0]["fixed"]
    assert top["polhode"] == [9, 10, 11]
    assert top["turns"]
    assert [row[3] for row in drawn_of("hammer")["parts"][0]["map"]] == [9, 10, 11]
    assert len(drawn_of("two_tops")["parts"]) == 2
    assert drawn_of("two_tops")["springs"] == [[0, 1, 1, 3]]
    assert drawn_of("sl3")["parts"][0]["deforms"]
    assert drawn_of("sl3")["polhode"] == []
    assert drawn_of("so4")["parts"] == drawn_of("zeitlin")["parts"] == []
    assert drawn_of("rod")["parts"][0]["turning"] == [12, 13, -1]
    assert drawn_of("kirchhoff")["parts"][0]["sliding"] == [15, 16, 17]
    assert "turning" not in drawn_of("so3")["parts"][0]


def test_every_ready_made_body_has_a_shape():
    for name in ready_made():
        d = derived(name)
        state = state_names(d.problem.group) if d.problem.group else ()
        for part in body_of(d, [x for x in state if x != "t"])["parts"]:
            assert any(part.get(x) for x in ("points", "solids", "moments", "turning")), name


SIDES = (0.5, 1.2, 0.9)
"""Half axes of a solid ellipsoid of mass 3, whose moments of inertia are 3 (b² + c²)/5, …"""
INERTIA = [3 * (sum(x * x for x in SIDES) - x * x) / 5 for x in SIDES]
TURNED = "(" + " + ".join(f"{v!r}*zeta_{i}^2" for i, v in enumerate(INERTIA, 1)) + ")/2"
OTHER = TURNED.replace("zeta_3", "zeta_6").replace("zeta_2", "zeta_5").replace("zeta_1", "zeta_4")
LAGRANGIANS = {
    "turned alone": ("SO(3)", f"{TURNED} + 0.7*zeta_1 - A_33", [0], [3**0.5]),
    "free": ("SE(3)", f"{TURNED} + 3*(zeta_4^2 + zeta_5^2 + zeta_6^2)/2 + T_2", [0], [1]),
    "two": ("SO(3) x SO(3)", f"{TURNED} + 4*{OTHER} + zeta_1*zeta_5/9", [0, 1], [3**0.5, 12**0.5]),
}
"""Group and L; its parts, and by how much the square root of a mass that is not known stretches."""
BUILT = """
    const module = (() => {{ {source} return {{ constants, energy, PARAMETERS }}; }})();
    {drawing}
    const velocity = {velocity}, x = {x}, page = {{ body: {body}, module }};
    const {{ energy }} = module, run = {{ k: module.constants([]) }};
    const {{ parts }} = built({{ page, p: [], velocity, energy, run }}, x, {{ of_inertia }});
    const most = (part, i) => max(...part.faces.flatMap((f) => f.v.map((r) => abs(r[i]))));
    console.log(JSON.stringify(parts.map((part) => [0, 1, 2].map((i) => most(part, i)))));
"""


@pytest.mark.parametrize("name", LAGRANGIANS)
def test_the_ellipsoid_of_an_inertia_that_the_energy_tells(name):
    group, L, parts, stretched = LAGRANGIANS[name]
    d = derive.derive(problem_of({"name": "typed", "group": group, "lagrangian": {"L": L}}))
    made = motion_of(d.problem, d.record).program
    (source,) = emit(made, d.record, ("javascript",), "typed", Options()).values()
    text = BUILT.format(
        source=source.replace("\nexport ", "\n"),
        drawing=scripts("vectors", "shapes", "body"),
        velocity=[k for k, x in enumerate(made.state) if x.startswith("zeta")],
        x=[float(x[-2] == x[-1]) if x[0] == "A" else 0.3 for x in made.state],
        body=json.dumps(moving_body(d.record.problem, d.problem.group, made.state)),
    )
    found = json.loads(printed(text))
    assert np.abs(np.array(found) - np.outer(stretched, SIDES)).max() < 1e-9
    assert len(found) == len(parts)


TRACED = """
    {drawing}
    const none = () => [], page = {{ body: {body}, module: {{ PARAMETERS: {names} }} }};
    const pieces = {{ of_inertia: none, of_moments: none }};
    const {{ parts }} = built({{ page, p: {values} }}, [], pieces);
    console.log(JSON.stringify(parts.map((part) => [part.traced, part.tips.at(-1)])));
"""


@pytest.mark.parametrize(
    ("name", "traced"), [("pendulum", [0, -0.8, 0]), ("so3", [1, 1, 0.2]), ("euler_top", None)]
)
def test_what_leaves_a_trail(name, traced):
    """The bob of a pendulum hangs on the other side of where the second axis is drawn to; about a
    fixed centre of mass, and where the last axis goes through it, its tip does (``None``)."""
    known = derived(name).problem.parameters
    text = TRACED.format(
        drawing=scripts("vectors", "shapes", "body"),
        body=json.dumps(drawn_of(name)),
        names=json.dumps([*known]),
        values=json.dumps([float(x.default or 1) for x in known.values()]),
    )
    ((places, tip),) = json.loads(printed(text))
    assert places == [traced or tip]


PAINTED = """
    {drawing}
    for (const {{ towards, right, up, solids }} of {views}) {{
        const eye = {{ look() {{}}, right, up, towards }}, painted = [];
        const pen = new Proxy({{}}, {{ get: () => () => {{}}, set: () => true }});
        const path = (list) => painted.push(list);
        const view = {{ width: 400, height: 400, pen, path, stroke() {{}} }};
        const pic = picture({{ colours: {{}} }}, view, eye, [0, 0, 0], 100);
        const part = {{ points: [], anchors: [], attractions: [], solids }};
        const page = {{ module: {{ PARAMETERS: [] }}, body: {{ parts: [part] }} }};
        const [{{ faces }}] = built({{ p: [], page }}, [], {{ {shape} }}).parts;
        for (const f of faces) pic.face(f.v, Array(33).fill("grey"), f.clear, f.inside);
        pic.done();
        console.log(JSON.stringify([painted, faces.map((f) => f.v.map(pic.to))]));
    }}
"""
FAR = 16
"""How far the eye is, where 100 pixels are 1 on a paper of 400."""


def nearness(face, places):
    """Of a flat face at places of the paper, by its corners there and their depths, 1/(FAR − z), as
    this is linear on the paper; −1 beside it."""
    x, y, z = np.array(face, float).T
    along, up = np.roll(x, -1) - x, np.roll(y, -1) - y
    if abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) < 1e-3:
        return np.full(len(places), -1.0)
    side = along * (places[:, 1:] - y) - up * (places[:, :1] - x)
    near = np.linalg.lstsq(np.stack([x, y, np.ones(len(x))], 1), 1 / (FAR - z), rcond=None)[0]
    inside = (side > -1e-9).all(axis=1) | (side < 1e-9).all(axis=1)
    return np.where(inside, places @ near[:2] + near[2], -1.0)


def looked_at(shape, random):
    """A shape from somewhere, and another one well behind it: one and its mirror image, twice."""
    for turn in range(4):
        right, up, towards = np.linalg.qr(random.normal(size=(3, 3)))[0].tolist()
        columns = random.normal(size=(3, 3)) + 2 * np.eye(3)
        columns[0] *= (-1) ** turn
        near = np.array([0.2, -0.1, 0.3])
        solids = [
            {"shape": shape, "columns": columns.tolist(), "shift": shift.tolist()}
            for shift in (near, near - 12 * np.array(towards))
        ]
        yield {"right": right, "up": up, "towards": towards, "solids": solids}


@pytest.mark.parametrize("shape", ["ball", "cylinder", "cone", "box", "tetrahedron"])
def test_what_is_in_front_is_drawn_over_what_is_behind(shape):
    """At many places of the paper the last face that is drawn there is the nearest that is."""
    random = np.random.default_rng(7)
    drawing = scripts("vectors", "shapes", "body", "canvas")
    views = json.dumps([*looked_at(shape, random)])
    for line in printed(PAINTED.format(drawing=drawing, views=views, shape=shape)).splitlines():
        painted, faces = json.loads(line)
        places = random.uniform(50, 350, size=(1000, 2))
        nearest = np.max([nearness(f, places) for f in faces], axis=0)
        last = np.full(len(places), -1.0)
        for face in painted:
            here = nearness(face, places)
            last = np.where(here > 0, here, last)
        assert (nearest > 0).sum() > 20
        assert np.abs(last - nearest).max() < 1e-9


SOLIDS = {
    "ball": ({"radius": 2}, 4 * np.pi / 3, [0, 0, 0]),
    "hollow_ball": ({"outer": 2, "inner": 0}, 4 * np.pi / 3, [0, 0, 0]),
    "ellipsoid": ({"semi_axes": [1, 2, 3]}, 4 * np.pi / 3, [0, 0, 0]),
    "box": ({"sides": [1, 2, 3]}, 8, [0, 0, 0]),
    "cylinder": ({"radius": 2, "height": 3}, 2 * np.pi, [0, 0, 0]),
    "cone": ({"radius": 2, "height": 3}, np.pi / 3, [0, 0, 1 / 4]),
    "tetrahedron": ({"vertices": [[1, 0, 0], [2, 0, 1], [1, 3, 0], [0, 0, 4]]}, 1 / 6, [1 / 4] * 3),
}
"""Sizes of each kind; volume and centre of the shape that is drawn as its image."""


@pytest.mark.parametrize("kind", SOLIDS)
def test_a_solid_is_drawn_with_its_volume_and_its_centre(kind):
    sizes, volume, centre = SOLIDS[kind]
    placed = {"shift": [1, 2, -1], "rotation": {"axis": [1, 2, 2], "angle": "pi/2"}}
    solid = {"kind": kind, "density": 3} | sizes | placed
    problem = problem_of({"name": "x", "group": "SO(3)", "solid": [solid]})
    data, state = problem_data(problem), [*state_names(problem.group)]
    (drawn,) = moving_body(data, problem.group, state)["parts"][0]["solids"]
    number = ExpressionValues(data)
    columns = np.array([number.vector(x) for x in drawn["columns"]])
    moments = problem.body.moments()
    m, *c = (approximate(x, {}) for x in (moments.m, *moments.c))
    assert 3 * volume * abs(np.linalg.det(columns)) == pytest.approx(m)
    assert centre @ columns + number.vector(drawn["shift"]) == pytest.approx(np.array(c) / m)


def test_a_mesh_is_drawn_as_it_is(tmp_path):
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (tmp_path / "wedge.obj").write_text("\n".join(lines))
    path = tmp_path / "wedge.toml"
    body = '[body]\nsolid = "mesh"\ndensity = 1\nfile = "wedge.obj"\n'
    path.write_text(f'name = "wedge"\ngroup = "SO(3)"\n{body}')
    (solid,) = body_of(derive.derive(path))["parts"][0]["solids"]
    drawn = [[solid["vertices"][i] for i in face] for face in solid["faces"]]
    expected = [[corners[i] for i in face] for face in faces]
    assert sorted(map(sorted, drawn)) == sorted(map(sorted, expected))


# ---------------------------------------------------------------- vectors

RNG = np.random.default_rng(7)


def seen(name, x, parameters=None):
    """What each arrow of a ready-made problem is there, by its meaning and what is shown of it: a
    row of three for each part, or three rows of a matrix; and the module."""
    d = derived(name)
    found = arrows(d.record)
    record = with_arrows(d.record, found)
    made, _ = moving_program(d.problem, record, sought=False)
    (source,) = emit(made, record, ("python",), name, Options()).values()
    module = library.module(name, source)
    p = [float(v if v is not None else 1) for _, v, *_ in made.parameters]
    k = module.constants(np.array(p))
    u = np.zeros(len(module.INPUTS))
    read = module.outputs(0.0, x, k, u)[len(made.outputs) - sum(len(a.entries) for a in found) :]
    cuts = np.cumsum([len(a.entries) for a in found])[:-1]
    rows = [y.reshape(-1, 3) for y in np.split(np.asarray(read), cuts)]
    numbers = dict(zip([x for x, *_ in made.parameters], p, strict=True))
    return list(zip([a.meaning for a in found], rows, strict=True)), numbers, module, (k, u)


def turned(axis, angle):
    """A rotation of space."""
    K = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    return np.eye(3) - np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def test_a_pendulum_has_an_arc_for_its_weight():
    angle, rate = 0.4, 1.5
    A = [np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)]
    found, p, *_ = seen("pendulum", np.array([*A, rate]))
    assert [m for m, _ in found] == [
        "angular velocity in the body",
        "angular acceleration by the forces",
    ]
    assert np.allclose(found[0][1], [[0, 0, rate]])
    assert np.allclose(found[1][1], [[0, 0, -p["g"] / p["l"] * np.sin(angle)]])


def test_a_bar_in_the_plane_has_forces_in_it_and_a_torque_out_of_it():
    angle, T = 0.3, np.array([0.1, -0.2])
    A = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    x = np.array([*A.ravel(), *T, 0.7, 0.5, -0.4])
    found, p, *_ = seen("hung_bar", x)
    told = {m: np.ravel(rows) for m, rows in found}
    ends = [np.array([-p["a"], 0]), np.array([p["a"], 0])]
    force, torque = np.zeros(2), 0.0
    for r in ends:
        v = A @ r + T - r  # from the anchor, above the end at rest
        pull = A.T @ (-p["k"] * (1 - p["s"] / np.linalg.norm(v)) * v)
        force += pull
        torque += r[0] * pull[1] - r[1] * pull[0]
    assert np.allclose(told["whole torque"], [0, 0, torque])
    assert "angular acceleration by the forces" not in told  # of its six terms
    assert np.allclose(told["acceleration by the forces"], [*force / (2 * p["m"]), 0])
    assert np.allclose(told["acceleration of gravity"], [*(A.T @ [0, -p["g"]]), 0])
    assert np.allclose(told["angular velocity in the body"], [0, 0, 0.7])


def test_two_tops_have_each_its_own():
    """The torque of the spring on each, and the gyroscopic one."""
    A, B = turned(np.array([1.0, 2, 0]), 0.5), turned(np.array([0.0, 1, 1]), -0.8)
    w, v = np.array([1.0, -0.5, 2]), np.array([0.3, 0.8, -1])
    found, p, *_ = seen("two_tops", np.array([*A.ravel(), *B.ravel(), *w, *v]))
    told = dict(found)
    points = [[(1, [1, 0, 0]), (1, [0, 1, 0])], [(1, [1, 0, 0.5]), (2, [0, 1, 0])]]
    a, b = np.array([1.0, 0, 0]), np.array([1, 0, 0.5])
    line = A @ a - B @ b
    pull = -p["k"] * (1 - p["l"] / np.linalg.norm(line)) * line
    torques = [np.cross(a, A.T @ pull), np.cross(b, -B.T @ pull)]
    for k, z in enumerate((w, v)):
        L = sum(m * np.cross(r, np.cross(z, r)) for m, r in points[k])
        torques[k] = torques[k] + np.cross(L, z)
    velocities = [x for name, x in found if name == "angular velocity in the body"]
    assert np.allclose(np.concatenate(velocities), [w, v])
    assert np.allclose(told["whole torque"], torques)
    d = derived("two_tops")
    assert [x["part"] for x in drawn(d.record, arrows(d.record), 0)] == [0, 1, 0, 1]
    assert [x["at"] for x in drawn(d.record, arrows(d.record), 5)] == [5, 8, 11, 14]


@pytest.mark.parametrize("name", ["sl3", "gl3", "gas_cloud", "jelly", "saff3"])
def test_what_the_points_do(name):
    """The velocity of each, and terms whose sum is the rate of Z."""
    d = derived(name)
    made, _ = moving_program(d.problem, d.record, sought=False)
    x = 0.2 * RNG.standard_normal(len(made.state))
    x[:9] += np.eye(3).ravel()
    if name in ("sl3", "saff3"):
        x[:9] /= np.cbrt(np.linalg.det(x[:9].reshape(3, 3)))
    found, _, module, (k, u) = seen(name, x)
    place = len(made.state) - len(module.BASIS)
    order = [i for i, s in enumerate(made.state) if s.startswith(("zeta", "w_"))]
    assert order[0] == place
    rates = module.rhs(0.0, x, k, u)
    linear = [E[:3, :3] for E in np.array(module.BASIS)]
    Z, rate = (np.tensordot(y[place:], linear, 1) for y in (x, rates))
    terms = [rows for m, rows in found if m.startswith("acceleration of the points")]
    assert all(y.shape == (3, 3) for y in terms)
    assert len(terms) >= 2
    assert np.allclose(sum(terms), rate, rtol=1e-9, atol=1e-9)
    told = dict(found)
    assert np.allclose(told["velocity of the points about the origin"], Z)
    own = [rows for m, rows in found if m == "acceleration of the points by their own motion"]
    assert np.allclose(own, [-Z @ Z])


def test_what_moves_no_points_of_space_has_none():
    for name in ("screw", "manakov", "sp4", "euler_poisson", "zeitlin", "ideal_fluid", "imu"):
        assert not arrows(derived(name).record), name


def test_every_meaning_has_its_french():
    for name in ("pendulum", "hung_bar", "two_tops", "jelly", "sl3"):
        d = derived(name).record
        for x, told in zip(arrows(d), legend(d, arrows(d), language("fr")), strict=True):
            assert told["meaning"] != x.meaning
