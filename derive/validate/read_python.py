"""Emitted Python read into terms, by its syntax tree; nothing of the text is ever run.

Read are the functions in plain numbers: ``_constants``, ``_rhs``, ``_energy``, ``_inertia``,
``_project``, ``_defect``, the Jacobians and those of a discrete step, with the names, the defaults
and the basis. The public functions, which hand arrays to these, the steps in time and their numbers
are not:
:func:`unread_statements` gives their text, to be compared with what is emitted.
"""

from __future__ import annotations

import ast
import re
from fractions import Fraction
from typing import Any

from ..check.values.evaluate import ELEMENTARY
from .ellipsoid_integrals import BUNDLES, MOST
from .ellipsoid_integrals import NAME as INTEGRALS
from .emitted_file import Module
from .terms import (
    DECIMAL,
    CodeError,
    CodeFunction,
    Expression,
    Statement,
    apply_operation,
    plain_text,
)

OF_STATE = (
    *("_rhs", "_energy", "_conserved", "_project", "_defect", "_jacobian", "_jacobian_inputs"),
    *("_momentum", "_multiplier", "_jacobian_raw", "_to_matrix"),
)
OF_Y, OF_BOTH = ("_velocity", "_momentum_rhs", "_poisson"), ("_velocity_step", "_momentum_rates")
SIGNATURES = {
    **dict.fromkeys(("_constants", "_inertia"), ("xp", "p")),
    **dict.fromkeys(OF_STATE, ("xp", "t", "x", "k", "u")),
    **dict.fromkeys(OF_Y, ("xp", "t", "y", "k", "u")),
    **dict.fromkeys(OF_BOTH, ("xp", "t", "x", "y", "k", "u")),
    "_from_matrix": ("xp", "z"),
    "_jacobian_parameters": ("xp", "t", "x", "p", "u"),
    "_step_momentum": ("xp", "x", "k"),
    "_step_force": ("xp", "t", "x", "k", "u"),
    "_step_velocity": ("xp", "x", "k", "q"),
    "_step_guess": ("xp", "x", "k", "q"),
    "_step_begin": ("xp", "x", "k", "q"),
    "_step_newton": ("xp", "x", "k", "b", "q", "v"),
    "_step_turn": ("xp", "v", "s"),
    "_step_turn_little": ("xp", "v", "s"),
    "_step_end": ("xp", "x", "k", "q", "v"),
}
CALLS = tuple(f"_{name}(xp, " for name in BUNDLES)
"""How a call of a function of integrals begins."""
SIGNS: dict[type, str] = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div"}
COOKIE = re.compile(r"[ \t\f]*#.*?coding[:=]")
LISTS = ("STATE", "PARAMETERS", "INPUTS", "CONSTANTS")
DATA = (*LISTS, "BASIS", "DEFAULTS", "CONSERVED")


def read_python(name: str, text: str) -> Module:
    """The module in a Python file; ``CodeError`` says what cannot be read, and where."""
    return PythonReader(text).module(parsed(name, text))


def parsed(name: str, text: str) -> ast.Module:
    """The syntax tree of a Python text; ``CodeError`` where it is none, or Python would read other
    letters than are here."""
    plain_text(text)
    if any(COOKIE.match(line) for line in text.split("\n")[:2]):
        raise CodeError("a line that names an encoding is not read")
    try:
        return ast.parse(text, name)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise CodeError(f"not Python: {error}") from None


def unread_statements(name: str, text: str) -> list[str]:
    """The statements of a module that Python runs and :func:`read_python` leaves out."""
    tree, found = parsed(name, text), []
    for node in tree.body:
        read = isinstance(node, ast.FunctionDef) and node.name in SIGNATURES
        data = isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") in DATA
        if not read and not data and node is not tree.body[0]:  # the docstring
            found.append(ast.get_source_segment(text, node) or "")
    return found


class PythonReader:
    """The reader of one module in Python."""

    def __init__(self, text: str):
        self.lines = [line.encode() for line in text.split("\n")]
        self.values: dict[str, Any] = {}
        self.functions: dict[str, CodeFunction] = {}

    def module(self, tree: ast.Module) -> Module:
        """The functions and lists of a file; ``CodeError`` for a name defined twice."""
        seen: set[str] = set()
        for node in tree.body:
            for name in self._names(node):
                if name in seen or name == "abs":
                    raise self._unknown(node, f"{name} is defined twice")
                seen.add(name)
        state, parameters, inputs, constants = (self._list(x) for x in LISTS)
        sizes = {"CONSTANTS": len(constants), "PARAMETERS": len(parameters)}
        sizes |= {"STATE": len(state), "INPUTS": len(inputs)}
        sizes["CONSERVED"] = len(self.values.get("CONSERVED", ()))
        basis, defaults = self.values.get("BASIS"), self.values.get("DEFAULTS")
        return Module(state, parameters, inputs, self.functions, sizes, defaults, basis)

    def _unknown(self, node: ast.AST, why: str = "") -> CodeError:
        line = getattr(node, "lineno", 0)
        return CodeError(f"line {line}: {why or f'{type(node).__name__} is not known here'}")

    # -- the module --------------------------------------------------------------------------

    def _names(self, node: ast.stmt) -> list[str]:
        """The names that a statement of the module defines; its functions and values are read."""
        if isinstance(node, ast.Import):
            return [alias.asname or alias.name for alias in node.names]
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            return []
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            (target,) = node.targets
            set_here = target.elts if isinstance(target, ast.Tuple) else [target]
            if names := [x.id for x in set_here if isinstance(x, ast.Name)]:
                if isinstance(target, ast.Name) and target.id in DATA:
                    self.values[target.id] = self._data(node.value)
                if len(names) == len(set_here):
                    return names
        if isinstance(node, ast.FunctionDef) and not node.decorator_list:
            if node.name in SIGNATURES:
                self._function(node)
            return [node.name]
        if isinstance(node, ast.ClassDef) and node.name not in SIGNATURES:
            return [node.name]
        raise self._unknown(node)

    def _list(self, name: str) -> tuple[str, ...]:
        found = self.values.get(name)
        if not isinstance(found, tuple) or not all(isinstance(x, str) for x in found):
            raise CodeError(f"{name} is no tuple of names")
        return found

    def _data(self, node: ast.expr) -> Any:
        """The value of a literal: names and numbers in tuples, lists, dictionaries; what
        numpy.array would be given."""
        if isinstance(node, (ast.Tuple, ast.List)):
            return tuple(self._data(x) for x in node.elts)
        if isinstance(node, ast.Dict):
            keys = [self._data(x) if x else None for x in node.keys]
            return dict(zip(keys, map(self._data, node.values), strict=True))
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return node.value
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "numpy.array":
            return self._data(node.args[0])
        return self._number(self._expression(node), node)

    def _number(self, e: Expression, node: ast.expr) -> Fraction:
        if e[0] == "int" or e[0] == "lit":
            return Fraction(e[1])
        if e[0] not in ("neg", "div"):
            raise self._unknown(node)
        return Fraction(apply_operation(e[0], [self._number(x, node) for x in e[1:]]))

    # -- functions ---------------------------------------------------------------------------

    def _function(self, node: ast.FunctionDef) -> None:
        a = node.args
        names = tuple(x.arg for x in a.args)
        extra = [*a.posonlyargs, *a.kwonlyargs, *a.defaults, a.vararg, a.kwarg, node.returns]
        extra += [x.annotation for x in a.args]
        if names != SIGNATURES[node.name] or any(extra):
            raise self._unknown(node, f"{node.name}({', '.join(names)}) has other arguments")
        name = node.name[1:]
        body = tuple(self._statement(x, names) for x in node.body)
        self.functions[name] = CodeFunction(name, names, body)

    def _statement(self, node: ast.stmt, arguments: tuple[str, ...]) -> Statement:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            (target,), value = node.targets, node.value
            if isinstance(target, ast.Name) and target.id not in ("_", "abs"):
                return ("set", target.id, self._expression(value))
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Name):
                names = tuple(x.id for x in target.elts if isinstance(x, ast.Name))
                if len(names) == len(target.elts) and value.id in arguments and "abs" not in names:
                    return ("unpack", names, value.id)
        if isinstance(node, ast.Return) and node.value is not None:
            value = node.value
            if isinstance(value, ast.Tuple) and len(value.elts) == 2:
                value = value.elts[0]  # beside the tests, which were computed before
            return ("return", self._expression(value))
        raise self._unknown(node)

    def _expression(self, node: ast.expr) -> Expression:
        if isinstance(node, ast.Name):
            return ("var", node.id)
        if isinstance(node, ast.Constant):
            return self._constant(node)
        if isinstance(node, ast.BinOp) and type(node.op) in SIGNS:
            return (SIGNS[type(node.op)], *map(self._expression, (node.left, node.right)))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return ("neg", self._expression(node.operand))
        if isinstance(node, (ast.List, ast.Tuple)):
            return ("list", *map(self._expression, node.elts))
        if isinstance(node, ast.Call) and ast.unparse(node).startswith("_is_zero(xp, "):
            return ("none", *map(self._expression, node.args[1:]))
        if isinstance(node, ast.Call) and ast.unparse(node).startswith(CALLS):
            name = ast.unparse(node.func).removeprefix("_")
            return ("fun", name, *map(self._expression, node.args[1:]))
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
            kind, k = self._expression(node.slice)
            if kind == "int" and 0 <= k < MOST:
                return ("fun", f"{INTEGRALS}_{k}", ("var", node.value.id))
            raise self._unknown(node)
        if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords:
            return self._call(node.func, self._expression(node.args[0]))
        raise self._unknown(node)

    def _call(self, f: ast.expr, argument: Expression) -> Expression:
        if isinstance(f, ast.Name) and f.id == "abs":
            return ("abs", argument)
        name = ast.unparse(f)
        if name.startswith("xp.") and name[3:] in ELEMENTARY:
            return ("fun", name[3:], argument)
        raise self._unknown(f, f"the function {name[:40]} is not known here")

    def _constant(self, node: ast.Constant) -> Expression:
        if type(node.value) is int:
            return ("int", node.value)
        if type(node.value) is not float or node.lineno != node.end_lineno:
            raise self._unknown(node)
        text = self.lines[node.lineno - 1][node.col_offset : node.end_col_offset].decode()
        if not DECIMAL.fullmatch(text):
            raise self._unknown(node, f"the number {text[:40]!r} is not read")
        return ("lit", text)
