"""Trims by name, as tests/equilibria/trims.toml has them."""

import tomllib
from functools import cache
from pathlib import Path

from derive import derive
from derive.problem.toml import problem_of
from tests.support.walks import SEED

TABLE = tomllib.loads(
    (Path(__file__).parents[1] / "equilibria" / "trims.toml").read_text(encoding="utf-8")
)
FOUND, REFUSED = TABLE["found"], TABLE["refused"]


def problem(row):
    """The data of the problem of a row: of the table, with keys of its own and what acts more."""
    data = {"name": "trimmed", **TABLE["problem"][row["of"]], **row.get("more", {})}
    if "covector" in row:
        data["force"] = [{"covector": row["covector"].split("; ")}]
    return data


def stated(row):
    """The problem of a row, or the name of a ready-made one."""
    return problem_of(problem(row)) if row["of"] in TABLE["problem"] else row["of"]


def made(row):
    """It derived."""
    return derive(stated(row))


def place(at):
    """The numbers that are given: of a place by its name, of a table, of several of these."""
    several = at if isinstance(at, list) else [at]
    return {k: y for x in several for k, y in (TABLE["place"][x] if x == str(x) else x).items()}


def asked(row):
    """What is asked of the problem of a row."""
    given = {x: row[x] for x in ("along", "bounds", "given") if x in row}
    free = row["free"].split() if "free" in row else None
    return {"at": place(row.get("at", {})), "free": free, **given}


@cache
def trim(name):
    """The trim of a row."""
    row = FOUND[name]
    return made(row).trim(**asked(row))


def holds(found):
    """Is a trim held, with all steps of its record?"""
    return all(v.holds for v in found.check(SEED))
