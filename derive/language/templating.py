"""Templates: where they are, and how they are filled; a field that is not defined is an error."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment


def folder(name: str) -> Path:
    """The folder ``name`` of templates: inside the package when installed, beside it in a checkout;
    ``FileNotFoundError`` for none."""
    package = Path(__file__).parents[1]
    for root in (package / "templates", package.parent / "templates"):
        if (root / name).is_dir():
            return root / name
    raise FileNotFoundError(f"no templates for {name!r} beside the package")


@cache
def environment(name: str, **delimiters: Any) -> Environment:
    """The Jinja environment of one folder of templates, which it reads once."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    return Environment(
        loader=FileSystemLoader(folder(name)),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
        **delimiters,
    )
