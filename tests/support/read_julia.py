"""Emitted Julia read by a published grammar and evaluated; what is not known is an error.

There is no Julia here to run it.  The grammar is that of tree-sitter; values are NumPy's floats,
which mix Float32 and Float64 and divide by zero as Julia does, and integers, of which there is no
quotient.  Arrays count from 1 and know their bounds and the type of their entries.  A name that a
function assigns has no value before; one that a loop alone assigns is another one in each turn.

A function is compiled once: every node to a function of a frame, the values of all names in it.
"""

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from math import prod

import numpy as np
import tree_sitter
import tree_sitter_julia

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "atan")
LANGUAGE = tree_sitter.Language(tree_sitter_julia.language())
REALS = {"Float64": np.float64, "Float32": np.float32}
COMMENT = "line_comment"
LOOPS = ("for_statement", "while_statement")
ASSIGNMENTS = ("assignment", "compound_assignment_expression")


class JuliaError(Exception):
    """What Julia would not take, or what is not known here."""


class DomainError(Exception):
    """What Julia throws for a number that a function does not take."""


class DimensionMismatchError(Exception):
    """What Julia throws for an array of another length."""


def converted(value, kind):
    """A value as what has a type takes it; ``None``: the type of any real number."""
    if kind is None and isinstance(value, np.floating):
        return value
    if kind in REALS.values() and (isinstance(value, np.floating) or type(value) is int):
        return kind(value)
    if kind in (int, bool) and type(value) in (kind, {bool: np.bool_}.get(kind)):
        return kind(value)
    raise JuliaError(f"{value!r} is stored as {kind}")


class Numbers:
    """An array of a shape, whose numbers are undefined until they are written; ``kind``: their
    type, where that is known."""

    def __init__(self, *shape, values=None, kind=None):
        self.kind, self.array = kind, np.full(shape, None, dtype=object)
        if values is not None:
            self.array.flat = [*values]

    @classmethod
    def part(cls, array, kind):
        """One that has its numbers in the array of another."""
        found = cls(0, kind=kind)
        found.array = array
        return found

    @property
    def shape(self):
        return self.array.shape

    def _place(self, index):
        shape = self.array.shape
        if len(index) == 1 and len(shape) == 2 and type(index[0]) is int:  # column by column
            column, row = divmod(index[0] - 1, shape[0])
            index = row + 1, column + 1
        if len(index) != len(shape):
            raise JuliaError(f"{len(index)} indices in an array of {len(shape)}")
        for i, n in zip(index, shape, strict=True):
            if type(i) is not int or not 1 <= i <= n:
                raise JuliaError(f"BoundsError: {index} in an array of shape {shape}")
        return tuple([i - 1 for i in index])

    def __getitem__(self, index):
        value = self.array[self._place(index)]
        if value is None:
            raise JuliaError(f"{index} is read before it is written")
        return value

    def __setitem__(self, index, value):
        self.array[self._place(index)] = converted(value, self.kind)

    def __iter__(self):
        return iter(self.whole())

    def whole(self):
        """All numbers, row by row."""
        found = [*self.array.flat]
        if any(x is None for x in found):
            raise JuliaError("not all of an array is written")
        return found


COLON = object()
"""All indices."""


class Record:
    """A value of a mutable struct: ``kinds`` has the types of its fields."""

    def __init__(self, name, kinds, values):
        self.name, self.kinds, self.values = name, kinds, {}
        for x, value in values.items():
            self[x] = value

    def __getitem__(self, name):
        if name not in self.values:
            raise JuliaError(f"{self.name} has no field {name}")
        return self.values[name]

    def __setitem__(self, name, value):
        kind = self.kinds.get(name, self)
        if isinstance(kind, tuple):  # of an array: the type of its entries, the number of indices
            right = isinstance(value, Numbers) and (value.kind, len(value.shape)) == kind
        else:
            right = kind == "Any" or (isinstance(value, Record) and kind == value.name)
            if not right:
                value, right = converted(value, kind), True
        if not right:
            raise JuliaError(f"{self.name}.{name} cannot be {value!r}")
        self.values[name] = value


@dataclass
class Function:
    """A function of the module; ``keywords``: what is after the semicolon, with defaults, and
    ``defaults`` those of the last arguments; ``alone``: is its body an expression?  ``run``: its
    body, of a frame of ``size`` values."""

    name: str
    arguments: tuple
    keywords: dict
    defaults: tuple
    body: list
    alone: bool
    run: Callable | None = None
    size: int = 0


@dataclass
class Names:
    """Name → its place in a frame; ``size``: how many places there are, of all loops."""

    places: dict = field(default_factory=dict)
    size: list = field(default_factory=lambda: [0])

    def more(self, names):
        """With others, or the same name for something else, within a loop."""
        found = Names(dict(self.places), self.size)
        for x in names:
            found.places[x] = self.size[0]
            self.size[0] += 1
        return found


UNDEFINED, BREAK, CONTINUE = object(), object(), object()


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


def assigned(nodes):
    """The names that statements assign, but for loops within them."""
    found = {}
    for node in nodes:
        target = named(node)[0] if node.type in ASSIGNMENTS else None
        if target is not None and target.type == "identifier":
            found[text(target)] = None
        if node.type in ("if_statement", "else_clause", "elseif_clause"):
            found |= dict.fromkeys(assigned(named(node)))
    return [*found]


def elementary(name):
    """NumPy's function, which takes what Julia's does."""
    function = getattr(np, {"atan": "arctan"}.get(name, name))

    def value(x, *more):
        if more and name == "atan":
            return np.arctan2(x, *more)
        out = function(x, *more)
        if np.isnan(out) and not np.isnan(x):
            raise DomainError(f"{name}({x})")
        return out

    return value


def thrown(error):
    raise error


def real_of(x):
    """The type of the numbers of an array, as far as they are written."""
    return x.kind or next(type(v) for v in x.array.flat if v is not None)


def copied(x, y):
    values = [*y]
    if len(values) != x.array.size or (isinstance(y, Numbers) and x.shape != y.shape):
        raise JuliaError(f"{len(values)} numbers into an array of shape {x.shape}")
    x.array.flat = [converted(v, x.kind) for v in values]


def filled(x, value):
    x.array[...] = real_of(x)(value) if x.array.size else None


def viewed(x, *places):
    """A part of an array: an index, some in order, or all."""
    if len(places) != len(x.shape):
        raise JuliaError(f"{len(places)} indices in an array of {len(x.shape)}")
    found = []
    for i, n in zip(places, x.shape, strict=True):
        first, last = (1, n) if i is COLON else (i, i) if type(i) is int else (i[0], i[-1])
        if not (first >= 1 and last <= n):
            raise JuliaError(f"BoundsError: a view of {i} in {n}")
        found.append(first - 1 if type(i) is int else slice(first - 1, last))
    return Numbers.part(x.array[tuple(found)], x.kind)


def zeros(kind, *sizes):
    if type(kind) is int:
        kind, sizes = np.float64, (kind, *sizes)
    return Numbers(*sizes, values=[kind(0)] * prod(sizes), kind=kind)


def reshaped(x, *sizes):
    """Julia's arrays are by columns."""
    return Numbers.part(x.array.reshape(sizes, order="F"), x.kind)


def permuted(x, order):
    return Numbers.part(x.array.transpose([i - 1 for i in order]), x.kind)


def vector(values):
    """What stands in brackets, of one type."""
    (kind,) = {*map(type, values)}
    return Numbers(len(values), values=values, kind=kind)


def quotient(a, b):
    if type(a) is not int or type(b) is not int or a < 0 or b <= 0:
        raise JuliaError(f"div({a!r}, {b!r}) is not known here")
    return a // b


def truncated(kind, x):
    if kind is not int or not np.isfinite(x):
        raise JuliaError(f"InexactError: trunc({kind}, {x})")
    return int(x)


BUILT_IN = {
    **REALS,
    **{name: elementary(name) for name in FUNCTIONS},
    "Int": int,
    "Bool": bool,
    "Any": "Any",
    "Function": Callable,
    "nothing": None,
    "NaN": np.float64("nan"),
    "Inf": np.float64("inf"),
    "Inf32": np.float32("inf"),
    "abs": abs,
    "isfinite": np.isfinite,
    "isinf": np.isinf,
    "iszero": lambda x: x == 0,
    "all": lambda f, x: all(map(f, x)),
    "any": lambda f, x: any(map(f, x)),
    "ntuple": lambda f, n: tuple(f(i + 1) for i in range(n)),
    "zero": lambda real: real(0),
    "float": lambda x: x,
    "typeof": type,
    "oftype": lambda x, value: type(x)(value),
    "eltype": lambda x: max((type(v) for v in x), key=lambda t: t().itemsize, default=np.float64),
    "promote_type": lambda a, b: np.result_type(a, b).type,
    "throw": thrown,
    "sum": lambda x: sum(x[1:], x[0]),
    "muladd": lambda a, b, c: a * b + c,
    "div": quotient,
    "trunc": truncated,
    "similar": lambda x: Numbers(*x.shape),
    "zeros": zeros,
    "collect": lambda x: vector([*x]),
    "reshape": reshaped,
    "PermutedDimsArray": permuted,
    "view": viewed,
    "copyto!": copied,
    "fill!": filled,
    "length": lambda x: x.array.size if isinstance(x, Numbers) else len(x),
    "DomainError": lambda given, why: DomainError(why),
    "DimensionMismatch": lambda why: DimensionMismatchError(why),
}  # fmt: skip


def arithmetic(op):
    """Of real numbers, of which one may be an integer or a truth value, or of integers alone."""

    def value(a, b):
        real, other = isinstance(a, np.floating), isinstance(b, np.floating)
        if real and other:
            return op(a, b)
        if real and type(b) in WHOLE:
            return op(a, type(a)(b))
        if type(a) in WHOLE and other:
            return op(type(b)(a), b)
        if type(a) is int and type(b) is int and op is not operator.truediv:
            return op(a, b)
        raise JuliaError(f"arithmetic of {a!r} and {b!r} is not known here")

    return value


WHOLE = (int, bool, np.bool_)


def power(a, b):
    if a < 0:
        raise DomainError(f"{a}^{b}")
    return a**b


def remainder(a, b):
    return a - b * quotient(a, b)


BINARY = {
    "+": arithmetic(operator.add),
    "-": arithmetic(operator.sub),
    "*": arithmetic(operator.mul),
    "/": arithmetic(operator.truediv),
    "^": arithmetic(power),
    "%": remainder,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "===": operator.is_,
    "isa": isinstance,
}


def truth(value):
    """A condition."""
    if type(value) is bool:
        return value
    if type(value) is not np.bool_:
        raise JuliaError(f"a condition that is {value!r}")
    return bool(value)


class Module:
    """The one module of a text: ``names`` has its constants, ``functions`` its functions."""

    def __init__(self, source):
        # 2.0*(a) may be taken for 2.0 before a call of *
        apart = re.sub(r"(?<=[\w.)])([*/^])(?=\()", r" \1 ", source)
        tree = tree_sitter.Parser(LANGUAGE).parse(apart.encode("utf-8"))
        if tree.root_node.has_error:
            bad = next(x for x in descendants(tree.root_node) if x.is_error or x.is_missing)
            raise JuliaError(f"no syntax of Julia: line {bad.start_point[0] + 1}: {text(bad)[:60]}")
        (module,) = named(tree.root_node)
        if module.type != "module_definition":
            raise unknown(module)
        self.names, self.functions, self.methods = {}, {}, {}
        name, *body = named(module)
        self.name = text(name)
        for node, after in pairwise([*body, None]):
            self._define(node, after)

    def _define(self, node, after):
        if node.type == "const_statement":
            target, _, value = named(named(node)[0])
            self._new(text(target), self._now(value))
        elif node.type == "function_definition":
            signature, *body = named(node)
            self._function(named(signature)[0], body)
        elif node.type == "assignment" and named(node)[0].type == "call_expression":
            signature, _, value = named(node)
            self._function(signature, [value], alone=True)
        elif node.type == "macrocall_expression":
            self._record(node)
        elif node.type != "string_literal" or after is None:  # a docstring
            raise unknown(node)

    def _now(self, node):
        """The value of what stands outside of functions."""
        names = Names()
        value = self._value(node, names)
        return value([UNDEFINED] * names.size[0])

    def _new(self, name, value):
        hidden = name in BUILT_IN and not (name in FUNCTIONS and callable(value))
        if name in self.names or hidden:
            raise JuliaError(f"{name} has a meaning already")
        self.names[name] = value

    def _record(self, node):
        """``Base.@kwdef mutable struct``, made without arguments, or by a function of its name."""
        *_, (definition,) = [named(x) for x in named(node)]
        if not text(node).startswith("Base.@kwdef mutable struct "):
            raise unknown(node)
        head, *fields = named(definition)
        name, kinds, values = text(head), {}, {}
        for x in fields:
            typed, _, value = named(x)
            known, kind = named(typed)
            kinds[text(known)], values[text(known)] = self._kind(kind), value
        methods = {0: lambda: Record(name, kinds, {x: self._now(v) for x, v in values.items()})}
        self.methods[name] = methods

        def made(*given):
            if len(given) not in methods:
                raise JuliaError(f"MethodError: {name} of {len(given)} arguments")
            return methods[len(given)](*given)

        self._new(name, made)

    def _kind(self, node):
        if node.type == "identifier":
            return text(node) if text(node) in self.methods else BUILT_IN[text(node)]
        name, listed = named(node)
        real, count = map(text, named(listed))
        if text(name) != "Array":
            raise unknown(node)
        return BUILT_IN[real], int(count)

    def _function(self, signature, body, *, alone=False):
        name, listed = named(signature)
        arguments, keywords, defaults, after = [], {}, [], False
        for x in listed.children:
            after = after or x.type == ";"
            if x.type == "identifier" and not after and not defaults:
                arguments.append(text(x))
            elif x.type == "named_argument":
                key, _, value = named(x)
                if after:
                    keywords[text(key)] = self._now(value)
                else:
                    arguments.append(text(key))
                    defaults.append(self._now(value))
            elif x.is_named:
                raise unknown(x)
        if len({*arguments, *keywords}) < len(arguments) + len(keywords):
            raise unknown(signature)
        found = Function(text(name), tuple(arguments), keywords, tuple(defaults), body, alone)

        def called(*given, **by_name):
            return self._run(found, given, by_name)

        if found.name in self.methods:
            self.methods[found.name][len(arguments)] = called
        else:
            self._new(found.name, called)
        self.functions[found.name] = found

    def _run(self, f, given, by_name):
        if left := len(f.arguments) - len(given):
            given = (*given, *(f.defaults[-left:] if 0 < left <= len(f.defaults) else ()))
        if len(given) != len(f.arguments) or not {*by_name} <= {*f.keywords}:
            raise JuliaError(f"MethodError: {f.name} takes {f.arguments}; {tuple(f.keywords)}")
        if f.run is None:
            self._compile(f)
        keywords = f.keywords | by_name
        frame = [*given, *keywords.values()]
        frame += [UNDEFINED] * (f.size - len(frame))
        done = f.run(frame)
        if done is None:
            raise JuliaError(f"{f.name} returns nothing that is said")
        return done[0]

    def _compile(self, f):
        """The body of a function, when it is called first."""
        names = Names().more([*f.arguments, *f.keywords])
        names = names.more([x for x in assigned(f.body) if x not in names.places])
        if f.alone:
            value = self._value(f.body[0], names)
            f.run = lambda frame: (value(frame),)
        else:
            f.run = self._block(f.body, names)
        f.size = names.size[0]

    def call(self, name, *given, **by_name):
        """The value of a function of the module."""
        with np.errstate(all="ignore"):
            return self.names[name](*given, **by_name)

    # -- statements: what they find is ``None``, or why what follows is left, or (value,) ---------

    def _block(self, nodes, names):
        parts = [self._statement(x, names) for x in nodes]

        def run(frame):
            for part in parts:
                done = part(frame)
                if done is not None:
                    return done
            return None

        return run

    def _statement(self, node, names):
        kind = node.type
        if kind == "return_statement":
            (value,) = [self._value(x, names) for x in named(node)] or [lambda frame: None]
            return lambda frame: (value(frame),)
        if kind in ("break_statement", "continue_statement"):
            signal = BREAK if kind.startswith("break") else CONTINUE
            return lambda frame: signal
        if kind in ASSIGNMENTS:
            return self._assignment(node, names)
        if kind == "if_statement":
            return self._branch(named(node), names)
        if kind in LOOPS:
            return self._loop(node, names)
        if kind == "binary_expression" and text(named(node)[1]) in ("&&", "||"):
            left, op, right = named(node)
            condition, wanted = self._value(left, names), text(op) == "&&"
            if right.type == "return_statement" or text(right).startswith("throw("):
                then = self._statement(right, names)
                return lambda frame: then(frame) if truth(condition(frame)) == wanted else None
        if kind == "call_expression":
            called = text(named(node)[0])
            if called == "throw" or called.endswith("!"):
                value = self._value(node, names)
                return lambda frame: value(frame) and None
        raise unknown(node)  # what begins a line with a sign, say, after an expression

    def _branch(self, nodes, names):
        """A condition, statements, and what is otherwise."""
        test, *rest = nodes
        clauses = [x for x in rest if x.type in ("elseif_clause", "else_clause")]
        condition = self._value(test, names)
        then = self._block([x for x in rest if x not in clauses], names)
        otherwise = self._block([], names)
        for x in reversed(clauses):
            if x.type == "else_clause":
                otherwise = self._block(named(x), names)
            elif len(clauses) > 1 or rest:
                raise unknown(x)
        return lambda frame: then(frame) if truth(condition(frame)) else otherwise(frame)

    def _loop(self, node, names):
        """What a name has from within a loop alone it has within each turn alone."""
        head, *body = named(node)
        counted = [text(named(head)[0])] if node.type == "for_statement" else []
        own = [x for x in assigned(body) if x not in names.places and x not in counted]
        within = names.more([*counted, *own])
        places = [within.places[x] for x in own]
        run = self._block(body, within)

        def turn(frame):
            for i in places:
                frame[i] = UNDEFINED
            return run(frame)

        if counted:
            place, values = within.places[counted[0]], self._value(named(head)[2], names)

            def for_each(frame):
                for i in values(frame):
                    frame[place] = i
                    done = turn(frame)
                    if done is BREAK:
                        break
                    if done is not None and done is not CONTINUE:
                        return done
                return None

            return for_each
        condition = self._value(head, names)

        def as_long(frame):
            while truth(condition(frame)):
                done = turn(frame)
                if done is BREAK:
                    break
                if done is not None and done is not CONTINUE:
                    return done
            return None

        return as_long

    def _assignment(self, node, names):
        target, op, value = named(node)
        found = self._value(value, names)
        if text(op) != "=":
            before, combined, more = self._value(target, names), BINARY[text(op)[:-1]], found
            found = lambda frame: combined(before(frame), more(frame))  # noqa: E731
        if target.type == "identifier":
            place = names.places[text(target)]
            return lambda frame: operator.setitem(frame, place, found(frame))
        if target.type == "index_expression":
            array, index = self._value(named(target)[0], names), self._index(target, names)
            return lambda frame: operator.setitem(array(frame), index(frame), found(frame))
        if target.type == "field_expression":
            record, name = named(target)
            of, name = self._value(record, names), text(name)
            return lambda frame: operator.setitem(of(frame), name, found(frame))
        raise unknown(node)

    def _index(self, node, names):
        first, *more = [self._value(x, names) for x in named(named(node)[1])]
        if not more:
            return lambda frame: (first(frame),)
        return lambda frame: (first(frame), *[x(frame) for x in more])

    # -- expressions: a function of a frame --------------------------------------------------

    def _value(self, node, names):
        function = getattr(self, f"_{node.type}", None)
        if function is None:
            raise unknown(node)
        return function(node, names)

    def _identifier(self, node, names):
        name, line = text(node), node.start_point[0] + 1
        if name in names.places:
            place = names.places[name]

            def local(frame):
                value = frame[place]
                if value is UNDEFINED:
                    raise JuliaError(f"UndefVarError: {name} in line {line}")
                return value

            return local

        def known(frame):
            for outer in (self.names, BUILT_IN):
                if name in outer:
                    return outer[name]
            raise JuliaError(f"UndefVarError: {name} in line {line}")

        return known

    def _integer_literal(self, node, names):
        value = int(text(node))
        return lambda frame: value

    def _boolean_literal(self, node, names):
        value = text(node) == "true"
        return lambda frame: value

    def _float_literal(self, node, names):
        written = text(node)
        value = (np.float32 if "f" in written else np.float64)(written.replace("f", "e"))
        return lambda frame: value

    def _string_literal(self, node, names):
        value = "".join(text(x) for x in named(node))
        return lambda frame: value

    def _range_expression(self, node, names):
        first, last = named(node)
        by = None
        if first.type == "range_expression":
            first, by = named(first)
        parts = [self._value(x, names) for x in (first, last, *[by] * (by is not None))]

        def value(frame):
            begin, end, *step = [x(frame) for x in parts]
            back = -1 if step and step[0] < 0 else 1
            return range(begin, end + back, *step)

        return value

    def _several(self, nodes, names):
        parts = [self._value(x, names) for x in nodes]
        return lambda frame: [x(frame) for x in parts]

    def _tuple_expression(self, node, names):
        values = self._several(named(node), names)
        return lambda frame: tuple(values(frame))

    def _vector_expression(self, node, names):
        values = self._several(named(node), names)
        return lambda frame: vector(values(frame))

    def _parenthesized_expression(self, node, names):
        (inside,) = named(node)
        return self._value(inside, names)

    def _index_expression(self, node, names):
        array, index = self._value(named(node)[0], names), self._index(node, names)

        def value(frame):
            of, at = array(frame), index(frame)
            if isinstance(of, tuple):
                if not 1 <= at[0] <= len(of):
                    raise JuliaError(f"BoundsError: {at} of {len(of)}")
                return of[at[0] - 1]
            return of[at]

        return value

    def _field_expression(self, node, names):
        record, name = named(node)
        name = text(name)
        if text(record) == "Base":
            return lambda frame: BUILT_IN[name]
        of = self._value(record, names)
        return lambda frame: of(frame)[name]

    def _unary_expression(self, node, names):
        sign, inside = named(node)
        return self._signed(text(sign), inside, names)

    def _signed(self, sign, inside, names):
        value = self._value(inside, names)
        if sign == "-":
            return lambda frame: -value(frame)
        if sign == "!":
            return lambda frame: not truth(value(frame))
        raise unknown(inside)

    def _binary_expression(self, node, names):
        left, op, right = named(node)
        a, b, op = self._value(left, names), self._value(right, names), text(op)
        if op == "&&":
            return lambda frame: truth(a(frame)) and truth(b(frame))
        if op == "||":
            return lambda frame: truth(a(frame)) or truth(b(frame))
        if op not in BINARY:
            raise unknown(node)
        combined = BINARY[op]
        return lambda frame: combined(a(frame), b(frame))

    def _ternary_expression(self, node, names):
        test, yes, no = (self._value(x, names) for x in named(node))
        return lambda frame: (yes if truth(test(frame)) else no)(frame)

    def _arrow_function_expression(self, node, names):
        arguments, body = named(node)
        listed = [arguments] if arguments.type == "identifier" else named(arguments)
        within = names.more([text(x) for x in listed if x.type == "identifier"])
        places = [within.places[text(x)] for x in listed if x.type == "identifier"]
        value = self._value(body, within)

        def made(frame):
            def called(*given):
                own = [*frame]
                for place, x in zip(places, given, strict=True):
                    own[place] = x
                return value(own)

            return called

        return made

    def _each(self, inside, clause, names):
        """The values of an expression that is for each of some."""
        name, _, values = named(named(clause)[0])
        within = names.more([text(name)])
        place, several = within.places[text(name)], self._value(values, names)
        value = self._value(inside, within)

        def found(frame):
            own = [*frame]
            return [value(own) for own[place] in several(frame)]

        return found

    def _call_expression(self, node, names):
        head, listed = named(node)
        positional = [x for x in named(listed) if x.type != "named_argument"]
        if head.type == "parametrized_type_expression":
            return self._vector(head, listed, names)
        if head.type == "operator" and len(positional) == 1:
            return self._signed(text(head), positional[0], names)
        if positional[-1:] and positional[-1].type == "for_clause":
            each = self._each(*positional, names)
            given = lambda frame: [each(frame)]  # noqa: E731
        else:
            given = self._several(positional, names)
        by_name = [named(x) for x in named(listed) if x.type == "named_argument"]
        keys = [text(key) for key, _, _ in by_name]
        values = self._several([value for _, _, value in by_name], names)
        function = self._value(head, names)
        if not keys:
            return lambda frame: function(frame)(*given(frame))
        return lambda frame: function(frame)(
            *given(frame), **dict(zip(keys, values(frame), strict=True))
        )

    def _operator(self, node, names):
        if text(node) != ":":
            raise unknown(node)
        return lambda frame: COLON

    def _vector(self, head, listed, names):
        """``Vector{T}(undef, n)``."""
        name, kind = named(head)
        undefined, count = named(listed)
        if (text(name), text(undefined)) != ("Vector", "undef"):
            raise unknown(head)
        (real,), size = (self._value(x, names) for x in named(kind)), self._value(count, names)

        def made(frame):
            if real(frame) not in REALS.values():
                raise unknown(head)
            return Numbers(size(frame))

        return made
