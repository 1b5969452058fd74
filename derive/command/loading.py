"""The problem that a command names, and its walk."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..language.near_names import did_you_mean, near_name
from ..language.refused import Refused
from ..problem.problem import Problem, ProblemError
from ..record.record import Derivation
from .guard import one_line

READY = Path(__file__).resolve().parents[1] / "problems"


class UsageError(Refused):
    """Bad input on the command line: one clear line, and the exit code 2."""


def ready_made() -> list[str]:
    """The names of the ready-made problems."""
    return sorted(f.name.removesuffix(".toml") for f in READY.iterdir() if f.name.endswith(".toml"))


def load_problem(name: str, **allowances: bool) -> Problem:
    """A ready-made problem by name, or a TOML file by path; ``allowances``: what may be negative,
    as in ``problem.toml.load``. ``ProblemError`` where there is neither."""
    from ..problem.toml import load

    if name in ready_made():
        return load(READY / f"{name}.toml")
    path = Path(name)
    if path.suffix == ".toml" or path.exists():
        return load(path, **allowances)
    if "\n" in name:
        raise ProblemError("a problem is a name or a .toml file, not its text: write it to a file")
    near = near_name(name.lower(), ready_made())
    if path.with_name(f"{path.name}.toml").is_file():
        near = f"{name}.toml"
    hint = did_you_mean(near[:60], after=" ")
    raise ProblemError(
        f"unknown problem {name[:60]!r}; {hint}ready-made: {', '.join(ready_made())}; "
        "or give a .toml file"
    )


def doubted(
    name: str, *, followed: bool = False, given: Mapping[str, float] | None = None, **allows: bool
) -> Problem:
    """A problem, with warnings of what may be meant otherwise in it.

    ``followed``: a motion is to be, which refuses names that the state has not; ``given``: numbers
    of parameters in place of their defaults.
    """
    from ..problem.doubts import doubts

    problem = load_problem(name, **allows)
    for doubt in doubts(problem, given or {}, followed=followed):
        print(f"derive: warning: {one_line(name)}: {one_line(doubt)}", file=sys.stderr)
    return problem


def derive(name: str, **chosen: Any) -> tuple[Problem, Derivation]:
    """A problem, :func:`doubted`, and its record; ``UsageError`` where it has no walk."""
    from ..pipeline import walk

    problem = doubted(name, **chosen)
    try:
        return problem, walk(problem)
    except ProblemError as error:
        raise UsageError(f"{name}: {error}") from None


def discrete_walk(name: str, **allowances: Any) -> tuple[Problem, Derivation]:
    """A problem, :func:`doubted`, and the record of its discrete motion."""
    from ..pipeline import discrete

    problem = doubted(name, **allowances)
    return problem, discrete(problem)


def allowed(args: argparse.Namespace) -> dict[str, bool]:
    """The keywords of :func:`load_problem` for what the flags allow to be negative."""
    from .arguments import ALLOWED

    return {f"negative_{x}": getattr(args, f"allow_negative_{x}") for x in ALLOWED}
