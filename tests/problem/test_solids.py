"""Solids: exact moments against slices, quadratures, textbooks and moved copies; mesh files."""

import math
import struct
import sys
from fractions import Fraction
from functools import reduce
from itertools import product
from pathlib import Path
from random import Random

import numpy as np
import pytest

from derive.check.trials.equimomental import slice_moments
from derive.check.values.arithmetic import EvaluationError
from derive.check.values.evaluate import Environment, evaluate
from derive.language import rational as q
from derive.language.tree import mul
from derive.problem.mesh import MeshError, mesh_moments, read
from derive.problem.problem import SolidError
from derive.problem.solids import joined_moments, moments, rotation_about, unit_moments
from derive.schema.body_kinds import SOLIDS
from tests.oracles.solids import nodes
from tests.support.needs import needs

needs_trimesh = needs("the module trimesh")
PLACED = {"density", "rotation", "shift"}
PLAIN = [kind for kind in SOLIDS if kind != "mesh"]
RHO, A, B, H, M, PHI = (("par", x) for x in ("rho", "a", "b", "h", "m", "phi"))
COS, SIN = ("fun", "cos", PHI), ("fun", "sin", PHI)


def made(kind, density, sizes, rotation=None, shift=None):
    if "file" in sizes:
        sizes = dict(zip(("vertices", "faces"), read(Path(sizes["file"])), strict=True))
    return SOLIDS[kind](density=density, rotation=rotation, shift=shift, **sizes)


def value(tree, names):
    """A tree over the given values of names, parameters and functions; fractions or floats."""
    if isinstance(tree, (int, Fraction)):
        return Fraction(tree)
    if tree in names:
        return names[tree]
    operator, *parts = tree
    if operator == "fun":
        return getattr(math, parts[0])(value(parts[1], names))
    if operator == "pow":
        return value(parts[0], names) ** parts[1]
    x, *rest = (value(part, names) for part in parts)
    for y in rest:
        x = {"add": lambda: x + y, "mul": lambda: x * y, "div": lambda: x / y}[operator]()  # noqa: B023
    return x


def values(found, names):
    rows = [[value(x, names) for x in row] for row in found.J]
    return value(found.m, names), [value(x, names) for x in found.c], rows


def lists(found):
    return found[0], list(found[1]), [list(row) for row in found[2]]


def size(random):
    return Fraction(random.randint(1, 40), random.randint(1, 12))


def random_sizes(kind, random):
    if kind == "hollow_ball":
        inner = size(random)
        return {"outer": inner + size(random), "inner": inner}
    if kind == "tetrahedron":
        return {"vertices": tuple(tuple(size(random) - 2 for _ in "xyz") for _ in range(4))}
    return {
        name: tuple(size(random) for _ in "xyz") if key.depth else size(random)
        for name, key in SOLIDS[kind].keys().items()
        if name not in (*PLACED, "quadric")
    }


def named(sizes):
    """The sizes as parameters, and their values."""
    values = {}

    def leaf(x):
        values["par", f"s{len(values)}"] = x
        return ("par", f"s{len(values) - 1}")

    def tree(x):
        return tuple(map(tree, x)) if isinstance(x, tuple) else leaf(x)

    return {name: tree(x) for name, x in sizes.items()}, values


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", PLAIN)
def test_against_slices(kind, seed):
    random = Random(f"{kind} {seed}")
    sizes, pi = random_sizes(kind, random), size(random)
    expected = lists(slice_moments(kind, sizes, pi))
    assert values(unit_moments(made(kind, 1, sizes)), {"π": pi}) == expected
    trees, names = named(sizes)
    found = values(unit_moments(made(kind, 1, trees)), names | {"π": pi})
    if kind == "tetrahedron" and found[0] < 0:
        trees["vertices"] = (*trees["vertices"][1::-1], *trees["vertices"][2:])
        found = values(unit_moments(made(kind, 1, trees)), names)
    assert found == expected
    env = Environment(3, {"π": pi}, parameters={name: x for (_, name), x in names.items()})
    again = unit_moments(made(kind, 1, trees)).J
    assert [[evaluate(x, env) for x in row] for row in again] == expected[2]


SIZES = {
    "ball": {"radius": 2},
    "box": {"sides": [1, 2, 3]},
    "ellipsoid": {"semi_axes": [1, 2, 3]},
    "cylinder": {"radius": 2, "height": 3},
    "cone": {"radius": 2, "height": 3},
    "hollow_ball": {"outer": 2, "inner": 1},
    "tetrahedron": {"vertices": [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 1]]},
}


@pytest.mark.parametrize("kind", PLAIN)
def test_against_numerical_integration(kind):
    w, r = nodes({"kind": kind} | SIZES[kind], {})
    mass, first, second = values(unit_moments(made(kind, 1, SIZES[kind])), {"π": math.pi})
    assert float(mass) == pytest.approx(w.sum(), rel=1e-12)
    assert [float(x) for x in first] == pytest.approx([*(r @ w)], abs=1e-12)
    assert np.array(second, float) == pytest.approx((r * w) @ r.T, rel=1e-12, abs=1e-12)


def test_trees_are_tidy():
    ball = unit_moments(made("ball", 1, {"radius": A}))
    assert ball.m == ("mul", Fraction(4, 3), "π", ("pow", A, 3))
    assert ball.J[0][0] == ("mul", Fraction(4, 15), "π", ("pow", A, 5))
    assert ball.J[0][1] == 0 == ball.c[2]
    assert moments(made("ball", RHO, {"radius": A})).m == (
        "mul",
        Fraction(4, 3),
        "π",
        RHO,
        ("pow", A, 3),
    )
    known_mass = moments(made("ball", ("div", M, ball.m), {"radius": A}))
    assert known_mass.m == M
    assert known_mass.J[2][2] == ("mul", Fraction(1, 5), M, ("pow", A, 2))
    assert unit_moments(made("cone", 1, {"radius": 1, "height": 6})).m == ("mul", 2, "π")
    sum_of_two = unit_moments(made("ball", 1, {"radius": ("add", A, B)}))
    assert sum_of_two.m == ("mul", Fraction(4, 3), "π", ("pow", ("add", A, B), 3))


def test_a_turned_ball_is_the_ball():
    still = moments(made("ball", RHO, {"radius": A}))
    for axis in ((0, 0, 1), (1, 1, 1), (1, -2, Fraction(1, 3))):
        assert moments(made("ball", RHO, {"radius": A}, rotation_about(axis, PHI))) == still
    shifted = moments(made("ball", RHO, {"radius": A}, rotation_about((1, 1, 1), PHI), (H, 0, 0)))
    assert shifted.c == (("mul", Fraction(4, 3), "π", H, RHO, ("pow", A, 3)), 0, 0)
    assert shifted.J[1:] == still.J[1:]


def test_rotation():
    turn = {COS: Fraction(3, 5), SIN: Fraction(4, 5)}
    for axis in ((1, 2, 2), (0, -3, 0), (Fraction(2, 7), Fraction(3, 7), Fraction(6, 7))):
        R = [[value(x, turn) for x in row] for row in rotation_about(axis, PHI)]
        assert q.times(R, q.transposed(R)) == q.identity(3)
        assert [sum(x * y for x, y in zip(row, axis, strict=True)) for row in R] == list(axis)
        assert q.trace(R) == 1 + 2 * turn[COS]
    quarter = ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    assert rotation_about((0, 0, 5), mul(Fraction(1, 2), "π")) == quarter
    assert rotation_about((0, 0, 1), mul(Fraction(-3, 2), "π")) == quarter
    assert rotation_about((3, 1, 2), 0) == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    assert rotation_about((0, 0, 1), PHI)[:2] == ((COS, mul(-1, SIN), 0), (SIN, COS, 0))
    third = rotation_about((1, 1, 1), mul(Fraction(2, 3), "π"))
    permuted = [[float(value(x, {"π": math.pi})) for x in row] for row in third]
    assert np.allclose(permuted, [[0, 0, 1], [1, 0, 0], [0, 1, 0]])


@pytest.mark.parametrize("kind", PLAIN)
def test_moved(kind):
    """ρ, R and s against the moments of the still solid; a tetrahedron against moved vertices."""
    random = Random(kind)
    sizes, pi, rho = random_sizes(kind, random), size(random), size(random)
    shift = tuple(size(random) - 1 for _ in range(3))
    rotation = rotation_about((1, 2, -2), PHI)
    names = {COS: Fraction(5, 13), SIN: Fraction(-12, 13), "π": pi, RHO: rho}
    found = values(moments(made(kind, RHO, sizes, rotation, shift)), names)
    R = [[value(x, names) for x in row] for row in rotation]
    s = tuple((x,) for x in shift)
    V, f, S = slice_moments(kind, sizes, pi)
    Rf = q.times(R, tuple((x,) for x in f))
    J = q.times(q.times(R, S), q.transposed(R))
    J = q.plus(J, q.plus(q.times(Rf, q.transposed(s)), q.times(s, q.transposed(Rf))))
    J = q.scaled(rho, q.plus(J, q.scaled(V, q.times(s, q.transposed(s)))))
    c = [rho * x[0] for x in q.plus(Rf, q.scaled(V, s))]
    assert found == (rho * V, c, [list(row) for row in J])
    if kind == "tetrahedron":
        at = [q.plus(q.times(R, tuple((x,) for x in v)), s) for v in sizes["vertices"]]
        moved = {"vertices": tuple(tuple(x for (x,) in v) for v in at)}
        assert found == values(moments(made(kind, rho, moved)), {})


@pytest.mark.parametrize("kind", PLAIN)
def test_turned_without_relations(kind):
    """J is R S R̄ for any values in the place of cos φ, sin φ and √3."""
    random = Random(kind)
    sizes, names = random_sizes(kind, random), {"π": Fraction(5)}
    names |= {COS: Fraction(7), SIN: Fraction(11), ("fun", "sqrt", 3): Fraction(13)}
    rotation = rotation_about((1, 1, 1), PHI)
    found = values(moments(made(kind, 1, sizes, rotation), relations=False), names)
    R = [[value(x, names) for x in row] for row in rotation]
    _, f, S = slice_moments(kind, sizes, names["π"])
    assert found[1] == [x for (x,) in q.times(R, [(x,) for x in f])]
    assert found[2] == [list(row) for row in q.times(q.times(R, S), q.transposed(R))]


def test_mixtures():
    ball = moments(made("ball", RHO, {"radius": A}))
    hole = moments(made("ball", mul(-1, RHO), {"radius": B}))
    names = {RHO: Fraction(5), A: Fraction(3), B: Fraction(2), "π": Fraction(3)}
    hollow = moments(made("hollow_ball", RHO, {"outer": A, "inner": B}))
    assert values(joined_moments(ball, hole), names) == values(hollow, names)
    halves = [made("box", 2, {"sides": (1, A, 3)}, None, (x, 0, 0)) for x in (0, 1)]
    whole = made("box", 2, {"sides": (2, A, 3)}, None, (Fraction(1, 2), 0, 0))
    assert joined_moments(*map(moments, halves)) == moments(whole)


def test_refused_axes():
    for axis in ((0, 0, 0), (1, 0), (A, 0, 0)):
        with pytest.raises(SolidError, match="three numbers, not all zero"):
            rotation_about(axis, PHI)
    with pytest.raises(EvaluationError, match="torus"):
        slice_moments("torus", {}, Fraction(3))
    with pytest.raises(EvaluationError, match="box"):
        slice_moments("box", {"sides": (1, 2)}, Fraction(3))


# meshes

CUBE = [tuple(Fraction(s, 10) for s in v) for v in product((-1, 1), (-2, 2), (-3, 3))]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
SIDES = {"sides": (Fraction(1, 5), Fraction(2, 5), Fraction(3, 5))}
OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
OCTANTS = [
    (x, 2 + y, 4 + z)[:: 1 if (x + y + z) % 2 == 0 else -1]
    for x, y, z in product(range(2), repeat=3)
]


def split(quads):
    return [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def off(vertices, faces):
    lines = ["OFF # a mesh", f"{len(vertices)} {len(faces)} 0", "# vertices"]
    lines += [" ".join(str(float(x)) for x in v) for v in vertices]
    return "\n".join([*lines, *(" ".join(map(str, (len(f), *f))) for f in faces)]).encode()


def obj(vertices, faces):
    lines = [
        "mtllib absent.mtl",
        "o thing",
        *(f"v {' '.join(str(float(x)) for x in v)}" for v in vertices),
    ]
    lines += ["vt 0 0", "vn 0 0 1", "usemtl red", "s off"]
    return "\r\n".join(
        [*lines, *("f " + " ".join(f"{k + 1}/1/1" for k in f) for f in faces)]
    ).encode()


def ascii_stl(vertices, faces):
    lines = ["solid thing"]
    for face in faces:
        lines += ["facet normal 0 0 0", "  outer loop"]
        lines += ["    vertex " + " ".join(f"{float(x):.9e}" for x in vertices[k]) for k in face]
        lines += ["  endloop", "endfacet"]
    return "\n".join([*lines, "endsolid thing", ""]).encode()


def binary_stl(vertices, faces):
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(float(x) for k in face for x in vertices[k]), 0)
        for face in faces
    )
    return b"solid but binary".ljust(80) + struct.pack("<I", len(faces)) + body


def written(tmp_path, data, name="thing.off"):
    path = tmp_path / name
    path.write_bytes(data)
    return path


FORMATS = {
    "quads.off": off(CUBE, QUADS),
    "triangles.off": off(CUBE, split(QUADS)),
    "coff.OFF": off(CUBE, QUADS).replace(b"OFF # a mesh\n", b"COFF "),
    "quads.obj": obj(CUBE, QUADS),
    "triangles.obj": obj(CUBE, split(QUADS)),
    "ascii.stl": ascii_stl(CUBE, split(QUADS)),
    "upper.STL": ascii_stl(CUBE, split(QUADS)).upper(),
    "parts.stl": ascii_stl(CUBE, split(QUADS[:3])) + ascii_stl(CUBE, split(QUADS[3:])),
}


@needs_trimesh
@pytest.mark.parametrize("name", FORMATS)
def test_cube_of_decimals(tmp_path, name):
    """0.1 is a tenth."""
    path = written(tmp_path, FORMATS[name], name)
    assert sorted(read(path)[0]) == sorted(CUBE)
    assert len(read(path)[1]) == 12
    found = moments(made("mesh", RHO, {"file": str(path)}, None, (H, 0, 0)))
    assert found == moments(made("box", RHO, SIDES, None, (H, 0, 0)))


@needs_trimesh
def test_cube_in_binary(tmp_path):
    wide = [tuple(10 * x for x in v) for v in CUBE]
    path = written(tmp_path, binary_stl(wide, split(QUADS)), "thing.stl")
    box = unit_moments(made("box", 1, {"sides": (2, 4, 6)}))
    assert mesh_moments(*read(path)) == box
    path = written(tmp_path, binary_stl(CUBE, split(QUADS)), "thing.stl")
    assert sorted(read(path)[0]) == sorted(CUBE)  # a tenth, no 0.10000000149
    fine = [tuple(x * Fraction("1.0000001") for x in v) for v in CUBE]
    path = written(tmp_path, binary_stl(fine, split(QUADS)), "thing.stl")
    assert np.float32(max(read(path)[0])[0]) == np.float32(0.10000001) != np.float32(0.1)


@needs_trimesh
def test_triangles_with_two_equal_vertices_are_left_out(tmp_path):
    again = [*CUBE, CUBE[0]]
    faces = [*split(QUADS), (0, 8, 1), (1, 0, 8), (8, 1, 0), (2, 2, 2)]
    assert len(read(written(tmp_path, off(again, faces)))[1]) == 12


@needs_trimesh
def test_octahedron(tmp_path):
    vertices, faces = read(written(tmp_path, off(OCTAHEDRON, OCTANTS)))
    found = mesh_moments(vertices, faces)
    assert (found.m, found.c) == (Fraction(4, 3), (0, 0, 0))
    assert (
        tuple(tuple(Fraction(2, 15) if i == j else 0 for j in range(3)) for i in range(3))
        == found.J
    )


@pytest.mark.parametrize("seed", range(3))
def test_meshes_against_fluxes_and_tetrahedra(seed):
    random = Random(seed)
    o = tuple(size(random) for _ in range(3))
    stretched = [(size(random), v) for v in OCTAHEDRON]
    points = [tuple(k * x + y for x, y in zip(v, o, strict=True)) for k, v in stretched]
    found = mesh_moments(points, OCTANTS)
    expected = slice_moments("mesh", {"vertices": points, "faces": OCTANTS}, Fraction(3))
    assert values(found, {}) == lists(expected)
    corners = [(o, *(points[k] for k in face)) for face in OCTANTS]
    parts = [unit_moments(made("tetrahedron", 1, {"vertices": c})) for c in corners]
    assert reduce(joined_moments, parts) == found


T = split(QUADS)
BAD = {
    "empty.off": (b"", "no OFF"),
    "empty.obj": (b"", "no faces"),
    "empty.stl": (b"", "no faces"),
    "points.off": (off(CUBE, []), "no faces"),
    "points.obj": (obj(CUBE, []), "no faces"),
    "zero.stl": (binary_stl(CUBE, []), "no faces"),
    "flat.off": (off(CUBE, [(0, 0, 1), (2, 2, 2)]), "no faces"),
    "hole.off": (off(CUBE, T[:-1]), r"a hole: the edge \(-0.1, .*\) – \(.*\) belongs to one"),
    "hole.stl": (ascii_stl(CUBE, T[:-1]), "a hole: the edge"),
    "thrice.off": (off(CUBE, [*T, T[0]]), "belongs to 3 triangles"),
    "flipped.off": (off(CUBE, [T[0][::-1], *T[1:]]), "disagree; orient all faces outwards"),
    "inside.obj": (obj(CUBE, [f[::-1] for f in T]), "inside-out.*: reverse the faces"),
    "flat.obj": (
        obj([(x, y, 0) for x, y, _ in OCTAHEDRON[:4]], [(0, 2, 1), (0, 1, 2)]),
        "without volume",
    ),
    "garbage.off": (Random(0).randbytes(5000), "no OFF"),
    "garbage.obj": (Random(1).randbytes(5000), "no faces"),
    "garbage.stl": (Random(2).randbytes(5000), "no faces"),
    "random.stl": (bytes(80) + struct.pack("<I", 40) + Random(3).randbytes(2000), "."),
    "nan.off": (off(CUBE, T).replace(b"-0.1 -0.2 -0.3", b"nan 0 0"), "not a finite number"),
    "inf.stl": (ascii_stl(CUBE, T).replace(b"1.000000000e-01", b"1e999"), "not a finite number"),
    "words.obj": (obj(CUBE, T).replace(b"v 0.1", b"v zero"), "not understood as OBJ"),
    "words.stl": (ascii_stl(CUBE, T).replace(b"1.000000000e-01", b"zero"), "not understood as STL"),
    "two.obj": (b"v 1 2\nv 3 4 5\nf 1 2 2\n", "a vertex is not three numbers"),
    "two.stl": (ascii_stl(CUBE, T).replace(b" 1.000000000e-01 ", b" ", 1), "three numbers"),
    "negative.obj": (obj(CUBE, T) + b"\nf -1 -2 -3\n", "lists of indices from 1"),
    "none.obj": (obj(CUBE, T) + b"\nf 0 1 2\n", "lists of indices from 1"),
    "beyond.obj": (obj(CUBE, [*T, (1, 2, 99)]), "not understood as OBJ"),
    "beyond.off": (off(CUBE, [*T, (1, 2, 99)]), "not understood as OFF"),
    "cut.off": (off(CUBE, T)[:150], "."),
    "counts.off": (b"OFF 999999999 999999999 0\n", "more than 40000 triangles"),
    "polygon.off": (b"OFF 1 1 0\n0 0 0\n99999999 0\n", "more than 40000 triangles"),
    "polygon.obj": (b"v 0 0 0\nf" + b" 1" * 200003, "more than 40000 triangles"),
    "many.stl": (bytes(80) + struct.pack("<I", 200001) + bytes(50 * 200001), "more than 40000"),
    "many.obj": (b"v 0 0 0\n" + b"f 1 1 1\n" * 200001, "more than 40000 triangles"),
    "lines.obj": (b"\n" * 2_000_001, "more than 2000000 lines"),
    "long.off": (b"OFF 1 1 0\n" + b"1 " * 20_000, "a line of more than 20000 characters"),
    "sizes.obj": (
        obj(
            [(1, 0, 0), (0, 1e-90, 0), (0, 0, 1), (0, 0, 0)],
            [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)],
        ),
        "too different sizes",
    ),
    "thing.ply": (b"ply\n", "ends in .obj, .off, .stl"),
    "thing": (b"", "ends in .obj, .off, .stl"),
}


@needs_trimesh
@pytest.mark.parametrize("name", BAD)
def test_bad_meshes(tmp_path, name, recwarn):
    data, message = BAD[name]
    path = written(tmp_path, data, name)
    with pytest.raises(MeshError, match=message) as caught:
        read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
    assert not recwarn


def test_files_that_are_none(tmp_path):
    (tmp_path / "folder.stl").mkdir()
    with (tmp_path / "large.stl").open("wb") as file:
        file.truncate(50_000_001)
    for name, message in {
        "absent.stl": "No such file",
        "folder.stl": "not a file",
        "large.stl": "larger than 50000000 bytes",
        "nul\0.stl": "null",
    }.items():
        with pytest.raises(MeshError, match=message):
            read(tmp_path / name)


@needs_trimesh
def test_nothing_else_is_opened(tmp_path, monkeypatch):
    (tmp_path / "absent.mtl").write_text("newmtl red\nmap_Kd secret.png\n")
    path = written(tmp_path, obj(CUBE, QUADS), "thing.obj")
    read(path)
    opened = []
    monkeypatch.setattr("builtins.open", lambda *args, **_: opened.append(args))
    assert len(read(path)[1]) == 12
    assert opened == []


def test_without_the_library(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    path = written(tmp_path, off(CUBE, QUADS))
    with pytest.raises(MeshError, match="pip install trimesh"):
        moments(made("mesh", RHO, {"file": str(path)}))


def test_an_ellipsoid_by_its_matrix_has_its_inverse_as_moments():
    """J = m/5 Q⁻¹, also off the diagonal."""
    Q = ((4, 1, 0), (1, 2, Fraction(-1, 2)), (0, Fraction(-1, 2), 1))
    found = moments(made("ellipsoid", 3, {"quadric": Q}))
    m, *J = (value(x, {"π": math.pi}) for x in (found.m, *(x for row in found.J for x in row)))
    matrix = np.array(Q, float)
    assert m == pytest.approx(3 * 4 / 3 * math.pi / math.sqrt(np.linalg.det(matrix)))
    assert np.reshape(J, (3, 3)) == pytest.approx(m / 5 * np.linalg.inv(matrix))
