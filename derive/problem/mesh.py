"""Closed triangle meshes: OFF, OBJ and STL read through trimesh, checked; their exact moments."""

from __future__ import annotations

import importlib
import re
import warnings
from collections.abc import Iterator, Sequence
from decimal import Decimal
from fractions import Fraction
from io import BytesIO
from math import lcm
from pathlib import Path
from typing import Any

import numpy as np

from ..language.limits import COORDINATE_BITS, MESH_BYTES, MESH_LINE, MESH_LINES, TRIANGLES
from ..language.tree import mul
from ..schema.body_kinds import Moments
from .problem import SolidError

Mesh = tuple[tuple[tuple[Fraction, ...], ...], tuple[tuple[int, ...], ...]]

NUMBERS = rb"[ \t]+(\S+[ \t]+\S+[ \t]+\S+)"
AGAIN = "export the mesh again"


class MeshError(SolidError):
    """What is wrong with a mesh file, and the remedy, in one line."""


def read(path: Path) -> Mesh:
    """The mesh of a file: vertices, three exact coordinates each; faces, three indices from 0 each.

    A decimal number of up to 15 digits is itself, a longer one the shortest decimal of its double;
    a binary one, of 32 bits, the shortest decimal that has them: 0.1 is a tenth. Equal vertices are
    one; a triangle with two of them is left out.
    :class:`MeshError` unless they close up, oriented outwards; crossings are not looked for.
    """
    try:
        return _read(path)
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from None


def mesh_moments(vertices: Sequence[Sequence[Fraction]], faces: Sequence[Sequence[int]]) -> Moments:
    """The moments of density 1, sums over the tetrahedra from the origin to the faces.

    With their signs: those of 0abc, with D = det(a, b, c) and s = a + b + c, are D/6, D s/24 and D
    (a ā + b b̄ + c c̄ + s s̄)/120.
    """
    scale = lcm(*{x.denominator for v in vertices for x in v})
    p = [tuple(x.numerator * (scale // x.denominator) for x in v) for v in vertices]
    at = [0] * len(p)  # Σ D of the faces at each vertex

    def weighted() -> Iterator[tuple[int, tuple[int, ...]]]:
        for i, j, k in faces:
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = p[i], p[j], p[k]
            D = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
            at[i], at[j], at[k] = at[i] + D, at[j] + D, at[k] + D
            yield D, (ax + bx + cx, ay + by + cy, az + bz + cz)
        yield from zip(at, p, strict=True)

    xx = xy = xz = yy = yz = zz = 0
    for w, (x, y, z) in weighted():
        wx, wy = w * x, w * y
        xx, xy, xz = xx + wx * x, xy + wx * y, xz + wx * z
        yy, yz, zz = yy + wy * y, yz + wy * z, zz + w * z * z
    first = [sum(w * v[i] for w, v in zip(at, p, strict=True)) for i in range(3)]
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    return Moments(
        m=mul(Fraction(sum(at), 18 * scale**3)),
        c=tuple(mul(Fraction(x, 24 * scale**4)) for x in first),
        J=tuple(tuple(mul(Fraction(x, 120 * scale**5)) for x in row) for row in rows),
    )


def _must(holds: bool, otherwise: str) -> None:
    """``MeshError(otherwise)`` unless it holds."""
    if not holds:
        raise MeshError(otherwise)


def _limit(count: int) -> None:
    """``MeshError`` for no faces, or for more than TRIANGLES."""
    _must(count > 0, "no faces")
    _must(count <= TRIANGLES, f"more than {TRIANGLES} triangles; simplify the mesh")


def _read(path: Path) -> Mesh:
    suffix = path.suffix.lower()
    _must(suffix in PREPARED, f"the name of a mesh ends in {', '.join(PREPARED)}")
    try:
        _must(path.is_file() or not path.exists(), "not a file")
        with path.open("rb") as file:
            raw = file.read(MESH_BYTES + 1)
    except (OSError, ValueError) as error:
        raise MeshError(getattr(error, "strerror", None) or str(error)) from None
    _must(len(raw) <= MESH_BYTES, f"larger than {MESH_BYTES} bytes; simplify the mesh")
    binary = suffix == ".stl" and len(raw) == 84 + 50 * int.from_bytes(raw[80:84], "little")
    data, count = raw, (len(raw) - 84) // 50
    if not binary:
        text = b"\n" + raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n").replace(b"\\\n", b" ")
        _must(text.count(b"\n") <= MESH_LINES, f"more than {MESH_LINES} lines; simplify the mesh")
        data, count = PREPARED[suffix](text)
    _limit(count)
    points, faces = _load(data, suffix[1:])
    values, places = np.unique(points, return_inverse=True)  # equal coordinates, equal vertices
    x, y, z = places.reshape(-1, 3).T
    _, some, index = np.unique((x * len(values) + y) * len(values) + z, True, True)
    places, (a, b, c) = places.reshape(-1, 3)[some], index[faces].T
    faces = index[faces][(a != b) & (b != c) & (c != a)]
    _limit(len(faces))
    written = values.astype(np.float32) if binary else values.tolist()
    exact = [Fraction(*Decimal(str(x)).as_integer_ratio()) for x in written]
    largest = max(abs(exact[0]), abs(exact[-1])) * lcm(*{x.denominator for x in exact})
    _must(largest < 2**COORDINATE_BITS, "coordinates of too different sizes; round them")
    _closed(values[places], faces)
    vertices = tuple((exact[i], exact[j], exact[k]) for i, j, k in places.tolist())
    return vertices, tuple(map(tuple, faces.tolist()))


def _obj(text: bytes) -> tuple[bytes, int]:
    """An OBJ of vertices and faces alone, without textures and normals; how many triangles."""
    points, faces = re.findall(rb"\nv" + NUMBERS, text), re.findall(rb"\nf([ \t].*)", text)
    sound = len(points) == len(re.findall(rb"\nv[ \t]", text))
    _must(sound, f"a vertex is not three numbers; {AGAIN}")
    _limit(max(len(faces), len(points) // 3, 1))
    indices = re.sub(rb"/[^ \t\n]*", b"", b"\nf".join((b"", *faces)))
    sound = len(indices) <= 40 * TRIANGLES and not re.search(rb"[^0-9f \t\n]|[ \t]0", indices)
    _must(sound, f"the faces are not short lists of indices from 1; {AGAIN}")
    return b"\nv ".join((b"", *points)) + indices, len(indices.split()) - 3 * len(faces)


def _off(text: bytes) -> tuple[bytes, int]:
    """An OFF without comments, and how many triangles it has."""
    lines = [x for x in re.sub(rb"#[^\n]*", b"", text).split(b"\n") if x and not x.isspace()]
    _must(
        max(map(len, lines), default=0) <= MESH_LINE, f"a line of more than {MESH_LINE} characters"
    )
    text = b"\n".join(lines).lstrip()
    header = re.match(rb"C?OFF\s+(\d{1,9})\s+(\d{1,9})\b", text)
    if header is None:
        raise MeshError(f"no OFF with the numbers of vertices and faces at the start; {AGAIN}")
    start, faces = header[0].count(b"\n") + 1 + int(header[1]), int(header[2])
    _limit(max(faces, int(header[1]) // 3))
    corners = [x.split(None, 1)[0] for x in lines[start : start + faces]]
    sound = all(x.isdigit() and len(x) < 9 for x in corners)
    _must(sound, f"a face does not start with the number of its vertices; {AGAIN}")
    return text, sum(int(x) - 2 for x in corners)


def _stl(text: bytes) -> tuple[bytes, int]:
    """An STL of its corners alone, and how many triangles it has."""
    corners = re.findall(rb"vertex" + NUMBERS, text := text.lower())
    sound = len(corners) == 3 * text.count(b"endfacet")
    _must(sound, f"a facet is not three vertices of three numbers; {AGAIN}")
    return b"\nvertex ".join((b"solid", *corners)) + b"\nendsolid", len(corners) // 3


PREPARED = {".obj": _obj, ".off": _off, ".stl": _stl}


def _load(data: bytes, kind: str) -> tuple[Any, Any]:
    """Points and faces as trimesh reads them; ``MeshError`` where it cannot."""
    try:
        trimesh = importlib.import_module("trimesh")
    except ImportError:
        raise MeshError("reading a mesh needs trimesh: pip install trimesh") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", message="string or file could not be read")
            m = trimesh.load(BytesIO(data), kind, force="mesh", process=False, skip_materials=True)
        points, faces = np.array(m.vertices), np.array(m.faces, dtype=np.int64)
        _must(points.shape[1] == 3 and 0 <= faces.min() <= faces.max() < len(points), "indices")
    except Exception:  # whatever the library makes of a damaged file
        raise MeshError(f"not understood as {kind.upper()}; {AGAIN}") from None
    _must(bool(np.isfinite(points).all()), f"a coordinate is not a finite number; {AGAIN}")
    return points, faces


def _closed(points: Any, faces: Any) -> None:
    """``MeshError`` unless edges run once each way, and the volume is positive."""

    def unlike(a: Any, b: Any, expected: int) -> tuple[int, str]:
        edges, counts = np.unique(a * len(points) + b, return_counts=True)
        for k in np.flatnonzero(counts != expected)[:1]:
            ends = (points[i].tolist() for i in divmod(int(edges[k]), len(points)))
            return int(counts[k]), " – ".join(f"({x:g}, {y:g}, {z:g})" for x, y, z in ends)
        return 0, ""

    a, b = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    count, edge = unlike(np.minimum(a, b), np.maximum(a, b), 2)
    _must(count != 1, f"a hole: the edge {edge} belongs to one triangle; fill it")
    _must(count == 0, f"the edge {edge} belongs to {count} triangles; separate what touches there")
    count, edge = unlike(a, b, 1)
    _must(count == 0, f"the triangles at the edge {edge} disagree; orient all faces outwards")
    x, y, z = (points[k] - points.mean(axis=0) for k in faces.T)
    parts = np.einsum("ij,ij->i", x, np.cross(y, z))
    sound = parts.sum() > 1e-12 * np.abs(parts).sum()
    _must(sound, "inside-out, or without volume: reverse the faces, to be oriented outwards")
