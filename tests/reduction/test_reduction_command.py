"""What a reduction tells, what is refused in one line, and the choice of symmetries."""

import pytest

from derive.command.cli import main
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.python.derived import derive
from derive.record.sentence import english
from tests.support.reduced import reduced


def said(capsys, *words, code=0):
    assert main(["reduction", *words]) == code
    return capsys.readouterr()


def test_the_effective_potential_of_a_top(capsys):
    words = said(capsys, "lagrange_top").out
    assert "𝒱 = mgl·A₃₃ + (𝒥₁ − A₃₃ 𝒥₂)²/(2 I1(1 − A₃₃²)) + 𝒥₂²/(2 I3)" in words
    assert "degree 3: the integral is elliptic" in " ".join(words.split())


def test_a_parameter_is_told_from_the_element_of_the_group(capsys):
    assert "𝒱 = ml‘g’ A₃₃ + " in said(capsys, "spherical_pendulum").out


def stated(L, group="SO(3)"):
    return derive(problem_of({"name": "own", "group": group, "lagrangian": {"L": L}}))


@pytest.mark.parametrize(
    ("L", "why"),
    [
        ("zeta_1^2 + zeta_2^2 + zeta_3^2 + zeta_3^4", "not quadratic"),
        ("zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 - A_33 - A_12", "no symmetry of L but of the time"),
        ("zeta_1^2 + zeta_2^2 - zeta_3^2 + A_11*A_22", "no symmetry of L but of the time"),
    ],
)
def test_what_is_not_reduced(L, why):
    with pytest.raises(ProblemError, match=why):
        stated(L).reduction()


def test_which_symmetries_are_taken():
    """Of three rotations of space, that about the third axis; of translations all."""
    found = derive("euler_top").reduction()
    assert found.kinds == ("rotation_space",)
    assert "their number is 1." in " ".join(str(found).split())
    assert derive("kirchhoff").reduction().kinds == ("translation_space",) * 3
    assert reduced("free").routhian.freedom == 1


@pytest.mark.parametrize(
    ("name", "word"),
    [
        ("flat", "elementary"),
        ("grown", "elementary"),
        ("lagrange_top", "elliptic"),
        ("steep", "hyperelliptic"),
    ],
)
def test_what_is_said_of_the_integral(name, word):
    step = reduced(name).record["quadrature"]
    assert word in str(step.prose)


def test_without_freedom_the_energy_is_the_potential():
    record = reduced("wheel").record
    energy = next(e for e in record["effective"].equations if e.lhs == "h̃")
    assert energy.rhs == "𝒱"


def test_every_equation_is_one_of_sympy():
    found = derive("charged_body").reduction()
    assert all(found[s.label].sympy() for s in found.record.steps)
    assert found.quadrature is None


@pytest.mark.parametrize(
    ("name", "left"),
    [("top", True), ("spherical_pendulum", True), ("charged_body", False), ("two_tops", False)],
)
def test_where_a_configuration_is_left_as_it_is(capsys, name, left):
    """Upright, by a turn of space and one of the body; by turns of space alone never."""
    words = " ".join(said(capsys, name, "effective").out.split())
    assert ("is positive a motion along the symmetries leaves" in words) == left
    assert ("No motion along the symmetries leaves" in words) != left


def test_a_null_field_is_not_said_to_vanish(capsys, tmp_path):
    """A boost on its light cone: 𝕀 = A₂₃² − A₁₃² is 0 there, and the field (A₂₃, A₁₃) is not."""
    shifts = [[[0, 0, int(i == 0)], [0, 0, int(i == 1)], [0, 0, 0]] for i in range(2)]
    file = tmp_path / "boost.toml"
    file.write_text(
        f'name = "boost"\n[group]\nname = "R2"\naction = "affine"\nbasis = {shifts}\n'
        '[lagrangian]\nL = "(zeta_1^2 - zeta_2^2)/2 - (T_1^2 - T_2^2)^2"\n'
    )
    words = " ".join(said(capsys, str(file)).out.split())
    assert "𝒥₁ = Π₁ A₂₃ + Π₂ A₁₃" in words
    assert "where the kinetic energy is positive a motion along the symmetries leaves" in words
    assert "elsewhere a motion" not in words


@pytest.mark.parametrize(
    ("L", "group", "condition"),
    [
        ("(zeta_1^2 + zeta_2^2 - zeta_3^2)/2", "SE(2)", "A₁₁² − A₁₂² ≠ 0, by which"),
        (
            "(zeta_1^2 + zeta_2^2 + 2*zeta_3^2 + zeta_4^2 + zeta_5^2 - zeta_6^2)/2 - A_33 - T_3^2",
            "SE(3)",
            "where 1 − 2 A₁₃² − 2 A₂₃² ≠ 0, 1 − 2 A₁₃² ≠ 0, by which",
        ),
    ],
)
def test_a_pivot_is_not_said_to_be_the_determinant(L, group, condition):
    """At the third column (1/√2, ½, ½) of a rotation 𝕀 has an inverse, and 1 − 2A₁₃² is 0."""
    words = english(stated(L, group).reduction().record["effective"].prose)
    assert condition in words
    assert "elsewhere the locked inertia" not in words
