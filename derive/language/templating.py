"""Templates: where they are, and how they are filled; a field that is not defined is an error."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .limits import Refused

if TYPE_CHECKING:
    from jinja2 import Environment


class MissingTemplateError(Refused):
    """A template or a folder of them that is not beside the package."""

    def __init__(self, name: str) -> None:
        super().__init__(f"{name} is missing beside the package; install derive again")


def folder(name: str) -> Path:
    """The folder ``name`` of templates: inside the package when installed, beside it in a checkout;
    :class:`MissingTemplateError` for none."""
    package = Path(__file__).parents[1]
    for root in (package / "templates", package.parent / "templates"):
        if (root / name).is_dir():
            return root / name
    raise MissingTemplateError(f"templates/{name}")


@cache
def environment(name: str, **delimiters: Any) -> Environment:
    """The Jinja environment of one folder of templates, which it reads once."""
    from jinja2 import (
        Environment,
        FileSystemLoader,
        FunctionLoader,
        StrictUndefined,
        TemplateNotFound,
    )

    files = FileSystemLoader(folder(name))

    def source(template: str) -> tuple[str, str | None, Any]:
        try:
            return files.get_source(made, template)
        except TemplateNotFound:
            raise MissingTemplateError(f"templates/{name}/{template}") from None

    made = Environment(
        loader=FunctionLoader(source),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
        **delimiters,
    )
    return made
