"""Steps and equations of a derivation, and what a search found, which print themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any, ClassVar, Generic, TypeVar

from ..check.form.hypotheses_checked import Verdict, in_a_line
from ..record.record import Derivation, Equation, Step
from ..search import FIRST


@dataclass(frozen=True)
class ShownEquation:
    """An equation of a step: a pair of operator trees, shown as a formula in a notebook."""

    equation: Equation
    record: Derivation = field(compare=False)

    def __repr__(self) -> str:
        return f"<equation {self}>"

    @property
    def lhs(self) -> Any:
        """The left side, an operator tree (:mod:`derive.language.tree`)."""
        return self.equation.lhs

    @property
    def rhs(self) -> Any:
        """The right side, an operator tree (:mod:`derive.language.tree`)."""
        return self.equation.rhs

    def __str__(self) -> str:
        from ..views.text import equation_text

        return equation_text(self.equation)

    def latex(self, lang: str = "en") -> str:
        """The formula in standard commands of LaTeX and amsmath, in lines that fit a page."""
        from ..views.language import language
        from ..views.text import formula

        return formula([self.equation], self.record.symbols, language=language(lang))

    def sympy(self) -> Any:
        """The equation in SymPy, an ``Eq`` of scalars or of matrices."""
        from .as_sympy import Translation

        return Translation(self.record).equation(self.equation)

    def _repr_latex_(self) -> str:
        return f"$${self.latex()}$$"


class Equated:
    """What has ``equations``."""

    equations: Any

    def sympy(self) -> tuple[Any, ...]:
        """The equations in SymPy, in order."""
        return tuple(e.sympy() for e in self.equations)


class Printed:
    """What prints a ``record``, or a part of it, as :meth:`_part` says."""

    record: Derivation

    def __str__(self) -> str:
        return self._rendered("text")

    def markdown(self, lang: str = "en") -> str:
        """The same in Markdown, its formulas between dollars."""
        return self._rendered("markdown", lang)

    def _repr_markdown_(self) -> str:
        return self.markdown()

    def _rendered(self, form: str, lang: str = "en", **how: Any) -> str:
        from ..views.rendering import render

        return render(self.record, form, lang, **self._part(), **how)

    def _part(self) -> dict[str, Any]:
        return {}


@dataclass(frozen=True)
class Answer(Equated, Printed):
    """The equations of motion of a derivation, and what their letters are; ``by_block``: names of
    the velocity of a product → those by its blocks."""

    record: Derivation
    by_block: Mapping[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<answer of {self.record.name}: {len(self.equations)} equations>"

    @property
    def equations(self) -> tuple[ShownEquation, ...]:
        """The equations of motion, solved for the rates, in entries where these are told."""
        from ..views.answer import equations_of_motion

        return tuple(ShownEquation(e, self.record) for e in equations_of_motion(self.record))

    def _part(self) -> dict[str, Any]:
        return {"answer": True, "by_block": self.by_block}


@dataclass(frozen=True)
class Shown(Equated):
    """A step of a derivation, which prints itself and shows its formulas in a notebook."""

    step: Step
    record: Derivation = field(compare=False)

    def __repr__(self) -> str:
        return f"<step {self.step.label}: {len(self.step.equations)} equations>"

    @property
    def equations(self) -> tuple[ShownEquation, ...]:
        """Its equations, in order."""
        return tuple(ShownEquation(e, self.record) for e in self.step.equations)

    def __str__(self) -> str:
        from ..views.text import step_text

        return step_text(self.step)

    def markdown(self, lang: str = "en") -> str:
        """The step in Markdown, its formulas between dollars."""
        from ..views.language import language
        from ..views.text import step_markdown

        return step_markdown(self.step, self.record.symbols, language=language(lang))

    def _repr_markdown_(self) -> str:
        return self.markdown()


class Page(str):
    """A page of HTML, which a notebook shows in a frame of its own."""

    def __repr__(self) -> str:
        return f"<page of {len(self)} characters>"

    def _repr_html_(self) -> str:
        frame = f'<iframe srcdoc="{escape(self)}" style="width:100%;height:{HEIGHT}px;border:0">'
        return f"{frame}</iframe>"


HEIGHT = 560
"""Of a page in a notebook, in pixels: a motion with its controls."""


class Verdicts(list[Verdict]):
    """Verdicts, which show what they come to, in a line with a tick, and why steps do not hold."""

    def _repr_markdown_(self) -> str:
        return repr(self)

    def __repr__(self) -> str:
        bad = [f"* `{v.label}`: {' '.join(v.reason.split())}" for v in self if not v.holds]
        return "\n".join([f"{'✗' if bad else '✓'} {in_a_line(self)}", *bad])


T = TypeVar("T")


class Recorded(Printed):
    """A derivation, which can be checked."""

    def check(self, seed: int | None = None) -> Verdicts:
        """A verdict for the symbols and one for every step, by exact arithmetic and other formulas,
        at points that are new each time; the same ``seed`` gives the same points."""
        from ..check.checker import check

        return Verdicts(check(self.record, seed))


class Finding(Recorded):
    """What a ``_search`` found, with its ``record``: the derivation, whose last steps tell it; in a
    notebook it shows these."""

    _search: ClassVar[str]

    def latex(self, lang: str = "en") -> str:
        """The steps that tell what was found, as a document for pdflatex."""
        return self._rendered("latex", lang)

    def _part(self) -> dict[str, Any]:
        return {"steps": self.record.since(FIRST[self._search])}


class SeveralFound(Finding, Generic[T]):
    """What a search ``found``, one after the other, each as an ``_each``."""

    _each: ClassVar[Any]
    found: tuple[Any, ...]

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, k: int) -> T:
        return self._each(self.found[k])  # type: ignore[no-any-return]

    def __iter__(self) -> Iterator[T]:
        return map(self._each, self.found)
