"""The page in which a body moves: its bytes, what it escapes, what it refuses; and in a browser
that it moves, keeps what is kept, and follows its sliders."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import derive
from derive.code.emit import emit
from derive.code.options import Options
from derive.command.cli import main
from derive.command.loading import load_problem, ready_made
from derive.figure.drawn_body import Numbers
from derive.language.values import approximate
from derive.page.moving_body import moving_body
from derive.page.shortened import called, shortened
from derive.pipeline import motion_of, program
from derive.problem.state_names import state_names
from derive.problem.toml import problem_of
from derive.walk.head import problem_data
from tests.support.needs import BROWSERS, need

FAST = {"start": {"zeta_3": 300.0}, "exp": (0.3, 0, 0)}
STARTS = {
    "top": FAST,
    "so3": {"start": {"zeta_1": 0.01, "zeta_2": 1.0}},
    "sl3": {"start": {"zeta_1": 1.0, "zeta_5": 0.5}},
    "hammer": {"start": {"zeta_1": 6.0, "zeta_3": 1.0, "w_3": 5.0}},
    "two_tops": {"start": {"zeta_1": 1.0, "zeta_5": 2.0}},
    "euler_poisson": {"start": {"zeta_1": 1.0, "gamma_1": 1.0, "gamma_2": 0.5}},
}


@pytest.fixture(scope="module")
def pages():
    """Name, language → the page of a motion."""
    kept = {}

    def page(name, language="en"):
        if (name, language) not in kept:
            d = derive.derive(name)
            kept[name, language] = d.motion_page(10.0, language=language, **STARTS[name])
        return kept[name, language]

    return page


def told(page):
    """The data of a page."""
    return json.loads(re.search(r'<script id="page" [^>]*>(.*?)</script>', page, re.DOTALL)[1])


# ---------------------------------------------------------------- the bytes


MOST = 40_000
LONGEST = "riemann_ellipsoid"
PAGELESS = ("affine", "linear", "ideal_fluid", "inhomogeneous_fluid", "stratified_fluid")


@pytest.mark.parametrize("name", sorted(ready_made(), key=lambda x: x not in ("sl3", LONGEST)))
def test_every_page_is_small(name):
    if name in PAGELESS:
        with pytest.raises(ValueError, match="no numeric code"):
            derive.derive(name).motion_page(5.0)
        return
    d = derive.derive(name)
    for language in ("en", "fr"):
        assert len(d.motion_page(5.0, language=language).encode()) <= MOST


def test_it_is_alone_and_always_the_same(pages):
    page = pages("top")
    assert not re.search(r"https?:|@import|url\(|src=|<link|fetch|XMLHttp|import\(|eval\(", page)
    assert page == derive.derive("top").motion_page(10.0, **FAST)


def test_it_says_where_its_script_is_from(pages):
    for name in ("top", "sl3"):
        (script,) = re.findall(r"<script>(.*?)</script>", pages(name), re.DOTALL)
        (comment,) = re.findall(r"/\*.*?\*/", script)
        assert f'"derive emit {name} --lang javascript --step gauss"' in comment
        assert "templates/html/motion" in comment


def test_what_a_body_has_not_is_not_in_its_page(pages):
    """An ellipsoid of the velocity, a spring, a mouse that turns."""
    marks = {"polhode": "ζ${", "spring": ".14+.72*", "camera": "pointerdown", "ball": "32,16,"}
    for name in ("top", "so3", "sl3", "two_tops", "euler_poisson"):
        page = pages(name)
        body = told(page)["body"]
        anchored = any(part["anchors"] for part in body["parts"])
        round_ones = any("ball" in str(part["solids"]) for part in body["parts"])
        has = {
            "polhode": body["polhode"],
            "spring": body["springs"] or anchored,
            "camera": body["parts"],
            "ball": round_ones
            or any(part["moments"] or "turning" in part for part in body["parts"]),
        }
        assert {x: mark in page for x, mark in marks.items()} == {
            x: bool(y) for x, y in has.items()
        }


def test_both_languages(pages):
    english, french = (told(pages("top", x)) for x in ("en", "fr"))
    assert english["words"]["energy"] == "energy"
    assert french["words"]["energy"] == "énergie"
    assert french["kept"]["angular_momentum_3"] == ["moment cinétique 3", "kg m²/s"]
    assert french["labels"]["rho"] == ["masse volumique", "kg/m³"]
    assert french["labels"]["zeta_1"] == ["vitesse angulaire dans le corps", "1/s"]
    assert '<html lang="fr">' in pages("top", "fr")
    assert english["kept"]["body_angular_momentum_3"][0] == "angular momentum in the body 3"
    untold = {x for x, y in english["words"].items() if y == french["words"][x]}
    assert untold == {"pause"}


BAD = "</script><script>alert(1)</script><img src=x onerror=alert(1)>`${alert(1)}`"
HOSTILE = f"""
name = "hostile"
title = '{BAD}'
group = "SO(3)"
[parameters]
a = {{ default = 1.0, unit = '{BAD}', meaning = '{BAD}' }}
[[point]]
mass = "a"
at = [1, 0, 0]
[[point]]
mass = 2
at = [0, 1, 0]
"""


@pytest.fixture
def hostile(tmp_path):
    path = tmp_path / "hostile.toml"
    path.write_text(HOSTILE, encoding="utf-8")
    return derive.derive(path).motion_page(1.0, start={"zeta_1": 1.0})


def test_nothing_of_a_stranger_is_markup_or_code(hostile):
    tags = re.findall(r"<(\w+)", re.sub(r"<script.*?</script>", "<script>", hostile, flags=re.S))
    assert tags.count("script") == 2
    assert "img" not in tags
    assert "alert" not in re.findall(r"<script>(.*?)</script>", hostile, re.DOTALL)[0]
    assert told(hostile)["labels"]["a"] == [BAD, BAD]


# ---------------------------------------------------------------- the script


def run_in_node(folder, text):
    """What a script prints."""
    (folder / "main.js").write_text(text, encoding="utf-8")
    done = subprocess.run(["node", folder / "main.js"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_shortened_module_does_the_same(pages, tmp_path):
    need("node")
    d, page = derive.derive("sl3"), told(pages("sl3"))
    code, names = motion_of(d.problem, d.record), ["begin", "gauss_to", "constants", "conserved"]
    chosen = Options(step="gauss", conserved=True)
    (source,) = emit(code.program, d.record, ("javascript",), "sl3", chosen).values()
    p, x = page["p"], page["x"]
    needed = called(source.replace("\nexport ", "\n"), names)
    whole = f"""
        const module = (() => {{ {needed} return {{ {", ".join(names)} }}; }})();
        const k = module.constants({p}), motion = module.begin(0, {x});
        module.gauss_to(motion, k, null, 3, 1e-9);
        console.log(JSON.stringify([...motion.x, ...module.conserved(3, motion.x, k)]));
    """
    found = [run_in_node(tmp_path, text) for text in (whole, shortened(whole))]
    assert found[0] == found[1]
    assert len(shortened(whole)) < 0.55 * len(whole)
    assert "dense" not in needed


HAND = {
    "const first = 1, a = 2; // one\nconst third = a - -first;\n": "const b=1,a=2,c=a- -b;",
    'f({ key: "a  b // c" }, `x ${long(key)}  y`);': 'f({key:"a  b // c"},`x ${long(key)}  y`);',
    "const long = 1; x.long = long; ++x.y;": "const a=1;x.long=a;++x.y;",
    "f(0.5, 2.0, 0.0, 10.05, 0, 1e-3, a ? 0.5 : true);": "f(.5,2,0,10.05,0,1e-3,a?.5:!0);",
    "f([1, , ], { a: 1, }, [, a], [1, 2,],);": "f([1,,],{a:1},[,a],[1,2]);",
    # an inner name may be that of an outer one which is not used within
    "const one = 1; const two = (x) => x + one; g((one) => one, two);": (
        "const a=1,b=b=>b+a;g(a=>a,b);"
    ),
    # keys stay, also of patterns, methods and getters
    "function f({ x, y: z = x }, ...more) { return { x, z: z, get more() { return more; } }; }": (
        "function a({x:a,y:c=a},...b){return{x:a,z:c,get more(){return b}}}"
    ),
    "for (const x of [1]) for (let y = x; y < 2; ++y) { const x = y; h(x); } x(y);": (
        "for(const a of[1])for(let b=a;b<2;++b){const a=b;h(a)}x(y);"
    ),
    "f((x, y) => (z) => x, () => 1); const g = (x) => { return (y) => y; };": (
        "f((a,b)=>b=>a,()=>1);const a=a=>{return a=>a};"
    ),
    "try { f(); } catch (fault) { const f = fault; g(f); }": "try{f()}catch(b){const a=b;g(a)}",
}


@pytest.mark.parametrize("source", HAND)
def test_shortening_by_hand(source):
    assert shortened(source) == HAND[source]


def test_what_is_used_often_of_the_language_has_a_name():
    once = '"use strict"; const first = Math.abs(1);'
    assert shortened(once) == '"use strict";const a=Math.abs(1);'
    often = '"use strict"; f(Math.abs(Math.cos(Math.sin(Math.exp(Math.PI)))), x.Math);'
    assert (
        shortened(often) == '"use strict";const a=Math;f(a.abs(a.cos(a.sin(a.exp(a.PI)))),x.Math);'
    )


@pytest.mark.parametrize("source", ["class A { }", "f(async () => 1);", "switch (x) { }"])
def test_what_is_not_read_is_told(source):
    with pytest.raises(ValueError, match=r"not read: (class|async|switch)"):
        shortened(source)


SCOPES = """
const out = [];
const value = 1, other = { value, twice: (value) => 2 * value, deep: { value: value + 1 } };
function outer(value, { inner = value + 1, list: [head, ...tail] }, last = inner) {
    let total = 0;
    const later = () => total + value;
    for (const [k, value] of tail.entries()) {
        const inner = k * value;
        total += inner ? inner : value;
    }
    for (let k = 0, end = 3; k < end; ++k) total += k;
    {
        const total = "hidden", all = [head, ...tail];
        const value = `${total} ${later()} {} ${all.map((x) => x + 1)}`;
        out.push(total, value);
    }
    try {
        throw { total: 7 };
    } catch ({ total: found }) {
        out.push(found, total);
    }
    const machine = {
        total,
        get last() { return last + total; },
        step(by = 1) { total += by; return { total, by }; },
        ["computed"]: (a, b = a) => (a > b ? a : b),
    };
    machine.step(); machine.step(value);
    out.push(machine.last, machine.total, machine.step(2).total, machine.computed(3), later());
    return typeof head === "number" && head in { 5: 1 } ? { head, tail } : null;
}
out.push(outer(3, { list: [5, 6, 7] }), outer(1, { inner: 4, list: ["a"] }, 9));
out.push(other.twice(21), other.value, other.deep.value, other?.deep?.value ?? 0);
out.push([1, 2, 3].reduce((value, other) => value * 10 + other, Number(value !== 1 ? 5 : 0)));
out.push(((value) => (other) => value - other)(5)(3), (() => ({ value: 1 }))().value);
console.log(JSON.stringify(out));
"""


def test_scopes_as_the_language_has_them(tmp_path):
    need("node")
    printed = [run_in_node(tmp_path, text) for text in (SCOPES, shortened(SCOPES))]
    assert printed[0] == printed[1] != ""
    assert len(shortened(SCOPES)) < 0.6 * len(SCOPES)


# ---------------------------------------------------------------- the body


def body_of(name):
    """What is drawn of a problem, by the names of the state that its code has."""
    d = derive.derive(name)
    group = d.problem.group if d.problem.advected is None else None
    return moving_body(d.record.problem, group, program(d.problem, d.record).state)


def test_what_is_drawn():
    top = body_of("top")
    assert top["parts"][0]["solids"][0]["shape"] == "cone"
    assert top["parts"][0]["fixed"]
    assert top["polhode"] == [9, 10, 11]
    assert top["turns"]
    assert [row[3] for row in body_of("hammer")["parts"][0]["map"]] == [9, 10, 11]
    assert len(body_of("two_tops")["parts"]) == 2
    assert body_of("two_tops")["springs"] == [[0, 1, 1, 3]]
    assert body_of("sl3")["parts"][0]["deforms"]
    assert body_of("sl3")["polhode"] == []
    assert body_of("so4")["parts"] == body_of("zeitlin")["parts"] == []
    assert body_of("rod")["parts"][0]["turning"] == [12, 13, -1]
    assert body_of("kirchhoff")["parts"][0]["sliding"] == [15, 16, 17]
    assert "turning" not in body_of("so3")["parts"][0]


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
def test_the_ellipsoid_of_an_inertia_that_the_energy_tells(name, tmp_path):
    need("node")
    group, L, parts, stretched = LAGRANGIANS[name]
    path = tmp_path / "typed.toml"
    path.write_text(f'name = "typed"\ngroup = "{group}"\n[lagrangian]\nL = "{L}"\n')
    d = derive.derive(path)
    made = motion_of(d.problem, d.record).program
    (source,) = emit(made, d.record, ("javascript",), "typed", Options()).values()
    scripts = Path(derive.__file__).parents[1] / "templates" / "html" / "motion"
    velocity = [k for k, x in enumerate(made.state) if x.startswith("zeta")]
    text = BUILT.format(
        source=source.replace("\nexport ", "\n"),
        drawing="".join((scripts / f"{x}.js").read_text() for x in ("vectors", "shapes", "body")),
        velocity=velocity,
        x=[float(x[-2] == x[-1]) if x[0] == "A" else 0.3 for x in made.state],
        body=json.dumps(moving_body(d.record.problem, d.problem.group, made.state)),
    )
    found = json.loads(run_in_node(tmp_path, text))
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
def test_what_leaves_a_trail(name, traced, tmp_path):
    """The bob of a pendulum hangs on the other side of where the second axis is drawn to; about a
    fixed centre of mass, and where the last axis goes through it, its tip does (``None``)."""
    need("node")
    d = derive.derive(name)
    made = motion_of(d.problem, d.record).program
    scripts = Path(derive.__file__).parents[1] / "templates" / "html" / "motion"
    known = d.problem.parameters
    text = TRACED.format(
        drawing="".join((scripts / f"{x}.js").read_text() for x in ("vectors", "shapes", "body")),
        body=json.dumps(moving_body(d.record.problem, d.problem.group, made.state)),
        names=json.dumps([*known]),
        values=json.dumps([float(x.default or 1) for x in known.values()]),
    )
    ((places, tip),) = json.loads(run_in_node(tmp_path, text))
    assert places == [traced or tip]


PAINTED = """
    {drawing}
    const eye = {{ look() {{}}, right: {right}, up: {up}, towards: {towards} }};
    const painted = [], pen = new Proxy({{}}, {{ get: () => () => {{}}, set: () => true }});
    const path = (list) => painted.push(list);
    const view = {{ width: 400, height: 400, pen, path, stroke() {{}} }};
    const pic = picture({{ colours: {{}} }}, view, eye, [0, 0, 0], 100);
    const part = {{ points: [], anchors: [], attractions: [], solids: [{solid}] }};
    const scene = {{ p: [], page: {{ module: {{ PARAMETERS: [] }}, body: {{ parts: [part] }} }} }};
    const [{{ faces }}] = built(scene, [], {{ {shape} }}).parts;
    for (const f of faces) pic.face(f.v, Array(33).fill("grey"), f.clear, f.inside);
    pic.done();
    console.log(JSON.stringify([painted, faces.map((f) => f.v.map(pic.to))]));
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


@pytest.mark.parametrize("shape", ["ball", "cylinder", "cone", "box", "tetrahedron"])
def test_what_is_in_front_is_drawn_over_what_is_behind(shape, tmp_path):
    """At many places of the paper the last face that is drawn there is the nearest that is."""
    need("node")
    scripts = Path(derive.__file__).parents[1] / "templates" / "html" / "motion"
    names = ("vectors", "shapes", "body", "canvas")
    drawing = "".join((scripts / f"{x}.js").read_text() for x in names)
    random = np.random.default_rng(7)
    for turn in range(4):
        right, up, towards = np.linalg.qr(random.normal(size=(3, 3)))[0].tolist()
        columns = random.normal(size=(3, 3)) + 2 * np.eye(3)
        columns[0] *= (-1) ** turn  # also mirrored
        solid = json.dumps({"shape": shape, "columns": columns.tolist(), "shift": [0.2, -0.1, 0.3]})
        text = PAINTED.format(**locals())
        painted, faces = json.loads(run_in_node(tmp_path, text))
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
    number = Numbers(data)
    columns = np.array([number.vector(x) for x in drawn["columns"]])
    moments = problem.body.moments()
    m, *c = (approximate(x, {}) for x in (moments.m, *moments.c))
    assert 3 * volume * abs(np.linalg.det(columns)) == pytest.approx(m)
    assert centre @ columns + number.vector(drawn["shift"]) == pytest.approx(np.array(c) / m)


def test_a_turn_has_the_slider_of_turns(pages):
    """A velocity that is no turn but a shear, or a stretch, has one to 1."""
    for name in ("so3", "sl3", "two_tops"):
        E = np.array(load_problem(name).group.basis, float)
        turns = (-E.transpose(0, 2, 1) == E).all(axis=(1, 2))
        assert told(pages(name))["reach"] == np.where(turns, 60, 1).tolist()


def test_every_ready_made_body_has_a_shape():
    for name in ready_made():
        problem = load_problem(name)
        group = problem.group if problem.advected is None else None
        state = [x for x in state_names(group) if x != "t"] if group else []
        for part in moving_body(problem_data(problem), group, state)["parts"]:
            assert any(part.get(x) for x in ("points", "solids", "moments", "turning")), name


def test_a_mesh_is_drawn_as_it_is(tmp_path):
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (tmp_path / "wedge.obj").write_text("\n".join(lines))
    path = tmp_path / "wedge.toml"
    body = '[body]\nsolid = "mesh"\ndensity = 1\nfile = "wedge.obj"\n'
    path.write_text(f'name = "wedge"\ngroup = "SO(3)"\n{body}')
    (solid,) = body_of(path)["parts"][0]["solids"]
    drawn = [[solid["vertices"][i] for i in face] for face in solid["faces"]]
    expected = [[corners[i] for i in face] for face in faces]
    assert sorted(map(sorted, drawn)) == sorted(map(sorted, expected))


# ---------------------------------------------------------------- the command


def test_the_command_writes_it_with_a_run_or_alone(tmp_path, capsys):
    page, out = tmp_path / "page.html", tmp_path / "run.csv"
    words = ["simulate", "top", "--t", "0.05", "--set", "zeta_3=100", "--html", str(page)]
    assert main(words) == 0
    assert capsys.readouterr().out == f"{page}\n"
    assert main([*words, "--out", str(out), "--lang", "fr"]) == 0
    assert out.exists()
    assert told(page.read_text(encoding="utf-8"))["comma"]


def test_notes_link_to_the_page_of_each_problem(tmp_path, capsys):
    out = tmp_path / "notes.html"
    assert main(["notes", "so3", "top", "--motion", "5", "--lang", "fr", "--out", str(out)]) == 0
    names = ["notes_so3_motion.html", "notes_top_motion.html"]
    assert capsys.readouterr().out.split() == [str(out), *(str(tmp_path / x) for x in names)]
    links = re.findall('<a href="([^#"]*)">En mouvement', out.read_text(encoding="utf-8"))
    assert links == names
    for name, text in zip(("so3", "top"), names, strict=True):
        page = derive.derive(name).motion_page(5.0, language="fr")
        assert (tmp_path / text).read_text(encoding="utf-8") == page


def test_notes_in_two_languages_have_pages_of_their_own(tmp_path, capsys):
    both = []
    for name, more in (("notes.html", []), ("notes_fr.html", ["--lang", "fr"])):
        out = str(tmp_path / name)
        assert main(["notes", "so3", "--motion", "5", "--out", out, *more]) == 0
        both.append({*capsys.readouterr().out.split()})
    assert not both[0] & both[1]
    page = told((tmp_path / "notes_so3_motion.html").read_text(encoding="utf-8"))
    assert "comma" not in page
    assert told((tmp_path / "notes_fr_so3_motion.html").read_text(encoding="utf-8"))["comma"]


# ---------------------------------------------------------------- in a browser


@pytest.fixture(scope="module")
def browser():
    need("the module playwright", "chromium")
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)))
    with sync_playwright() as playwright:
        arguments = ["--no-sandbox", "--disable-gpu"]
        running = playwright.chromium.launch(executable_path=path, args=arguments)
        yield running
        running.close()


@pytest.fixture
def opened(browser, tmp_path):
    """A page in the browser; at the end nothing was said on its console."""
    said = []

    def open_page(text, width=1280, **how):
        file = tmp_path / "page.html"
        file.write_text(text, encoding="utf-8")
        how.setdefault("reduced_motion", "reduce")
        shown = browser.new_page(viewport={"width": width, "height": 844}, **how)
        shown.on("console", lambda message: said.append(message.text))
        shown.on("pageerror", lambda error: said.append(str(error)))
        shown.on("request", lambda x: x.url.startswith("file:") or said.append(x.url))
        shown.goto(file.as_uri())
        return shown

    yield open_page
    assert not said


INK = """() => [...document.querySelectorAll("canvas")].map((c) => {
    const { data } = c.getContext("2d").getImageData(0, 0, c.width, c.height);
    return data.filter((v, i) => i % 4 === 3 && v > 0).length/data.length*4;
})"""
MOTION = 'document.getElementById("motion").motion'
CHANGES = """() => [...document.querySelectorAll("tbody td:nth-child(3)")].map(
    (cell) => Number(cell.textContent.replace("−", "-")))"""


def seek(page, t):
    page.evaluate(f"{MOTION}.seek({t})")
    page.wait_for_function(f"Math.abs({MOTION}.time - {t}) < 1e-12")


@pytest.mark.dist
@pytest.mark.parametrize("name", STARTS)
def test_it_moves_and_keeps_what_is_kept(name, pages, opened):
    page = opened(pages(name))
    page.wait_for_timeout(200)
    assert page.evaluate(f"{MOTION}.time") == 0
    seek(page, 1.0)
    page.wait_for_timeout(100)
    ink = page.evaluate(INK)
    assert min(ink) > 0.002
    assert ink[0] > 0.03 or name == "euler_poisson"  # the body, not the ground alone
    assert max(page.evaluate(CHANGES)) < 1e-9
    page.get_by_role("button", name="play").click()
    page.wait_for_function(f"{MOTION}.time > 1.001")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="pause").click()
    after = page.evaluate(f"{MOTION}.time")
    page.wait_for_timeout(200)
    assert page.evaluate(f"{MOTION}.time") == after
    seek(page, 10.0)
    assert max(page.evaluate(CHANGES)) < 1e-9


@pytest.mark.dist
@pytest.mark.parametrize("name", [x for x in ready_made() if x not in {*PAGELESS, *STARTS}])
def test_every_ready_made_problem_has_a_page_that_draws(name, opened):
    page = opened(derive.derive(name).motion_page(2.0))
    seek(page, 0.5)
    page.wait_for_timeout(100)
    assert min(page.evaluate(INK)) > 0.002


DRAWN = """(n) => {
    const { prototype } = CanvasRenderingContext2D, stage = document.querySelectorAll("canvas")[n];
    const kept = globalThis.drawn = { dots: [], lines: [], strokes: [] };
    const heard = (name, does) => {
        const own = prototype[name];
        prototype[name] = function (...a) {
            if (this.canvas === stage) does.apply(this, a);
            own.call(this, ...a);
        };
    };
    heard("clearRect", () => Object.assign(kept, { dots: [], lines: [], strokes: [] }));
    heard("arc", (x, y) => kept.dots.push([x, y]));
    heard("beginPath", () => { kept.path = []; });
    heard("stroke", function () { kept.strokes.push([this.strokeStyle, kept.path]); });
    for (const name of ["moveTo", "lineTo"]) {
        heard(name, (x, y) => [kept.lines, kept.path].forEach((list) => list.push([x, y])));
    }
}"""
"""Keeps the places, in pixels, of what the last picture on the n-th canvas has: its dots, ends of
its lines, and strokes, colour and line."""

IN_PLANE = """
name = "flat"
group = "{}"
[[point]]
mass = 1
at = [0.3, -0.7]
[[point]]
mass = 2
at = [0.4, 0.2]
[[potential]]
kind = "gravity"
g = {}
"""


@pytest.mark.parametrize(
    ("group", "gravity"),
    [("SO(2)", [0, -9.81]), ("SO(2)", [3, 2]), ("SE(2)", [0, -9.81]), ("SL(2)", [-1, 0])],
)
def test_a_plane_is_seen_as_it_is(group, gravity, opened, tmp_path):
    """The first axis to the right, the second up, and gravity along them."""
    path = tmp_path / "flat.toml"
    path.write_text(IN_PLANE.format(group, gravity))
    page = opened(derive.derive(path).motion_page(2.0, start={"zeta_1": 1.3}))
    page.wait_for_timeout(100)
    page.evaluate(DRAWN, 0)
    seek(page, 0.7)
    page.wait_for_timeout(100)
    (one, other, *_), lines = map(np.array, page.evaluate("[drawn.dots, drawn.lines]"))
    A = np.reshape(page.evaluate(f"[...{MOTION}.state]")[:4], (2, 2))
    apart, own = (other - one) * [1, -1], A @ [0.1, 0.9]
    scale = np.linalg.norm(apart) / np.linalg.norm(own)
    assert scale > 50
    assert np.abs(apart - scale * own).max() < 1e-6
    fall = (lines[-4] - lines[-5]) * [1, -1]  # before the head of the arrow
    assert np.abs(fall - 30 * np.array(gravity) / np.linalg.norm(gravity)).max() < 1e-6


def test_a_curve_ends_where_its_time_does(opened):
    """What leads to its name is of another colour, that of no curve."""
    page = opened(derive.derive("hung_bar").motion_page(2.0))
    page.wait_for_timeout(100)
    page.evaluate(DRAWN, 1)
    seek(page, 1.5)
    page.wait_for_timeout(100)
    strokes = [(x, np.array(line)) for x, line in page.evaluate("drawn.strokes")]
    axes = strokes[0][1]
    curves = [(x, line) for x, line in strokes if len(line) > 20]
    assert len(curves) == 3
    colours = {x for x, _ in curves}
    for colour, line in strokes:
        assert colour not in colours or line[:, 0].max() <= axes[:, 0].max() + 1e-9
    state = page.evaluate(f"[...{MOTION}.state]")[6:]
    ends = [line[-1, 1] for _, line in curves]  # in the order of their names, the highest first
    assert np.all(np.diff(ends) > 0)
    span = (ends[0] - ends[-1]) / (max(state) - min(state))
    assert ends == pytest.approx([ends[0] + span * (v - max(state)) for v in sorted(state)[::-1]])


@pytest.mark.dist
def test_the_state_is_that_of_a_run(pages, opened):
    page = opened(pages("sl3"))
    expected = derive.derive("sl3").simulate(10.0, points=1, tol=1e-12, **STARTS["sl3"]).states[-1]
    seek(page, 10.0)
    found = page.evaluate(f"[...{MOTION}.state]")
    assert np.abs(np.array(found) - expected).max() < 1e-7


@pytest.mark.dist
def test_sliders_change_the_motion_and_all_goes_back(pages, opened):
    page = opened(pages("top"))

    def state(t=1.0):
        seek(page, t)
        return np.array(page.evaluate(f"[...{MOTION}.state]"))

    first = state()
    for name, value in (("g", 5.0), ("zeta_1", 40.0), ("theta_1", 0.4)):
        row = page.locator(f'[data-name="{name}"]')
        row.locator("xpath=ancestor::details").evaluate("(e) => { e.open = true; }")
        row.locator("input[type=range]").fill(str(value))
        assert page.evaluate(f"{MOTION}.time") == 0
        assert np.abs(state() - first).max() > 0.01
        page.get_by_role("button", name="As it was").click()
        assert np.array_equal(state(), first)


def typed(page, name, text):
    """Type a number, and leave its box."""
    row = page.locator(f'[data-name="{name}"]')
    row.locator("input[inputmode]").fill(text)
    row.locator("input[inputmode]").press("Tab")
    return row


@pytest.mark.dist
@pytest.mark.parametrize("width", [390, 1280])
def test_a_wrong_number_is_told_where_it_is(width, pages, opened):
    page = opened(pages("top"), width)
    row = typed(page, "R", "0")
    told = page.get_by_role("status")
    assert told.inner_text() == "No body has these numbers: R = 0."
    assert row.get_by_role("status").count() == 1
    box = told.bounding_box()
    assert 0 <= box["y"] <= 844 - box["height"]
    energy = page.locator('tr[data-name="energy"] td').first
    assert energy.inner_text() == ""
    typed(page, "R", "0.03")
    assert told.inner_text() == ""
    page.wait_for_timeout(100)
    assert energy.inner_text() != ""


@pytest.mark.dist
def test_a_number_with_a_comma_or_a_point_and_nothing_else(pages, opened):
    page = opened(pages("top", "fr"))

    def g():
        return page.evaluate(f"{MOTION}.given.p[3]")

    for text, value in (("1,5", 1.5), ("2.25", 2.25), ("−3e-1", -0.3)):
        typed(page, "g", text)
        assert g() == value
    for text in ("1,234.5", "five", "", "1e999"):
        box = typed(page, "g", text).locator("input[inputmode]")
        assert box.get_attribute("aria-invalid") == "true"
        assert page.get_by_role("status").inner_text() == "Ce n’est pas un nombre."
        assert g() == -0.3
    typed(page, "g", "9,81")
    assert box.get_attribute("aria-invalid") == "false"


@pytest.mark.dist
def test_a_slider_spins_the_body_both_ways(pages, opened):
    page = opened(pages("so3"))
    ends = page.locator('[data-name="zeta_3"] input[type=range]').evaluate("(x) => [x.min, x.max]")
    assert [float(x) for x in ends] == [-60, 60]


@pytest.mark.dist
def test_the_trail_follows_the_speed_that_is_set(opened):
    """The tip of an axis that turns fast about another goes a small angle between two points."""
    page = opened(derive.derive("top").motion_page(10.0, start={"zeta_1": 0.5}))
    page.locator('[data-name="zeta_1"] input[type=range]').fill("50")
    seek(page, 1.0)
    page.wait_for_timeout(200)
    page.get_by_role("button", name="play").click()
    page.wait_for_function(f"{MOTION}.time > 1.2")
    page.get_by_role("button", name="pause").click()
    trail = page.evaluate(f"{MOTION}.trail.map(([t]) => t)")
    assert len(trail) == 480
    assert np.diff(trail).min() > 0
    assert np.diff(trail).max() < 0.2 / 50


@pytest.mark.dist
def test_what_is_not_kept_stands_apart(opened):
    page = opened(derive.derive("jelly").motion_page(2.0, start={"zeta_1": 0.1}))
    groups = "[...document.querySelectorAll('tbody')].map((x) => x.innerText)"
    kept, others = page.evaluate(groups)
    assert "energy" not in kept
    assert others.startswith("What is not kept")
    assert "energy" in others


@pytest.mark.dist
def test_a_component_along_no_direction_is_not_shown(pages, opened):
    """Along gravity, in its unit; without gravity those along the axes, which are kept then."""
    page = opened(pages("so3"))
    row = "[...document.querySelectorAll('[data-name=angular_momentum]')].map((x) => x.innerText)"
    (shown,) = page.evaluate(row)
    assert "kg m²/s" in shown
    page.locator('[data-name="g_3"] input[inputmode]').fill("0")
    page.locator('[data-name="g_3"] input[inputmode]').press("Enter")
    page.wait_for_timeout(100)
    assert page.evaluate(row) == []
    along = row.replace("name=", "name^=")
    assert [x.split()[:3] for x in page.evaluate(along)] == [
        ["angular", "momentum", str(k)] for k in (1, 2, 3)
    ]
    page.locator('[data-name="g_1"] input[inputmode]').fill("1")
    page.locator('[data-name="g_1"] input[inputmode]').press("Enter")
    page.wait_for_timeout(100)
    assert len(page.evaluate(row)) == len(page.evaluate(along)) == 1


def test_the_energy_is_kept_where_nothing_moves_it(pages):
    assert not told(pages("so3")).get("lost", False)
    pushed = told(derive.derive("so3").motion_page(1.0, start={"u_1": 0.5}))
    assert not pushed.get("lost", False)
    assert pushed["words"]["kept"] == "What is kept without inputs"
    assert told(pages("top"))["words"]["kept"] == "What is kept"
    assert told(pages("sl3"))["words"]["defect"] == "off the group by |det A − 1|"
    assert told(pages("top"))["words"]["defect"] == "off the group by"


@pytest.mark.parametrize(
    ("more", "lost"),
    [
        ("", False),
        ('[[potential]]\nkind = "expression"\nU = "r1_z*cos(t)"\n', True),
        ('[[potential]]\nkind = "expression"\nU = "r1_z*cos(1)"\n', False),
        ("[[damping]]\ncoefficient = 1\n", True),
    ],
)
def test_what_makes_an_energy_change(more, lost, tmp_path):
    points = "".join(
        f"[[point]]\nmass = 1\nat = {at}\n" for at in ([1, 0, 0], [0, 1, 0], [0, 0, 1])
    )
    path = tmp_path / "three.toml"
    path.write_text(f'name = "three"\ngroup = "SO(3)"\n{points}{more}', encoding="utf-8")
    assert told(derive.derive(path).motion_page(1.0)).get("lost", False) == lost


def test_a_path_is_said_to_be_on_the_ellipsoid_where_nothing_acts(pages):
    free = ("euler_top",)
    for name in (*free, "gyrostat", "top", "kovalevskaya_top"):
        caption = told(derive.derive(name).motion_page(1.0))["words"]["polhode"]
        assert ("its path, the polhode, on" in caption) == (name in free), name


@pytest.mark.dist
def test_a_body_that_becomes_flat_is_told(opened):
    page = opened(derive.derive("gl3").motion_page(5.0, start={"zeta_1": -0.5}))
    page.evaluate(f"{MOTION}.seek(5)")
    page.wait_for_function('document.querySelector(".message").textContent.includes("det A = 0")')


@pytest.mark.dist
def test_by_the_keyboard(pages, opened):
    page = opened(pages("top"))
    page.wait_for_timeout(100)
    page.keyboard.press("ArrowRight")
    page.wait_for_function(f"{MOTION}.time > 0")
    page.keyboard.press("Home")
    page.wait_for_function(f"{MOTION}.time === 0")
    before = page.locator("canvas").first.screenshot()
    page.locator("canvas").first.focus()
    page.keyboard.press("ArrowLeft")
    page.wait_for_timeout(100)
    assert page.locator("canvas").first.screenshot() != before
    assert page.evaluate(f"{MOTION}.time") == 0
    page.keyboard.press("Space")
    page.wait_for_function(f"{MOTION}.time > 0")


@pytest.mark.dist
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_on_a_phone_by_night(scheme, pages, opened):
    page = opened(pages("top", "fr"), 390, color_scheme=scheme, has_touch=True)
    page.wait_for_timeout(100)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    assert page.locator("canvas").first.bounding_box()["height"] > 300
    assert min(page.evaluate(INK)) > 0.002
    sizes = page.evaluate(
        '[...document.querySelectorAll(".controls button")].map((b) => b.offsetHeight)'
    )
    assert min(sizes) >= 44
    colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, re.findall(r"\d+", colour))) > 380) == (scheme == "light")
    assert "t = 0,00" in page.locator(".clock").inner_text()


@pytest.mark.dist
def test_it_plays_by_itself_where_motion_is_welcome(pages, opened):
    page = opened(pages("two_tops"), reduced_motion="no-preference")
    page.wait_for_function(f"{MOTION}.time > 0.2")


@pytest.mark.dist
def test_a_collision_is_told(opened):
    at_rest = dict.fromkeys(("T_1", "w_2", "zeta_3"), 0.0)  # about the centre, to which they fall
    page = opened(derive.derive("comet").motion_page(1.0, start=at_rest))
    page.evaluate(f"{MOTION}.seek(1)")
    page.wait_for_function('document.querySelector(".message").textContent.includes("collision")')


@pytest.mark.dist
def test_texts_of_a_stranger_are_shown_as_text(hostile, opened):
    page = opened(hostile)
    assert BAD in page.locator('[data-name="a"]').inner_text()
    assert page.locator("h1").inner_text() == BAD
    assert page.locator("img").count() == 0


@pytest.mark.dist
@pytest.mark.parametrize("width", [1280, 390])
def test_what_is_beside_keeps_its_place(width, opened):
    """A value about 0.001, where small numbers begin to be powers of ten."""
    d, tilt = derive.derive("top"), (0.3, 0, 0)
    spin = d.simulate(0.01, start={"zeta_3": 1.0}, exp=tilt, points=1)["body_angular_momentum_3"][0]
    page = opened(d.motion_page(10.0, start={"zeta_3": 0.001 / spin}, exp=tilt), width)
    told, places = set(), set()
    for k in range(20):
        seek(page, 0.0125 * 1.37**k)
        page.wait_for_timeout(20)
        cell = page.locator('[data-name="body_angular_momentum_3"] td').first
        told.add(cell.inner_text())
        places.add(page.locator(".adjuster").first.bounding_box()["y"])
        assert page.locator(".clock").bounding_box()["height"] < 30
    assert "0.0010000" in told
    assert {len(x) for x in told} == {9}
    assert len(places) == 1
