"""The direction of the house: language ← schema, algebra ← problem ← walk → record ← the rest."""

import ast
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "derive"
BELOW = ("record", "algebra", "schema", "language")
ALLOWED = {
    "language": {"language"},
    "algebra": {"algebra", "language"},
    "schema": {"schema", "language"},
    "problem": {"problem", "schema", "algebra", "language"},
    "record": {"record", "record/prose", "schema", "language"},
    "record/prose": {"record/prose"},
    "walk": {"walk", "record", "record/prose", "problem", "schema", "algebra", "language"},
    "check": {"check", "record", "algebra", "language"},
    "search": {"search", "code", "walk", "problem", *BELOW},
    "routines": {"routines"},
    "code": {"code", "routines", "record", "algebra", "language", "__init__"},
    "validate": {"validate", "check", "record", "algebra", "language"},
    "motion": {"motion", "code", "views/figure", "problem", *BELOW},
    "compare": {"compare", "motion", "code", "problem", "schema", "algebra", "language"},
    "views": {
        *("views", "views/figure", "views/printing", "views/paper"),
        *("record", "record/prose", "schema", "algebra", "language"),
    },
    "views/printing": {"views/printing", "record", "language"},
    "views/figure": {"views/figure", "views/printing", "record", "schema", "language"},
    "views/paper": {"views/paper", "check", "record", "record/prose", "algebra", "language"},
    "views/plot": {"views/plot", "motion", "language"},
    "lecture": {
        "lecture",
        "views",
        "views/printing",
        "views/figure",
        "check",
        "record",
        "record/prose",
        "language",
    },
    "views/page": {
        *("views/page", "views", "views/figure", "motion", "code"),
        *("problem", "record", "algebra", "language"),
    },
}
"""Room, or a part of one with rules of its own → what it may import."""
BOTH_SIDES = {
    "pipeline.py",
    "searches.py",
    "programs.py",
    "python",
    "command",
    "__init__.py",
    "__main__.py",
}
FILES = sorted(p for p in ROOT.rglob("*.py"))


@cache
def parts(path):
    """The imports and functions of a file, also inside functions."""
    kinds = (ast.Import, ast.ImportFrom, ast.FunctionDef)
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return [x for x in ast.walk(tree) if isinstance(x, kinds)]


def room_of(parts):
    """The room of a place in the house, by its folders."""
    part = "/".join(parts[:2])
    return part if part in ALLOWED else parts[0]


def rooms_of(path):
    """The rooms that a file imports from."""
    package = path.relative_to(ROOT).parts[:-1]
    for node in parts(path):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            target = (*base, *(node.module.split(".") if node.module else ()))
            names = [a.name for a in node.names] if len(target) == 1 else [""]
            yield from (room_of([*target, x]) if target else "__init__" for x in names)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("derive"):
            yield room_of([*node.module.split(".")[1:], "__init__"])
        elif isinstance(node, ast.Import):
            assert not any(a.name.split(".")[0] == "derive" for a in node.names)


def test_imports_go_one_way():
    for path in FILES:
        room = room_of(path.relative_to(ROOT).parts)
        assert room in BOTH_SIDES or {*rooms_of(path)} <= ALLOWED[room], path


def test_functions_are_small():
    """The length of a file is left to judgement: a cap splits files in odd places."""
    for path in FILES:
        # an iteration that is printed in every language is not cut: its parts share arrays
        most = 80 if path.parent.name == "algorithms" else 60
        for node in parts(path):
            if isinstance(node, ast.FunctionDef):
                assert node.end_lineno - node.lineno < most, (path, node.name)


@cache
def direct(path):
    """The files of this package that one imports."""
    found = []
    for node in parts(path):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = path.parents[node.level - 1]
            folder = base.joinpath(*(node.module or "").split("."))
            candidates = [folder.with_suffix(".py"), folder / "__init__.py"]
            candidates += [folder / f"{a.name}.py" for a in node.names]
            found += [c for c in candidates if c.is_file()]
    return found


@cache
def listed(path):
    """The files of a package that it finds there by itself, when they are asked for."""
    found = "iter_modules(__path__)" in path.read_text(encoding="utf-8")
    return [p for p in path.parent.glob("*.py") if p != path] if found else []


def imported(start):
    """A file and all of this package that it imports, directly or not."""
    seen, stack = set(), [start]
    while stack:
        path = stack.pop()
        if path not in seen:
            seen.add(path)
            stack += direct(path) + listed(path)
    return seen


def test_the_checker_knows_no_walk_and_no_words():
    """Neither directly nor through what it imports."""
    names = {str(p.relative_to(ROOT)) for p in imported(ROOT / "check" / "checker.py")}
    assert "check/trials/potential_accounts.py" in names
    assert "check/trials/model.py" in names
    assert not any(n.startswith(("walk/", "code/", "views/", "problem/")) for n in names)
    assert not names & {"algebra/words.py", "algebra/calculus.py"}


ORACLES = sorted((Path(__file__).parents[1] / "oracles").glob("*.py"))
NOT_OURS = {
    "cmath",
    "collections",
    "dataclasses",
    "decimal",
    "fractions",
    "functools",
    "itertools",
    "math",
    "re",
    "typing",
}
NOT_OURS |= {"jax", "mpmath", "numpy", "scipy", "sympy"}


@pytest.mark.parametrize("path", ORACLES, ids=lambda p: p.name)
def test_oracles_share_no_code_with_what_they_judge(path):
    """They import libraries and each other: not derive, nor the tests' ways to its code."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom):
            assert not node.level, "an oracle says in full what it imports"
            names = [f"{node.module}.{a.name}" for a in node.names]
        for name in names:
            assert name.startswith("tests.oracles.") or name.split(".")[0] in NOT_OURS, name
        called = node.func if isinstance(node, ast.Call) else None
        loaders = {"__import__", "exec", "eval"}
        assert getattr(called, "id", getattr(called, "attr", "")) not in loaders


def test_a_name_says_which_file():
    """No two rooms have files of one name, and no file lies outside a room but these."""
    stems = [p.stem for p in FILES if p.stem != "__init__"]
    assert sorted(x for x in {*stems} if stems.count(x) > 1) == []
    assert {p.name for p in ROOT.glob("*.py")} == {x for x in BOTH_SIDES if x.endswith(".py")}


def test_no_test_hides_another():
    """Python knows a file of tests by its name alone, where no ``__init__.py`` is beside it."""
    alone = [
        x
        for x in (ROOT.parent / "tests").rglob("test_*.py")
        if not (x.parent / "__init__.py").is_file()
    ]
    assert len({x.name for x in alone}) == len(alone)


def test_no_circle_of_files():
    """Nor one that is closed by an import inside a function, or for types alone."""
    state = {}

    def visit(path, trail):
        if state.get(path) == "done":
            return
        names = [str(p.relative_to(ROOT)) for p in (*trail, path)]
        assert state.get(path) != "open", f"a circle: {' -> '.join(names)}"
        state[path] = "open"
        for other in direct(path):
            visit(other, (*trail, path))
        state[path] = "done"

    for path in FILES:
        visit(path, ())
