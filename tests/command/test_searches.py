"""What is searched for, by the command: in every format and both languages the steps that tell it
and no others, a step alone, and a record that is checked."""

import pytest

from derive.command.cli import main
from derive.views.rendering import FORMATS

SEARCHES = {
    "symmetries": ("top", "symmetries", "conserved_3", "By a symmetry", "Par une symétrie"),
    "reduction": (
        *("spherical_pendulum", "momentum_1", "quadrature"),
        *("The locked inertia", "L’inertie bloquée"),
    ),
    "integrals --degree 2": (
        *("lagrange_top", "poisson", "first_integrals"),
        *("For generic values of the parameters", "Pour des valeurs génériques des paramètres"),
    ),
    "integrals --degree 2 --conditions": (
        *("lagrange_top", "poisson", "first_integrals"),
        *("where one of these conditions holds", "là où l’une de ces conditions"),
    ),
    "equilibria": (
        *("euler_top", "equilibrium_1", "energy_casimir_3"),
        *("A relative equilibrium", "Un équilibre relatif"),
    ),
    "trim --at A_11=-1 --at A_22=-1": (
        *("pendulum", "trim", "trim"),
        *("The velocity stays 0 with", "La vitesse reste 0 avec"),
    ),
    "equilibria --near Pi_2=1": (
        *("euler_top", "enclosure_1", "enclosure_1"),
        *("(Krawczyk)", "(Krawczyk)"),
    ),
}
"""Words of a command → a problem, the first and the last step that is shown, and what they say."""


@pytest.mark.parametrize("words", SEARCHES)
@pytest.mark.parametrize("form", FORMATS)
def test_it_is_shown_in_every_format(words, form, tmp_path, capsys):
    name, first, last, *said = SEARCHES[words]
    command, *options = words.split()
    file, own = tmp_path / f"out.{form}", [command, name, *options]

    def shown(*more):
        assert main([*own, "--format", form, "--out", str(file), *more]) == 0
        return " ".join(file.read_text(encoding="utf-8").replace("\\_", "_").split())

    english = shown()
    assert f"{name}.{first}" in english
    assert f"{name}.{last}" in english
    if form == "json":
        assert main(["check", str(file)]) == 0
        return
    assert f"{name}.mass" not in english
    if form == "text":
        french = shown("--lang", "fr")
        assert [x in y for x, y in zip(said, (english, french), strict=True)] == [True, True]
        assert said[0] == said[1] or said[0] not in french
    if form == "text" and command in ("symmetries", "reduction"):
        alone = shown(last)
        assert alone.startswith(f"{name}.{last} ·")
        assert f"{name}.{first} ·" not in alone
