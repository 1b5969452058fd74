"""The reduced equations of a record, read from its steps, and their Poisson tensor."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

from ...algebra.groups import Group
from ...language import rational as q
from ...language.show import show
from ...language.tree import Tree, nodes, replaced
from ...record.record import Derivation, RecordError, Step
from ...record.sentence import Claim
from ..trials.trial_points import group_of
from ..values.arithmetic import Varying
from ..values.residue import Residue, random_prime
from .entries_checked import constant_entries, entries_moved
from .spectra_and_residues import Value, drawn, gradient, is_parameter, residues, value
from .symmetry_count import SymmetryCount

# The reduced equations of a record, read from its steps: variables, rates, energy, Casimirs and
# integrals; and exact points of theirs modulo a large prime.

VARIABLE = {"Π̇": "Π", "Ȧ": "A", "Γ̇": "Γ"}
"""The variable that each rate is of."""


class ReducedSystem:
    """The ``variables`` of the equations, momenta first, their ``rates`` and the ``energy`` as
    trees, the ``casimirs`` and the ``integrals``, the energy first; ``tensor``: their brackets."""

    def __init__(self, d: Derivation, group: Group, random: Random):
        try:
            energy, *rates = d["poisson"].equations
        except (KeyError, ValueError):
            raise RecordError("no reduced equations: the step poisson is missing") from None
        self.record, self.group, self.random = d, group, random
        self.energy = energy.rhs
        self.variables: tuple[Tree, ...] = tuple(_variable(e.lhs) for e in rates)
        self.rates = tuple(e.rhs for e in rates)
        self.casimirs, self.integrals = (
            rates_of(d[x]) if {x, f"{d.name}.{x}"} & {s.label for s in d.steps} else ()
            for x in ("casimirs", "first_integrals")
        )
        self.conditions = [
            step
            for step in d.steps
            if any(x.kind in ("condition.one", "condition.several") for x in step.claims)
        ]
        self.claims = [x for step in d.steps for x in step.claims]
        if self.momenta != group.dimension:
            raise RecordError(f"{self.momenta} momenta of {group.dimension}")
        self.tensor = PoissonTensor(d.problem, group, self.variables)

    @property
    def momenta(self) -> int:
        """How many of the variables are momenta."""
        return sum(x[1] == "Π" for x in self.variables if isinstance(x, tuple))

    @cached_property
    def parameters(self) -> list[Tree]:
        """The parameters in the equations, and π."""
        trees = (self.energy, *self.rates, *self.casimirs, *self.integrals)
        found = (x for t in trees for x in nodes(t) if is_parameter(x))
        return [*dict.fromkeys(found)]

    def with_numbers(self, numbers: Mapping[Tree, Fraction]) -> ReducedSystem:
        """The same with numbers for some letters."""
        found = ReducedSystem(self.record, self.group, self.random)
        found.energy = substituted(self.energy, numbers)
        found.rates, found.casimirs, found.integrals = (
            tuple(substituted(t, numbers) for t in trees)
            for trees in (self.rates, self.casimirs, self.integrals)
        )
        return found

    # -- points --------------------------------------------------------------------------------

    @cached_property
    def prime(self) -> int:
        """A prime of 256 bits: numbers that differ have other residues."""
        return random_prime(self.random)

    def place(
        self, level: Tree | None = None, values: Iterable[tuple[Tree, Tree]] = ()
    ) -> ResiduePoint:
        """A random point; on the ``level`` where a polynomial vanishes; with these ``values`` of
        some parameters."""
        p = self.prime
        letters = (*self.parameters, *self.variables)
        at = drawn(letters, self.random, p)
        for letter, t in values:
            at[letter] = value(t, at, p)
        found = ResiduePoint(self, at)
        return found if level is None else found.on(level)

    @cached_property
    def anywhere(self) -> ResiduePoint:
        """A random point, the same for all claims."""
        return self.place()

    @cached_property
    def fault(self) -> str:
        """Why these are no Hamiltonian equations of the energy with these Casimirs and integrals;
        "" where they are."""
        if len({*self.variables}) != len(self.variables):
            return "a variable has two rates"
        here = self.anywhere
        if here.field(self.energy) != [value(x, here.at, here.p) for x in self.rates]:
            return "the rates are not the brackets with the energy"
        if any(any(here.field(x)) for x in self.casimirs):
            return "a polynomial is no Casimir"
        if any(here.bracket(x, self.energy) for x in self.integrals):
            return "a polynomial is no integral, as a function of all variables"
        if self.integrals[:1] not in ((), (self.energy,)):
            return "the first of the integrals is not the energy"
        return ""


@dataclass(frozen=True)
class ResiduePoint:
    """Values of the variables and the parameters of a system, modulo a large prime."""

    system: ReducedSystem
    at: Mapping[Tree, Residue]

    @property
    def p(self) -> int:
        """The prime."""
        return self.system.prime

    def on(self, level: Tree) -> ResiduePoint:
        """The point with another value of the first variable in which a polynomial is linear, so
        that it vanishes; ``RecordError`` where there is none."""
        for x in self.system.variables:
            a, b, c = (value(level, {**self.at, x: Residue(k, self.p)}, self.p) for k in range(3))
            if a - 2 * b + c == 0 and b != a:
                return ResiduePoint(self.system, {**self.at, x: -a / (b - a)})
        raise RecordError(f"no point is known where {show(level)[:80]} vanishes")

    @cached_property
    def _varied(self) -> dict[Tree, Value]:
        variables = self.system.variables
        pairs = zip(variables, q.identity(len(variables)), strict=True)
        return {**self.at} | {x: Varying(self.at[x], unit) for x, unit in pairs}

    @cached_property
    def _gradients(self) -> dict[Tree, list[Value]]:
        return {}

    def gradient(self, f: Tree) -> list[Value]:
        """The derivatives of a polynomial by the variables."""
        if f not in self._gradients:
            varied = value(f, self._varied, self.p)
            self._gradients[f] = gradient(varied, len(self.system.variables))
        return self._gradients[f]

    @cached_property
    def tensor(self) -> dict[tuple[int, int], Value]:
        """Λ, by its entries."""
        return self.system.tensor.at([self.at[x] for x in self.system.variables])

    def field(self, f: Tree) -> list[Value]:
        """The Hamiltonian vector field Λ dF: the rates {x_i, F}."""
        slopes, found = self.gradient(f), [Residue(0, self.p) for _ in self.system.variables]
        for (i, j), c in self.tensor.items():
            found[i] += c * slopes[j]
        return found

    def bracket(self, f: Tree, g: Tree) -> Value:
        """{F, G}."""
        return q.dot(self.gradient(f), self.field(g))

    @cached_property
    def poisson_rank(self) -> int:
        """The rank of Λ."""
        span = range(len(self.system.variables))
        return self._rank([[self.tensor.get((i, j), 0) for j in span] for i in span])

    def rank(self, f: Sequence[Tree]) -> int:
        """How many of some polynomials are independent of each other."""
        return self._rank([self.gradient(x) for x in f])

    def rank_on_leaves(self, f: Sequence[Tree]) -> int:
        """How many are independent of each other and of all Casimirs: as many as their fields."""
        return self._rank([self.field(x) for x in f])

    def _rank(self, rows: Sequence[Sequence[Value]]) -> int:
        return q.rank(residues(rows, self.p))


def substituted(t: Tree, numbers: Mapping[Tree, Fraction]) -> Tree:
    """A tree with numbers for letters."""
    for x, y in numbers.items():
        t = replaced(t, x, y)
    return t


def _variable(rate: Tree) -> Tree:
    """The variable that has a rate; ``RecordError`` for what is no rate."""
    if not isinstance(rate, tuple) or str(rate[1]) not in VARIABLE:
        raise RecordError("the step poisson has an equation that is no rate")
    return (rate[0], VARIABLE[str(rate[1])], *rate[2:])


def rates_of(step: Step) -> tuple[Tree, ...]:
    """The polynomials whose rates the equations of a step are."""
    return tuple(e.lhs[2] for e in step.equations if isinstance(e.lhs, tuple) and len(e.lhs) == 3)


# The Poisson tensor of reduced equations, from the matrices of the group.
#
# {Π_a, Π_b} = ε⟨Π, [E_b, E_a]⟩,  {g_ij, Π_b} = (gE_b)_ij or (E_b g)_ij,
# {Γ_i, Π_b} = −ε(ρ(E_b)Γ)_i,  {g_ij, g_kl} = {Γ_i, Γ_j} = 0
#
# with ε = 1 and gE_b where Z = g⁻¹ġ, ε = −1 and E_b g where Z = ġg⁻¹.

Linear = dict[int | None, Fraction]
"""A linear form by the numbers of the variables in it, ``None`` for the constant."""


class PoissonTensor:
    """The brackets of the ``variables`` of reduced equations on the dual of a group's algebra;
    ``RecordError`` where they are no linear forms in the variables."""

    def __init__(self, problem: Mapping[str, Any], group: Group, variables: Sequence[Tree]):
        self.group, self.variables = group, variables
        self.left = problem["lagrangian"]["trivialisation"] == "left"
        self.carried = sum(x["size"] for x in problem.get("advected", ()))
        self.place = {x: k for k, x in enumerate(variables)}
        self.forms: dict[tuple[int, int], Linear] = {}
        for x, i in self.place.items():
            for b in range(group.dimension):
                j = self.place["at", "Π", b + 1]
                if form := {k: c for k, c in self._bracket_with_momentum(x, b).items() if c}:
                    self.forms[i, j] = form
                    if i >= group.dimension:
                        self.forms[j, i] = {k: -c for k, c in form.items()}

    def _bracket_with_momentum(self, x: Tree, b: int) -> Linear:
        """{x, Π_b}."""
        sign = 1 if self.left else -1
        assert isinstance(x, tuple)
        e, found = self.group.basis[b], Linear()
        if x[1] == "Π":
            for k, c in enumerate(self.group.structure_constants[b][x[2] - 1]):
                found[self.place["at", "Π", k + 1]] = sign * c
        elif x[1] == "Γ":
            first = self.group.n - self.carried
            for j, c in enumerate(e[first + x[2] - 1][first:], 1):
                self._add(found, ("entry", "Γ", j), -sign * c)
        else:
            moved = entries_moved(e, (x[2] - 1, x[3] - 1), left=self.left)
            for (i, j), c in moved.items():
                self._add(found, ("entry", "A", i + 1, j + 1), c)
        return found

    def _add(self, form: Linear, x: tuple[Any, ...], c: Fraction) -> None:
        """Add a multiple of an entry to a linear form: of a variable, or of a constant."""
        if not c:
            return
        if x in self.place:
            form[self.place[x]] = c
            return
        _, letter, *place = x
        i, j = (k - 1 for k in place) if letter == "A" else (-1, -1)
        constant = self.constants.get((i, j))
        if constant is None:
            raise RecordError("the variables do not move among themselves")
        form[None] = form.get(None, Fraction(0)) + c * constant

    @cached_property
    def constants(self) -> dict[tuple[int, int], Fraction]:
        """The entries that are the same for all elements of the group."""
        return constant_entries(self.group)

    def at(self, x: Sequence[Value]) -> dict[tuple[int, int], Value]:
        """The entries Λ_ij = {x_i, x_j}, those that do not vanish for all x, at values of the
        variables."""
        return {
            ij: sum(((1 if k is None else x[k]) * c for k, c in form.items()), Fraction(0))
            for ij, form in self.forms.items()
        }


# What the claims of a record speak of, read once: its reduced equations, its symmetries.


class ClaimedRecord:
    """A record, and the random numbers with which its claims are tried."""

    def __init__(self, d: Derivation, seed: int | str):
        self.record, self.random = d, Random(f"{seed} claims")

    @cached_property
    def reduced(self) -> ReducedSystem:
        """The Lie–Poisson equations of the record; ``RecordError`` where it has none."""
        return ReducedSystem(self.record, self.group, self.random)

    @cached_property
    def group(self) -> Group:
        """The group of the problem; ``RecordError`` where it has none."""
        group = group_of(self.record.problem)
        if group is None:
            raise RecordError("the claim is of a group")
        return group

    @cached_property
    def symmetries(self) -> SymmetryCount:
        """The symmetries of its Lagrangian; ``KeyError`` where it has none of its own."""
        return SymmetryCount(self.record.problem, self.group, self.random)


Judge = Callable[[ClaimedRecord, Step, Claim], str]
"""What is wrong with a claim of a step, in words; "" if nothing is."""
