"""Emitted Julia read by a published grammar and evaluated; what is not known is an error.

There is no Julia here to run it.  The grammar is that of tree-sitter; values are NumPy's floats,
which mix Float32 and Float64 and divide by zero as Julia does; arrays count from 1 and know their
bounds, and a name that a function assigns has no value before.
"""

import operator
import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import tree_sitter
import tree_sitter_julia

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "atan")
LANGUAGE = tree_sitter.Language(tree_sitter_julia.language())
REALS = {"Float64": np.float64, "Float32": np.float32}
COMMENT = "line_comment"


class JuliaError(Exception):
    """What Julia would not take, or what is not known here."""


class DomainError(Exception):
    """What Julia throws for a number that a function does not take."""


class DimensionMismatchError(Exception):
    """What Julia throws for an array of another length."""


class Numbers:
    """An array of a shape, whose numbers are undefined until they are written."""

    def __init__(self, *shape, values=None):
        self.shape = shape
        self.values = [None] * int(np.prod(shape)) if values is None else [*values]

    def _place(self, index):
        if len(index) != len(self.shape):
            raise JuliaError(f"{len(index)} indices in an array of {len(self.shape)}")
        for i, n in zip(index, self.shape, strict=True):
            if type(i) is not int or not 1 <= i <= n:
                raise JuliaError(f"BoundsError: {index} in an array of shape {self.shape}")
        return int(np.ravel_multi_index([i - 1 for i in index], self.shape))

    def __getitem__(self, index):
        value = self.values[self._place(index)]
        if value is None:
            raise JuliaError(f"{index} is read before it is written")
        return value

    def __setitem__(self, index, value):
        if not isinstance(value, np.floating):
            raise JuliaError(f"{value!r} is no number to store")
        self.values[self._place(index)] = value

    def __iter__(self):
        return iter(self.whole())

    def whole(self):
        """All numbers, row by row."""
        if any(x is None for x in self.values):
            raise JuliaError("not all of an array is written")
        return self.values


@dataclass
class Function:
    """A function of the module; ``keywords``: what is after the semicolon, with defaults."""

    name: str
    arguments: tuple
    keywords: dict
    body: list
    local: frozenset


def named(node):
    """The children that are not punctuation or comments."""
    return [x for x in node.named_children if x.type != COMMENT]


def text(node):
    return node.text.decode("utf-8")


def unknown(node):
    at = f"line {node.start_point[0] + 1}"
    return JuliaError(f"not known here: {node.type} in {at}: {text(node)[:60]}")


def descendants(node):
    yield node
    for x in node.children:
        yield from descendants(x)


def elementary(name):
    """NumPy's function, which takes what Julia's does."""

    def value(x):
        out = getattr(np, {"atan": "arctan"}.get(name, name))(x)
        if np.isnan(out) and not np.isnan(x):
            raise DomainError(f"{name}({x})")
        return out

    return value


def thrown(error):
    raise error


def real_of(x):
    """The type of the numbers of an array, as far as they are written."""
    return next(type(v) for v in x.values if v is not None)


def copied(x, y):
    if x.shape != y.shape:
        raise JuliaError(f"an array of shape {y.shape} into one of {x.shape}")
    x.values[:] = y.whole()


def filled(places, value):
    for x, i in places:
        x[i,] = real_of(x)(value)


BUILT_IN = {
    **REALS,
    **{name: elementary(name) for name in FUNCTIONS},
    "nothing": None,
    "abs": abs,
    "isfinite": np.isfinite,
    "iszero": lambda x: x == 0,
    "all": lambda f, x: all(map(f, x)),
    "any": lambda f, x: any(map(f, x)),
    "ntuple": lambda f, n: tuple(f(i + 1) for i in range(n)),
    "zero": lambda real: real(0),
    "eltype": lambda x: max((type(v) for v in x), key=lambda t: t().itemsize, default=np.float64),
    "promote_type": lambda a, b: np.result_type(a, b).type,
    "throw": thrown,
    "sum": lambda x: sum(x[1:], x[0]),
    "similar": lambda x: Numbers(*x.shape),
    "view": lambda x, places: [(x, i) for i in places],
    "copyto!": copied,
    "fill!": filled,
    "length": lambda x: int(np.prod(x.shape)) if isinstance(x, Numbers) else len(x),
    "DomainError": lambda given, why: DomainError(why),
    "DimensionMismatch": lambda why: DimensionMismatchError(why),
}  # fmt: skip


def arithmetic(op):
    def value(a, b):
        if not (isinstance(a, np.floating) or isinstance(b, np.floating)):
            raise JuliaError("arithmetic of integers is not known here")
        return op(a, b)

    return value


BINARY = {
    "+": arithmetic(operator.add),
    "-": arithmetic(operator.sub),
    "*": arithmetic(operator.mul),
    "/": arithmetic(operator.truediv),
    "<=": operator.le,
    "==": operator.eq,
    "===": operator.is_,
}


class Module:
    """The one module of a text: ``names`` has its constants, ``functions`` its functions."""

    def __init__(self, source):
        # 2.0*(a) may be taken for 2.0 before a call of *
        apart = re.sub(r"(?<=[\w.)])([*/])(?=\()", r" \1 ", source)
        tree = tree_sitter.Parser(LANGUAGE).parse(apart.encode("utf-8"))
        if tree.root_node.has_error:
            bad = next(x for x in descendants(tree.root_node) if x.is_error or x.is_missing)
            raise JuliaError(f"no syntax of Julia: line {bad.start_point[0] + 1}: {text(bad)[:60]}")
        (module,) = named(tree.root_node)
        if module.type != "module_definition":
            raise unknown(module)
        self.names, self.functions = {}, {}
        name, *body = named(module)
        self.name = text(name)
        for node, after in pairwise([*body, None]):
            self._define(node, after)

    def _define(self, node, after):
        if node.type == "const_statement":
            target, _, value = named(named(node)[0])
            self._new(text(target), self._value(value, {}))
        elif node.type == "function_definition":
            signature, *body = named(node)
            self._function(named(signature)[0], body)
        elif node.type == "assignment" and named(node)[0].type == "call_expression":
            signature, _, value = named(node)
            self._function(signature, [value])
        elif node.type != "string_literal" or after is None:  # a docstring
            raise unknown(node)

    def _new(self, name, value):
        if name in self.names or name in BUILT_IN:
            raise JuliaError(f"{name} has a meaning already")
        self.names[name] = value

    def _function(self, signature, body):
        name, listed = named(signature)
        arguments, keywords, after = [], {}, False
        for x in listed.children:
            after = after or x.type == ";"
            if x.type == "identifier" and not after:
                arguments.append(text(x))
            elif x.type == "named_argument" and after:
                key, _, value = named(x)
                keywords[text(key)] = self._value(value, {})
            elif x.is_named:
                raise unknown(x)
        if len({*arguments, *keywords}) < len(arguments) + len(keywords):
            raise unknown(signature)
        statements = [x for b in body for x in descendants(b) if x.type == "assignment"]
        local = frozenset(text(named(x)[0]) for x in statements)
        found = Function(text(name), tuple(arguments), keywords, body, local)
        self._new(found.name, lambda *given, **by_name: self._run(found, given, by_name))
        self.functions[found.name] = found

    def _run(self, f, given, by_name):
        if len(given) != len(f.arguments) or not {*by_name} <= {*f.keywords}:
            raise JuliaError(f"MethodError: {f.name} takes {f.arguments}; {tuple(f.keywords)}")
        undefined = dict.fromkeys(f.local, JuliaError)
        scope = undefined | dict(zip(f.arguments, given, strict=True)) | f.keywords | by_name
        with np.errstate(all="ignore"):
            if f.body[0].type in ("arrow_function_expression", "call_expression"):
                return self._value(f.body[0], scope)
            done, value = self._statements(f.body, scope)
        if not done:
            raise JuliaError(f"{f.name} returns nothing that is said")
        return value

    def call(self, name, *given, **by_name):
        """The value of a function of the module."""
        return self.names[name](*given, **by_name)

    # -- statements --------------------------------------------------------------------------

    def _statements(self, nodes, scope):
        for node in nodes:
            if node.type == "return_statement":
                (value,) = named(node)
                return True, self._value(value, scope)
            if node.type == "assignment":
                self._assign(node, scope)
            elif node.type == "if_statement" and all(
                x.type not in ("else_clause", "elseif_clause") for x in named(node)
            ):
                condition, *body = named(node)
                if self._condition(condition, scope):
                    done, value = self._statements(body, scope)
                    if done:
                        return True, value
            elif node.type == "for_statement":
                done, value = self._loop(node, scope)
                if done:
                    return True, value
            elif node.type == "binary_expression" and named(node)[2].type == "return_statement":
                condition, op, (value,) = *named(node)[:2], named(named(node)[2])
                if self._condition(condition, scope) == (text(op) == "&&"):
                    return True, self._value(value, scope)
            elif text(node).startswith(("throw(", "all(", "length(")) or (
                node.type == "call_expression" and text(named(node)[0]).endswith("!")
            ):
                self._value(node, scope)
            else:
                raise unknown(node)  # what begins a line with a sign, say, after an expression
        return False, None

    def _loop(self, node, scope):
        """What a name has from within a loop it has within each turn alone."""
        binding, *body = named(node)
        outside = [x for x, value in scope.items() if value is not JuliaError]
        for turn in self._turns(binding, scope):
            own = scope | turn
            done, value = self._statements(body, own)
            scope.update({x: own[x] for x in outside})
            if done:
                return True, value
        return False, None

    def _turns(self, binding, scope):
        name, _, values = named(binding)
        return [{text(name): i} for i in self._value(values, scope)]

    def _assign(self, node, scope):
        target, _, value = named(node)
        if target.type == "identifier":
            scope[text(target)] = self._value(value, scope)
        elif target.type == "index_expression":
            array, index = named(target)
            self._value(array, scope)[self._index(index, scope)] = self._value(value, scope)
        else:
            raise unknown(node)

    def _index(self, node, scope):
        return tuple(self._value(x, scope) for x in named(node))

    # -- expressions -------------------------------------------------------------------------

    def _value(self, node, scope):
        function = getattr(self, f"_{node.type}", None)
        if function is None:
            raise unknown(node)
        return function(node, scope)

    def _condition(self, node, scope):
        value = self._value(node, scope)
        if type(value) not in (bool, np.bool_):
            raise JuliaError(f"a condition that is {value!r}")
        return bool(value)

    def _identifier(self, node, scope):
        name = text(node)
        for names in (scope, self.names, BUILT_IN):
            if name in names:
                if names[name] is JuliaError:
                    break
                return names[name]
        raise JuliaError(f"UndefVarError: {name} in line {node.start_point[0] + 1}")

    def _integer_literal(self, node, scope):
        return int(text(node))

    def _boolean_literal(self, node, scope):
        return text(node) == "true"

    def _range_expression(self, node, scope):
        first, last = (self._value(x, scope) for x in named(node))
        return range(first, last + 1)

    def _float_literal(self, node, scope):
        written = text(node)
        real = np.float32 if "f" in written else np.float64
        return real(written.replace("f", "e"))

    def _string_literal(self, node, scope):
        return "".join(text(x) for x in named(node))

    def _tuple_expression(self, node, scope):
        return tuple(self._value(x, scope) for x in named(node))

    def _parenthesized_expression(self, node, scope):
        (inside,) = named(node)
        return self._value(inside, scope)

    def _each(self, inside, clause, scope):
        """The values of an expression that is for each of some."""
        (binding,) = named(clause)
        return [self._value(inside, scope | turn) for turn in self._turns(binding, scope)]

    def _index_expression(self, node, scope):
        array, index = named(node)
        array = self._value(array, scope)
        index = self._index(index, scope)
        return array[index[0] - 1] if isinstance(array, tuple) else array[index]

    def _unary_expression(self, node, scope):
        sign, inside = named(node)
        if text(sign) != "-":
            raise unknown(node)
        return -self._value(inside, scope)

    def _binary_expression(self, node, scope):
        left, op, right = named(node)
        if text(op) in ("&&", "||"):
            a = self._condition(left, scope)
            return self._value(right, scope) if a == (text(op) == "&&") else a
        if text(op) not in BINARY:
            raise unknown(node)
        return BINARY[text(op)](self._value(left, scope), self._value(right, scope))

    def _ternary_expression(self, node, scope):
        condition, yes, no = named(node)
        return self._value(yes if self._condition(condition, scope) else no, scope)

    def _arrow_function_expression(self, node, scope):
        arguments, body = named(node)
        listed = [arguments] if arguments.type == "identifier" else named(arguments)
        names = [text(x) for x in listed if x.type == "identifier"]
        return lambda *given: self._value(body, scope | dict(zip(names, given, strict=True)))

    def _call_expression(self, node, scope):
        head, listed = named(node)
        positional = [x for x in named(listed) if x.type != "named_argument"]
        if head.type == "parametrized_type_expression":
            return self._vector(head, listed, scope)
        if positional[-1:] and positional[-1].type == "for_clause":
            given = [self._each(*positional, scope)]
        else:
            given = [self._value(x, scope) for x in positional]
        if head.type == "operator" and text(head) == "-" and len(given) == 1:
            return -given[0]
        by_name = [named(x) for x in named(listed) if x.type == "named_argument"]
        keywords = {text(key): self._value(value, scope) for key, _, value in by_name}
        return self._value(head, scope)(*given, **keywords)

    def _vector(self, head, listed, scope):
        """``Vector{T}(undef, n)``."""
        name, kind = named(head)
        undefined, count = named(listed)
        (real,) = (self._value(x, scope) for x in named(kind))
        if (text(name), text(undefined)) != ("Vector", "undef") or real not in REALS.values():
            raise unknown(head)
        return Numbers(self._value(count, scope))
