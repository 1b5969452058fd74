"""``derive notes``: the whole record of problems as a text, with their motions if asked for."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..problem.problem import Problem
from ..record.record import Derivation
from ..views.rendering import NOTES, RenderError, notes, pdf
from .showing import UsageError, derive, discrete_walk, notation, warn_of_letters
from .writing import with_progress, write


def command_notes(args: argparse.Namespace) -> int:
    """Lecture notes of problems: .tex, .pdf or .html; or .sty, the macros of their fragments."""
    out = Path(args.out)
    if out.suffix not in NOTES:
        raise UsageError(f"--out {args.out}: the name must end in {', '.join(NOTES)}")
    names = dict.fromkeys(args.problem)
    walked = discrete_walk if args.discrete else derive
    walks = list(with_progress((walked(name) for name in names), len(names), "walks"))
    records = [record for _, record in walks]
    pages = {} if args.motion is None else pages_of_motions(args, out, walks)
    pictures = {} if args.picture is None else pictures_of_motions(args, out, walks)
    moving, drawn = (
        dict(zip((d.name for d in records), files, strict=False)) for files in (pages, pictures)
    )
    text = notes(
        records,
        out.suffix,
        args.lang,
        fragment=args.fragment,
        moving=moving,
        pictures=drawn,
        **notation(args),
    )
    if out.suffix in (".tex", ".pdf"):
        warn_of_letters(records)
    content = pdf_of(text, out, pictures) if out.suffix == ".pdf" else text
    for path in write({out.name: content, **pages, **pictures}, out.parent, links=True):
        print(path)
    return 0


def pdf_of(tex: str, out: Path, pictures: Mapping[str, bytes]) -> bytes:
    """The PDF of LaTeX with its pictures, to be the file ``out``; where none is made, the LaTeX is
    written beside it, as OUT.tex: the error says where."""
    try:
        (made,) = with_progress((pdf(x, pictures) for x in [tex]), 1, "LaTeX")
    except RenderError as error:
        (source, *_) = write({f"{out.name}.tex": tex, **pictures}, out.parent)
        raise RenderError(f"{error}; the LaTeX is written to {source}") from None
    return made


def pages_of_motions(
    args: argparse.Namespace, out: Path, walks: Sequence[tuple[Problem, Derivation]]
) -> dict[str, str]:
    """File → the page in which the body of a problem moves, one for each; ``Refused`` where one
    has no motion."""
    from ..motion.trajectory import Method
    from .simulating import moving_page

    if args.discrete or out.suffix != ".html":
        raise UsageError("--motion: pages are linked from notes FILE.html, without --discrete")
    chosen: tuple[Any, ...] = args.motion, Method(), args.lang
    names = beside(out, walks, ".html")
    return {name: moving_page(*x, *chosen, given={}) for name, x in zip(names, walks, strict=True)}


def pictures_of_motions(
    args: argparse.Namespace, out: Path, walks: Sequence[tuple[Problem, Derivation]]
) -> dict[str, bytes]:
    """File → the picture of the motion of a problem, one for each; ``Refused`` where one has no
    motion."""
    from .simulating import picture_of

    if args.discrete or args.fragment or out.suffix == ".sty":
        raise UsageError("--picture: notes have pictures without --discrete, --fragment and .sty")
    ending = ".svg" if out.suffix == ".html" else ".pdf"
    return {
        name: picture_of(*x, args.picture, name, args.lang)
        for name, x in zip(beside(out, walks, ending), walks, strict=True)
    }


def beside(out: Path, walks: Sequence[tuple[Problem, Derivation]], ending: str) -> list[str]:
    """The names of the files of motions beside the notes ``out``, which begin as its own does:
    other notes in the same folder, as in another language, have others."""
    return [f"{out.stem}_{record.name}_motion{ending}" for _, record in walks]
