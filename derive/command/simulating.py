"""``derive simulate``: a run or an ensemble in one command; and ``derive compare``: someone's
right-hand side beside ours.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ..algebra.groups import names_by_block
from ..code.naming import own_prefix
from ..code.options import Options
from ..code.program import Program
from ..compare.comparison import MOST, STATES, comparison, reports
from ..motion import signals
from ..motion.emitted import python_of
from ..motion.emitted_code import parts
from ..motion.ensemble import (
    EnsembleMotions,
    Part,
    Plan,
    VariedNumber,
    require_an_ensemble,
    require_steps_of_an_ensemble,
)
from ..motion.ensemble_files import writer
from ..motion.first_numbers import DAMPING, FORCES, INPUTS, MotionError, is_weightless
from ..motion.native import AT_EVENT
from ..motion.run import Array, Run, format_of, shown, written
from ..motion.simulate import beginning, run, some_turns
from ..motion.start import state_file
from ..motion.trajectory import STEPS, Method, instants, step_of
from ..pipeline import walk
from ..problem.problem import Problem
from ..programs import motion_of, motion_of_many, program
from ..record.record import Derivation
from ..views.language import language
from ..views.page.motion_page import motion_page, with_seen
from ..views.plot.pictures import plot
from .showing import UsageError, allowed, columns, derive, doubted, each_once
from .writing import filled, growing, heard, one_line, require_place, with_progress, working, write


def made(problem: Problem, dynamics: bool) -> tuple[Program, ModuleType]:
    """The program of a problem, with its dynamics or without, and its Python."""
    record, options = walk(problem), Options(dynamics=dynamics)
    found = program(problem, record, options)
    return found, python_of(found, record, own_prefix(problem.name), options)


def command_compare(args: argparse.Namespace) -> int:
    """Hold a right-hand side of your own, in C or Python, against that of a problem."""
    problem = doubted(args.problem)
    table = None if args.table is None else Path(args.table)
    states = STATES if args.states is None else args.states
    if not 1 <= states <= MOST:
        raise UsageError(f"--states {states}: from 1 to {MOST}")
    seed = args.seed or 0
    with working(args.problem):
        held = comparison(problem, made, Path(args.file), args.function, table, seed, states)
        agrees, lines = reports(held, made)
        for line in lines:
            print(one_line(line), flush=True)
    return 0 if agrees else 1


# ``derive simulate``: from a problem to a run in one command.

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
    if args.input or args.linear:
        raise MotionError(
            "--html: the inputs of a page go by [[signal]] of the problem, or are held, set by its "
            "sliders: leave out --input, --linear"
        )
    if args.dt is not None or args.method not in (None, STEPS[0]):
        raise MotionError("--html: the page moves by gauss to a tolerance: leave out --dt, --step")
    return moving_page(problem, record, args.t, method_of(args, STEPS[0]), args.lang, **start)


def moving_page(
    problem: Problem, record: Derivation, t: float | None, method: Method, lang: str, **start: Any
) -> str:
    """The page of a motion from 0 to t, for ``None`` some turns, from a start as ``beginning``
    takes it; ``Refused``."""
    code = motion_of(replace(problem, events=()), with_seen(record), weightless=True)
    begin = beginning(code, problem, **start)
    t = some_turns(code, begin) if t is None else t
    instants(method, t, 1)  # refuses a time that is none
    tol, held = method.tol, start["given"]
    return motion_page(code, problem, record, begin, t, tol, language(lang), held)


def picture_of(problem: Problem, record: Derivation, t: float, name: str, lang: str) -> bytes:
    """A picture of the motion from 0 to t, in the format of a name; ``Refused``."""
    method = Method()
    code = motion_of(problem, record, method.step)
    found, words = run(code, problem, method, t, 500, given={}), language(lang)
    return plot(found, name, word=words.word, mark=words.mark)


def method_of(args: argparse.Namespace, step: str) -> Method:
    """The step, and its size or tolerance."""
    chosen = {} if args.tol is None else {"tol": args.tol}
    return Method(step, args.dt, **chosen, order=args.order or "")


def start_of(args: argparse.Namespace, problem: Problem, record: Derivation) -> dict[str, Any]:
    """Where the motion starts, as ``beginning`` takes it; on stderr what is amiss with it."""
    given: dict[str, float] = {}
    chosen = each_once("--set", args.set)
    if args.state:
        given, doubt = state_file(Path(args.state), problem, record)
        table = signals.read(args.input)[0].names if args.input else ()
        given = {x: y for x, y in given.items() if x not in table}
        if doubt:
            print(f"derive: warning: {one_line(f'{args.state}: {doubt}')}", file=sys.stderr)
    own = names_by_block(problem.group) if problem.group else {}
    both = own | {name: x for x, name in own.items()}
    return {
        "given": {x: y for x, y in given.items() if both.get(x) not in chosen} | chosen,
        "exponent": args.exp or (),
        "project": args.project,
    }


def run_of(
    args: argparse.Namespace, problem: Problem, record: Derivation, start: dict[str, Any]
) -> Run:
    """The run that a command asks for; ``Refused`` where there is none."""
    method = method_of(args, step_of(record.problem or {}, args.method, args.dt))
    light = is_weightless(record.problem or {}, start["given"])
    with working(args.problem):
        motion = motion_of(problem, record, method.step, method.order, weightless=light)
    return run(
        motion,
        problem,
        method,
        args.t,
        500 if args.points is None else args.points,
        **start,
        progress=lambda parts, total: with_progress(parts, total, problem.name),
        inputs=args.input,
        linear=args.linear,
    )


def command_simulate(args: argparse.Namespace) -> int:
    """Run ``derive simulate``: its exit code."""
    if args.dt is not None and args.tol is not None:
        raise MotionError("--dt is a step of one size, --tol chooses it: give one of them")
    if args.t is None and (args.dt is not None or args.ensemble is not None or args.input):
        raise MotionError("for how long? give --t with --dt, --ensemble or --input")
    if args.ensemble is None:
        require_an_ensemble(args.vary, args.seed, args.device)
    if args.out:
        format_of(args.out)  # refused before the work
    for file in filter(None, (args.out, args.html)):
        require_place(Path(file))
    chosen = {"followed": True, "given": each_once("--set", args.set)}
    with working(args.problem):
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
    told = (x for line in summary(found) for x in filled(one_line(line), columns(None)))
    print(*pages, *told, *files, sep="\n")
    return _told(found)


def summary(run: Run) -> list[str]:
    """What a run says of itself, in lines."""
    name, method = run.facts["problem"], run.facts["method"]
    count, how = len(run.t), run.facts["language"]
    span = f"{count} instant{'s' * (count != 1)}, t = 0 … {run.t[-1]:g}"
    lines = [f"{name}: {span}, by {method}, in {how}"]
    drives = run.facts.get("drives", [])
    for kind in ("energy", "conserved"):
        for label, column in run.of_kind(kind).items():
            if label in run.facts.get("vanishing", ()):
                continue
            every = kind == "energy" or parts(label)[0] == "trace"  # those of a fluid on the torus
            by = [x for x in drives if every or x in (INPUTS, FORCES)]
            why = f": by {' and '.join(by)}" if by else ""
            change = float(np.abs(column - column[0]).max())
            first = at_first(run, label)
            place = " (derive integrals shows it)" * (parts(label)[0] == "integral")
            said = f"{first:.9g} at first, changed by at most {change:.1e}{why}"
            lines.append(f"  {label}: {said}{place}")
    for label, column in run.of_kind("defect").items():
        most = float(column.max())
        lines.append(f"  {label}, how far the state is off its group: at most {most:.1e}")
    lines += events(run)
    last = dict(zip(run.names, run.table[-1].tolist(), strict=True))
    state = [*run.of_kind("state")]
    largest = sorted(state, key=lambda x: -abs(last[x]))[:LARGEST]
    chosen = state if len(state) <= MANY else [x for x in state if x in largest]
    told = [f"{shown(run.facts, x)} = {last[x]:.6g}" for x in chosen]
    told += [f"… (the largest of {len(state)})"] * (len(chosen) < len(state))
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
        told = [f"{t:.12g}" for t in found]
        often, rest = "once" if len(found) == 1 else f"{len(found)} times", ""
        if len(told) > TOLD:
            told, rest = [*told[:3], "…", told[-1]], f" ({ALL_EVENTS})"
        lines.append(f"  event {name}: {often}, at t = {', '.join(told)}{rest}")
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
        drives = run.facts.get("drives", ())
        damped = DAMPING in drives  # and the energy is not kept
        lead = "" if damped else "of what it keeps the energy alone is told: "
        text = lead + why.removeprefix(f"{name}: ")
        if FORCES in drives:
            text = "what it keeps without its forces of the state is not sought"
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


# ``derive simulate --ensemble``: many motions, written part by part.


def plan_of(args: argparse.Namespace, start: dict[str, Any]) -> Plan:
    """The ensemble that a command asks for; ``MotionError`` for options that are not for one."""
    if args.html or args.input or args.linear:
        given = "--html shows" if args.html else "--input is for"
        raise MotionError(f"{given} one motion: leave out --ensemble")
    require_steps_of_an_ensemble(args.method, args.dt, args.order)
    chosen: dict[str, Any] = {} if args.tol is None else {"tol": args.tol}
    points = 1 if args.points is None else args.points
    varied = tuple(VariedNumber(*x) for x in args.vary or ())
    chosen |= {"seed": args.seed or 0, "device": args.device or ""}
    return Plan(args.ensemble, varied, args.t, points, **chosen, **start)


def command_ensemble(
    args: argparse.Namespace, problem: Problem, record: Derivation, start: dict[str, Any]
) -> int:
    """Run ``derive simulate --ensemble``: its exit code."""
    plan = plan_of(args, start)
    many = EnsembleMotions(motion_of_many(problem, record), problem, plan)
    if not all(x.terminal for x in problem.events):
        text = "events that are not terminal are not looked for in an ensemble"
        print(f"derive: warning: {problem.name}: {text}", file=sys.stderr)
    tally = Tally(len(many.names))
    with heard() as interrupted, kept(many, args.out) as add:
        about = f"{problem.name}, parts of {many.size}"
        parts = with_progress(many.parts(interrupted), many.count, about)
        for part in parts:
            add(part)
            tally.add(part)
            if interrupted():
                break
        stopped = interrupted() and tally.motions < plan.n
    for line in ensemble_summary(many, tally):
        print(one_line(line))
    if args.out:
        print(args.out)
    if stopped:
        text = f"interrupted after {tally.motions} of {plan.n} motions"
        print(f"derive: {problem.name}: {text}", file=sys.stderr)
        return 130
    return 0 if any(k == 0 or k >= AT_EVENT for k in tally.count) else 1


@contextmanager
def kept(many: EnsembleMotions, out: str) -> Iterator[Callable[[Part], None]]:
    """What writes the parts to a file, or, where none is named, nowhere."""
    if not out:
        yield lambda part: None
        return
    with growing(Path(out)) as file, writer(file, out, many.joined([many.none])) as made:
        yield made.add


class Tally:
    """What is told of motions: how many have which status, mean and deviation of their ends."""

    def __init__(self, size: int):
        self.count: Counter[int] = Counter()
        self.sum, self.squares = np.zeros(size), np.zeros(size)
        self.origin: np.ndarray[Any, Any] | None = None

    @property
    def motions(self) -> int:
        """How many there were."""
        return self.count.total()

    def add(self, part: Part) -> None:
        """Count some more."""
        self.count.update(part.status.tolist())
        ends = part.states[part.status == 0, -1]
        if len(ends):
            self.origin = ends[0] if self.origin is None else self.origin
            self.sum += (ends - self.origin).sum(axis=0)
            self.squares += ((ends - self.origin) ** 2).sum(axis=0)

    def ends(self) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Mean and standard deviation of the states, and of what is read off them, at the end."""
        assert self.origin is not None
        mean = self.sum / self.count[0]
        return self.origin + mean, np.sqrt(np.maximum(self.squares / self.count[0] - mean**2, 0))


def ensemble_summary(many: EnsembleMotions, tally: Tally) -> list[str]:
    """What an ensemble says of itself, in lines."""
    facts, plan = many.facts, many.plan
    span = f"{plan.n} motions, t = 0 … {many.t[-1]:g}"
    by = f"by {facts['method']}, in {'CUDA' if plan.device else 'C'}"
    lines = [f"{facts['problem']}: {span}, {by}; seed {plan.seed}"]
    lines += [f"  {x}" for _, x in facts["varied"]]
    lines += [f"  {tally.count[k]} {text}" for k, text in many.said.items() if tally.count[k]]
    if tally.count[0]:
        pairs = zip(many.names, *(x.tolist() for x in tally.ends()), strict=True)
        told = ", ".join(f"{shown(facts, x)} = {mean:.6g} ± {off:.2g}" for x, mean, off in pairs)
        lines.append(f"  at the end, mean and deviation: {told}")
    return lines
