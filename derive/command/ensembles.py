"""``derive simulate --ensemble``: many motions, written part by part."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..motion.ensemble import Many, Part, Plan, require_steps_of_an_ensemble
from ..motion.ensemble_files import writer
from ..motion.start import MotionError
from ..motion.varied import Varied
from ..native.motion_in_c import AT_EVENT
from ..pipeline import motion_of_many
from ..problem.problem import Problem
from ..record.record import Derivation
from .guard import heard, one_line
from .progress import with_progress
from .writing import growing


def plan_of(args: argparse.Namespace, start: dict[str, Any]) -> Plan:
    """The ensemble that a command asks for; ``MotionError`` for options that are not for one."""
    if args.html:
        raise MotionError("--html shows one motion: leave out --ensemble")
    require_steps_of_an_ensemble(args.method, args.dt, args.order)
    chosen = {} if args.tol is None else {"tol": args.tol}
    points = 1 if args.points is None else args.points
    varied = tuple(Varied(*x) for x in args.vary or ())
    seed = args.seed or 0
    return Plan(args.ensemble, varied, args.t, points, seed=seed, **chosen, **start)


def command_ensemble(
    args: argparse.Namespace, problem: Problem, record: Derivation, start: dict[str, Any]
) -> int:
    """Run ``derive simulate --ensemble``: its exit code."""
    plan = plan_of(args, start)
    many = Many(motion_of_many(problem, record), problem, plan)
    if not all(x.terminal for x in problem.events):
        text = "events that are not terminal are not looked for in an ensemble"
        print(f"derive: warning: {problem.name}: {text}", file=sys.stderr)
    tally = Tally(len(many.first.x))
    with heard() as interrupted, kept(many, args.out) as add:
        about = f"{problem.name}, parts of {many.size}"
        parts = with_progress(many.parts(interrupted), many.count, about)
        for part in parts:
            add(part)
            tally.add(part)
            if interrupted():
                break
        stopped = interrupted() and tally.motions < plan.n
    for line in summary(many, tally):
        print(one_line(line))
    if args.out:
        print(args.out)
    if stopped:
        text = f"interrupted after {tally.motions} of {plan.n} motions"
        print(f"derive: {problem.name}: {text}", file=sys.stderr)
        return 130
    return 0 if any(k == 0 or k >= AT_EVENT for k in tally.count) else 1


@contextmanager
def kept(many: Many, out: str) -> Iterator[Callable[[Part], None]]:
    """What writes the parts to a file, or, where none is named, nowhere."""
    if not out:
        yield lambda part: None
        return
    with growing(Path(out)) as file, writer(file, out, many.whole([many.none])) as made:
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
        """Mean and standard deviation of the states at the end."""
        assert self.origin is not None
        mean = self.sum / self.count[0]
        return self.origin + mean, np.sqrt(np.maximum(self.squares / self.count[0] - mean**2, 0))


def summary(many: Many, tally: Tally) -> list[str]:
    """What an ensemble says of itself, in lines."""
    facts, plan = many.facts, many.plan
    span = f"{plan.n} motions, t = 0 … {many.t[-1]:g}"
    lines = [f"{facts['problem']}: {span}, by {facts['method']}, in C; seed {plan.seed}"]
    lines += [f"  {x}" for _, x in facts["varied"]]
    lines += [f"  {tally.count[k]} {text}" for k, text in many.said.items() if tally.count[k]]
    if tally.count[0]:
        pairs = zip(many.code.program.state, *(x.tolist() for x in tally.ends()), strict=True)
        told = ", ".join(f"{name} = {mean:.6g} ± {off:.2g}" for name, mean, off in pairs)
        lines.append(f"  at the end, mean and deviation: {told}")
    return lines
