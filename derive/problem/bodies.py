"""The body of a problem file: points, moments as parameters or given, solids and their mixtures."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from pathlib import Path
from typing import Any

from ..algebra.groups import Group
from ..language import rational as q
from ..language.derivatives import product, quotient
from ..language.laurent import OverlongError, collected
from ..language.limits import TEXT
from ..language.tree import Tree, add, mul, neg
from ..language.values import approximate
from ..schema.solid_kinds import SOLIDS
from .fields import block, choice, expression, known, missing, tables, vector
from .moments import Moments, SolidError
from .problem import Body, GivenBody, MomentBody, PointBody, ProblemError
from .solids import Solid, moments, rotation_about, together

FIRST, SECOND = ("c", "centre"), ("J", "I", "I_centre")
MEANINGS = {
    "c": "the first moment, mass times centre of mass",
    "centre": "the centre of mass",
    "J": "the matrix of moments about the origin",
    "I": "the tensor of inertia about the origin",
    "I_centre": "that about the centre of mass",
}
"""How a body's first and second moments are given; I in R³ alone."""

PLACING = {"density", "rotation", "shift"}


def body(data: Mapping[str, Any], moved: Group | None, folder: Path) -> Body | None:
    """The body of a file; ``folder``: where its mesh files are looked for."""
    masses, solids = tables(data, "point"), tables(data, "solid")
    table = data.get("body")
    if moved is None:
        if masses or solids or table is not None:
            raise ProblemError("a text about any group has no body of its own; leave it out")
        return None
    points = _points(masses, moved)
    if table is None and not solids:
        return points
    if table is not None and (not isinstance(table, dict) or solids):
        raise ProblemError("give either one table [body] or the tables [[solid]]")
    if moved.factors:
        what = "a product" if len(moved.factors) > 1 else "an affine group given by a basis"
        raise ProblemError(f"body: {what} moves [[point]] tables alone, no solids and no moments")
    if table is not None and "solid" not in table:
        if points:
            raise ProblemError("give either [[point]] tables or moments in [body]")
        return _moments(table, moved.n)
    if moved.n != 3:
        raise ProblemError(f"a solid is in R^3, and {moved.name} moves points of R^{moved.n}")
    if table is not None:
        for key in ("moments", "given"):
            if key in table:
                raise ProblemError(f"body: give either 'solid' or {key!r}")
        choice(table, "solid", tuple(SOLIDS), "body")
        listed: dict[str, Mapping[str, Any]] = {
            "body": {"kind" if k == "solid" else k: x for k, x in table.items()}
        }
    else:
        listed = {f"solid {k}": s for k, s in enumerate(solids, 1)}
    return _mixture({where: _solid(s, where, folder) for where, s in listed.items()}, points)


def _points(listed: list[Mapping[str, Any]], moved: Group) -> PointBody | None:
    masses, positions, blocks = [], [], []
    for k, p in enumerate(listed, 1):
        where = f"point {k}"
        known(p, {"mass", "at", "block"}, where)
        blocks.append(block(p, moved, where))
        masses.append(expression(missing(p, "mass", where), f"{where}, mass"))
        n = moved.places[blocks[-1] - 1][1].n
        positions.append(vector(missing(p, "at", where), n, f"{where}, at"))
    return PointBody(tuple(masses), tuple(positions), tuple(blocks)) if masses else None


def _moments(table: Mapping[str, Any], n: int) -> Body:
    """Moments as parameters, or given as expressions."""
    known(table, {"moments", "given", "solid"}, "body")
    if "given" not in table:
        choice(table, "moments", ("symbolic",), "body")
        return MomentBody(n)
    given = table["given"]
    if not isinstance(given, dict) or "moments" in table:
        raise ProblemError('body: give either moments = "symbolic" or given = { m, c, J }')
    where = "body, given"
    known(given, {"m", *FIRST, *SECOND}, where)
    mass = expression(missing(given, "m", where), f"{where}, m")
    named = _one_of(given, FIRST, where)
    first = vector(given[named], n, f"{where}, {named}")
    if named == "centre":
        first = tuple(_exact(product(mass, x)) for x in first)
    name = _one_of(given, SECOND if n == 3 else SECOND[:1], where)
    rows = given[name]
    if not isinstance(rows, list) or len(rows) != n:
        raise ProblemError(f"{where}, {name}: expected a list of {n} rows")
    J = tuple(vector(row, n, f"{where}, {name}, row {i}") for i, row in enumerate(rows, 1))
    if any(J[i][j] != J[j][i] for i in range(n) for j in range(i)):
        raise ProblemError(f"{where}, {name}: the matrix must be symmetric")
    if name != "J":
        J = _from_inertia(J)
    if name == "I_centre":
        J = _from_centre(J, mass, first, where)
    return GivenBody(mass, first, J)


def _one_of(given: Mapping[str, Any], names: tuple[str, ...], where: str) -> str:
    """The one key of some that is there."""
    found = [x for x in names if x in given]
    if len(found) != 1:
        listed = ", or ".join(f"{x}, {MEANINGS[x]}" for x in names)
        raise ProblemError(f"{where}: give {'one of ' * (len(names) > 1)}{listed}")
    return found[0]


def _from_inertia(tensor: tuple[tuple[Tree, ...], ...]) -> tuple[tuple[Tree, ...], ...]:
    """J = ½ (Tr I) 1 − I, from I = (Tr J) 1 − J."""
    span = range(3)
    half = [_half(*(tensor[j][j] for j in span if j != i), neg(tensor[i][i])) for i in span]
    return tuple(tuple(half[i] if i == j else neg(tensor[i][j]) for j in span) for i in span)


def _from_centre(
    J: tuple[tuple[Tree, ...], ...], mass: Tree, first: tuple[Tree, ...], where: str
) -> tuple[tuple[Tree, ...], ...]:
    """J + c c̄/m, from J about the centre of mass (Steiner)."""
    if mass == 0:
        raise ProblemError(f"{where}, m: a body without mass has no centre of mass")

    def entry(i: int, j: int) -> Tree:
        return _exact(add(J[i][j], quotient(product(first[i], first[j]), mass)))

    span = range(len(first))
    return tuple(tuple(entry(min(i, j), max(i, j)) for j in span) for i in span)


def _exact(t: Tree) -> Tree:
    """The same with like terms added, a number where it is one."""
    try:
        found = collected(t)
    except OverlongError:
        raise ProblemError(
            "body, given: centre or I_centre is too long to be carried to the origin; give c and I "
            "or J, or a parameter of its own for each sum"
        ) from None
    return int(found) if isinstance(found, Fraction) and found.denominator == 1 else found


def _half(*terms: Tree) -> Tree:
    """½ Σ, a number where all terms are."""
    numbers = [x for x in terms if isinstance(x, (int, Fraction))]
    if len(numbers) < len(terms):
        return collected(mul(Fraction(1, 2), add(*terms)))
    total = Fraction(sum(numbers), 2)
    return int(total) if total.denominator == 1 else total


def _solid(data: Mapping[str, Any], where: str, folder: Path) -> Solid:
    kind = choice(data, "kind", tuple(SOLIDS), where)
    known(data, {"kind", *PLACING, *SOLIDS[kind]}, where)
    sizes: dict[str, Any] = {}
    for key, shape in SOLIDS[kind].items():
        value, place = missing(data, key, where), f"{where}, {key}"
        if shape is None:
            sizes[key] = _file(value, place, folder)
        elif shape == ():
            sizes[key] = _positive(expression(value, place), place, zero=key == "inner")
        elif len(shape) == 1:
            whole_sizes = vector(value, shape[0], place)
            sizes[key] = tuple(_positive(x, place) for x in whole_sizes)
        else:
            if not isinstance(value, list) or len(value) != shape[0]:
                raise ProblemError(f"{place}: expected a list of {shape[0]} points")
            sizes[key] = tuple(vector(x, shape[1], place) for x in value)
    density = expression(missing(data, "density", where), f"{where}, density")
    turned = rotation(data["rotation"], 3, f"{where}, rotation") if "rotation" in data else None
    shift = vector(data["shift"], 3, f"{where}, shift") if "shift" in data else None
    try:
        mesh = _mesh(Path(sizes["file"])) if kind == "mesh" else None
    except SolidError as error:
        raise ProblemError(f"{where}: {error}") from None
    return Solid(kind, density, sizes, turned, shift, mesh)


def _mesh(path: Path) -> Any:
    """A mesh, read by what needs NumPy."""
    from .mesh import read

    return read(path)


def _positive(size: Tree, where: str, zero: bool = False) -> Tree:
    """A length: a number must be positive."""
    value = approximate(size, {})
    if value is not None and (value < 0 or (value == 0 and not zero)):
        raise ProblemError(f"{where}: a length that is not positive")
    return size


def _file(value: Any, where: str, folder: Path) -> str:
    """The path of a mesh, inside the folder of the problem file."""
    if not isinstance(value, str) or not value or not value.isprintable() or len(value) > TEXT:
        raise ProblemError(f"{where}: expected a file name in quotes, of letters that print")
    try:
        path = (folder / value).resolve()
    except (OSError, RuntimeError):  # a link to itself
        raise ProblemError(f"{where}: {value[:60]!r} leads nowhere") from None
    if not path.is_relative_to(folder.resolve()):
        raise ProblemError(f"{where}: {value[:60]!r} is outside the folder of the problem file")
    return str(path)


def rotation(value: Any, n: int, place: str) -> tuple[tuple[Tree, ...], ...]:
    """{ axis, angle } in R³, or a matrix of numbers that is a rotation of Rⁿ."""
    if isinstance(value, dict) and n == 3:
        known(value, {"axis", "angle"}, place)
        axis = vector(missing(value, "axis", place), 3, f"{place}, axis")
        angle = expression(missing(value, "angle", place), f"{place}, angle")
        try:
            return rotation_about(axis, angle)
        except SolidError as error:
            raise ProblemError(f"{place}: {error}") from None
    turning = "{ axis, angle } or " if n == 3 else ""
    if not isinstance(value, list) or len(value) != n:
        raise ProblemError(f"{place}: expected {turning}a list of {n} rows")
    if not all(isinstance(row, list) for row in value):
        other = ", or { axis, angle }" if n == 3 else ""
        raise ProblemError(f"{place}: expected {n} rows of {n} numbers{other}")
    rows = tuple(vector(row, n, place) for row in value)
    if not all(isinstance(x, (int, Fraction)) for row in rows for x in row):
        other = "; else give { axis, angle }" if n == 3 else ""
        raise ProblemError(f"{place}: the entries must be numbers{other}")
    R = tuple(tuple(Fraction(str(x)) for x in row) for row in rows)
    off = q.minus(q.times(R, q.transposed(R)), q.identity(n))
    if max(abs(x) for x in q.flatten(off)) > Fraction(1, 10**6):
        exact = "; { axis, angle } is exact" if n == 3 else ""
        raise ProblemError(f"{place}: the rows are not orthogonal unit vectors{exact}")
    if q.determinant(R) < 0:
        raise ProblemError(f"{place}: a reflection; change the sign of one row")
    return rows


def _mixture(solids: Mapping[str, Solid], points: PointBody | None) -> GivenBody:
    """The moments of solids, each under its place in the file, and points together."""
    parts = []
    for where, solid in solids.items():
        try:
            parts.append(moments(solid, relations=False))
        except SolidError as error:
            raise ProblemError(f"{where}: {error}") from None
    total = reduce(together, parts)
    own = total if points is None else together(total, _of_points(points))
    return GivenBody(own.mass, own.first, own.second, points, tuple(solids.values()))


def _of_points(body: PointBody) -> Moments:
    pairs = list(zip(body.masses, body.positions, strict=True))
    span = range(3)
    return Moments(
        add(*body.masses),
        tuple(add(*(mul(m, r[i]) for m, r in pairs)) for i in span),
        tuple(tuple(add(*(mul(m, r[i], r[j]) for m, r in pairs)) for j in span) for i in span),
    )
