"""The command line: ``derive list | walk | symmetries | reduction | integrals | equilibria |
notes | emit | simulate | plot | check | paper | build``."""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..language.near_names import did_you_mean, near_name
from ..language.refused import Refused
from ..problem.problem import Problem, ProblemError
from ..record.record import Derivation, Step
from ..schema.table import nearest
from ..views.rendering import NOTES, RenderError, notes, pdf, render, unprinted
from .encoding import as_in_a_file, replacing_unencodable
from .guard import StoppedError, one_line, time_limit
from .progress import with_progress

if TYPE_CHECKING:
    from ..check.verdict import Verdict

READY = Path(__file__).resolve().parents[1] / "problems"


class UsageError(Refused):
    """Bad input on the command line: one clear line, and the exit code 2."""


def ready_made() -> list[str]:
    """The names of the ready-made problems."""
    return sorted(f.name.removesuffix(".toml") for f in READY.iterdir() if f.name.endswith(".toml"))


def load_problem(name: str, **allowances: bool) -> Problem:
    """A ready-made problem by name, or a TOML file by path; ``allowances``: what may be negative,
    as in ``problem.toml.load``. ``UsageError`` where there is neither."""
    from ..problem.toml import load

    if name in ready_made():
        return load(READY / f"{name}.toml")
    path = Path(name)
    if path.suffix == ".toml" or path.exists():
        return load(path, **allowances)
    if "\n" in name:
        raise UsageError("a problem is a name or a .toml file, not its text: write it to a file")
    near = near_name(name.lower(), ready_made())
    if path.with_name(f"{path.name}.toml").is_file():
        near = f"{name}.toml"
    hint = did_you_mean(near[:60], after=" ")
    raise UsageError(
        f"unknown problem {name[:60]!r}; {hint}ready-made: {', '.join(ready_made())}; "
        "or give a .toml file"
    )


def derive(name: str, **allowances: bool) -> tuple[Problem, Derivation]:
    """A problem and its record, with warnings of doubts; ``UsageError`` where it has no walk."""
    from ..pipeline import walk
    from ..problem.doubts import doubts

    problem = load_problem(name, **allowances)
    for doubt in doubts(problem):
        print(f"derive: warning: {one_line(name)}: {one_line(doubt)}", file=sys.stderr)
    try:
        return problem, walk(problem)
    except ProblemError as error:
        raise UsageError(f"{name}: {error}") from None


def discrete_walk(name: str, **allowances: bool) -> tuple[Problem, Derivation]:
    """A problem and the record of its discrete motion."""
    from ..pipeline import discrete

    problem = load_problem(name, **allowances)
    return problem, discrete(problem)


def allowances(args: argparse.Namespace) -> dict[str, bool]:
    """The keywords of :func:`load_problem` for what the flags allow to be negative."""
    from .arguments import ALLOWED

    return {f"negative_{x}": getattr(args, f"allow_negative_{x}") for x in ALLOWED}


def save(text: str, out: str | None, form: str) -> None:
    """Write a text of one of the formats to stdout, or whole to the file ``out``."""
    from .writing import write

    if out is None:
        if form != "text":
            as_in_a_file()
        sys.stdout.write(text if text.endswith("\n") else text + "\n")
    else:
        path = Path(out)
        write({path.name: text}, path.parent, links=True)


def command_list(_: argparse.Namespace) -> int:
    """Groups and ready-made problems."""
    from .listing import listing

    print(listing({name: load_problem(name) for name in ready_made()}))
    return 0


def command_walk(args: argparse.Namespace) -> int:
    """Print the walk of a problem."""
    from ..pipeline import both_trivialisations

    if args.discrete and args.trivialisation:
        raise UsageError("--discrete and --trivialisation are of two roads: leave out one")
    walked = discrete_walk if args.discrete else derive
    problem, record = walked(args.problem, **allowances(args))
    if args.trivialisation:
        if problem.fluid:
            raise UsageError(
                f"{record.name}: a fluid is told on the right alone: leave out --trivialisation"
            )
        if args.format == "json":
            raise UsageError("--trivialisation both is to be read: choose another --format")
        record = both_trivialisations(record)
    chosen = {"fragment": args.fragment, "steps": steps_of(record, args.labels), **notation(args)}
    shown = render(record, args.format, args.lang, **chosen)
    if args.format == "latex":
        warn_of_letters([record])
    save(shown, args.out, args.format)
    return 0


def command_integrals(args: argparse.Namespace) -> int:
    """Find the polynomial first integrals of the reduced equations of a problem."""
    from ..pipeline import integrals

    problem = load_problem(args.problem)
    chosen = {"at_defaults": args.at_defaults, "conditions": args.conditions}
    record = integrals(problem, args.degree, **chosen)[1]
    # the JSON is a whole record, which can be checked
    new = () if args.format == "json" else told_steps(record)
    shown = {"fragment": args.fragment, "steps": new, **notation(args)}
    save(render(record, args.format, args.lang, **shown), args.out, args.format)
    return 0


def command_equilibria(args: argparse.Namespace) -> int:
    """Find relative equilibria of the reduced equations of a problem, and their stability."""
    from ..pipeline import equilibria, equilibrium_near

    if args.near and args.at:
        raise UsageError("--at is exact and --near is not: give one of them")
    for option, given in (("--at", args.at), ("--near", args.near)):
        several = Counter(name for name, _ in given or ())
        if twice := [name for name, count in several.items() if count > 1]:
            raise UsageError(f"{option} {twice[0]}: given more than once; leave out all but one")
    found: object
    if args.near:
        found, record = equilibrium_near(load_problem(args.problem), dict(args.near))
    else:
        found, record = equilibria(load_problem(args.problem), dict(args.at or ()))
    if not found:
        raise UsageError(
            f"{record.name}: no equilibrium among the points with at most one momentum, 1, and at "
            "most one other coordinate, 1 or -1: give one by --at NAME=NUMBER"
        )
    new = () if args.format == "json" else told_steps(record, "equilibrium_1")
    chosen = {"fragment": args.fragment, "steps": new, **notation(args)}
    save(render(record, args.format, args.lang, **chosen), args.out, args.format)
    return 0


def told_steps(record: Derivation, first: str = "poisson") -> list[Step]:
    """The steps of a record from one on: those that tell integrals, or equilibria."""
    labels = [step.label for step in record.steps]
    return [*record.steps[labels.index(f"{record.name}.{first}") :]]


def command_symmetries(args: argparse.Namespace) -> int:
    """All symmetries of a problem's Lagrangian, and what the motion keeps by each."""
    from ..pipeline import symmetries
    from ..symmetries.steps import shown as about_symmetries

    problem, walked = derive(args.problem, **allowances(args))
    save_record(symmetries(problem, walked).record, about_symmetries, args)
    return 0


def command_reduction(args: argparse.Namespace) -> int:
    """Routh's reduction by symmetries that commute: effective potential, what is left to solve."""
    from ..pipeline import reduction
    from ..reduction.reduced_record import shown

    problem, walked = derive(args.problem, **allowances(args))
    save_record(reduction(problem, walked).record, shown, args)
    return 0


def save_record(
    record: Derivation, own: Callable[[Derivation], list[Step]], args: argparse.Namespace
) -> None:
    """Write the steps of a record that are asked for, else its ``own``; in JSON all."""
    steps = steps_of(record, args.labels)
    if not steps and args.format != "json":
        steps = own(record)
    chosen = {"fragment": args.fragment, "steps": steps, **notation(args)}
    shown = render(record, args.format, args.lang, **chosen)
    if args.format == "latex":
        warn_of_letters([record])
    save(shown, args.out, args.format)


def steps_of(record: Derivation, labels: Sequence[str]) -> list[Step]:
    """The steps with these labels, which may lack the problem's name; ``UsageError`` for others."""
    by_label = {s.label: s for s in record.steps}
    short = {x.removeprefix(f"{record.name}."): x for x in by_label}
    found = []
    for label in labels:
        if label not in by_label and label not in short:
            hint = nearest(label, {*short, *by_label})
            raise UsageError(f"{record.name} has no step {label[:60]!r}{hint}")
        found.append(by_label[short.get(label, label)])
    return found


def command_notes(args: argparse.Namespace) -> int:
    """Lecture notes of problems: .tex, .pdf or .html; or .sty, the macros of their fragments."""
    from .writing import write

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
    from .writing import write

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
    from ..motion.method import Method
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


def warn_of_letters(records: Sequence[Derivation]) -> None:
    """Warn on stderr of the letters of some records that LaTeX does not have."""
    if lost := unprinted(records):
        shown = ", ".join(lost[:20])
        print(f"derive: warning: LaTeX has no {one_line(shown)} here, and shows ?", file=sys.stderr)


def notation(args: argparse.Namespace) -> dict[str, str]:
    """The notations that were chosen for transposes and skew matrices."""
    return {"transpose": args.notation, "hat": args.hat}


def command_emit(args: argparse.Namespace) -> int:
    """Write the numeric code of a problem."""
    from ..code.emit import planned
    from .emitting import checked, languages, made, options, validated, wanted
    from .writing import write

    if args.names:
        prefix = args.prefix  # with one, the problem need not be there
        if prefix is None:
            prefix = load_problem(args.problem, **allowances(args)).name
        print(*planned(languages(args), prefix, options(args)), sep="\n")
        return 0
    if args.check:
        return checked(args, lambda **more: derive(args.problem, **allowances(args) | more))
    problem, record = derive(args.problem, **allowances(args))
    asked = wanted(args, problem)
    compiled, files = made(problem, record, asked)
    if args.validate and not validated(files, files, record, compiled, asked):
        return 1  # and nothing is written
    for path in write(files, Path(args.out or ".")):
        print(path)
    return 0


def command_simulate(args: argparse.Namespace) -> int:
    """Follow the motion of a problem: its states, its energy, and all that it keeps, as a file."""
    from .simulating import command_simulate

    return command_simulate(args, lambda name: derive(name, **allowances(args)))


def command_plot(args: argparse.Namespace) -> int:
    """Draw a run of a motion, or several: .svg, .pdf or .png (needs matplotlib)."""
    from ..motion.ensemble_files import read_either
    from ..plot.kinds_told import PRECISION
    from ..plot.pictures import plot
    from ..plot.plot_sheet import ending
    from ..plot.precision import plot_precision
    from ..views.language import language
    from .writing import write

    ending(args.out)
    out, paths, word = Path(args.out), [Path(x) for x in args.run_file], language(args.lang).word
    if args.kind == PRECISION:
        picture = plot_precision(paths, out.name, word)
    elif len(paths) > 1:
        raise UsageError(f"several runs are for --kind {PRECISION}: give one")
    else:
        picture = plot(read_either(paths[0]), out.name, args.kind, word, args.column)
    for path in write({out.name: picture}, out.parent, links=True):
        print(path)
    return 0


def command_check(args: argparse.Namespace) -> int:
    """Re-check every recorded step, independently of the code that derived it."""
    from ..check.checker import fresh_seed
    from ..check.checker import verdicts as check
    from ..record.json_reader import read

    failed, refused, seed = 0, 0, fresh_seed() if args.seed is None else args.seed
    for name in args.problem:
        try:
            record = (
                read(Path(name)) if name.endswith(".json") else derive(name, **allowances(args))[1]
            )
            verdicts = list(with_progress(check(record, seed), 1 + len(record.steps), name))
        except Refused as error:
            if len(args.problem) == 1:
                raise
            print(f"derive: {one_line(error)}", file=sys.stderr)
            refused += 1
            continue
        failed += told(name, verdicts)
    print(f"seed {seed} (--seed repeats this run)")
    return 2 if refused else 1 if failed else 0


def told(name: str, verdicts: Sequence[Verdict]) -> int:
    """Print the verdicts on the record of a name: how many fail."""
    for v in verdicts:
        words = _trial_text(v) if v.holds else one_line(v.reason)
        print(f"{'holds' if v.holds else 'FAILS'}  {v.label}: {words}")
    bad, steps = sum(not v.holds for v in verdicts), [v for v in verdicts if v.of == "equation"]
    holding, bound = sum(v.holds for v in steps), max(v.bound for v in verdicts)
    print(
        f"{one_line(name)}: {holding} of {len(steps)} steps hold exactly"
        + (", but the symbols are not as declared" if bad + holding > len(steps) else "")
        + ("" if bad else f"; a false one passes with probability below {bound:.0e}")
    )
    return bad


def _trial_text(v: Verdict) -> str:
    """What a verdict says was found to hold, and on which groups, as text."""
    count, groups = v.tried
    return f"{count} {v.of}{'s' * (count != 1)} on {', '.join(groups)}"


def command_paper(args: argparse.Namespace) -> int:
    """The paper's numbered equations against the derivation."""
    from ..paper import findings as paper
    from ..paper.printed import PAPER
    from ..views.language import language
    from ..views.paper import as_json, as_text

    records = [derive(name)[1] for name in paper.PROBLEMS]
    findings = list(with_progress(paper.findings(records), len(PAPER), "equations"))
    shown = as_json(findings) if args.format == "json" else as_text(findings, language(args.lang))
    save(shown, args.out, args.format)
    return 0


def command_build(args: argparse.Namespace) -> int:
    """Make all of generated/ again."""
    from ..code.emit import emit
    from ..pipeline import program
    from .writing import write

    def made(name: str) -> tuple[str, dict[str, str]]:
        problem, record = derive(name)
        files = {f"walk.{end}": render(record, form) for form, end in FILES.items()}
        return name, files | emit(program(problem, record), record, ("c", "python"), name)

    for name, files in with_progress(map(made, BUILT), len(BUILT), "problems"):
        for path in write(files, Path(args.out) / name):
            print(path, file=sys.stderr)
        if args.print:
            print(files["walk.txt"])
    return 0


BUILT = ("so3", "se3", "sl3")
FILES = {"text": "txt", "latex": "tex", "json": "json"}
COMMANDS = {
    "list": command_list,
    "walk": command_walk,
    "integrals": command_integrals,
    "equilibria": command_equilibria,
    "symmetries": command_symmetries,
    "reduction": command_reduction,
    "notes": command_notes,
    "emit": command_emit,
    "simulate": command_simulate,
    "plot": command_plot,
    "check": command_check,
    "paper": command_paper,
    "build": command_build,
}


def _discard_stdout() -> None:
    """Drop what stdout holds, which the interpreter would try to write at its end."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


BROUGHT = {"numpy": "NumPy", "sympy": "SymPy"}
"""What comes with the package, though not in a browser, and is loaded where it is needed."""

ABOUT = """Equations of motion of bodies moved by Lie groups: derived step by step, checked,
shown as text, LaTeX or a web page, and emitted as code."""


def run(options: argparse.ArgumentParser, argv: Sequence[str] | None) -> int:
    """Run the command of the arguments: its exit code."""
    try:
        args = options.parse_args(argv)
    except SystemExit:
        sys.stdout.flush()  # the help: main tells what cannot be written
        raise
    with time_limit(getattr(args, "seconds", None)):
        return int(args.run(args))


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command: 0, 1 when a check failed, 2 for bad input, 130 after Ctrl-C."""
    from .arguments import parser

    if sys.stdout is None:  # closed by who started us
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    try:
        with replacing_unencodable():
            status = run(parser(COMMANDS, ABOUT), argv)
            sys.stdout.flush()
        return status
    except Refused as error:
        print(f"derive: {one_line(error)}", file=sys.stderr)
        return 2
    except StoppedError as error:
        print(f"derive: {one_line(error)}", file=sys.stderr)
        return 2
    except ModuleNotFoundError as error:
        if error.name not in BROUGHT:
            raise
        print(f"derive: this needs {BROUGHT[error.name]}, which is not here", file=sys.stderr)
        return 2
    except (MemoryError, RecursionError) as error:
        what = "out of memory" if isinstance(error, MemoryError) else "nested too deeply"
        print(f"derive: {what}: the input is too large for this machine", file=sys.stderr)
        return 2
    except BrokenPipeError:  # who reads has seen enough
        _discard_stdout()
        return 0
    except OSError as error:
        place = one_line(error.filename or "standard output")
        print(f"derive: {place}: {error.strerror}", file=sys.stderr)
        _discard_stdout()
        return 2
    except KeyboardInterrupt:
        return 130
