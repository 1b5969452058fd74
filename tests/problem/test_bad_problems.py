"""What is wrong in a file of one's own: one line that names the file, the key, the remedy."""

import os
import re
import tomllib
from pathlib import Path

import pytest

from derive.command.cli import main
from derive.pipeline import walk
from derive.problem.problem import ProblemError
from derive.problem.toml import load, problem_of
from tests.corpus import problems, table
from tests.support.walks import own_verdicts

NAME = "bad.toml"
NEGATIVE = "is negative; correct it, or allow it with --allow-negative-"
COMMANDS = (["walk", NAME, "--out", "walk.txt"], ["emit", NAME, "--out", "out"])


@pytest.mark.parametrize(
    ("text", "data", "words"), [pytest.param(*x, id=x[-1][0]) for x in problems("refused")]
)
def test_it_is_refused_in_one_line(text, data, words, tmp_path, monkeypatch, capsys):
    """By each command, which writes nothing; and in Python in the same words."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / NAME).write_bytes(text.encode("utf-8"))
    for command in COMMANDS:
        assert main(command) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(f"derive: {NAME}: ")
        assert err.count("\n") == 1
        assert err[:-1].isprintable()
        assert [x for x in words if x not in err] == []
        assert os.listdir() == [NAME]
    if data is not None:
        with pytest.raises(ProblemError) as told:
            walk(problem_of(data))
        assert str(told.value) in err


@pytest.mark.parametrize(("text", "data", "words"), problems("taken"))
def test_it_is_taken(text, data, words, tmp_path, monkeypatch, capsys):
    """However odd."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / NAME).write_bytes(text.encode("utf-8"))
    assert main(COMMANDS[0]) == 0, capsys.readouterr().err


@pytest.mark.parametrize(
    "text", ['title = "« a “b” »"\nm = = 1\n', "at = [1,5\n", 'a = 3 "b"\n', "m = 1.5.2\n"]
)
def test_what_is_not_known_is_not_guessed(text, tmp_path):
    (tmp_path / NAME).write_text(text, encoding="utf-8")
    with pytest.raises(ProblemError) as told:
        load(tmp_path / NAME)
    assert not re.search("curly|comma: |stands in quotes", str(told.value))


def test_too_many_parameters():
    data = table("problems")["base"]["two"]
    with pytest.raises(ProblemError, match="'parameters': more than"):
        problem_of(data | {"parameters": {f"k{i}": 1 for i in range(5000)}})


ALLOWED = re.compile(r"(.*) is negative; .* allow it with (\S+) \(in Python: (\w+)=True\)")
MADE_NEGATIVE = [x for x, _, words in problems("refused") if NEGATIVE in words[0]]


@pytest.mark.parametrize("text", MADE_NEGATIVE, ids=range(len(MADE_NEGATIVE)))
def test_what_may_be_negative_is_taken_with_a_warning(text, tmp_path, monkeypatch, capsys):
    """Where the refusal says how it is allowed; in Python too."""
    monkeypatch.chdir(tmp_path)
    Path(NAME).write_text(text, encoding="utf-8")
    walked, emitted = COMMANDS
    assert main(walked) == 2
    what, option, word = ALLOWED.match(capsys.readouterr().err.removeprefix("derive: ")).groups()
    for command in (walked, emitted):
        assert main([*command, option]) == 0
        assert f"derive: warning: {what} is negative\n" in capsys.readouterr().err
    record = walk(problem_of(tomllib.loads(text), **{word: True}))
    assert all(v.holds for v in own_verdicts(record))
