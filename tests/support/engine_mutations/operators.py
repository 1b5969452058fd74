"""Single changes of a module's syntax tree: signs, terms, factors, bars, indices, numbers, tests.

Left alone are annotations, texts, what is raised, and what only prints.
"""

import ast
import copy
import re
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from derive.language.read import read
from derive.language.show import show

SIGNS = {ast.Add: ast.Sub, ast.Sub: ast.Add}
PRODUCTS = (ast.Mult, ast.MatMult, ast.Div, ast.FloorDiv, ast.Pow, ast.Mod)
COMPARED = {
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE,
    ast.GtE: ast.Gt, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
OPPOSITES = {ast.Eq, ast.NotEq, ast.Is, ast.IsNot, ast.In, ast.NotIn}
TRANSPOSES = {"transposed", "transpose"}
SILENT = {"say", "phrase", "listed", "isinstance", "zip", "replace", "cast", "print", "getattr"}
"""Calls whose arguments are of different kinds, or are words."""
PRINTS = {"__str__", "__repr__"}
TYPES = {"tuple", "list", "dict", "set", "Callable", "Mapping", "Sequence", "Iterator", "Literal"}


class Mutant(NamedTuple):
    """One change: ``lines`` of the source that it touches, and the nodes of the module's tree."""

    module: str
    lines: tuple[int, int]
    kind: str
    change: str
    tree: ast.Module
    old: ast.AST
    new: ast.AST

    def changed(self) -> ast.Module:
        """The module with it."""
        return ast.fix_missing_locations(with_node(self.tree, self.old, self.new))

    def __str__(self) -> str:
        return f"{self.module}:{self.lines[0]}: {self.kind}: {self.change}"


def mutants(module: str, source: str) -> Iterator[Mutant]:
    """Every single change of a module."""
    tree = ast.parse(source)
    for node, statement in live(tree):
        seen = {ast.unparse(node)}
        for kind, new in changes(node):
            text = ast.unparse(new)
            if text in seen:
                continue
            seen.add(text)
            first, last = statement.lineno, getattr(statement, "end_lineno", statement.lineno)
            if isinstance(statement, ast.stmt) and hasattr(statement, "body"):
                first, last = node.lineno, node.end_lineno
            told = f"{short(ast.unparse(node))}  →  {short(text)}"
            yield Mutant(module, (first, last), kind, told, tree, node, new)


def short(text: str) -> str:
    """On one line, and not a long one."""
    line = " ".join(text.split())
    return line if len(line) <= 70 else line[:67] + "…"


def with_node(node: ast.AST, old: ast.AST, new: ast.AST) -> ast.AST:
    """The tree with one node replaced; what is not changed is shared."""
    if node is old:
        return ast.copy_location(new, old)
    twin = copy.copy(node)
    for field, value in ast.iter_fields(node):
        if isinstance(value, list):
            parts = [with_node(x, old, new) if isinstance(x, ast.AST) else x for x in value]
            setattr(twin, field, parts)
        elif isinstance(value, ast.AST):
            setattr(twin, field, with_node(value, old, new))
    return twin


def live(node: ast.AST, statement: ast.AST | None = None) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Every expression that computes something, with the statement it stands in."""
    if isinstance(node, (ast.Raise, ast.Import, ast.ImportFrom, ast.JoinedStr)):
        return
    if isinstance(node, ast.FunctionDef) and node.name in PRINTS:
        return
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        return
    if isinstance(node, ast.Assign) and alias(node):
        return
    if isinstance(node, ast.Subscript) and ast.unparse(node.value) in TYPES:
        return
    inner = node if isinstance(node, ast.stmt) else statement
    if isinstance(node, ast.expr):
        yield node, inner or node
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "msg", "type_params"):
            continue
        for part in value if isinstance(value, list) else [value]:
            if isinstance(part, ast.AST) and not (field == "comparators" and members(part)):
                yield from live(part, inner)


def members(node: ast.AST) -> bool:
    """Is it a list of words, among which one is looked for?"""
    parts = node.elts if isinstance(node, ast.Tuple) else ()
    return bool(parts) and all(isinstance(getattr(x, "value", 0), str) for x in parts)


def alias(node: ast.Assign) -> bool:
    """Does it give a name to a type?"""
    named = isinstance(node.targets[0], ast.Name) and node.targets[0].id[:1].isupper()
    form = ast.unparse(node.value)
    return named and form.startswith(("tuple[", "dict[", "Callable[", "Literal[", "str |", "int |"))


def changes(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """(kind, new node) for one expression."""
    if isinstance(node, ast.BinOp):
        yield from of_operation(node)
    elif isinstance(node, ast.UnaryOp):
        yield "sign" if isinstance(node.op, ast.USub) else "condition", node.operand
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        yield (
            "comparison",
            ast.Compare(node.left, [COMPARED[type(node.ops[0])]()], node.comparators),
        )
    elif isinstance(node, ast.BoolOp):
        other = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        yield "condition", ast.BoolOp(other, node.values)
    elif isinstance(node, ast.Constant) and type(node.value) is int:
        yield "number", ast.Constant(node.value + 1)
    elif isinstance(node, ast.Attribute) and node.attr == "bar":
        yield "transpose", node.value
    elif isinstance(node, ast.Subscript):
        yield from of_subscript(node)
    elif isinstance(node, ast.Tuple) and node.elts and isinstance(node.ctx, ast.Load):
        yield from of_tree(node)
    elif isinstance(node, ast.Call):
        yield from of_call(node)
    for field in ("test", "ifs"):
        tests = getattr(node, field, [])
        for test in tests if isinstance(tests, list) else [tests]:
            yield from negated(node, field, test)


def negated(node: ast.AST, field: str, test: ast.expr) -> Iterator[tuple[str, ast.AST]]:
    """A conditional expression with its test negated, unless a changed comparison does that."""
    if isinstance(test, ast.Compare) and type(test.ops[0]) in OPPOSITES:
        return
    if field == "test":
        twin = copy.copy(node)
        twin.test = ast.UnaryOp(ast.Not(), test)
        yield "condition", twin


def of_operation(node: ast.BinOp) -> Iterator[tuple[str, ast.AST]]:
    op = type(node.op)
    if op in SIGNS:
        yield "sign", ast.BinOp(node.left, SIGNS[op](), node.right)
        yield "term", node.left
        if op is ast.Add:
            yield "term", node.right
    elif op in PRODUCTS:
        yield "factor", node.left
        if op is ast.Mult:
            yield "factor", node.right
            yield "order", ast.BinOp(node.right, node.op, node.left)


def of_subscript(node: ast.Subscript) -> Iterator[tuple[str, ast.AST]]:
    """x[i][j] with its indices swapped; x[a, b] as well."""
    if not isinstance(node.ctx, ast.Load):
        return
    if isinstance(node.value, ast.Subscript):
        inside = ast.Subscript(node.value.value, node.slice, ast.Load())
        yield "indices", ast.Subscript(inside, node.value.slice, ast.Load())
    if isinstance(node.slice, ast.Tuple) and len(node.slice.elts) == 2:
        turned = ast.Tuple(node.slice.elts[::-1], ast.Load())
        yield "indices", ast.Subscript(node.value, turned, ast.Load())


def of_tree(node: ast.Tuple) -> Iterator[tuple[str, ast.AST]]:
    """An operator tree that is written out: ("mul", a, b)."""
    op = node.elts[0]
    if not (isinstance(op, ast.Constant) and isinstance(op.value, str)) or len(node.elts) < 2:
        return
    if op.value in ("T", "inv") and len(node.elts) == 2:
        yield "transpose" if op.value == "T" else "factor", node.elts[1]
    if op.value in ("add", "mul"):
        kind = "term" if op.value == "add" else "factor"
        for k in range(1, len(node.elts)):
            yield kind, only(node, k)
    for k in range(1, len(node.elts) - 1):
        yield "order", swapped(node, k)
    yield "sign", ast.Tuple([ast.Constant("mul"), ast.Constant(-1), node], ast.Load())


def only(node: ast.Tuple, k: int) -> ast.AST:
    """A tree without its k-th operand."""
    rest = [*node.elts[:k], *node.elts[k + 1 :]]
    return rest[1] if len(rest) == 2 and not isinstance(rest[1], ast.Starred) else tuple_of(rest)


def tuple_of(parts: list[ast.expr]) -> ast.Tuple:
    return ast.Tuple(parts, ast.Load())


def swapped(node: ast.Tuple, k: int) -> ast.AST:
    parts = list(node.elts)
    parts[k], parts[k + 1] = parts[k + 1], parts[k]
    return tuple_of(parts)


def of_call(node: ast.Call) -> Iterator[tuple[str, ast.AST]]:
    name = ast.unparse(node.func).rpartition(".")[2]
    if name in SILENT:
        return
    if ast.unparse(node.func) in ("read", "stated") and isinstance(node.args[0], ast.Constant):
        yield from of_formula(node, node.args[0].value)
    one = len(node.args) == 1 and not node.keywords and not isinstance(node.args[0], ast.Starred)
    if one and (name == "neg" or name in TRANSPOSES):
        yield "sign" if name == "neg" else "transpose", node.args[0]
    if name in ("add", "mul") and len(node.args) > 1:
        for k in range(len(node.args)):
            rest = [*node.args[:k], *node.args[k + 1 :]]
            yield "term" if name == "add" else "factor", ast.Call(node.func, rest, node.keywords)
            if name == "add" and not isinstance(node.args[k], ast.Starred):
                minus = ast.Tuple([ast.Constant("mul"), ast.Constant(-1), node.args[k]], ast.Load())
                parts = [*node.args[:k], minus, *node.args[k + 1 :]]
                yield "sign", ast.Call(node.func, parts, node.keywords)
    if 2 <= len(node.args) <= 4 and name != "add":
        for k in range(len(node.args) - 1):
            if type(node.args[k]) is not type(node.args[k + 1]):
                continue  # hardly of one kind
            parts = list(node.args)
            parts[k], parts[k + 1] = parts[k + 1], parts[k]
            yield "order", ast.Call(node.func, parts, node.keywords)


def of_formula(node: ast.Call, text: str) -> Iterator[tuple[str, ast.AST]]:
    """A formula that is written out, changed as its trees would be: stated("C = ĀA")."""
    pieces = re.split(r"( = |,  )", text)
    for k in range(0, len(pieces), 2):
        whole = ast.parse(repr(read(pieces[k])), mode="eval").body
        for part, _ in live(whole):
            for kind, new in changes(part):
                tree = eval(ast.unparse(with_node(whole, part, new)), {"Fraction": Fraction})
                try:
                    shown = show(tree)
                    if show(read(shown)) != shown:
                        continue
                except (AttributeError, IndexError, TypeError, ValueError):
                    continue  # no tree
                formula = ast.Constant("".join([*pieces[:k], shown, *pieces[k + 1 :]]))
                yield kind, ast.Call(node.func, [formula, *node.args[1:]], node.keywords)
