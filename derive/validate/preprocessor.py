"""Emitted C as a plain C99 compiler sees it: without comments, directives and macros.

Only what the emitted files contain is understood.  Under a condition, the guard of a header apart,
stand spellings of ``restrict`` and ``inline`` and nothing that computes, whether or not a compiler
would skip it; all else is an error.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .terms import CodeError, plain_text

COMMENT = re.compile(r'"[^"\n]*"|/\*.*?\*/|//[^\n]*', re.DOTALL)
WORD = re.compile(r'"[^"]*"|[A-Za-z_]\w*')
SPELLINGS = {
    "RESTRICT": ("", "restrict", "__restrict"),
    "FUNCTION": ("static inline", "static __host__ __device__ inline"),
}
"""The definitions that the macros of the files may have: none of them changes what is computed."""
SKIPPED = ('extern "C" {', "}")
LIBRARY = ("<math.h>", "<stddef.h>")
PRAGMAS = (
    "GCC ivdep",
    "clang loop vectorize(assume_safety)",
    *(f"omp parallel for{simd} if (parallel : n > 4096)" for simd in ("", " simd")),
)
"""All pragmas that emitted files have; others may change what is computed."""
VERSION = "__STDC_VERSION__ >= 199901L"


@dataclass(frozen=True)
class Branch:
    """One branch of an #if: is it ``taken``, was one ``before`` it; is the #if the ``guard`` of a
    header, or for C++ alone?"""

    taken: bool
    before: bool
    guard: bool = False
    cplusplus: bool = False


def _without_comment(comment: re.Match[str]) -> str:
    """What a comment leaves in the text: a space, and its line ends; a string stays as it is."""
    return comment[0] if comment[0][0] == '"' else " " + "\n" * comment[0].count("\n")


class Preprocessor:
    """A preprocessor of emitted C; ``files``: name → text; ``prefix``: of its macros' names."""

    def __init__(self, files: Mapping[str, str], prefix: str):
        self.files, self.prefix = files, prefix
        self.macros: dict[str, str] = {}
        self.seen: list[str] = []
        self.guards: set[str] = set()

    def text(self, name: str) -> str:
        """One file, its includes and macros replaced; ``CodeError`` for what is not known.

        Lines of the form ``# 7 "file"`` say where the next line stands.
        """
        if name not in self.files or name in self.seen:
            raise CodeError(f"the file {name!r} is missing, or included twice")
        self.seen.append(name)
        source = self.files[name]
        if "\\" in source or "??" in source:
            raise CodeError("a backslash or a trigraph is not read")
        plain_text(source)
        plain = COMMENT.sub(_without_comment, source)
        if "'" in re.sub(r'"[^"\n]*"', "", plain):
            raise CodeError("a character is not read")
        branches: list[Branch] = []
        lines = [f'# 1 "{name}"']
        for k, line in enumerate(plain.split("\n"), 1):
            try:
                lines.append(self._line(line.strip(), branches))
            except CodeError as error:
                raise CodeError(f"{name}, line {k}: {error}") from None
            if "\n" in lines[-1]:  # another file stands here
                lines.append(f'# {k + 1} "{name}"')
        if branches:
            raise CodeError("an #if without #endif")
        return "\n".join(lines)

    def _line(self, line: str, branches: list[Branch]) -> str:
        """The text that replaces one line; directives change the open ``branches``."""
        taken = all(b.taken for b in branches)
        plain = all(b.guard for b in branches)
        if not line.startswith("#"):
            if line and not plain and not (line in SKIPPED and branches[-1].cplusplus):
                raise CodeError(f"code under a condition: {line[:60]!r}")
            return WORD.sub(lambda m: self.macros.get(m[0], m[0]), line) if taken else ""
        word, _, rest = line[1:].strip().partition(" ")
        rest = rest.strip()
        if word in ("if", "ifdef", "ifndef"):
            value = self._condition(word, rest)
            guard = plain and word == "ifndef" and rest.endswith("_H") and value
            self.guards |= {rest} if guard else set()
            branches.append(Branch(value, value, guard, line == "#ifdef __cplusplus"))
        elif word in ("elif", "else", "endif") and branches:
            self._branch(word, rest, branches)
        elif word == "define":
            self._define(rest, taken)
        elif word == "include" and plain:
            return "" if rest in LIBRARY else self.text(rest.strip('"'))
        elif word != "pragma" or rest not in PRAGMAS:
            raise CodeError(f"an unknown directive: {line[:60]!r}")
        return ""

    def _branch(self, word: str, rest: str, branches: list[Branch]) -> None:
        """Follow an #elif, #else or #endif."""
        last = branches.pop()
        if word == "endif":
            return
        if last.guard:
            raise CodeError("another branch of the guard of a header")
        value = not last.before and (word == "else" or self._condition("if", rest))
        branches.append(Branch(value, last.before or value))

    def _condition(self, word: str, text: str) -> bool:
        """Does the condition of an #if, #ifdef, #ifndef or #elif hold?"""
        if word != "if":
            return (text in self.macros) == (word == "ifdef")
        return any(all(map(self._test, part.split("&&"))) for part in text.split("||"))

    def _test(self, text: str) -> bool:
        """Is a macro defined, or not defined, as one term of a condition asks?"""
        text = text.strip()
        if text == VERSION:
            return True
        found = re.fullmatch(r"(!?) *defined *\(? *(\w+) *\)?", text)
        if not found:
            raise CodeError(f"an unknown condition: {text[:60]!r}")
        return (found[2] in self.macros or found[2] == "__STDC_VERSION__") == (not found[1])

    def _define(self, text: str, taken: bool) -> None:
        """Define a macro, which must have one of its known spellings."""
        name, _, value = text.partition(" ")
        value = value.strip()
        spellings = {f"{self.prefix}_{x}": y for x, y in SPELLINGS.items()}
        spellings |= dict.fromkeys(self.guards, ("",))
        if value not in spellings.get(name, ()):
            raise CodeError(f"an unknown macro: {text[:60]!r}")
        if taken:
            self.macros[name] = value
