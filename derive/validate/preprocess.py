"""Emitted C as a plain C99 compiler sees it: without comments, directives and macros.

Only what the emitted files contain is understood.  Lines that such a compiler skips may hold other
spellings of ``restrict`` and ``inline`` and nothing that computes; all else is an error.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from .terms import CodeError

COMMENT = re.compile(r'"[^"\n]*"|/\*.*?\*/|//[^\n]*', re.DOTALL)
SPELLINGS = {
    "RESTRICT": ("", "restrict", "__restrict"),
    "FUNCTION": ("static inline", "static __host__ __device__ inline"),
}
"""What the macros of the files may stand for: none of it changes what is computed."""
SKIPPED = ('extern "C" {', "}")
LIBRARY = ("<math.h>", "<stddef.h>")
VERSION = "__STDC_VERSION__ >= 199901L"


def preprocessed(name: str, files: Mapping[str, str]) -> str:
    """The text of a file with those that it includes; ``CodeError`` for what is not known here."""
    return Preprocessor(files).text(name)


class Preprocessor:
    """``files``: name → text."""

    def __init__(self, files: Mapping[str, str]):
        self.files = files
        self.macros: dict[str, str] = {}
        self.seen: list[str] = []

    def text(self, name: str) -> str:
        """One file, its macros put in."""
        if name not in self.files or name in self.seen:
            raise CodeError(f"the file {name!r} is missing, or included twice")
        self.seen.append(name)
        source = self.files[name]
        if "\\" in source or "??" in source:
            raise CodeError("a backslash or a trigraph is not read")
        plain = COMMENT.sub(lambda m: m[0] if m[0][0] == '"' else " ", source)
        if "'" in re.sub(r'"[^"\n]*"', "", plain):
            raise CodeError("a character is not read")
        branches: list[list[bool]] = []  # is it taken, was one taken before
        lines = [self._line(line.strip(), branches) for line in plain.split("\n")]
        if branches:
            raise CodeError("an #if without #endif")
        return "\n".join(lines)

    def _line(self, line: str, branches: list[list[bool]]) -> str:
        taken = all(b[0] for b in branches)
        if not line.startswith("#"):
            if not taken and line and line not in SKIPPED:
                raise CodeError(f"code under a condition: {line[:60]!r}")
            return self._expanded(line) if taken else ""
        word, _, rest = line[1:].strip().partition(" ")
        rest = rest.strip()
        if word in ("if", "ifdef", "ifndef"):
            value = self._condition(word, rest)
            branches.append([value, value])
        elif word in ("elif", "else", "endif") and branches:
            self._branch(word, rest, branches)
        elif word == "define":
            self._define(rest, taken)
        elif word == "include" and taken:
            return "" if rest in LIBRARY else self.text(rest.strip('"'))
        elif word != "pragma":
            raise CodeError(f"an unknown directive: {line[:60]!r}")
        return ""

    def _branch(self, word: str, rest: str, branches: list[list[bool]]) -> None:
        if word == "endif":
            branches.pop()
            return
        value = not branches[-1][1] and (word == "else" or self._condition("if", rest))
        branches[-1] = [value, branches[-1][1] or value]

    def _condition(self, word: str, text: str) -> bool:
        if word != "if":
            return (text in self.macros) == (word == "ifdef")
        return any(all(map(self._test, part.split("&&"))) for part in text.split("||"))

    def _test(self, text: str) -> bool:
        text = text.strip()
        if text == VERSION:
            return True
        found = re.fullmatch(r"(!?) *defined *\(? *(\w+) *\)?", text)
        if not found:
            raise CodeError(f"an unknown condition: {text[:60]!r}")
        return (found[2] in self.macros or found[2] == "__STDC_VERSION__") == (not found[1])

    def _define(self, text: str, taken: bool) -> None:
        name, _, value = text.partition(" ")
        value = value.strip()
        spellings = SPELLINGS.get(name.rpartition("_")[2], ("",) if name.endswith("_H") else ())
        if value not in spellings or not re.fullmatch(r"[A-Za-z]\w*", name):
            raise CodeError(f"an unknown macro: {text[:60]!r}")
        if taken:
            self.macros[name] = value

    def _expanded(self, line: str) -> str:
        if '"' in line:
            return line
        return re.sub(r"[A-Za-z_]\w*", lambda m: self.macros.get(m[0], m[0]), line)
