"""Notes that show a picture of the motion of each problem."""

import re

import pytest

from derive.command.cli import main
from derive.views.plot.pictures import plot
from tests.support.needs import need, needs
from tests.support.walks import derived

pytestmark = needs("the module matplotlib")


@pytest.mark.parametrize(
    ("name", "shown", "problems"),
    [
        ("notes.html", r'<img src="([^"]*\.svg)"', ("rod", "euler_top")),
        ("notes.tex", r"{(\w+\.pdf)}", ("rod",)),
    ],
)
def test_the_picture_of_each_problem_is_beside_and_shown(name, shown, problems, tmp_path, capsys):
    out = tmp_path / name
    assert main(["notes", *problems, "--picture", "3", "--out", str(out)]) == 0
    pictures = re.findall(shown, out.read_text(encoding="utf-8"))
    assert [x.rpartition(".")[0] for x in pictures] == [f"notes_{x}_motion" for x in problems]
    assert capsys.readouterr().out.split() == [str(out), *(str(tmp_path / x) for x in pictures)]
    for problem, picture in zip(problems, pictures, strict=True):
        run = derived(problem).simulate(3.0)
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
