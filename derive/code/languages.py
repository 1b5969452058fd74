"""The table of the languages of the emitted code: how each writes numbers, statements, comments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from .printers import SourcePrinter, decimal


@dataclass(frozen=True)
class TargetLanguage:
    """A language: an entry of the table below, and a folder of templates.

    ``files``: for each form of emission, ``source`` and ``header`` both, what follows the prefix in
    the names of the files: ``.rs`` is made of the template ``problem.rs``, ``.inline.h:.h`` is the
    file ``.h`` made of ``problem.inline.h``.
    ``declare``: a constant, of ``{real}``, ``{name}`` and ``{text}``; ``bundle``: the integrals
    over an ellipsoid, where that is otherwise, with ``{prefix}`` as well; ``load`` reads entry
    ``{index}`` (counted from ``first``) of an array; ``batch`` the same of state s of n.
    ``parenthesised``: a statement of several lines needs parentheses; ``continued``: what ends a
    line of it that goes on.
    ``reserved``: words, with spaces, that no name is in this language alone; ``caseless``: capitals
    and small letters are the same.
    ``mutates``: how the name of a function ends that writes what it is given.
    ``needs``: a language whose files these ones include.  ``framed``: are there templates of
    what finds a principal frame?  ``steps``: the steps in time that it has, ``step_files`` those of
    their files that are apart.
    """

    name: str
    files: Mapping[str, tuple[str, ...]]
    printer: Callable[[str], SourcePrinter]
    declare: str
    comment: tuple[str, str, str]
    reals: Mapping[str, str]
    bundle: str = ""
    load: str = "{array}[{index}]"
    batch: str = ""
    first: int = 0
    parenthesised: bool = False
    continued: str = ""
    reserved: str = ""
    caseless: bool = False
    mutates: str = ""
    needs: str = ""
    framed: bool = False
    steps: tuple[str, ...] = ()
    step_files: tuple[str, ...] = ()


def _c(real: str) -> SourcePrinter:
    """The printer of C: suffix f for float."""
    suffix = "f" if real == "float" else ""
    return SourcePrinter(
        lambda q: decimal(q, suffix),
        "fabs" + suffix,
        lambda name: f"{name}{suffix}",
        integrals="{prefix}_{function}(",
        item="{}.v[{}]",
    )


def _plain(function: str, absolute: str, none: str) -> Callable[[str], SourcePrinter]:
    """Printers of a language whose numbers have no suffix and whose functions are a pattern."""
    integrals = "_{function}(xp, " if function.startswith("xp.") else "{function}("
    return lambda real: SourcePrinter(
        decimal, absolute, lambda name: function.format(name), none, integrals
    )


def _rust(real: str) -> SourcePrinter:
    none = f"{'f32' if real == 'float' else 'f64'}::from(u8::from({{}} == 0.0))"
    return SourcePrinter(decimal, "abs", none=none)


def _julia(real: str) -> SourcePrinter:
    def number(q: Fraction) -> str:
        text = decimal(q)
        if real == "double":
            return text
        return "/".join(x.replace("e", "f") if "e" in x else f"{x}f0" for x in text.split("/"))

    return SourcePrinter(number, none="iszero({})", first=1)


HASH, SLASH = ("# ", "# ", ""), ("// ", "// ", "")
C = TargetLanguage(
    "c",
    {"source": (".h", ".c"), "header": (".inline.h:.h",)},
    _c,
    "const {real} {name} = {text};",
    ("/* ", " * ", " */"),
    {"double": "double", "float": "float"},
    bundle="const {prefix}_integrals {name} = {text};",
    batch="{array}[{index}*n + s]",
    framed=True,
    steps=("gauss", "rk4", "vern9", "discrete"),
    step_files=("_steps.h",),
)


def _one_file(ending: str) -> dict[str, tuple[str, ...]]:
    """The same file in both forms."""
    return {"source": (ending,), "header": (ending,)}


_LANGUAGES = (
    C,
    replace(C, name="cpp", files=_one_file(".hpp"), batch="", needs="c", step_files=()),
    replace(C, name="cvode", files=_one_file("_cvode.h"), batch="", needs="c", step_files=()),
    TargetLanguage(
        "python",
        _one_file(".py"),
        _plain("xp.{}", "abs", "_is_zero(xp, {})"),
        "{name} = {text}",
        HASH,
        {"double": "float64", "float": "float32"},
        parenthesised=True,
        framed=True,
        steps=("gauss", "rk4", "vern9", "discrete", "gauss_jax"),
    ),
    TargetLanguage(
        "rust",
        _one_file(".rs"),
        _rust,
        "let {name}: {real} = {text};",
        SLASH,
        {"double": "f64", "float": "f32"},
        bundle="let {name} = {text};",
        batch="{array}[{index}][s]",
        steps=("gauss", "rk4", "vern9", "discrete"),
    ),
    TargetLanguage(
        "julia",
        _one_file(".jl"),
        _julia,
        "{name} = {text}",
        HASH,
        {"double": "Float64", "float": "Float32"},
        first=1,
        parenthesised=True,
        mutates="!",
    ),
    TargetLanguage(
        "javascript",
        _one_file(".mjs"),
        _plain("Math.{}", "Math.abs", "Number({} === 0)"),
        "const {name} = {text};",
        SLASH,
        {"double": "Float64Array", "float": "Float32Array"},
        batch="{array}[8*{index} + s]",
        steps=("gauss", "rk4", "vern9", "discrete"),
    ),
)
LANGUAGES = {x.name: x for x in _LANGUAGES}
"""Name → language, as ``--lang`` takes them."""
