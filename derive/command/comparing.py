"""``derive compare``: someone's right-hand side beside ours."""

from __future__ import annotations

import argparse
from pathlib import Path
from types import ModuleType

from ..code.naming import own_prefix
from ..code.options import Options
from ..code.program import Program
from ..compare.comparison import MOST, STATES, comparison, reports
from ..motion.emitted import python_of
from ..pipeline import walk
from ..problem.problem import Problem
from ..programs import program
from .showing import UsageError, doubted
from .terminal import working
from .writing import one_line


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
    print(*map(one_line, lines), sep="\n")
    return 0 if agrees else 1
