"""Command lines that are refused, those of tests/corpus/commands.toml: one line that says why."""

import os

import pytest

from derive.command.cli import main
from tests.corpus import commands
from tests.support.needs import need


@pytest.mark.parametrize(
    ("words", "files", "said"), [pytest.param(*x, id=" ".join(x[0])) for x in commands()]
)
def test_it_is_refused_in_one_line(words, files, said, tmp_path, monkeypatch, capsys):
    """Exit 2, beside warnings one line, and nothing is written."""
    if "--ensemble" in words:
        need("cc")
    monkeypatch.chdir(tmp_path)
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    try:
        status = main(words)
    except SystemExit as end:
        status = end.code
    out, err = capsys.readouterr()
    (line,) = (x for x in err.splitlines() if not x.startswith("derive: warning: "))
    assert (status, out) == (2, "")
    assert line.startswith(("derive: ", f"derive {words[0]}: error: "))
    assert [x for x in said if x not in line] == []
    # what means nothing that is known has no meaning guessed
    assert ("did you mean" in line) <= any("did you mean" in x for x in said)
    assert {*os.listdir()} == {*files}
