"""The direction of the house: algebra ← mechanics ← walk → record ← views, walk → code."""

import ast
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1] / "derive"
ALLOWED = {
    "algebra": {"algebra"},
    "mechanics": {"mechanics", "algebra", "reserved", "limits"},
    "record": {"record", "algebra", "limits", "reserved"},
    "check": {"check", "record", "algebra", "limits"},
    "paper": {"paper", "check", "record", "algebra"},
    "walk": {"walk", "record", "mechanics", "algebra"},
    "validate": {"validate", "check", "record", "algebra"},
    "views": {"views", "paper", "record", "algebra", "templating"},
    "code": {"code", "record", "algebra", "limits", "templating", "reserved", "__init__"},
    "reserved.py": set(),
    "limits.py": set(),
    "guard.py": {"limits"},
    "templating.py": set(),
    "writing.py": set(),
    "library.py": {"writing"},
    "validation.py": {"validate", "code", "record"},
    "progress.py": set(),
    "encoding.py": set(),
    "listing.py": {"mechanics", "algebra"},
}
BOTH_SIDES = {
    "api.py",
    "arguments.py",
    "compiled.py",
    "derived.py",
    "rendering.py",
    "pipeline.py",
    "cli.py",
    "__init__.py",
    "__main__.py",
}
FILES = sorted(p for p in ROOT.rglob("*.py"))


def rooms_of(path):
    """The rooms that a file imports from, also inside functions."""
    package = path.relative_to(ROOT).parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            target = (*base, *(node.module.split(".") if node.module else ()))
            yield target[0] if target else "__init__"
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("derive"):
            yield [*node.module.split("."), "__init__"][1]
        elif isinstance(node, ast.Import):
            assert not any(a.name.split(".")[0] == "derive" for a in node.names)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_go_one_way(path):
    room = path.relative_to(ROOT).parts[0]
    if room in BOTH_SIDES:
        return
    assert set(rooms_of(path)) <= ALLOWED[room]


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_functions_are_small(path):
    """The length of a file is left to judgement: a cap splits files in odd places."""
    source = path.read_text(encoding="utf-8")
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < 60, node.name


@cache
def direct(path):
    """The files of this package that one imports, also inside functions."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = path.parents[node.level - 1]
            folder = base.joinpath(*(node.module or "").split("."))
            candidates = [folder.with_suffix(".py")]
            candidates += [folder / f"{a.name}.py" for a in node.names]
            found += [c for c in candidates if c.is_file()]
    return found


def imported(start):
    """A file and all of this package that it imports, directly or not."""
    seen, stack = set(), [start]
    while stack:
        path = stack.pop()
        if path not in seen:
            seen.add(path)
            stack += direct(path)
    return seen


def test_the_checker_knows_no_walk_and_no_words():
    """Neither directly nor through what it imports."""
    names = {str(p.relative_to(ROOT)) for p in imported(ROOT / "check" / "checker.py")}
    assert "check/model.py" in names
    assert not any(n.startswith(("walk/", "code/", "views/", "mechanics/")) for n in names)
    assert not names & {"algebra/words.py", "algebra/calculus.py", "algebra/forms.py"}


ORACLES = sorted((Path(__file__).parent / "oracles").glob("*.py"))
NOT_OURS = {"cmath", "dataclasses", "fractions", "functools", "itertools", "math", "re", "typing"}
NOT_OURS |= {"mpmath", "numpy", "scipy", "sympy"}


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
