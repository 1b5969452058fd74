"""Emitted C read into terms, by a parser of C; a construct that is not known here is an error."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ..check.values.evaluate import ELEMENTARY
from .ellipsoid_integrals import BUNDLES, MOST
from .ellipsoid_integrals import NAME as INTEGRALS
from .emitted_file import Module
from .preprocessor import Preprocessor
from .terms import (
    DECIMAL,
    Body,
    CodeError,
    CodeFunction,
    Expression,
    MissingParserError,
    Statement,
)

SIGNATURES = {
    "constants": ("int", "const* p", "* k"),
    "rhs": ("void", "t", "const* x", "const* k", "const* u", "* dx"),
    "rhs_batch": ("void", "size_t n", "t", "const* x", "const* k", "const* u", "* dx"),
    "energy": ("real", "t", "const* x", "const* k"),
    "multiplier": ("real", "t", "const* x", "const* k", "const* u"),
    "conserved": ("void", "t", "const* x", "const* k", "* out"),
    "step_momentum": ("void", "const* x", "const* k", "* out"),
    "step_force": ("void", "t", "const* x", "const* k", "const* u", "* out"),
    "step_velocity": ("void", "const* x", "const* k", "const* q", "* out"),
    "step_guess": ("void", "const* x", "const* k", "const* q", "* out"),
    "step_begin": ("void", "const* x", "const* k", "const* q", "* out"),
    "step_newton": ("void", *(f"const* {a}" for a in "xkbqv"), "* out"),
    "step_turn": ("void", "const* v", "const* s", "* out"),
    "step_turn_little": ("void", "const* v", "const* s", "* out"),
    "step_end": ("void", *(f"const* {a}" for a in "xkqv"), "* out"),
    "project": ("void", "const* x", "* out"),
    "defect": ("real", "const* x"),
    "to_matrix": ("void", "const* x", "* out"),
    "from_matrix": ("void", "const* z", "* out"),
    "jacobian": ("void", "t", "const* x", "const* k", "const* u", "* dx", "* D"),
    "jacobian_inputs": ("void", "t", "const* x", "const* k", "const* u", "* D"),
    "jacobian_raw": ("void", "t", "const* x", "const* k", "const* u", "* D"),
    "jacobian_parameters": ("void", "t", "const* x", "const* p", "const* u", "* D"),
    "momentum": ("void", "t", "const* x", "const* k", "* out"),
    "velocity": ("void", "t", "const* y", "const* k", "* out"),
    "velocity_step": ("void", "t", "const* x", "const* y", "const* k", "* out"),
    "momentum_rhs": ("void", "t", "const* y", "const* k", "const* u", "* dy"),
    "momentum_rates": ("void", "t", "const* x", "const* y", "const* k", "const* u", "* dy"),
    "poisson": ("void", "t", "const* y", "const* k", "* out"),
}
"""Function → what it returns, and what it takes in order: the contract with its callers."""

SIZES = ("STATE", "ALGEBRA", "PARAMETERS", "CONSTANTS", "INPUTS", "CONSERVED", "REDUCED", "MATRIX")
DECLARED = {"P": "PARAMETERS", "K": "CONSTANTS", "U": "INPUTS"}
"""Macro → the size that it declares: arrays that may be empty, which C does not have: SIZE is 1
then."""
LISTS = ("state", "parameter", "input", "conserved")
REFUSALS = ("SINGULAR", "NOT_FINITE")
"""What ``constants`` returns of a body that has no rates; with SIZES these are all enumerators."""
SIGNS = {"+": "add", "-": "sub", "*": "mul", "/": "div"}
SIGNS |= {">": "gt", "<": "lt", "<=": "le", "==": "eq"}


def read_c(name: str, files: Mapping[str, str], prefix: str) -> Module:
    """The module in a C file and the header it includes; ``CodeError`` says what cannot be read,
    and in which line."""
    c_ast, tree = parsed_c(name, files, prefix)
    found = CReader(c_ast, prefix).module(tree)
    if found.parameters is None:  # one header of functions names them in a comment
        named = re.findall(r"^ \*   p\[([0-9]+)\] (\w+)", files[name], re.MULTILINE)
        if [int(i) for i, _ in named] != list(range(found.sizes["PARAMETERS"])):
            raise CodeError("the parameters are not listed in order")
        found = replace(found, parameters=tuple(x for _, x in named))
    return found


def parsed_c(name: str, files: Mapping[str, str], prefix: str) -> tuple[Any, Any]:
    """The classes of a parser's nodes, and the tree of a C file with what it includes."""
    try:
        from pycparser import c_ast, c_parser
    except ImportError:
        raise MissingParserError(
            "C is read back by pycparser: install it by  pip install 'derive-mechanics[validate]'"
        ) from None
    text = "typedef unsigned long size_t;\n" + Preprocessor(files, prefix).text(name)
    try:
        return c_ast, c_parser.CParser().parse(text, name)
    except (c_parser.ParseError, RecursionError) as error:
        raise CodeError(f"not C: {error}") from None


class CReader:
    """The reader of one translation unit; ``c``: the classes of the parser's nodes."""

    def __init__(self, c: Any, prefix: str):
        self.c, self.prefix = c, prefix
        self.real = ""
        self.sizes: dict[str, int] = {}
        self.integers: set[str] = set()
        self.lists: dict[str, tuple[str, ...]] = {}
        self.functions: dict[str, CodeFunction] = {}
        self.declared: set[str] = set()

    def module(self, tree: Any) -> Module:
        """All functions and lists of the file; ``CodeError`` for any other definition."""
        for node in tree.ext[1:]:
            if self._of_integrals(node):
                continue
            if isinstance(node, self.c.FuncDef):
                self._function(node)
            elif isinstance(node, self.c.Decl):
                self._declaration(node)
            else:
                raise self._unknown(node)
        if missing := self.declared - set(self.functions):
            raise CodeError(f"the function {min(missing)} is declared and not defined")
        sizes = {x: self.sizes.get(f"{self.prefix}_N_{x}", -1) for x in SIZES}
        lists = (self.lists.get(f"{self.prefix}_{x}_names") for x in LISTS[:3])
        state, parameters, inputs = lists
        return Module(state, parameters, inputs, self.functions, sizes)

    def _of_integrals(self, node: Any) -> bool:
        """Is a definition that of what holds the integrals over an ellipsoid?"""
        return isinstance(node, self.c.Typedef) and node.name == f"{self.prefix}_integrals"

    def _unknown(self, node: Any) -> CodeError:
        kind, at = type(node).__name__, getattr(node, "coord", None)
        where = f" in {at.file}, line {at.line}" if at else ""
        return CodeError(f"C that is not known here: {kind}{where}")

    # -- declarations ------------------------------------------------------------------------

    @property
    def _enumerators(self) -> dict[str, int]:
        """The enumerators → their values, or 0 for those compared with the record."""
        sizes = dict.fromkeys((f"{self.prefix}_N_{x}" for x in SIZES), 0)
        counts = {x: self.sizes.get(f"{self.prefix}_N_{n}", 0) for x, n in DECLARED.items()}
        sizes |= {f"{self.prefix}_SIZE_{x}": max(1, n) for x, n in counts.items()}
        return sizes | {f"{self.prefix}_{x}": k for k, x in enumerate(REFUSALS, 1)}

    @property
    def _tables(self) -> set[str]:
        return {f"{self.prefix}_{x}_names" for x in LISTS}

    def _declaration(self, node: Any) -> None:
        """Read an enumeration, the prototype of a function, or a list of names."""
        c, kind = self.c, node.type
        if isinstance(kind, c.Enum) and kind.values:
            for x in kind.values.enumerators:
                known = x.name in self._enumerators and x.name not in self.sizes
                if not known or not isinstance(x.value, c.Constant):
                    raise self._unknown(x)
                self.sizes[x.name] = self._integer(x.value)[1]
                wanted = self._enumerators[x.name]
                if wanted and self.sizes[x.name] != wanted:
                    raise CodeError(f"{x.name} is {self.sizes[x.name]}, not {wanted}")
        elif isinstance(kind, c.FuncDecl):
            self._arguments(node)
            self.declared.add(node.name.removeprefix(f"{self.prefix}_"))
        elif isinstance(kind, c.ArrayDecl) and node.name in self._tables:
            if isinstance(node.init, c.InitList) and node.name not in self.lists:
                if not all(isinstance(x, c.Constant) for x in node.init.exprs):
                    raise self._unknown(node)
                self.lists[node.name] = tuple(x.value.strip('"') for x in node.init.exprs)
            elif node.init is not None or node.storage != ["extern"]:
                raise self._unknown(node)
        else:
            raise self._unknown(node)

    def _arguments(self, node: Any) -> tuple[str, ...]:
        """The names of a declared function's arguments, after a look at its signature."""
        name = node.name.removeprefix(f"{self.prefix}_")
        if node.type.args is None:
            raise self._unknown(node)
        found = [self._type(node.type.type), *(self._argument(x) for x in node.type.args.params)]
        if name not in SIGNATURES or tuple(found) != SIGNATURES[name]:
            raise CodeError(f"the function {node.name}({', '.join(found[1:])}) is not known here")
        return tuple(x.split()[-1] for x in found[1:])

    def _argument(self, node: Any) -> str:
        """An argument as SIGNATURES writes it, as ``const* x``."""
        if isinstance(node.type, self.c.PtrDecl):
            if self._type(node.type.type) != "real":
                raise self._unknown(node)
            const = "const" if "const" in node.type.type.quals else ""
            return f"{const}* {node.name}"
        kind = self._type(node.type)
        return str(node.name) if kind == "real" else f"{kind} {node.name}"

    def _type(self, node: Any) -> str:
        """The type at a node: "real" (double, or float), "int", "size_t" or "void"."""
        if not isinstance(node, self.c.TypeDecl) or len(getattr(node.type, "names", ())) != 1:
            raise self._unknown(node)
        (name,) = node.type.names
        if name in ("int", "size_t", "void"):
            return str(name)
        if name not in ("double", "float") or self.real not in ("", name):
            raise self._unknown(node)
        self.real = name
        return "real"

    # -- functions and statements ------------------------------------------------------------

    def _function(self, node: Any) -> None:
        name = node.decl.name.removeprefix(f"{self.prefix}_")
        arguments = self._arguments(node.decl)
        if name in self.functions:
            raise CodeError(f"the function {node.decl.name} stands twice")
        self.integers = {"n"} if name == "rhs_batch" else set()
        self.functions[name] = CodeFunction(name, arguments, self._body(node.body))

    def _body(self, node: Any) -> Body:
        if not isinstance(node, self.c.Compound):
            raise self._unknown(node)
        found = (self._statement(x) for x in node.block_items or ())
        return tuple(x for x in found if x is not None)

    def _statement(self, node: Any) -> Statement | None:
        c = self.c
        if isinstance(node, c.Decl) and node.init is not None and node.quals == ["const"]:
            plain = not node.storage and not node.funcspec and node.name not in self.sizes
            kept = getattr(getattr(node.type, "type", None), "names", None)
            if plain and kept == [f"{self.prefix}_integrals"]:
                return ("set", node.name, self._integrals(node.init))
            if self._type(node.type) == "real" and plain:
                return ("set", node.name, self._expression(node.init))
        elif isinstance(node, c.Assignment) and node.op == "=":
            if isinstance(node.lvalue, c.ArrayRef):
                _, array, index = self._expression(node.lvalue)
                return ("store", array, index, self._expression(node.rvalue))
        elif isinstance(node, c.If) and node.iffalse is None:
            return ("if", self._expression(node.cond), self._body(node.iftrue))
        elif isinstance(node, c.For):
            return self._loop(node)
        elif isinstance(node, c.Return) and node.expr is not None:
            return ("return", self._expression(node.expr))
        elif self._unused(node):
            return None
        raise self._unknown(node)

    def _unused(self, node: Any) -> bool:
        """Is a statement ``(void)t;``, which marks an argument as unused?"""
        c = self.c
        if not isinstance(node, c.Cast) or not isinstance(node.expr, c.ID):
            return False
        return self._type(node.to_type.type) == "void"

    def _loop(self, node: Any) -> Statement:
        """The statement of ``for (int i = 0; i < bound; ++i)``, also with size_t."""
        c, first = self.c, node.init
        if not isinstance(first, c.DeclList) or len(first.decls) != 1:
            raise self._unknown(node)
        (i,) = first.decls
        start, test, step = i.init, node.cond, node.next
        plain = (
            self._type(i.type) in ("int", "size_t")
            and isinstance(start, c.Constant)
            and start.value == "0"
            and isinstance(test, c.BinaryOp)
            and test.op == "<"
            and isinstance(step, c.UnaryOp)
            and step.op == "++"
            and all(isinstance(x, c.ID) and x.name == i.name for x in (test.left, step.expr))
        )
        if not plain:
            raise self._unknown(node)
        bound = self._place(test.right)
        self.integers.add(i.name)
        body = self._body(node.stmt)
        self.integers.discard(i.name)
        return ("for", i.name, bound, body)

    # -- expressions -------------------------------------------------------------------------

    def _expression(self, node: Any) -> Expression:
        c = self.c
        if isinstance(node, c.ID):
            if node.name in self.integers:
                raise CodeError(f"the integer {node.name} stands for a number")
            return ("int", self.sizes[node.name]) if node.name in self.sizes else ("var", node.name)
        if isinstance(node, c.Constant):
            return self._integer(node) if node.type == "int" else self._decimal(node)
        if isinstance(node, c.ArrayRef) and isinstance(node.name, c.StructRef):
            held, (kind, k) = node.name, self._place(node.subscript)
            if (
                isinstance(held.name, c.ID)
                and held.field.name == "v"
                and kind == "int"
                and k < MOST
            ):
                return ("fun", f"{INTEGRALS}_{k}", ("var", held.name.name))
            raise self._unknown(node)
        if isinstance(node, c.ArrayRef) and isinstance(node.name, c.ID):
            return ("at", node.name.name, self._place(node.subscript))
        elif isinstance(node, c.UnaryOp) and node.op in "-!":
            return ("neg" if node.op == "-" else "not", self._expression(node.expr))
        elif isinstance(node, c.BinaryOp) and node.op in SIGNS:
            if self._whole(node.left) and self._whole(node.right):
                raise CodeError("C cuts off a quotient of integers, and their sums and products")
            left, right = self._expression(node.left), self._expression(node.right)
            compared_with_zero = node.op == "==" and left[0] == "var" and right == ("int", 0)
            return ("none", left) if compared_with_zero else (SIGNS[node.op], left, right)
        elif isinstance(node, c.FuncCall) and isinstance(node.name, c.ID):
            return self._call(node)
        raise self._unknown(node)

    def _call(self, node: Any) -> Expression:
        suffix = "f" if self.real == "float" else ""
        name = node.name.name.removesuffix(suffix) if suffix else node.name.name
        if f"{name}{suffix}" != node.name.name or not node.args or len(node.args.exprs) != 1:
            raise self._unknown(node)
        (argument,) = node.args.exprs
        if name == "fabs":
            return ("abs", self._expression(argument))
        if name not in ELEMENTARY:
            raise CodeError(f"the function {node.name.name} is not known here")
        return ("fun", name, self._expression(argument))

    def _integrals(self, node: Any) -> Expression:
        """The call of a function of integrals over an ellipsoid."""
        whole = getattr(node.name, "name", "") if isinstance(node, self.c.FuncCall) else ""
        name = whole.removeprefix(f"{self.prefix}_")
        if name == whole or name not in BUNDLES:
            raise self._unknown(node)
        return ("fun", name, *map(self._expression, node.args.exprs))

    def _place(self, node: Any) -> Expression:
        """An index, or its bound: sums and multiples of the integers, without overflow."""
        c = self.c
        if isinstance(node, c.ID) and node.name in self.integers:
            return ("var", node.name)
        if isinstance(node, c.ID) and node.name in self.sizes:
            return ("int", self.sizes[node.name])
        if isinstance(node, c.Constant):
            return self._integer(node)
        if isinstance(node, c.BinaryOp) and node.op in "+*":
            sides = (node.left, node.right)
            if node.op == "+" or any(isinstance(x, c.ID) for x in sides):
                return (SIGNS[node.op], *map(self._place, sides))
        raise self._unknown(node)

    def _whole(self, node: Any) -> bool:
        """Is an expression of an integer type in C?"""
        c = self.c
        if isinstance(node, c.ID):
            return node.name in self.integers or node.name in self.sizes
        if isinstance(node, c.BinaryOp):
            return self._whole(node.left) and self._whole(node.right)
        if isinstance(node, c.UnaryOp):
            return self._whole(node.expr)
        return isinstance(node, c.Constant) and node.type == "int"

    def _integer(self, node: Any) -> Expression:
        if node.type != "int" or not re.fullmatch(r"0|[1-9][0-9]{0,6}", node.value):
            raise CodeError(f"the number {node.value[:40]!r} is not read")
        return ("int", int(node.value))

    def _decimal(self, node: Any) -> Expression:
        suffix = "f" if self.real == "float" else ""
        text = node.value.removesuffix(suffix)
        if f"{text}{suffix}" != node.value or not DECIMAL.fullmatch(text):
            raise CodeError(f"the number {node.value[:40]!r} is not read")
        return ("lit", text)
