"""``derive simulate``: from a problem to a run in one command."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..motion.driven import DAMPING, INPUTS, is_weightless
from ..motion.ensemble import require_an_ensemble
from ..motion.kept_words import parts
from ..motion.method import STEPS, Method, instants
from ..motion.run import Array, Run
from ..motion.run_files import format_of, written
from ..motion.simulate import beginning, run
from ..motion.start import MotionError, state_file
from ..page.motion_page import motion_page
from ..pipeline import motion_of
from ..plot.pictures import plot
from ..problem.problem import Problem
from ..record.record import Derivation
from ..views.language import language
from .ensembles import command_ensemble
from .guard import one_line
from .loading import allowed, derive
from .progress import with_progress
from .writing import require_place, write

ROUNDING = 1e-15
"""A component that is smaller, beside the others, is that of sums of a few terms."""

MANY, LARGEST = 60, 8
"""Of a state of more than so many numbers only so many are told, those that are largest."""

TOLD, ALL_EVENTS = 10, "all are in the file of --out, and run.events in Python"
"""So many times of an event are told; where there are more."""


def page_of(
    args: argparse.Namespace, problem: Problem, record: Derivation, start: dict[str, Any]
) -> str:
    """The page that a command asks for; ``Refused`` where there is none."""
    if not args.html.endswith(".html"):
        raise MotionError(f"{args.html}: the name of a page must end in .html")
    if args.dt is not None or args.method not in (None, STEPS[0]):
        raise MotionError("--html: the page moves by gauss to a tolerance: leave out --dt, --step")
    return moving_page(problem, record, args.t, method_of(args), args.lang, **start)


def moving_page(
    problem: Problem, record: Derivation, t: float, method: Method, lang: str, **start: Any
) -> str:
    """The page of a motion from 0 to t, from a start as ``beginning`` takes it; ``Refused``."""
    code = motion_of(replace(problem, events=()), record, weightless=True)
    begin = beginning(code, problem, **start)
    instants(method, t, 1)  # refuses a time that is none
    return motion_page(code, problem, record, begin, t, method.tol, language(lang))


def picture_of(problem: Problem, record: Derivation, t: float, name: str, lang: str) -> bytes:
    """A picture of the motion from 0 to t, in the format of a name; ``Refused``."""
    method = Method()
    code = motion_of(problem, record, method.step)
    found, words = run(code, problem, method, t, 500, given={}), language(lang)
    return plot(found, name, word=words.word, mark=words.mark)


def method_of(args: argparse.Namespace) -> Method:
    """The step, and its size or tolerance."""
    chosen = {} if args.tol is None else {"tol": args.tol}
    return Method(args.method or STEPS[0], args.dt, **chosen, order=args.order or "")


def start_of(args: argparse.Namespace, problem: Problem, record: Derivation) -> dict[str, Any]:
    """Where the motion starts, as ``beginning`` takes it; on stderr what is amiss with it."""
    given: dict[str, float] = {}
    if args.state:
        given, doubt = state_file(Path(args.state), problem, record)
        if doubt:
            print(f"derive: warning: {one_line(f'{args.state}: {doubt}')}", file=sys.stderr)
    return {
        "given": given | dict(args.set or ()),
        "exponent": args.exp or (),
        "project": args.project,
    }


def run_of(
    args: argparse.Namespace, problem: Problem, record: Derivation, start: dict[str, Any]
) -> Run:
    """The run that a command asks for; ``Refused`` where there is none."""
    method = method_of(args)
    light = is_weightless(record.problem or {}, start["given"])
    return run(
        motion_of(problem, record, method.step, method.order, weightless=light),
        problem,
        method,
        args.t,
        500 if args.points is None else args.points,
        **start,
        progress=lambda parts, total: with_progress(parts, total, problem.name),
    )


def command_simulate(args: argparse.Namespace) -> int:
    """Run ``derive simulate``: its exit code."""
    if args.dt is not None and args.tol is not None:
        raise MotionError("--dt is a step of one size, --tol chooses it: give one of them")
    if args.ensemble is None:
        require_an_ensemble(args.vary, args.seed)
    if args.out:
        format_of(args.out)  # refused before the work
    for file in filter(None, (args.out, args.html)):
        require_place(Path(file))
    chosen = {"followed": True, "given": dict(args.set or ())}
    problem, record = derive(args.problem, **chosen, **allowed(args))
    start = start_of(args, problem, record)
    if args.ensemble is not None:
        return command_ensemble(args, problem, record, start)
    pages, files = [], []  # all are written before a word is said: who reads it may go away
    if args.html:
        out, page = Path(args.html), page_of(args, problem, record, start)
        pages = write({out.name: page}, out.parent, links=True)
    if args.html and not args.out:
        print(*pages, sep="\n")
        return 0
    found = run_of(args, problem, record, start)
    if args.out:
        out = Path(args.out)
        files = write({out.name: written(found, out.name)}, out.parent, links=True)
    print(*pages, *map(one_line, summary(found)), *files, sep="\n")
    return _told(found)


def summary(run: Run) -> list[str]:
    """What a run says of itself, in lines."""
    name, method = run.facts["problem"], run.facts["method"]
    count, how = len(run.t), run.facts["language"]
    span = f"{count} instant{'s' * (count != 1)}, t = 0 … {run.t[-1]:g}"
    lines = [f"{name}: {span}, by {method}, in {how}"]
    drives = run.facts.get("drives", [])
    for kind in ("energy", "conserved"):
        by = drives if kind == "energy" else [x for x in drives if x == INPUTS]
        why = f": by {' and '.join(by)}" if by else ""
        for label, column in run.of_kind(kind).items():
            if label in run.facts.get("vanishing", ()):
                continue
            change = float(np.abs(column - column[0]).max())
            first = at_first(run, label)
            place = " (derive integrals shows it)" * (parts(label)[0] == "integral")
            said = f"{first:.9g} at first, changed by at most {change:.1e}{why}"
            lines.append(f"  {label}: {said}{place}")
    for label, column in run.of_kind("defect").items():
        lines.append(f"  {label}: at most {float(column.max()):.1e}")
    lines += events(run)
    last = dict(zip(run.names, run.table[-1].tolist(), strict=True))
    state = [*run.of_kind("state")]
    largest = sorted(state, key=lambda x: -abs(last[x]))[:LARGEST]
    shown = state if len(state) <= MANY else [x for x in state if x in largest]
    told = [f"{x} = {last[x]:.6g}" for x in shown]
    told += [f"… (the largest of {len(state)})"] * (len(shown) < len(state))
    return [*lines, f"  at the end: {', '.join(told)}"]


def at_first(run: Run, label: str) -> float:
    """A quantity at first; 0 where that is the rounding of what has the same name."""
    family = [x for x in run.names if parts(x)[0] == parts(label)[0]]
    size = max(abs(float(run[x][0])) for x in family)
    first = float(run[label][0])
    return 0.0 if abs(first) <= ROUNDING * size else first


def events(run: Run) -> list[str]:
    """What happened, a line each event: how often, and when; of more than TOLD times the first
    three and the last."""
    times: dict[str, list[float]] = {}
    for one in run.events:
        times.setdefault(one.name, []).append(one.t)
    lines = []
    for name, found in times.items():
        shown = [f"{t:.12g}" for t in found]
        often, rest = "once" if len(found) == 1 else f"{len(found)} times", ""
        if len(shown) > TOLD:
            shown, rest = [*shown[:3], "…", shown[-1]], f" ({ALL_EVENTS})"
        lines.append(f"  event {name}: {often}, at t = {', '.join(shown)}{rest}")
    return lines


def negative(t: Array, column: Array) -> str:
    """When a column is below 0, its first stretch and at how many instants; empty where never.

    What is 0 to rounding is 0, as the pressure of a fluid that is only sheared.
    """
    below = np.flatnonzero(column < -1e-12 * np.abs(column).max())
    if not len(below):
        return ""
    gaps = np.flatnonzero(np.diff(below) > 1)
    last = below[gaps[0]] if len(gaps) else below[-1]
    until = f" … {t[last]:.4g}" if last > below[0] else ""
    more = " and later" if len(gaps) else ""
    return f"at t = {t[below[0]]:.4g}{until}{more}, at {len(below)} of {len(t)} instants"


def _told(run: Run) -> int:
    """The exit code, and on stderr what is amiss."""
    name = run.facts["problem"]
    if why := run.facts.get("unsought"):
        damped = DAMPING in run.facts.get("drives", ())  # and the energy is not kept
        lead = "" if damped else "of what it keeps the energy alone is told: "
        text = lead + why.removeprefix(f"{name}: ")
        print(f"derive: note: {one_line(f'{name}: {text}')}", file=sys.stderr)
    for label, column in run.of_kind("multiplier").items():
        if run.facts.get("filled") and (where := negative(run.t, column)):
            text = f"{label} is negative {where}: a fluid would tear there"
            print(f"derive: warning: {name}: {text}", file=sys.stderr)
    if not run.ended and not np.any(run.states != run.states[0]):
        text = "nothing moves: give it a velocity, as --set zeta_1=1"
        print(f"derive: warning: {name}: {text}", file=sys.stderr)
    if run.ended == "interrupted":
        print(f"derive: {name}: interrupted at t = {run.t[-1]:g}", file=sys.stderr)
        return 130
    if run.ended and not (run.events and run.events[-1].terminal):
        print(f"derive: {one_line(f'{name}: {run.ended}')}", file=sys.stderr)
        return 1
    return 0
