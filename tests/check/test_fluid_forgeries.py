"""Statements about a fluid that have no meaning are refused, and it is said why."""

from dataclasses import replace

import pytest

from derive.check.fluid.fluid_checker import FluidChecker
from derive.check.fluid.fluid_spaces import Ball, FlatTorus, curl
from derive.language.read import read
from derive.record.record import Equation
from tests.support.walks import FLUIDS, SEED, record

D = record("ideal_fluid")
STRATIFIED = record("stratified_fluid")
STEP = D["ideal_fluid.pressure"]
WITHOUT = {
    "no name": (("add", "u", "foo"), "u", "no value for 'foo'"),
    "no function": (("call", "foo", "u"), "u", "no function 'foo'"),
    "no operation": ("j(u) = u", "has no meaning for fields"),
    "two kinds in a sum": ("u + p = u", "a sum of things of two kinds"),
    "two fields": ("uu = u", "these are not multiplied"),
    "a function as a factor": ("pu = u", "a function is no factor"),
    "one argument": ("dϖ(δy) = 0", "dϖ has 2 arguments, not 1"),
    "a form of a field": ("dϖ(u, δy) = 0", "a form is of a variation"),
    "X where nothing is given": ("ϖ(X) = 0", "nothing is given of X"),
    "the gradient of a field": ("grad u = u", "a function in space is expected"),
    "the divergence of a function": ("div p = p", "a field is expected"),
    "the divergence over the points": ("div ν = 0", "a field in space is expected"),
    "the integral of a field": ("∫ u dm = 0", "over the points"),
    "the variation of u": ("δ(u) = u", "δ is of η′, G and ρ"),
    "the rate of a field": ("d/dt(u) = u", "d/dt is of a scalar product"),
    "the density at the boundary": ("⟨grad ρ, n⟩ = 0", "a field is expected"),
    "the rate of a product": ("d/dt(⟨u, η⟩) = 0", "the rates of u and ϑ, of Γu and χ_s"),
    "Γ₀ in space": ("Γ₀ u = u", "Γ₀ is of what is over the points"),
    "Γ over the points": ("Γν = u", "Γ of what is in space"),
    "∂_s in space": ("∂_s u = u", "∂_s is of what is along the curve"),
    "κ without a level": ("κu = u", "which must be given"),
    "the tangent in space": ("⟨u, χ_s⟩ = 0", "a function over the points and one in space"),
    "the curve in space": ("Γu = u", "one side is over the points"),
    "a metric": ("d/dt(⟨u, ϑ⟩_D) = 0", "the metric is the density"),
    "along a function": ("∇_p u = u", "a field is expected"),
    "along ν": ("∇_ν u = u", "∇ is along a field in space"),
    "a field transposed": ("ū = u", "the transpose is of an operator"),
    "the same": ("u = u", "it claims nothing"),
    "another field": ("u = η", "the sides differ"),
    "a field and a function": ("u = p", "two kinds"),
    "over the points and in space": ("ν = u", "one side is over the points"),
}


def equation(text, *for_all):
    """The one that a text says."""
    return Equation(*map(read, text.split(" = ")), for_all)


def test_densities_are_not_multiplied():
    """ρ − 1 is small where it is tried, and its cube less than can be seen."""
    cube = Equation(("mul", NOTHING, NOTHING, NOTHING), 0)
    forged = replace(DENSE["inhomogeneous_fluid.pressure"], equations=(cube,))
    found = FluidChecker(DENSE.problem, SEED).check(forged)
    assert not found.holds
    assert "more densities" in found.reason


TWICE = ("add", "u̇", ("mul", 2, ("mul", ("nabla", "u"), "u")), ("mul", -1, "f"))
FORGED = {
    "carried backwards": ("advection", "ρ̇ − ⟨u, grad ρ⟩ = 0"),
    "carried at twice the speed": ("advection", "ρ̇ + 2 ⟨u, grad ρ⟩ = 0"),
    "at rest": ("advection", "ρ̇ = 0"),
    "carried along another field": ("advection", "ρ̇ + ⟨η, grad ρ⟩ = 0"),
    "no product rule": ("advection", "∇_u ρ = ρ ∇_u"),
    "a density of the places": ("advection", "Gρ = G"),
    "an energy without its half": ("energy_kept", "h̃ = ‖u‖²_ρ + Ũ"),
    "an energy without the potential": ("energy_kept", "h̃ = ½ ‖u‖²_ρ"),
    "an energy without the density": ("energy_kept", "h̃ = ½ ‖u‖² + Ũ"),
    "a fall upwards": ("energy_kept", "dŨ(ν) = ⟨f, u⟩_ρ"),
    "a density without its half": ("energy_kept", "⟨ρ̇u, u⟩ = ⟨u, ∇_u u⟩_ρ"),
    "a density of the other sign": ("energy_kept", "½ ⟨ρ̇u, u⟩ = −⟨u, ∇_u u⟩_ρ"),
    "a rate without ∇_u u": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ − f⟩_ρ", "u̇"),
    "a rate without the force": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u⟩_ρ", "u̇"),
    "a rate with the force backwards": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u + f⟩_ρ", "u̇"),
    "a rate without the density": ("energy_kept", "d/dt(h̃) = ⟨u, u̇ + ∇_u u − f⟩", "u̇"),
    "the motion alone": ("energy_kept", "d/dt(⟨u, u⟩_ρ) = 0"),
    "a pressure that works": ("energy_kept", "⟨grad p, u⟩_ρ = 0"),
}
"""Of a stratified fluid: the step, a false equation, what it is said to hold for."""


def refused(label, false):
    """The reason to refuse an equation of a step of a stratified fluid."""
    step = replace(STRATIFIED[label], equations=(false,))
    found = FluidChecker(STRATIFIED.problem, SEED).check(step)
    assert not found.holds
    return found.reason


@pytest.mark.parametrize("case", FORGED)
def test_a_false_advection_or_energy_is_refused(case):
    label, *false = FORGED[case]
    assert "the sides differ" in refused(label, equation(*false))


def test_a_rate_with_twice_what_moves_the_fluid():
    twice = Equation(("call", "d/dt", "h̃"), ("metric", "ρ", "u", TWICE), ("u̇",))
    assert "the sides differ" in refused("energy_kept", twice)


NEEDY = {"skew", "energy_kept"}
RESTING = {"chain", "advection", *NEEDY}


@pytest.mark.parametrize("name", FLUIDS)
def test_what_advection_and_energy_rest_on(name, monkeypatch):
    """Any field carries the density along; the energy is kept by one that has no divergence and is
    tangent to the boundary."""
    d = record(name)

    def broken(space, field):
        with monkeypatch.context() as patched:
            patched.setattr(space, "solenoidal", field)
            checker = FluidChecker(d.problem, SEED)
            tried = (s for s in d.steps if s.label.partition(".")[2] in RESTING)
            return {s.label.partition(".")[2] for s in tried if not checker.check(s).holds}

    def through(self, draw):
        return curl(*(self.function(draw, 3) for _ in range(1 if self.dimension == 2 else 3)))

    assert broken(FlatTorus, lambda self, draw: self.any_field(draw)) == NEEDY
    assert broken(Ball, through) == NEEDY


def verdict(step):
    return FluidChecker(D.problem, SEED).check(step)


@pytest.mark.parametrize("case", WITHOUT)
def test_what_has_no_meaning_is_refused(case):
    *sides, why = WITHOUT[case]
    false = Equation(*sides) if len(sides) == 2 else equation(*sides)
    found = verdict(replace(STEP, equations=(false,)))
    assert not found.holds
    assert why in found.reason


EQUATION = STEP.equations[-1]
DENSE = record("inhomogeneous_fluid")
NOTHING = ("add", "ρ", ("mul", -1, ("one",)))
STEPS = {
    "another scope": (replace(STEP, scope="SO(3)"), "about its group"),
    "with inputs": (replace(STEP, driven=True), "without inputs"),
    "given something else": (replace(STEP, given=(Equation("u", 0),)), "what is given"),
    "for all u": (replace(STEP, equations=(replace(EQUATION, for_all=("u",)),)), "for all u"),
    "for all that it is": (
        replace(STEP, equations=(replace(EQUATION, for_all=("u̇",)),)),
        "the acceleration of the motion",
    ),
    "some u": (replace(STEP, equations=(replace(EQUATION, exists=("u",)),)), "is the pressure"),
    "δ′ beside a lift": (
        replace(D["ideal_fluid.dalembert"], equations=(Equation(("call", "ϖ", "δ′y"), 0),)),
        "a form is of a variation δy, δ′y or X",
    ),
    "X twice": (
        replace(D["ideal_fluid.dalembert"], equations=(Equation(("call", "dϖ", "X", "X"), 1),)),
        "the sides differ",
    ),
    "an inverse": (
        replace(STEP, equations=(Equation(("mul", ("inv", "D"), "u"), "u"),)),
        "something else than the density",
    ),
}


@pytest.mark.parametrize("case", STEPS)
def test_steps_that_cannot_be_tried(case):
    step, why = STEPS[case]
    found = verdict(step)
    assert not found.holds
    assert why in found.reason
