"""Emitted files read, each by its language; of C, as a plain compiler sees it, all is read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import PurePath
from typing import Any

from .code_reader import SIZES, Reader, by_name
from .exact_points import BUNDLES
from .syntax import CONTRACT, SYNTAX, Token, tokens
from .terms import CodeError, Module, Statement, plain_text

DECLARED = {"P": "PARAMETERS", "K": "CONSTANTS", "U": "INPUTS"}
"""Macro → the size that it declares: arrays that may be empty, which C does not have: SIZE is 1
then."""
LISTS = ("state", "parameter", "input", "output", "conserved", "event")
PLACES = {"X": "state", "P": "parameters", "U": "inputs", "Y": "outputs"}
"""The letters of the places of numbers, and of what."""
REFUSALS = ("SINGULAR", "NOT_FINITE")
"""What ``constants`` returns of a body that has no rates; with SIZES these are all enumerators."""
COMMENT = re.compile(r'"[^"\n]*"|/\*.*?\*/|//[^\n]*', re.DOTALL)
NEUTRAL = (
    "#ifndef {guard}_H\n#define {guard}_H\n",
    """#if defined(__cplusplus) || defined(__GNUC__)
#define {prefix}_RESTRICT __restrict
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 199901L
#define {prefix}_RESTRICT restrict
#else
#define {prefix}_RESTRICT
#endif
""",
    """#ifndef {prefix}_FUNCTION
#if defined(__CUDACC__) || defined(__HIPCC__)
#define {prefix}_FUNCTION static __host__ __device__ inline
#else
#define {prefix}_FUNCTION static inline
#endif
#endif
""",
    '#ifdef __cplusplus\nextern "C" {{\n#endif\n',
    "#ifdef __cplusplus\n}}\n#endif\n",
    """#ifdef _OPENMP
#pragma omp parallel for simd if (parallel : n > 4096)
#elif defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#endif
""",
    """#ifdef _OPENMP
#pragma omp parallel for if (parallel : n > 4096)
#elif defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
""",
    "#include <math.h>\n",
    "#include <stddef.h>\n",
)
"""All directives that emitted files have: none of them changes what is computed."""


LANGUAGES = {
    ".h": "c",
    ".c": "c",
    ".hpp": "cpp",
    ".py": "python",
    ".rs": "rust",
    ".jl": "julia",
    ".mjs": "javascript",
}
"""The end of a file's name → its language."""
LOOP = re.compile(
    r"/\* (Newton's method|Carlson's duplication) \*/\n.*?/\* end of \1 \*/\n", re.DOTALL
)
"""What of emitted C is a loop that is not read, between two comments with its name."""


Beside = Sequence[tuple[str, Any]]
"""What of a file is not read: the line where it stands, or its name; a word and its column, or the
text."""


@dataclass(frozen=True)
class FileRead:
    """What a file says, and what of it is not read."""

    module: Module
    unread: Beside


def read(name: str, files: Mapping[str, str], prefix: str) -> FileRead:
    """The reading of a file of an emission, in C with the header that it includes; ``CodeError``
    says what cannot be read, and in which line."""
    language = LANGUAGES[PurePath(name).suffix]
    text = files[name]
    if language == "c":
        loops = [(m[1], m[0]) for x in files.values() for m in LOOP.finditer(x)]
        plain = {x: LOOP.sub(lambda m: blank(m[0]), text) for x, text in files.items()}
        module, events = read_c(name, plain, prefix)
        return FileRead(module, [*loops, *(("events", x.text) for x in events)])
    cookie = re.compile(r"[ \t\f]*#.*?coding[:=]")
    if language == "python" and any(map(cookie.match, text.split("\n")[:2])):
        raise CodeError("a line that names an encoding is not read")
    reader = Reader(language, tokens(SYNTAX[language], text, name), prefix)
    return FileRead(reader.module(), unread_text(reader, text))


def unread_text(reader: Reader, text: str) -> Beside:
    """What a reader has left of a text."""
    lines = text.split("\n")
    return [(lines[x.line - 1].strip(), x[:2]) for x in reader.unread]


def read_c(name: str, files: Mapping[str, str], prefix: str) -> tuple[Module, Sequence[Token]]:
    """The module in a C file without loops and the header it includes, and what is not read."""
    reader = CReader("c", words(name, files, prefix), prefix)
    found = reader.module()
    if found.parameters is None:  # one header of functions names them in a comment
        named = re.findall(r"^ \*   p\[([0-9]+)\] (\w+)", files[name], re.MULTILINE)
        if [int(i) for i, _ in named] != list(range(found.sizes["PARAMETERS"])):
            raise CodeError("the parameters are not listed in order")
        found = replace(found, parameters=tuple(x for _, x in named))
    lists = (found.state, found.parameters, found.inputs, found.outputs)
    placed = [reader.places.get(x, y) for x, y in zip(PLACES, lists, strict=True)]
    for letter, listed, read in zip(PLACES, lists, placed, strict=True):
        if listed is not None and read != listed:
            raise CodeError(
                f"{prefix}_{letter}_… are not the places of the names of {PLACES[letter]}"
            )
    # one header has no list of names beside
    own: dict[str, Any] = dict(zip(PLACES.values(), placed, strict=True))
    return replace(found, **own, state_by_block=reader.by_block), reader.events


def calls_of_cpp(name: str, text: str, prefix: str) -> tuple[str, ...]:
    """The functions of C that a header of C++ calls; ``CodeError`` where one is not given what it
    takes, in order, or calls none."""
    found: dict[str, None] = {}
    reader = Reader("c", tokens(SYNTAX["c"], text, name), prefix)
    for i, token in enumerate(reader.tokens):
        reader.at = i
        function = token.text.removeprefix(f"{prefix}_")
        if function in CONTRACT and function != token.text and reader.near(1) == "(":
            start = reader.at + 2
            given = " ".join(x.text for x in reader.tokens[start : reader.closed(start)])
            names = [re.findall(r"\w+", x.replace(" data ", ""))[-1:] for x in given.split(",")]
            if names != [[x] for x in " ".join(CONTRACT[function]).split()]:
                reader.unknown(f"{token.text} is not given what it takes")
            found[function] = None
    return tuple(found)


def defaults_of_cpp(name: str, text: str, prefix: str) -> tuple[tuple[str, ...], dict[str, Any]]:
    """The parameters that a header of C++ lists, and their defaults; none where it has none."""
    tables, reader = dict[str, Any](), Reader("c", tokens(SYNTAX["c"], text, name), prefix)
    for i, token in enumerate(reader.tokens):
        reader.at = i
        if (
            token.text in ("parameter_names", "defaults")
            and reader.near(1) == reader.near(2) == "{"
        ):
            reader.at += 2
            tables[token.text] = reader.value()
    listed = tables.get("parameter_names", ())
    return listed, by_name(listed, tables["defaults"]) if "defaults" in tables else {}


def words(name: str, files: Mapping[str, str], prefix: str) -> Iterator[Token]:
    """The words of a file, after those of the header that it includes, without directives."""
    if not files.get(name):
        raise CodeError(f"the file {name!r} is missing")
    source = files[name]
    plain_text(source)
    if "\\" in source or "??" in source:
        raise CodeError("a backslash or a trigraph is not read")
    text = COMMENT.sub(lambda m: m[0] if m[0][0] == '"' else blank(m[0]), source)
    text = re.sub(r"[ \t]+$", "", text, flags=re.MULTILINE)
    for block in NEUTRAL:
        neutral = block.format(prefix=prefix, guard=prefix.upper())
        text = text.replace(neutral, "\n" * neutral.count("\n"))
    header = f'#include "{prefix}.h"\n'
    if header in text and name != f"{prefix}.h":
        yield from words(f"{prefix}.h", files, prefix)
        text = text.replace(header, "\n", 1)
    if name == f"{prefix}.h":
        text = re.sub(r"#endif\s*\Z", "", text)
    if left := re.search("#[^\n]*", text):
        line = text.count("\n", 0, left.start()) + 1
        raise CodeError(f"{name}, line {line}: the directive {left[0][:60]!r} is not known here")
    macros = (f"{prefix}_RESTRICT", f"{prefix}_FUNCTION")
    yield from (x for x in tokens(SYNTAX["c"], text, name) if x.text not in macros)


def blank(comment: str) -> str:
    """What a comment leaves in the text: a space, and its line ends."""
    return " " + "\n" * comment.count("\n")


class CReader(Reader):
    """The reader of C, all of which is known, declarations, lists of names and functions, but for
    ``events``."""

    def __init__(self, *given: Any):
        super().__init__(*given)
        self.events: list[Token] = []
        self.places: dict[str, tuple[str, ...]] = {}
        self.by_block: tuple[str, ...] | None = None

    def module(self) -> Module:
        """All functions and lists of the file; ``CodeError`` for any other definition."""
        declared: set[str] = set()
        while self.word:
            if not self._enumeration() and not self._list_of_names() and not self._further():
                name = self._function_named()
                self.head(name)
                if self.took(";"):
                    declared.add(name)
                else:
                    self.function(name)
        if missing := declared - set(self.functions):
            raise CodeError(f"the function {min(missing)} is declared and not defined")
        sizes = {x: self.sizes.get(f"{self.prefix}_N_{x}", -1) for x in SIZES}
        lists = (self.values.get(f"{self.prefix}_{x}_names") for x in LISTS[:4])
        state, parameters, inputs, outputs = lists
        if (defaults := self.values.get(f"{self.prefix}_defaults")) is not None:
            defaults = by_name(parameters or (), defaults)
        return Module(state, parameters, inputs, self.functions, sizes, defaults, outputs=outputs)

    def _further(self) -> bool:
        """Pass what holds the integrals over an ellipsoid, or what is no claim of the record and
        not read, the functions whose signs are events, where one stands here."""
        start = self.at
        if self.took(f"typedef struct {{ … }} {self.prefix}_integrals ;"):
            return True
        if not self.took(f"void {self.prefix}_events ( … )"):
            return False
        if not self.took(";"):
            self.take("{ … }")
        self.events += self.tokens[start : self.at]
        return True

    def _function_named(self) -> str:
        """The function of the contract whose head begins here."""
        name = self.near(1).removeprefix(f"{self.prefix}_")
        if name not in CONTRACT or name == self.near(1):
            self.unknown()
        return name

    def _enumeration(self) -> bool:
        """Read an enumeration of sizes, where one stands here."""
        start = self.at
        if self.near(2).startswith(f"{self.prefix}_AT_") and self.took("enum { … } ;"):
            self.events += self.tokens[start : self.at]
            return True
        if self._places():
            return True
        if not self.took("enum {"):
            return False
        while self.word != "}":
            name, known = self.word, self._enumerators()
            if name not in known or name in self.sizes:
                self.unknown()
            self.at += 1
            self.take("=")
            self.sizes[name] = self.integer()[1]
            if known[name] and self.sizes[name] != known[name]:
                raise CodeError(f"{name} is {self.sizes[name]}, not {known[name]}")
            if not self.took(",") and self.word != "}":
                self.unknown()
        self.take("} ;")
        return True

    def _places(self) -> bool:
        """Read the places of the numbers of x, p, u or y by their names, where they stand here."""
        letter = self.near(2).removeprefix(f"{self.prefix}_")[:2].removesuffix("_")
        head, found = f"{self.prefix}_{letter}_", list[str]()
        if letter == "X" and letter in self.places and self.took("enum {"):
            return self._by_block(head)
        if letter not in PLACES or letter in self.places or not self.took("enum {"):
            return False
        while self.word.startswith(head):
            found.append(self.next().removeprefix(head))
            self.take(f"= {len(found) - 1}")
            if not self.took(","):
                break
        self.places[letter] = tuple(found)
        self.take("} ;")
        return True

    def _by_block(self, head: str) -> bool:
        """Read the names of numbers of x by their blocks, each equal to another of its place."""
        own: dict[str, str] = {}
        while self.word.startswith(head):
            name = self.next().removeprefix(head)
            self.take("=")
            own[self.next().removeprefix(head)] = name
            if not self.took(","):
                break
        self.take("} ;")
        self.by_block = tuple(own.get(x, x) for x in self.places["X"])
        return True

    def _enumerators(self) -> dict[str, int]:
        """The enumerators → their values, or 0 for those compared with the record."""
        sizes = dict.fromkeys((f"{self.prefix}_N_{x}" for x in SIZES), 0)
        counts = {x: self.sizes.get(f"{self.prefix}_N_{n}", 0) for x, n in DECLARED.items()}
        sizes |= {f"{self.prefix}_SIZE_{x}": max(1, n) for x, n in counts.items()}
        return sizes | {f"{self.prefix}_{x}": k for k, x in enumerate(REFUSALS, 1)}

    def _list_of_names(self) -> bool:
        """Read the declaration of a list of names, or of the defaults, or the list, where one
        stands here."""
        stated, table = self.took("extern"), f"{self.prefix}_defaults"
        names = self.took("const char * const")
        if not names and not self.took(f"const double {table}", f"const float {table}"):
            self.at -= stated
            return False
        if names and self.word not in {f"{self.prefix}_{x}_names" for x in LISTS}:
            self.unknown()
        name = self.next() if names else table
        self.take("[ … ]")
        if not stated:
            self.take("=")
            if name in self.values:
                self.unknown(f"{name} stands twice")
            self.values[name] = found = self.value()
            kinds = str if names else Fraction | None
            if not isinstance(found, tuple) or not all(isinstance(x, kinds) for x in found):
                self.unknown(f"{name} is no list of {'names' if names else 'numbers'}")
        self.take(";")
        return True

    # -- statements --------------------------------------------------------------------------

    def statement(self, body: list[Statement]) -> None:
        """An assignment, a condition or a loop."""
        if self.took("if ("):
            condition = self.expression()
            self.take(") {")
            body.append(("if", condition, self._block()))
            return
        if self.took("for ("):
            body.append(self._loop())
            return
        if self.took(f"const {self.prefix}_integrals"):
            self.constant(body)
            if body[-1][2][1] not in BUNDLES:
                self.unknown("what are no integrals")
            self.end()
            return
        super().statement(body)

    def _block(self) -> tuple[Statement, ...]:
        """Statements, and the bracket after them."""
        found = tuple(self.body())
        self.take("}")
        return found

    def _loop(self) -> Statement:
        """What follows ``for (``: ``int i = 0; i < bound; ++i) { … }``, also with size_t."""
        if not self.took("int") and not self.took("size_t"):
            self.unknown()
        i = self.naming()
        self.take(f"= 0 ; {i} <")
        bound = self.integer_sum()
        self.take(f"; ++ {i} ) {{")
        self.counters.add(i)
        body = self._block()
        self.counters.discard(i)
        return ("for", i, bound, body)
