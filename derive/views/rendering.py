"""Records in the formats of the command line: one walk, notes of several, both sides."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..language.limits import Refused
from ..record.record import Derivation, Symbol
from .printing.typeset import WIDTH

if TYPE_CHECKING:
    from ..record.record import Step
    from .language import Language
    from .paper.findings import PaperFinding
    from .printing.signs import Notation


# A record to be read beside the other trivialisation: what holds for any Lagrangian, step by step
# on the left and on the right.


def both_sides(d: Derivation, left: Derivation, right: Derivation) -> Derivation:
    """A record behind the steps of ``left`` and ``right``, each beside its like.

    To be read, not to be checked: of the names, it explains those that mean the same on both sides.
    """
    general = [step for pair in zip(left.steps, right.steps, strict=True) for step in pair]
    there = {step.label for step in general}
    own = [step for step in d.steps if step.label not in there]
    return replace(d, steps=(*general, *own), symbols=(*_symbols(d, left, right),))


def _symbols(d: Derivation, left: Derivation, right: Derivation) -> Iterator[Symbol]:
    """The symbols of the three, without those that the sides define each in its own way."""
    others = {s.name: s.meaning for s in right.symbols}
    sided = {s.name for s in left.symbols if others.get(s.name) != s.meaning}
    found = {s.name: s for s in (*left.symbols, *d.symbols)}
    yield from (s for s in found.values() if s.name not in sided)


NOTES = (".tex", ".pdf", ".html", ".sty")


class RenderError(Refused, ValueError):
    """A choice that has no sense, or TeX that is not there: the message says what to do."""


FORMATS = ("text", "latex", "markdown", "html", "json")
LINKED = ("latex", "html")
"""Formats whose references are links, and whose notation may be chosen."""


def _whole(
    d: Derivation, form: str, words: Language, notation: Notation, alone: bool, width: int
) -> str:
    """The text of a record, or of a record of some steps ``alone``, in a format and a language."""
    from . import text
    from .latex import latex

    if form == "html":
        return notes([d], ".html", words.name, **vars(notation))
    if form == "latex":
        return latex(d, notation, language=words)
    if form == "markdown":
        return text.markdown(d, language=words)
    if form == "text" and not alone:
        return text.text(d, width, language=words)
    if form == "text":
        own = text.clashing(d, text.letters_of(d, words))
        listed = (text.step_text(x, width, language=words, quoted=own) for x in d.steps)
        return "\n".join(listed)
    from ..record.as_json import to_json

    if alone:
        raise RenderError("the JSON is of a whole walk: name no steps")
    if words.name != "en":
        raise RenderError("--lang: the JSON is in English, its messages and places are for any")
    return to_json(d)


def render(
    d: Derivation,
    form: str,
    lang: str = "en",
    *,
    fragment: bool = False,
    steps: Sequence[Step] = (),
    answer: bool = False,
    by_block: Mapping[str, str] | None = None,
    width: int = WIDTH,
    **notation: str,
) -> str:
    """A record in one of the formats, in one of the languages; or some ``steps`` of it alone, or
    its ``answer``, which tells names of the velocity ``by_block``, ζ_a → that of its block; the
    lines of a text at most ``width`` columns wide.

    :class:`RenderError` for a format that is none, and for choices that do not go together.
    """
    from .language import language
    from .printing.signs import Notation

    if form not in FORMATS:
        raise RenderError(f"no format {form[:40]!r}; there are {', '.join(FORMATS)}")
    if fragment and form not in LINKED:
        raise RenderError("--fragment is for --format latex and html")
    if form != "json":
        from .layout import as_read

        d, steps = as_read(d), as_read(replace(d, steps=tuple(steps))).steps
    chosen = Notation(**notation)
    if form not in LINKED and chosen != Notation():
        raise RenderError("--notation and --hat are for --format latex and html")
    if answer:
        return _answer(d, form, language(lang), chosen, by_block or {}, not fragment, width)
    if steps:
        d = _of_steps(d, steps, linked=form in LINKED)
    if fragment and form == "html":
        from .html import fragment as markup

        found = corrections([d])
        return "".join(markup([d], chosen, language=language(lang), findings=found))
    if fragment:
        from .latex import fragment as fragment_of

        return fragment_of(d, language=language(lang))
    return _whole(d, form, language(lang), chosen, bool(steps), width)


def _answer(
    d: Derivation,
    form: str,
    words: Language,
    notation: Notation,
    by_block: Mapping[str, str],
    alone: bool,
    width: int,
) -> str:
    """The equations of motion of a record with what their letters are."""
    from . import answer, html, latex

    if form == "json":
        raise RenderError("--answer is to be read, the JSON is of a whole walk: leave out one")
    told, made = answer.summary(d, words, by_block), {"latex": latex.answer, "html": html.answer}
    if form in made:
        return made[form](told, notation, alone=alone)
    return answer.answer_text(told, width) if form == "text" else answer.answer_markdown(told)


def _of_steps(d: Derivation, steps: Sequence[Step], *, linked: bool) -> Derivation:
    """A record of some steps; where references are ``linked``, of those among them alone, and
    without its names."""
    there = {s.label for s in steps}
    if linked:
        steps = [replace(s, uses=tuple(x for x in s.uses if x in there)) for s in steps]
    return replace(d, steps=tuple(steps), symbols=() if linked else d.symbols)


def notes(
    records: Sequence[Derivation],
    ending: str,
    lang: str = "en",
    *,
    fragment: bool = False,
    moving: Mapping[str, str] | None = None,
    pictures: Mapping[str, str] | None = None,
    **notation: str,
) -> str:
    """Lecture notes of several records as a web page or as LaTeX, with the paper's corrections.

    ``fragment``: LaTeX without a preamble, for a document that uses the package ``.sty``.
    ``moving``: the pages that a web page links to, by the names of the records; ``pictures``: files
    of pictures of their motions, which are shown.
    """
    from . import latex
    from .html import html
    from .language import language
    from .layout import as_read
    from .printing.signs import Notation

    if ending not in NOTES:
        raise RenderError(f"no notes end in {ending[:40]!r}; they end in {', '.join(NOTES)}")
    chosen, words = Notation(**notation), language(lang)
    if fragment and ending != ".tex":
        raise RenderError("--fragment is LaTeX: give --out FILE.tex")
    if ending == ".sty":
        return latex.package(chosen, language=words)
    if not records:
        raise RenderError("which problems? give names or files, as in: derive notes so3 se3")
    for name in (names := [d.name for d in records]):
        if names.count(name) > 1:
            raise RenderError(
                f"{names.count(name)} problems have the name {name!r}, and their equations the "
                "same labels; give each its own (key 'name' of its file)"
            )
    records = [*map(as_read, records)]
    found = corrections(records)
    if fragment:
        return latex.fragment(records, language=words, findings=found)
    if ending == ".html":
        beside = {"moving": moving, "pictures": pictures}
        return html(records, chosen, language=words, findings=found, **beside)
    return latex.latex(records, chosen, language=words, findings=found, pictures=pictures)


def unprinted(records: Sequence[Derivation]) -> str:
    """The characters of titles, units and meanings that LaTeX shows as question marks."""
    from .printing.signs import unknown_to_tex

    words = [str(d.problem["title"]) for d in records]
    for d in records:
        for about in d.problem["parameters"].values():
            words += (str(about[key]) for key in ("unit", "meaning") if about.get(key))
    return unknown_to_tex("".join(words))


def corrections(records: Sequence[Derivation]) -> list[PaperFinding]:
    """The findings about the numbers that these records have and the paper prints otherwise."""
    from ..record.record import AMENDED
    from .paper.findings import amendments

    numbers = {n for d in records for step in d.steps for n in step.paper} & AMENDED
    return amendments(numbers) if numbers else []


def pdf(tex: str, pictures: Mapping[str, bytes] | None = None) -> bytes:
    """The PDF of a LaTeX document, with files of ``pictures`` that it shows; ``RenderError`` names
    what is missing or the first error."""
    import os
    import shutil
    import subprocess
    import tempfile

    latexmk, pdflatex = shutil.which("latexmk"), shutil.which("pdflatex")
    if pdflatex is None:
        raise RenderError(
            "no pdflatex: install TeX (Debian: texlive-latex-extra texlive-pictures lmodern)"
        )
    # the same text is the same PDF on any day: TeX has the time from here, if it asks for one
    timeless = {"SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"} | os.environ
    quiet = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    runs = (
        [[latexmk, "-pdf", *quiet, "notes.tex"]]
        if latexmk
        else [[pdflatex, *quiet, "notes.tex"]] * 3
    )
    with tempfile.TemporaryDirectory(prefix="derive-") as folder:
        (Path(folder) / "notes.tex").write_text(tex, encoding="utf-8")
        for name, picture in (pictures or {}).items():
            (Path(folder) / name).write_bytes(picture)
        for command in runs:
            done = subprocess.run(command, cwd=folder, env=timeless, capture_output=True)
        if done.returncode:
            log = done.stdout.decode(errors="replace").splitlines()
            wrong = next((line for line in log if line.startswith("!")), "! no PDF was made")
            raise RenderError(f"pdflatex: {wrong[2:]}")
        return (Path(folder) / "notes.pdf").read_bytes()
