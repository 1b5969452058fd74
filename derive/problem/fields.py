"""The tables of a problem file as TOML has them, and the names of the state in expressions."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cache
from typing import Any

from ..algebra.groups import Group, names_by_block
from ..language.expression import LATEX
from ..language.limits import TABLES
from ..language.rational import Matrix, identity, matrix
from ..language.reserved import by_letter, suffixed
from ..language.tree import Tree, add, mul, neg, plain
from ..schema.kind import SECTIONS, Advected
from ..schema.table import nearest
from .problem import Problem, ProblemError

LIKE_A_PLACE = re.compile(r"[rv][0-9]+_\w+")


def tables(data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The tables of an array [[key]]; not more than their limit."""
    tables = data.get(key, [])
    if not isinstance(tables, list) or not all(isinstance(t, dict) for t in tables):
        raise ProblemError(f"key {key!r} must be written [[{key}]]")
    most = TABLES[key]
    if len(tables) > most:
        more = "; give their moments in [body]" if key == "point" else ""
        raise ProblemError(f"more than {most} tables [[{key}]]{more}")
    return tables


def named_tables(data: Mapping[str, Any], *keys: str) -> dict[str, Mapping[str, Any]]:
    """Those of some arrays by what messages call them, as "force 2"."""
    return {f"{key} {k}": x for key in keys for k, x in enumerate(tables(data, key), 1)}


TOLD = ("name", "title", "kind", "unit", "meaning")
"""Keys that have no expression."""


def used_at(data: Mapping[str, Any], name: str, *but: str) -> str:
    """The first table and key, but some, in which a name stands, as other messages say it."""
    word = re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])")
    for kind in (*TABLES, "body", *SECTIONS):
        listed = isinstance(data.get(kind), list)
        for k, table in enumerate(data[kind] if listed else [data.get(kind, {})], 1):
            for key, value in table.items():
                if key not in (*but, *TOLD) and word.search(str(value)):
                    return f"{kind} {k}, key {key!r}" if listed else f"{kind}, key {key!r}"
    return "file"


# The names of the state in an expression of a Lagrangian, as the emitted code has them.

LIKE_AN_ENTRY = re.compile(r"A[0-9]*_([1-9]{2}|[0-9]+_[0-9]+)|(T|zeta)[0-9]*_[1-9][0-9]*")
"""What an entry of the state of some group is called."""


def no_entry(name: str, group: Group, known: Mapping[str, Tree]) -> str:
    """That a state with the ``known`` names has none of this name, in words, where it is like that
    of an entry; "" for any other."""
    if not LIKE_AN_ENTRY.fullmatch(name):
        return ""
    on_group = any(isinstance(t, tuple) and t[1] == "A" for t in known.values())
    whose = group.name if on_group else "the state of this algebra"
    return f"{whose} has no {name[:40]}; its entries are {entries(_with_blocks(known, group))}"


def _with_blocks(known: Iterable[str], group: Group) -> list[str]:
    """The names of a state, and in a product those of the velocity by its blocks."""
    return [*known, *names_by_block(group).values()]


def entries(known: Iterable[str]) -> str:
    """The names of a state in words: the first and the last of each letter."""
    runs = by_letter(x for x in known if x != "t").values()
    ends = (dict.fromkeys((run[0], run[-1])) for run in runs)
    return ", ".join(map(" … ".join, ends))


def undeclared(
    name: str, where: str, parameters: Collection[str], group: Group, known: Mapping[str, Tree]
) -> str:
    """That a name in an expression of a Lagrangian is neither a parameter nor of the state, in
    words."""
    if name in known:
        return f"{where}: {name!r} is of the state, which is not known there"
    if fault := no_entry(name, group, known):
        return f"{where}: {fault}"
    hint = called_here(name[:40], known, group, parameters, ".").removeprefix("; ")
    other = f"{hint} Else " if hint else ""
    return (
        f"{where}: {name[:40]!r} is not declared; {other}add it to [parameters]; the state has "
        f"{entries(_with_blocks(known, group))}"
    )


def by_points(group: Group) -> dict[str, str]:
    """The velocities of translations → what points call them, w; none without them, or of a
    product, which calls them by its blocks."""
    (_, group), *others = group.places
    turns = group.dimension - group.n
    span = range(1, group.n + 1) if group.free_translations and not others else ()
    return {suffixed("zeta", turns + i): suffixed("w", i) for i in span}


def called_here(
    name: str,
    known: Collection[str],
    group: Group | None,
    others: Collection[str] = (),
    end: str = "",
) -> str:
    """``; w_1 is zeta_4 here`` and an ``end``, where a velocity has another of the ``known`` names,
    or in a product such by its blocks, w1_1 or w2_1; else which of the ``others`` is nearest, or of
    the names by blocks."""
    zeta = [x for x in known if x.startswith("zeta_")] if group else []
    blocks = [x for a, x in names_by_block(group).items() if a in zeta] if group else []
    same = [x for x in blocks if re.sub("[0-9]+_", "_", x, count=1) == name]
    if group and not blocks:  # where nothing is translated, people have w for ω
        pairs = (by_points(group) or {x: x.replace("zeta", "w") for x in zeta}).items()
        same = [b for p in pairs for a, b in (p, p[::-1]) if a == name and b in known]
    if same:
        return f"; {name} is {' or '.join(same)} here{end}"
    of_block = blocks and re.match("(zeta|w)[1-9]", name)
    return nearest(name, blocks if of_block else [*others, *(blocks if others else ())])


def out_of_place(problem: Problem, name: str, where: str, of_state: Sequence[str]) -> str:
    """What a name is that stands where it is not known, in words; "" for any other."""
    if (of_place := re.fullmatch("[rv]_[1-9][0-9]*", name)) and where.startswith("output"):
        return "is of a place; say of which: 'at', a place of the body, or 'on', a point"
    if any(x.name == name for x in problem.outputs):
        return "is another output; write its expression here"
    if name in of_state and "relative_to" in where:
        return (
            "is of the state, and what moves in space depends on the place r_1, r_2, … in it, on t "
            "and on parameters alone"
        )
    if of_place and "covector" in where:
        return "is of a place, and a covector has none; it knows the state, t and inputs"
    return ""


def is_entry(t: Tree) -> bool:
    """Is it an entry of g?"""
    return isinstance(t, tuple) and t[:2] == ("entry", "A")


@cache
def entry_places(group: Group) -> Mapping[str, tuple[int, int]]:
    """The names of the entries of g in the state → their row and column, from 0."""
    named = state_names(group).items()
    return {x: (t[2] - 1, t[3] - 1) for x, t in named if isinstance(t, tuple) and is_entry(t)}


def element(group: Group, numbers: Mapping[str, Any]) -> Matrix:
    """g, a matrix of the group's size, of numbers by name; what these do not tell is as in 1."""
    g = [[*row] for row in identity(group.size)]
    for name, (i, j) in entry_places(group).items():
        g[i][j] = numbers.get(name, g[i][j])
    return matrix(g)


def coordinates(group: Group) -> list[Tree]:
    """The coordinates ζ_1 … ζ_d of a velocity, as trees."""
    return [("entry", "ζ", a) for a in range(1, group.dimension + 1)]


def known_in_lagrangian(group: Group, advected: Sequence[Advected] | None) -> dict[str, Tree]:
    """Name → what it stands for in a Lagrangian."""
    return state_names(group) if advected is None else reduced_names(group, advected)


def reduced_names(group: Group, advected: Sequence[Advected]) -> dict[str, Tree]:
    """Name → what it stands for, where the state has no g: t, the entries of Γ, all advected
    quantities in one column, and ζ."""
    listed = [suffixed(x.name, i) for x in advected for i in range(1, x.size + 1)]
    found: dict[str, Tree] = {"t": "t"}
    found |= {name: ("entry", "Γ", i) for i, name in enumerate(listed, 1)}
    return found | _velocity(group)


def state_names(group: Group) -> dict[str, Tree]:
    """Name → what it stands for: t, the entries of g, a matrix that acts on (r, 1), and ζ."""
    found: dict[str, Tree] = {"t": "t"}
    several = len(group.places) > 1
    for k, (offset, factor) in enumerate(group.places, 1):
        mark, span = str(k) if several else "", range(1, factor.n + 1)
        for i in span:
            for j in () if factor.vectors else span:
                found[suffixed(f"A{mark}", i, j)] = ("entry", "A", offset + i, offset + j)
            if factor.affine:
                place = ("entry", "A", offset + i, offset + factor.n + 1)
                found[suffixed(f"T{mark}", i)] = place
    return found | _velocity(group)


def names_of_points(group: Group) -> dict[str, Tree]:
    """Name → what it stands for in a problem of points: as those of the state of its code, the
    coordinates of the velocity by those of the record."""
    other = by_points(group.in_user_basis)
    found = {name: t for name, t in state_names(group).items() if name not in other}
    if group.affine:
        span = range(1, group.n + 1)
        found |= {suffixed("T", i): ("entry", "T", i) for i in span}
    own = [_in_record(group, a) for a in range(group.dimension)]
    columns = [group.in_user_basis.nearest(e) for e in group.basis]
    for a, row in enumerate(zip(*columns, strict=True), 1):
        name = suffixed("zeta", a)
        terms = (mul(plain(x), y) for x, y in zip(row, own, strict=True) if x)
        found[other.get(name, name)] = add(*terms)
    return found


def _in_record(group: Group, a: int) -> Tree:
    """The coordinate ``a``, from 0, of the velocity in the basis of a record: of ζ and w in R³, and
    elsewhere, where ζ comes after the forces, in entries of Z and w."""
    if group.turns_space:
        return ("entry", "ζ", a + 1) if a < 3 else ("entry", "w", a - 2)
    n = group.n
    return add(
        *(
            mul(plain(x), ("entry", "w", i + 1) if j == n else ("entry", "Z", i + 1, j + 1))
            for x, i, j in group.coordinate_terms(a)
        )
    )


def angular_velocity(group: Group, block: int, by_coordinates: bool = False) -> list[Tree]:
    """The components in the body of that of a block that turns, three, or one in the plane; or by
    the coordinates of Z, of which it is the one in space where Z is ġg⁻¹."""
    if group.turns_space and not by_coordinates:
        return [("entry", "ζ", k) for k in (1, 2, 3)]
    first, factor = group.places[block - 1]
    planes = [(2, 1)] if factor.n == 2 else [(3, 2), (1, 3), (2, 1)]
    if not by_coordinates:
        return [("entry", "Z", first + i, first + j) for i, j in planes]
    pairs = [*zip(group.basis, coordinates(group), strict=True)]
    return [
        add(*(mul(plain(x), z) for e, z in pairs if (x := e[first + i - 1][first + j - 1])))
        for i, j in planes
    ]


def names_at_place(n: int, first: int, i: int) -> dict[str, Tree]:
    """r_1, … as the coordinates in space of place i, whose ``n`` rows come after the ``first``."""
    place = ("call", ("at", "r", i), "t")
    return {suffixed("r", k): ("entry", place, first + k) for k in range(1, n + 1)}


def names_in_forces(group: Group) -> list[str]:
    """The names of the state, and of the velocity of the place, that a force may depend on."""
    n = max(factor.n for _, factor in group.places)
    return [*names_of_points(group), *(suffixed("v", k) for k in range(1, n + 1))]


def velocity_at_place(
    n: int, first: int, i: int, wind: Sequence[Tree], *, turned: bool
) -> dict[str, Tree]:
    """v_1, … as the components of the velocity of the same place, less that of a ``wind``, in
    space, or ``turned`` into the body."""
    v = [
        add(("entry", ("at", "v", i), first + k), *((neg(x),) if x != 0 else ()))
        for k, x in enumerate(wind, 1)
    ]
    if turned:
        columns = [
            [("entry", "A", first + j, first + k) for j in range(1, n + 1)] for k in range(1, n + 1)
        ]
        v = [add(*map(mul, column, v)) for column in columns]
    return {suffixed("v", k): x for k, x in enumerate(v, 1)}


def _velocity(group: Group) -> dict[str, Tree]:
    return {suffixed("zeta", a): t for a, t in enumerate(coordinates(group), 1)}


def meant(t: Tree, names: Mapping[str, Tree]) -> Tree:
    """An expression with its names as what they stand for."""
    if not isinstance(t, tuple):
        return t
    if t[0] == "par":
        return names.get(t[1], t)
    parts = [meant(x, names) for x in t[1:]]
    # the signs of both are one: ζ₁ is −Z₁₂ in the plane
    return mul(*parts) if t[0] == "mul" else (t[0], *parts)


# What is wrong with a text that is not TOML, at which line, and what to write instead.

AT = re.compile(r"at line ([0-9]+), column ([0-9]+)")
CURLY = "“”„‟«»‘’‚"
SPACES = "\u00a0\u1680\u2007\u202f\u3000\u200b\ufeff"
"""No-break and other spaces that TOML does not know."""
WORD = re.compile(r"[\w.*/^+()-]+")
DECIMAL = re.compile(r"=\s*([-+]?[0-9]+),([0-9]+)\s*$")
TEXT = re.compile(r""" "[^"]*" | '[^']*' | \#.* """, re.VERBOSE)
ENDS = {
    "Unescaped": f"write {LATEX}",
    "Unclosed array": "a list ends with ], and its entries are parted by commas",
    "Unclosed inline": "{ … } ends with }, on the line where it begins",
    **dict.fromkeys(
        ("Unterminated", 'Expected "\'"', "Illegal character '\\n'"),
        "a text ends with the quote that it begins with",
    ),
}
"""The beginning of a message → what is missing."""
TWICE = ("Cannot overwrite", "Cannot declare", "Cannot mutate")


def unread(raw: bytes, error: ValueError) -> str:
    """The message of Python's reader, always with a line, and the remedy where it is known."""
    if isinstance(error, UnicodeDecodeError):
        line = raw[: error.start].count(b"\n") + 1
        return f"line {line} has a byte that is not UTF-8; save the file as UTF-8"
    lines = raw.decode("utf-8-sig", "replace").split("\n")
    last = max((k for k, x in enumerate(lines, 1) if x.strip()), default=1)
    end = f"at line {last}, column {len(lines[last - 1]) + 1}, the end"
    said = str(error).replace("at end of document", end)
    if said.startswith(TWICE):
        said += "; a key or a table stands twice, where a list of tables is written [[…]]"
    at = AT.search(said)
    if at is None:
        return said
    shown = lines[int(at[1]) - 1].rstrip("\r")
    hint = remedy(said, shown, int(at[2]) - 1)
    return f"{said}; {hint}" if hint else said


def remedy(said: str, line: str, column: int) -> str:
    """What to write instead, from what stands about a column, from 0, of a line; "" if unknown."""
    before, letter, key = line[:column], line[column : column + 1], line.partition("=")[0]
    if quote := next((x for x in TEXT.sub("", line) if x in CURLY), ""):
        return f'{quote} is a curly quote: text stands in straight ones, "…"'
    if letter and letter in SPACES:
        return f"a no-break space (U+{ord(letter):04X}) stands here: write a plain one"
    if letter == "−":
        return "− is not the minus sign of a number: write -"
    if not key.isascii():
        return "names have the letters A to Z, a to z, digits and _ only"
    if found := _decimal(line, column):
        return f"a decimal point, not a comma: {found}"
    if said.startswith("Invalid statement") and line.lstrip().startswith((";", "//")):
        return "a comment begins with #"
    if said.startswith("Expected '=' after a key") and letter == ":":
        return "a key and its value are parted by =, not by :"
    if said.startswith("Expected ']"):
        return "a table is written [name], one of a list of tables [[name]]"
    bare = said.startswith(("Invalid value", "Expected newline", "Unclosed")) and "=" in before
    hint = _unquoted(line, column) if bare else ""
    return hint or next((x for begin, x in ENDS.items() if said.startswith(begin)), "")


def _decimal(line: str, column: int) -> str:
    """The number with a point, where one with a comma ends or has its comma at the column."""
    comma = re.match(r",[0-9]+", line[column:])
    found = DECIMAL.search(line[: column + comma.end()] if comma else line[:column])
    return f"{found[1]}.{found[2]}" if found else ""


def _unquoted(line: str, column: int) -> str:
    """That a text or an expression has no quotes, or a number no digit on one side of its point."""
    word = next((x for x in WORD.finditer(line) if x.start() <= column < x.end()), None)
    if word is None:
        nothing = not line[column:].split("#")[0].strip() and line[:column].rstrip().endswith("=")
        return "a value is missing" if nothing else ""
    value = word[0]
    if re.fullmatch(r"[-+]?(\.[0-9]+|[0-9]+\.)", value):
        return "a digit stands on both sides of the point: " + re.sub(
            r"^([-+]?)\.", r"\g<1>0.", value if value[-1] != "." else f"{value}0"
        )
    if re.search(r"[A-Za-z*/^+(]", value) and value[-1] != "(":
        return f'a text or an expression stands in quotes: "{value[:40]}"'
    return ""
