"""Figures: well-formed, legible, within their frame, harmless; what hides is what is in front."""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import replace
from functools import cache
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.record.as_json import from_json, to_json
from derive.record.record import Derivation
from derive.views.figure.drawing import Scene, Stroke, svg, tikz
from derive.views.figure.drawn_body import ExpressionValues, overlap
from derive.views.figure.scene import WIDTH, parts_of_inertia, scene
from tests.support.processes import typeset
from tests.support.walks import record as ready_made_record

PROBLEMS = sorted((Path(__file__).parents[2] / "derive" / "problems").glob("*.toml"))
GENERAL = ("affine", "linear")
BODILESS = {"lagrangian", "inertia", "fluid", "kinematics"}
STATED = [p.stem for p in PROBLEMS if BODILESS & {*tomllib.loads(p.read_text(encoding="utf-8"))}]
OF_INERTIA = (
    *("charged_body", "coupled", "euler_top", "gyrostat", "kirchhoff"),
    *("kovalevskaya_top", "lagrange_top", "rod", "spherical_pendulum"),
)
"""Those whose Lagrangian states the inertia of rotations, which is drawn as an ellipsoid."""
NAMES = [p.stem for p in PROBLEMS if p.stem not in {*GENERAL, *STATED} - {*OF_INERTIA}]
OWN = {
    "mixture": """
        group = "SE(3)"
        solid = [
            { kind = "cylinder", density = 1, radius = 0.5, height = 2,
              rotation = { axis = [1, 1, 0], angle = "pi/3" } },
            { kind = "hollow_ball", density = 1, outer = 0.6, inner = 0.4, shift = [-1.2, 0.6, 0] },
            { kind = "tetrahedron", density = 1,
              vertices = [[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1]] },
        ]
        point = [{ mass = 1, at = [0, 0, 2] }]
        potential = [{ kind = "gravity", g = [0, "-9.81", 0] }]
    """,
    "plane": """
        group = "SE(2)"
        body = { moments = "symbolic" }
        parameters = { k_s = {} }
        potential = [
            { kind = "spring", at = [0.5, 0.3], anchor = [1, 50], stiffness = "k_s" },
            { kind = "gravity", g = [0, "-9.81"] },
        ]
        input = [{ name = "left", kind = "force", at = [0, 1] },
                 { name = "right", kind = "force", at = [0, 1] }]
    """,
    "product": """
        group = "SO(3) x SE(3) x SE(3)"
        parameters = { k = {}, x = {} }
        point = [
            { mass = 1, at = [1, 0.4, 0.3] }, { mass = 2, at = [0, 1, "-x"] },
            { mass = 1, at = [1, 0, 0], block = 2 }, { mass = 1, at = [0, 1, 0], block = 2 },
            { mass = 1, at = [0, 0, 1], block = 2 }, { mass = 0, at = [1, 0, 1], block = 3 },
            { mass = 1, at = [0, 1, 0], block = 3 }, { mass = 1, at = [-1, 0, 0], block = 3 },
            { mass = 1, at = [-1, 0.3, 2], block = 3 },
        ]
        potential = [
            { kind = "spring", between = [1, 3], stiffness = "k" },
            { kind = "spring", on = 8, anchor = [-1, 0, 0], stiffness = "k" },
            { kind = "gravity", g = [0, 0, 9.81] },
        ]
    """,
    "swarm": 'group = "GL(3)"\npoint = ['
    + ",".join(
        f"{{ mass = {1 + k % 3}, at = [{k * k % 17}, {k * 5 % 13}, {k * 7 % 11}] }}"
        for k in range(20)
    )
    + ']\npotential = [{ kind = "attraction", strength = 2, centre = [900, 0, 0] }]',
}
ALL = [*NAMES, *OWN]
HOSTILE = ('"><script>alert(1)</script>', r"\input{/etc/passwd}", "a\n$}{%&#^_~", "ï中" * 40)


@cache
def record(name: str) -> Derivation:
    if name in OWN:
        text = re.sub(r"\n\s+", " ", OWN[name]) if name != "swarm" else OWN[name]
        keys = r" (?=(?:group|solid|point|potential|input|body|parameters) = )"
        return walk(problem_of(tomllib.loads(f'name = "{name}"\n' + re.sub(keys, "\n", text))))
    return ready_made_record(name)


@cache
def figure(name: str) -> Scene:
    found = scene(record(name))
    assert found is not None
    return found


def changed(name: str, **problem: Any) -> Scene:
    d = record(name)
    found = scene(replace(d, problem={**d.problem, **problem}))
    assert found is not None
    return found


def alone(source: str) -> str:
    """A document with nothing but TikZ."""
    head = "\\documentclass{article}\n\\usepackage{tikz}\n\\begin{document}\n"
    return f"{head}{source}\n\\end{{document}}\n"


@pytest.mark.parametrize("name", sorted({*GENERAL, *STATED} - {*OF_INERTIA}))
def test_a_text_without_a_body_has_no_figure(name: str) -> None:
    assert scene(record(name)) is None


@pytest.mark.parametrize("name", ALL)
def test_a_figure(name: str) -> None:
    """It is well-formed and alone; all is in its frame, and labels are apart; it is a function of
    the record."""
    drawn, shown = figure(name), svg(figure(name))
    root = ElementTree.fromstring(shown)
    assert root.tag.endswith("}svg")
    assert root.get("role") == "img"
    assert root[0].tag.endswith("}title")
    assert [float(x) for x in root.get("viewBox", "").split()[:2]] == [0, 0]
    tags = {element.tag.split("}")[1] for element in root.iter()}
    assert tags <= {"svg", "title", "g", "path", "circle", "text", "tspan"}
    assert not any("id" in element.attrib or "href" in element.attrib for element in root.iter())
    assert "nan" not in shown
    # in the frame
    assert drawn.width >= WIDTH
    corners = [p for s in drawn.strokes for p in s.points]
    corners += [c for label in drawn.labels for c in (label.box[:2], label.box[2:])]
    corners += [
        (d.at[0] + s * d.radius, d.at[1] + s * d.radius) for d in drawn.dots for s in (1, -1)
    ]
    assert all(0 < x < drawn.width and 0 < y < drawn.height for x, y in corners)
    # labels apart
    for a, b in combinations(drawn.labels, 2):
        assert not overlap(a.box, b.box), (a.latex, b.latex)
    for label in drawn.labels:
        assert not any(overlap(label.box, (*d.at, *d.at)) for d in drawn.dots), label.latex
    # of the record
    again = scene(from_json(to_json(record(name))))
    assert again is not None
    assert svg(again) == shown
    assert tikz(again) == tikz(drawn)
    assert again.caption == drawn.caption


def test_tikz_compiles(tmp_path: Path) -> None:
    log = typeset(alone("\n\n".join(tikz(figure(name)) for name in ALL)), tmp_path)
    assert " ! " not in log
    assert "Missing character" not in log


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_are_printed_not_obeyed(name: str, tmp_path: Path) -> None:
    potentials = [
        {**p, "stiffness": ["par", name]} if p["kind"] == "spring" else p
        for p in record("ellipsoid").problem["potentials"]
    ]
    inputs = [{"kind": "force", "name": name, "on": 2, "frame": "body"}]
    drawn = changed("ellipsoid", title=name, potentials=potentials, inputs=inputs)
    product = changed("two_tops", group=f"{name} x {name}", title=name)
    for x in (drawn, product):
        root = ElementTree.fromstring(svg(x))
        assert not any("script" in element.tag for element in root.iter())
        assert r"\input" not in tikz(x)
        assert any(label.name for label in x.labels)
    assert "passwd" not in typeset(alone(tikz(drawn) + tikz(product)), tmp_path)


@pytest.mark.parametrize("value", [1e300, -1e300, 1e-300, 0.0, None])
def test_any_value_of_a_parameter_gives_a_figure(value: float | None) -> None:
    for name in ("ellipsoid", "sl3", "so3", "hammer", "top", "plane"):
        given = record(name).problem["parameters"]
        parameters = {k: {"default": value, "unit": "", "meaning": ""} for k in given}
        drawn = changed(name, parameters=parameters)
        places = [x for s in drawn.strokes for p in s.points for x in p]
        assert all(math.isfinite(x) and abs(x) < 400 for x in places)
        ElementTree.fromstring(svg(drawn))


def inked(drawn: Scene, pen: str, role: str = "body") -> float:
    """The length of what is drawn with a pen."""
    lines = [s.points for s in drawn.strokes if (s.pen, s.role) == (pen, role)]
    return sum(math.dist(a, b) for line in lines for a, b in pairwise(line))


def solid(kind: str, **sizes: Any) -> dict[str, Any]:
    return {"kind": kind, "density": 1, "sizes": sizes, "rotation": None, "shift": None}


def of_solids(*solids: dict[str, Any]) -> Scene:
    body = {**record("hammer").problem["body"], "solids": list(solids)}
    return changed("hammer", body=body)


def cuboid(*sides: int) -> dict[str, Any]:
    """A box as a mesh."""
    x, y, z = (s / 2 for s in sides)
    vertices = [[i * x, j * y, k * z] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    sheets = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [f for a, b, c, d in sheets for f in ([a, b, c], [a, c, d])]
    return solid("mesh", vertices=vertices, faces=faces)


@pytest.mark.parametrize("sides", [(1, 1, 1), (3, 1, 2), (1, 4, 1)])
def test_a_box_shows_nine_edges_as_its_mesh_does(sides: tuple[int, int, int]) -> None:
    box, mesh = of_solids(solid("box", sides=list(sides))), of_solids(cuboid(*sides))
    assert len([s for s in box.strokes if (s.role, s.pen) == ("body", "line")]) == 9
    assert len([s for s in box.strokes if (s.role, s.pen) == ("body", "hidden")]) == 3
    for pen in ("line", "hidden"):
        assert inked(mesh, pen) == pytest.approx(inked(box, pen), rel=0.05)


def test_a_ball_is_a_circle_half_of_whose_equator_is_hidden() -> None:
    drawn = of_solids(solid("ball", radius=1))
    (contour,) = [s for s in drawn.strokes if (s.role, s.pen) == ("body", "line")]
    x, y = (sum(p[i] for p in contour.points[1:]) / 64 for i in range(2))
    radii = [math.dist(p, (x, y)) for p in contour.points]
    assert max(radii) == pytest.approx(min(radii), rel=1e-6)
    assert inked(drawn, "hidden") == pytest.approx(inked(drawn, "thin"), rel=0.1)
    assert inked(drawn, "hidden", "axis") > 0  # within the ball


def test_what_is_behind_is_hidden() -> None:
    """A small ball inside a large one is all dashed; beside it, none of its contour is."""
    small, large = solid("ball", radius=0.2), solid("ball", radius=1)
    inside = of_solids(large, small)
    assert inked(inside, "line") == pytest.approx(inked(of_solids(large), "line"), rel=0.02)
    beside = of_solids(large, {**small, "shift": [0, 3, 0]})
    assert len([s for s in beside.strokes if (s.role, s.pen) == ("body", "line")]) == 2


def test_a_cone_seen_from_the_side_of_its_base_shows_the_whole_rim() -> None:
    assert not [s for s in figure("top").strokes if (s.role, s.pen) == ("body", "hidden")]


def test_a_fine_mesh_is_drawn_with_less() -> None:
    n, m = 90, 45
    vertices = [
        [math.sin(math.pi * j / m) * math.cos(2 * math.pi * i / n),
         math.sin(math.pi * j / m) * math.sin(2 * math.pi * i / n), math.cos(math.pi * j / m)]
        for j in range(m + 1) for i in range(n)
    ]  # fmt: skip
    corners = [(j * n + i, j * n + (i + 1) % n) for j in range(m) for i in range(n)]
    faces = [f for a, b in corners for f in ([a, a + n, b], [b, a + n, b + n])]
    drawn = of_solids(solid("mesh", vertices=vertices, faces=faces))
    ball = of_solids(solid("ball", radius=1))
    assert inked(drawn, "line") == pytest.approx(inked(ball, "line"), rel=0.1)


def strokes(drawn: Scene, role: str) -> list[Stroke]:
    return [s for s in drawn.strokes if s.role == role]


def test_what_is_drawn_for_which_problem() -> None:
    assert len(strokes(figure("sl3"), "spring")) == 6
    assert len([d for d in figure("sl3").dots if not d.ring]) == 4
    assert len(strokes(figure("comet"), "attraction")) == 3
    assert strokes(figure("ellipsoid"), "support")
    assert strokes(figure("ellipsoid"), "force")
    assert not strokes(figure("so4"), "gravity")
    (line, _) = strokes(figure("so3"), "gravity")
    assert line.points[0][1] > line.points[1][1]
    assert line.points[0][0] == pytest.approx(line.points[1][0])
    written = {label.latex for label in figure("ellipsoid").labels}
    assert {"e_{1}", "e_{2}", "e_{3}", "r_{1}", "r_{2}", r"\gamma", r"\mathsf{thrust}"} <= written
    assert {"e_{1}", "e_{2}"} <= {label.latex for label in figure("plane").labels}
    assert "e_{3}" not in {label.latex for label in figure("plane").labels}


def test_up_is_against_gravity() -> None:
    (line, _) = strokes(figure("mixture"), "gravity")
    (up,) = [label for label in figure("mixture").labels if label.latex == "e_{2}"]
    assert line.points[0][1] > line.points[1][1]
    assert up.at[1] == max(x.at[1] for x in figure("mixture").labels if x.base == "e")


def test_captions_say_what_the_drawing_does_not() -> None:
    def said(name: str) -> str:
        return " ".join(map(str, figure(name).caption))

    assert "Of the 4 coordinates the first three are drawn." in said("so4")
    assert "has a panel of its own" in said("two_tops")
    assert "The ring is the fixed origin." in said("so3")
    assert "ring" not in said("se3")
    assert "outline is free" in said("se3")
    assert "centre of attraction" in said("comet")
    assert "sample values" in said("plane")
    assert "sample values" not in said("so3")
    assert "the inertia of the Lagrangian for rotations alone" in said("rod")
    assert "Lagrangian" not in said("so3")


def test_the_ellipsoid_of_a_stated_inertia() -> None:
    """That of mass 1 has the moments I: ½ tr I − I = a²/5, a its half axes; that of a rod, of mass
    m, is thin, and along the third axis."""
    problem = record("charged_body").problem
    (part,) = parts_of_inertia(problem, ExpressionValues(problem))
    (solid,) = part.solids
    for k, column in enumerate(solid.sizes["map"]):
        assert column[k] ** 2 / 5 == pytest.approx((1.0 + 1.4 + 1.9) / 2 - (1.0, 1.4, 1.9)[k])
        assert not any(x for i, x in enumerate(column) if i != k)
    problem = record("rod").problem
    (part,) = parts_of_inertia(problem, ExpressionValues(problem))
    assert not part.fixed
    long = [math.hypot(*column) for column in part.solids[0].sizes["map"]]
    assert long[2] ** 2 / 5 == pytest.approx(1.5**2 / 12)
    assert long[:2] == pytest.approx([0.02 * long[2]] * 2)


def test_inertia_that_has_no_value_has_no_figure() -> None:
    d = record("euler_top")
    named = {name: {**x, "default": 0.0} for name, x in d.problem["parameters"].items()}
    assert scene(replace(d, problem={**d.problem, "parameters": named})) is None


def test_a_force_of_the_state_is_drawn_under_its_name() -> None:
    """At its place, as an input is; what has no name, or no place, is said not to be drawn."""
    drag = {"name": "drag", "on": 1, "frame": "body", "force": [1, 0, 0], "moment": []}
    bare = {"on": 2, "frame": "body", "force": [1, 0, 0], "moment": []}
    turning = {"name": "brake", "on": 2, "frame": "body", "force": [], "moment": [1, 0, 0]}
    loads = {"name": "loads", "covector": [0] * 3}

    def told(*forces: dict[str, Any]) -> tuple[str, bool]:
        drawn = changed("ellipsoid", forces=[*forces])
        return " ".join(map(str, drawn.caption)), any(x.base == "drag" for x in drawn.labels)

    caption, there = told(drag)
    assert there
    assert "The directions of the forces of the state are arbitrary." in caption
    assert "not drawn" not in caption.replace("Damping is not drawn.", "")
    for other in (bare, turning, loads):
        caption, there = told(drag, other)
        assert there
        assert "Forces of the state without a name are not drawn." in caption
        caption, there = told(other)
        assert not there
        assert "Forces of the state are not drawn." in caption
