"""The answer of a record: its equations of motion alone, with what their letters are."""

import numpy as np
import pytest
import sympy

import derive
from derive.command.cli import main
from derive.command.showing import ready_made
from derive.language.show import show_name
from derive.language.tree import names, nodes
from derive.views.answer import answer, definitions, equations_of_motion, steps_of_answer
from derive.views.language import LANGUAGES, language
from derive.views.printing.line_breaking import display_width
from tests.support.walks import record as walk_of

PENDULUM = """\
A pendulum in the plane — SO(2)

       Ȧ = AZ
      ζ̇₁ = ‘g’ A₁₂/l

where
      Z = [0, −ζ₁; ζ₁, 0]

  A     linear part of g
  Z     A⁻¹α, in the Lie algebra
  ζ     coordinates of Z in the basis of the Lie algebra
  l     length of the rod, [m], default 0.8
  ‘g’   gravity, [m/s^2], default 9.81

From pendulum.motion, pendulum.explicit.
"""


def test_it_is_short(capsys):
    assert main(["walk", "pendulum", "--answer"]) == 0
    assert capsys.readouterr().out == PENDULUM


@pytest.mark.parametrize("name", ready_made())
def test_it_is_of_the_record_and_says_what_letters_are(name):
    """Its equations stand in the walk; of each letter an equation of the problem's own, or what it
    means; in every language, in the width that is asked for."""
    record = walk_of(name)
    motion = equations_of_motion(record)
    defined = definitions(record, motion)
    there = {e for step in record.steps for e in step.equations}
    assert motion
    assert {*motion, *defined} <= there
    assert len({e.lhs for e in motion}) == len(motion)
    used = {x for e in (*motion, *defined) for x in names(e.rhs)}
    for words in map(language, LANGUAGES):
        shown = answer(record, 72, language=words)
        assert all(display_width(line) <= 72 for line in shown.split("\n"))
        meant = [s for s in record.symbols if s.name in used]
        assert all(f"\n  {show_name(s.name)} " in shown for s in meant)
        assert words.word("where") in shown or not defined
        assert steps_of_answer(record)[0].label in shown


def test_entries_stand_for_their_vector():
    motion = equations_of_motion(walk_of("kirchhoff"))
    rates = {x for e in motion for x in nodes(e.lhs) if isinstance(x, tuple) and x[0] == "entry"}
    assert {("entry", "ζ̇", k) for k in range(1, 7)} == rates
    assert "ζ̇" not in {e.lhs for e in motion}


def test_a_moment_of_inertia_is_told_where_it_stands():
    """I₁₁ of the top by its own line, not by the tensor it is an entry of."""
    record = walk_of("top")
    defined = {e.lhs: e for e in definitions(record, equations_of_motion(record))}
    assert {("entry", "I", 1, 1), ("entry", "I", 3, 3), "m"} == {*defined}


def test_python_has_it():
    d = derive.derive("euler_top")
    rate = d.answer.sympy()[1].rhs
    (zeta,) = rate.atoms(sympy.MatrixSymbol)
    moments = {"I1": 1, "I2": 1.6, "I3": 2.2}
    values = {x: moments[x.name] for x in rate.free_symbols - {zeta}}
    found = rate.subs(values).subs(zeta, sympy.Matrix([0.3, -0.7, 0.2])).doit()
    assert np.isclose(float(found), (1.6 - 2.2) / 1.0 * -0.7 * 0.2)
    assert str(d.answer) == answer(d.record)
    assert d._repr_markdown_().startswith(d.answer.markdown())
    assert "<details>" in d._repr_markdown_()


def test_the_steps_have_one_name_in_every_walk(capsys):
    for name, label in (("top", "components"), ("euler_top", "explicit"), ("affine", "equations")):
        assert main(["walk", name, "answer"]) == 0
        assert f"{name}.{label}  ·" in capsys.readouterr().out


@pytest.mark.parametrize("more", [["kernel"], ["--trivialisation", "both"]])
def test_it_stands_alone(capsys, more):
    assert main(["walk", "top", "--answer", *more]) == 2
    assert "--answer shows its own steps" in capsys.readouterr().err
