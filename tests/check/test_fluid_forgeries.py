"""Statements about a fluid that have no meaning are refused, and it is said why."""

from dataclasses import replace
from fractions import Fraction

import pytest

from derive.check.fluid.ball import Ball, curl
from derive.check.fluid.flat_torus import Torus
from derive.check.fluid.fluid_checker import FluidChecker
from derive.record.record import Equation
from tests.support.walks import FLUIDS, SEED, record

D = record("ideal_fluid")
STRATIFIED = record("stratified_fluid")
STEP = D["ideal_fluid.pressure"]
WITHOUT = {
    "no name": (("add", "u", "foo"), "u", "no value for 'foo'"),
    "no operation": (("hat", "u"), "u", "has no meaning for fields"),
    "two kinds in a sum": (("add", "u", "p"), "u", "a sum of things of two kinds"),
    "two fields": (("mul", "u", "u"), "u", "these are not multiplied"),
    "a function as a factor": (("mul", "p", "u"), "u", "a function is no factor"),
    "no function": (("call", "foo", "u"), "u", "no function 'foo'"),
    "one argument": (("call", "dϖ", "δy"), 0, "dϖ has 2 arguments, not 1"),
    "a form of a field": (("call", "dϖ", "u", "δy"), 0, "a form is of a variation"),
    "X where nothing is given": (("call", "ϖ", "X"), 0, "nothing is given of X"),
    "the gradient of a field": (("call", "grad", "u"), "u", "a function in space is expected"),
    "the divergence of a function": (("call", "div", "p"), "p", "a field is expected"),
    "the divergence over the points": (("call", "div", "ν"), 0, "a field in space is expected"),
    "the integral of a field": (("call", "∫", "u"), 0, "over the points"),
    "the variation of u": (("call", "δ", "u"), "u", "δ is of η′, G and ρ"),
    "the rate of a field": (("call", "d/dt", "u"), "u", "d/dt is of a scalar product"),
    "the gradient of the density at the boundary": (
        ("inner", ("call", "grad", "ρ"), "n"),
        0,
        "a field is expected",
    ),
    "the rate of a product": (
        ("call", "d/dt", ("inner", "u", "η")),
        0,
        "the rates of u and ϑ, of Γu and γ_s",
    ),
    "Γ₀ in space": (("mul", "Γ_0", "u"), "u", "Γ₀ is of what is over the points"),
    "Γ over the points": (("mul", "Γ", "ν"), "u", "Γ of what is in space"),
    "∂_s in space": (("mul", "∂_s", "u"), "u", "∂_s is of what is along the curve"),
    "κ without a level": (("mul", "κ", "u"), "u", "which must be given"),
    "the tangent in space": (
        ("inner", "u", "γ_s"),
        0,
        "a function over the points and one in space",
    ),
    "the curve in space": (("mul", "Γ", "u"), "u", "one side is over the points"),
    "a metric": (("call", "d/dt", ("metric", "D", "u", "ϑ")), 0, "the metric is the density"),
    "along a function": (("mul", ("nabla", "p"), "u"), "u", "a field is expected"),
    "along ν": (("mul", ("nabla", "ν"), "u"), "u", "∇ is along a field in space"),
    "a field transposed": (("T", "u"), "u", "the transpose is of an operator"),
    "the same": ("u", "u", "it claims nothing"),
    "another field": ("u", "η", "the sides differ"),
    "a field and a function": ("u", "p", "two kinds"),
    "over the points and in space": ("ν", "u", "one side is over the points"),
}


def test_densities_are_not_multiplied():
    """ρ − 1 is small where it is tried, and its cube less than can be seen."""
    cube = Equation(("mul", NOTHING, NOTHING, NOTHING), 0)
    forged = replace(DENSE["inhomogeneous_fluid.pressure"], equations=(cube,))
    found = FluidChecker(DENSE.problem, SEED).check(forged)
    assert not found.holds
    assert "more densities" in found.reason


HALF = Fraction(1, 2)
SLOPE = ("inner", "u", ("call", "grad", "ρ"))
ALONG = ("nabla", "u")
BEND = ("mul", ALONG, "u")
RATE = ("call", "d/dt", "h̃")
FALL = ("mul", -1, "f")


def power(*summed, metric=("metric", "ρ")):
    """⟨u, Σ⟩_ρ, or without the density."""
    return (*metric, "u", ("add", *summed))


FORGED = {
    "carried backwards": ("advection", ("add", "ρ̇", ("mul", -1, SLOPE)), 0),
    "carried at twice the speed": ("advection", ("add", "ρ̇", ("mul", 2, SLOPE)), 0),
    "at rest": ("advection", "ρ̇", 0),
    "carried along another field": ("advection", ("add", "ρ̇", ("inner", "η", SLOPE[2])), 0),
    "no product rule": ("advection", ("mul", ALONG, "ρ"), ("mul", "ρ", ALONG)),
    "a density of the places": ("advection", ("mul", "G", "ρ"), "G"),
    "an energy without its half": (
        "energy_kept",
        "h̃",
        ("add", ("norm2", "ρ", "u"), "Ũ"),
    ),
    "an energy without the potential": ("energy_kept", "h̃", ("mul", HALF, ("norm2", "ρ", "u"))),
    "an energy without the density": (
        "energy_kept",
        "h̃",
        ("add", ("mul", HALF, ("norm2", "u")), "Ũ"),
    ),
    "a fall upwards": ("energy_kept", ("call", "dŨ", "ν"), ("metric", "ρ", "f", "u")),
    "a change of the density without its half": (
        "energy_kept",
        ("inner", ("mul", "ρ̇", "u"), "u"),
        ("metric", "ρ", "u", BEND),
    ),
    "a change of the density of the other sign": (
        "energy_kept",
        ("mul", HALF, ("inner", ("mul", "ρ̇", "u"), "u")),
        ("mul", -1, ("metric", "ρ", "u", BEND)),
    ),
    "a rate without ∇_u u": ("energy_kept", RATE, power("u̇", FALL), ("u̇",)),
    "a rate with twice ∇_u u": (
        "energy_kept",
        RATE,
        power("u̇", ("mul", 2, BEND), FALL),
        ("u̇",),
    ),
    "a rate without the force": ("energy_kept", RATE, power("u̇", BEND), ("u̇",)),
    "a rate with the force backwards": ("energy_kept", RATE, power("u̇", BEND, "f"), ("u̇",)),
    "a rate without the density": (
        "energy_kept",
        RATE,
        power("u̇", BEND, FALL, metric=("inner",)),
        ("u̇",),
    ),
    "the motion alone": ("energy_kept", ("call", "d/dt", ("metric", "ρ", "u", "u")), 0),
    "a pressure that works": ("energy_kept", ("metric", "ρ", ("call", "grad", "p"), "u"), 0),
}
"""Of a stratified fluid: the step, the sides of a false equation, what it is said to hold for."""


@pytest.mark.parametrize("case", FORGED)
def test_a_false_advection_or_energy_is_refused(case):
    label, left, right, *for_all = FORGED[case]
    step = STRATIFIED[label]
    found = FluidChecker(STRATIFIED.problem, SEED).check(
        replace(step, equations=(Equation(left, right, *for_all),))
    )
    assert not found.holds
    assert "the sides differ" in found.reason


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

    assert broken(Torus, lambda self, draw: self.any_field(draw)) == NEEDY
    assert broken(Ball, through) == NEEDY


def verdict(step):
    return FluidChecker(D.problem, SEED).check(step)


@pytest.mark.parametrize("case", WITHOUT)
def test_what_has_no_meaning_is_refused(case):
    left, right, why = WITHOUT[case]
    found = verdict(replace(STEP, equations=(Equation(left, right),)))
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
