"""The Poisson tensor of reduced equations, from the matrices of the group.

    {Π_a, Π_b} = ε⟨Π, [E_b, E_a]⟩,  {g_ij, Π_b} = (gE_b)_ij or (E_b g)_ij,
    {Γ_i, Π_b} = −ε(ρ(E_b)Γ)_i,  {g_ij, g_kl} = {Γ_i, Γ_j} = 0

with ε = 1 and gE_b where Z = g⁻¹ġ, ε = −1 and E_b g where Z = ġg⁻¹.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from ...algebra.groups import Group
from ...algebra.residue_vectors import residue_of
from ...language.tree import Tree
from ...record.record import RecordError
from .constant_entries import constant_entries
from .rational_values import Value

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
                if form := {k: c for k, c in self._moved(x, b).items() if c}:
                    self.forms[i, j] = form
                    if i >= group.dimension:
                        self.forms[j, i] = {k: -c for k, c in form.items()}

    def _moved(self, x: Tree, b: int) -> Linear:
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
            i, j = x[2] - 1, x[3] - 1
            for k in range(self.group.size):
                if self.left:
                    self._add(found, ("entry", "A", i + 1, k + 1), e[k][j])
                else:
                    self._add(found, ("entry", "A", k + 1, j + 1), e[i][k])
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

    def at(self, x: Sequence[Value], p: int) -> dict[tuple[int, int], Value]:
        """The entries Λ_ij = {x_i, x_j}, those that do not vanish for all x, modulo p at values of
        the variables."""
        found = {}
        for ij, form in self.forms.items():
            terms = ((1 if k is None else x[k]) * residue_of(c, p) for k, c in form.items())
            total = sum(terms, 0)
            found[ij] = total % p if isinstance(total, int) else total
        return found
