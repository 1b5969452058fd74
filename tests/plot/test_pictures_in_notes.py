"""Notes that show a picture of the motion of each problem."""

import re

import pytest

import derive
from derive.command.cli import main
from derive.plot.pictures import plot
from tests.support.needs import need, needs

pytestmark = needs("the module matplotlib")


@pytest.mark.parametrize(
    ("name", "shown"), [("notes.html", r'<img src="([^"]*)"'), ("notes.tex", r"{(\w+\.pdf)}")]
)
def test_the_picture_of_each_problem_is_beside_and_shown(name, shown, tmp_path, capsys):
    out = tmp_path / name
    assert main(["notes", "rod", "euler_top", "--picture", "3", "--out", str(out)]) == 0
    pictures = re.findall(shown, out.read_text(encoding="utf-8"))
    ending = "svg" if name == "notes.html" else "pdf"
    assert pictures == [f"{out.stem}_{x}_motion.{ending}" for x in ("rod", "euler_top")]
    assert capsys.readouterr().out.split() == [str(out), *(str(tmp_path / x) for x in pictures)]
    for problem, picture in zip(("rod", "euler_top"), pictures, strict=True):
        run = derive.derive(problem).simulate(3.0)
        assert (tmp_path / picture).read_bytes() == plot(run, picture)


def test_without_it_nothing_is_shown(tmp_path):
    assert main(["notes", "rod", "--out", str(tmp_path / "notes.tex")]) == 0
    assert "graphic" not in (tmp_path / "notes.tex").read_text(encoding="utf-8")
    assert len([*tmp_path.iterdir()]) == 1


def test_in_a_pdf(tmp_path):
    need("pdflatex")
    bare, out = tmp_path / "bare.pdf", tmp_path / "notes.pdf"
    assert main(["notes", "rod", "--out", str(bare)]) == 0
    assert main(["notes", "rod", "--picture", "3", "--out", str(out)]) == 0
    assert (tmp_path / "notes_rod_motion.pdf").stat().st_size > 2000
    assert out.stat().st_size > bare.stat().st_size + 2000
