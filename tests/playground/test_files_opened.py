"""Files that are chosen, or dropped on the page; the moments of a mesh, by derive's own reader of
meshes."""

import struct
import tomllib
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from derive.problem.mesh import mesh_moments
from tests.playground.test_moving import MOTION
from tests.support import in_node
from tests.support.played import PENDULUM
from tests.support.playground_site import text_in, walked

DROP = """([name, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text], name));
    const told = { dataTransfer: data, bubbles: true, cancelable: true };
    document.querySelector("#editor .cm-content").dispatchEvent(new DragEvent("drop", told));
}"""


def test_a_problem_file_is_opened(page):
    with page.expect_file_chooser() as asked:
        page.click("#open")
    file = {"name": "mine.toml", "mimeType": "text/plain", "buffer": PENDULUM.encode()}
    asked.value.set_files(file)
    page.wait_for_function("(x) => play.text.text === x", arg=PENDULUM)
    walked(page, "own")


def test_a_problem_file_is_dropped(page):
    text = PENDULUM.replace("default = 2", "default = 3")
    page.evaluate(DROP, ["mine.TOML", text])
    page.wait_for_function("(x) => play.text.text === x", arg=text)
    walked(page, "own")


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("cow.stl", "solid", "cow.stl: its triangles do not close up"),
        ("cow.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "do not close up"),
        ("run.npz", "", "derive plot run.npz"),
        ("so3.json", '{"problem": {}, "steps": []}', "derive check so3.json"),
        ("other.json", "{}", "ends in .toml"),
        ("notes.txt", "", "ends in .toml"),
    ],
)
def test_of_another_a_line_says_what_to_do(page, name, text, told):
    before = text_in(page)
    page.evaluate(DROP, [name, text])
    page.wait_for_function(
        "(x) => document.querySelector('#state').textContent.includes(x)", arg=told
    )
    assert text_in(page) == before


# ---- meshes

CORNERS = [(0, 0, 0), (4, 0, 1), (1, 2, 0), (5, 2, 1), (1, 0, 3), (5, 0, 4), (2, 2, 3), (6, 2, 4)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
"""A slanted box, whose numbers a float has; its sides with the outside outwards."""
FACES = [(a, *x) for a, *rest in SIDES for x in pairwise(rest)]
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
STL = [
    "facet normal 0 0 0\nouter loop\n"
    + "".join(f"vertex {x}.0 {y} {z:.1e}\n" for x, y, z in (CORNERS[k] for k in face))
    + "endloop\nendfacet\n"
    for face in FACES
]
BINARY = b"".join(
    struct.pack("<12fH", 0, 0, 0, *(x for k in face for x in CORNERS[k]), 0) for face in FACES
)
MESHES = {
    "obj": OBJ
    + "".join(f"f {' '.join(f'{k + 1}/7/2' for k in side)}  # a side\n" for side in SIDES),
    "obj back": OBJ + "".join(f"f {' '.join(str(k - 8) for k in side)}\r\n" for side in SIDES),
    "obj inside out": OBJ + "".join(f"f {a + 1} {c + 1} {b + 1}\n" for a, b, c in FACES),
    "off": f"OFF\n8 6 12\n{OBJ.replace('v ', '')}"
    + "".join(f"4 {' '.join(map(str, side))}\n" for side in SIDES),
    "stl": f"solid x\n{''.join(STL)}endsolid x\n",
    "stl binary": (b"solid" + b" " * 75 + struct.pack("<I", len(FACES)) + BINARY).decode("latin1"),
    "stl open": f"solid x\n{''.join(STL[1:])}endsolid x\n",
    "obj wrong": OBJ + "f 1 2 9\n",
    "off of nothing": "OFF\n0 0 0\n",
}


def test_the_moments_of_a_mesh():
    exact = mesh_moments([tuple(map(Fraction, x)) for x in CORNERS], FACES)
    call = """Object.entries(given).map(([name, text]) => moments(name.split(" ")[0],
        Uint8Array.from(text, (x) => x.charCodeAt(0)).buffer))"""
    found = in_node.told('import { moments } from "./src/mesh.js";', call, MESHES)
    for name, made in zip(MESHES, found, strict=True):
        if name in ("stl open", "obj wrong", "off of nothing"):
            assert made is None, name
            continue
        assert made["m"] == exact.m
        assert np.allclose(made["c"], np.array(exact.c, float), rtol=1e-13)
        assert np.allclose(made["J"], np.array(exact.J, float), rtol=1e-13)


def test_a_mesh_becomes_the_body(page):
    """Of the problem that stands there, of some density, which is a parameter."""
    page.evaluate("(x) => { play.text.text = x; }", PENDULUM)
    page.evaluate("delete document.body.dataset.walked")
    page.evaluate(DROP, ["box.STL", MESHES["stl"]])
    walked(page, "own")
    made = tomllib.loads(text_in(page))
    assert made["body"]["given"]["m"] == "22*rho"
    assert made["body"]["given"]["c"] == ["66*rho", "22*rho", "44*rho"]
    assert made["parameters"]["rho"]["default"] == 1000
    assert made["potential"] == tomllib.loads(PENDULUM)["potential"]
    assert "point" not in made
    assert not {"l", "m"} & {*made["parameters"]}
    assert made["name"] == "box"
    # it moves as it is, by its triangles; that is told, and can be undone
    page.wait_for_selector("iframe[data-moved]:not(.stale)", timeout=90_000)
    (part,) = page.frames[-1].evaluate(f"{MOTION}.scene.page.body.parts")
    (solid,) = part["solids"]
    assert len(solid["faces"]) == len(FACES)
    seen = {tuple(x) for x in solid["vertices"]}
    assert seen == {tuple(map(float, CORNERS[k])) for face in FACES for k in face}
    assert "box.STL" in page.inner_text("#taken")
    page.click("#taken button")
    walked(page, "own")
    assert text_in(page) == PENDULUM
    assert not page.is_visible("#taken")
