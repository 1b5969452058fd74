"""What the program can do, one capability a line, read from the program itself: commands with their
options, keys of problem files, words of Python with what each has, options and steps of the emitted
code in each language, rules of records, ready-made problems.

python -m tests.support.capabilities writes the list beside this file; a test holds that none that
stands there is lost.
"""

import argparse
import inspect
from contextlib import suppress
from dataclasses import fields
from pathlib import Path

import derive
from derive.code.languages import LANGUAGES
from derive.code.options import ADDED, CHOICES, DEPENDENT, REPEATED
from derive.command.arguments import parser
from derive.command.cli import COMMANDS
from derive.command.showing import ready_made
from derive.record.vocabulary import RULES
from derive.schema.table import Table

LISTED = Path(__file__).with_suffix(".txt")


def commands():
    """Each command with each option, and what that may be."""
    top = parser(COMMANDS, "")
    chosen = next(x for x in top._actions if isinstance(x, argparse._SubParsersAction))
    for name, command in chosen.choices.items():
        for action in command._actions:
            words = "|".join(map(str, action.choices or ()))
            yield " ".join(["command", name, *(action.option_strings or [action.dest]), words])


def tables(cls=Table):
    """Each table of a problem, with each key."""
    for table in cls.__subclasses__():
        for field in fields(table):
            yield f"table {table.__name__} {field.name}"
        yield from tables(table)


def words():
    """Each word of Python, with each argument and each public member."""
    for name in derive.__all__:
        word = getattr(derive, name)
        yield f"python {name}"
        with suppress(ValueError):  # an exception has no signature
            yield from (f"python {name}({x})" for x in inspect.signature(word).parameters)
        if inspect.isclass(word):
            yield from (f"python {name}.{x}" for x in dir(word) if not x.startswith("_"))


def emissions():
    """Each option of the emitted code with each value, each language with each step."""
    for option, (values, _) in (CHOICES | REPEATED | DEPENDENT).items():
        yield from (f"option {option} {value}" for value in values)
    yield from (f"option {option}" for option in ADDED)
    for language in LANGUAGES.values():
        yield from (f"step {language.name} {step}" for step in language.steps)
        yield from (f"file {language.name} {x}" for names in language.files.values() for x in names)


def about_options():
    """What the help of a command says of options of the emitted code: plain text, without marks."""
    told = {about for _, about in (CHOICES | REPEATED | DEPENDENT).values()}
    return told | {*ADDED.values()}


def records():
    """Each rule of a record, each ready-made problem."""
    yield from (f"rule {name}" for name in RULES)
    yield from (f"problem {name}" for name in ready_made())


def listed():
    """All lines, in order."""
    sources = (commands, tables, words, emissions, records)
    return sorted({line.strip() for source in sources for line in source()})


if __name__ == "__main__":
    LISTED.write_text("\n".join(listed()) + "\n", encoding="utf-8")
