"""The mapping from names to exact values that an environment reads."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Generic, TypeVar

Values = dict[str, Any]
M = TypeVar("M")


class NameValues(Mapping[str, Any], Generic[M]):
    """The mapping from names to values at a model; ``groups`` of them are computed in turn when a
    name is first asked for that no earlier group has; an earlier group's value stands."""

    def __init__(self, model: M, groups: Sequence[Callable[[M], Values]]):
        self.model = model
        self.known: Values = {}
        self.pending = [*groups]

    def __getitem__(self, name: str) -> Any:
        while name not in self.known and self.pending:
            self._compute_next()
        return self.known[name]

    def _compute_next(self) -> None:
        self.known = self.pending[0](self.model) | self.known
        del self.pending[0]

    def __iter__(self) -> Iterator[str]:
        while self.pending:
            self._compute_next()
        return iter(self.known)

    def __len__(self) -> int:
        return len([*self])
