"""What is told before an option is chosen is what the command says when it is."""

import pytest

from derive import derive
from derive.code.options import ADDED, CHOICES, DEPENDENT, REPEATED, Options
from derive.command.cli import main
from derive.command.emitting import further, refused

FORMS = {
    "so3": ((), Options()),
    "sl3": (("julia",), Options(frame="given", momenta=True)),
    "spherical_pendulum": (("c", "rust"), Options(jacobian=("raw",))),
    "euler_top": (("python",), Options(step=("gauss", "gauss_jax"))),
    "zeitlin": (("c",), Options(real="float")),
    "top": (("c",), Options(attitude="quaternion", step=("rk4",))),
}


def words(languages, options):
    """As the command takes them."""
    found = [f"--lang={x}" for x in languages]
    found += [f"--{x}={getattr(options, x)}" for x in (*CHOICES, *DEPENDENT) if getattr(options, x)]
    found += [f"--{x}={y}" for x in REPEATED for y in getattr(options, x)]
    return found + [f"--{x}" for x in ADDED if getattr(options, x)]


@pytest.mark.parametrize("name", FORMS)
def test_the_reasons_are_those_of_the_command(name, capsys, tmp_path):
    languages, options = FORMS[name]
    d = derive(name)
    found = refused(d.problem, d.record, languages or ("c", "python"), options)
    assert found
    choices = dict(further(languages or ("c", "python"), options))
    assert {*found} <= {*choices}
    for choice, reason in found.items():
        command = ["emit", name, *words(*choices[choice]), "--out", str(tmp_path / "out")]
        assert main(command) == 2
        assert reason in capsys.readouterr().err, choice
    assert not (tmp_path / "out").exists()


ORDERS = [f"order {k}" for k in (2, 4, 6, 8)]
REFUSED_OF_SO3 = ("form header", *ORDERS, "multiplier", "ensemble")
REFUSED_OF_SO3 += ("attitude angle", "jacobian outputs", "jacobian step")
CHOICES_OF_SO3 = dict(further(("python",), Options()))


@pytest.mark.parametrize("choice", CHOICES_OF_SO3)
def test_what_is_not_refused_is_made(choice, tmp_path, capsys):
    d = derive("so3")
    why = refused(d.problem, d.record, ("python",), Options()).get(choice)
    assert bool(why) == (choice in REFUSED_OF_SO3)
    status = main(["emit", "so3", *words(*CHOICES_OF_SO3[choice]), "--out", str(tmp_path / "out")])
    assert status == (2 if why else 0)
    assert (why or "") in capsys.readouterr().err


def test_what_is_refused_itself_is_told_alone():
    d = derive("sl3")
    (told,) = refused(d.problem, d.record, ("c",), Options(attitude="quaternion")).items()
    assert told == ("", "sl3: a quaternion needs a factor SO(3) or SE(3), not SL(3)")
