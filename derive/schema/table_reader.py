"""The values under keys, as files and records both have them: of the right type, or one line.

Each method that is named by a type of a key (:class:`Key`) reads one.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, ClassVar, TypeVar

from ..language.limits import HYPERVISCOSITY, MAGNITUDE, SAMPLES, TEXT, TORUS
from ..language.reserved import COLUMNS, WORDS, numbers_of_input, taken
from ..language.tree import Tree
from .force_kinds import Acting, Input
from .kind import Parameter
from .motion_kinds import Output
from .table import Rows, Slot, Table, hint, nearest

UNIT = re.compile(r"[\w^*/.·°%⁰¹²³⁴-⁹⁻ -]{0,30}")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
LONGEST = 16
"""The most entries of a vector whose length is not known."""
T = TypeVar("T", bound=Table)


class TableReader(ABC):
    """What files and records have in common.

    ``last``: points are numbered from 1 to this; ``count``: how many have a mass; ``blocks``: how
    many blocks the group has; ``timed``: do the expressions of the table know the time?
    """

    error: ClassVar[type[Exception]]
    numbered: ClassVar[str] = "points"
    last: int = 0
    count: int = 0
    blocks: int = 1
    timed: bool = False

    @abstractmethod
    def names(self, own: type[Table]) -> tuple[str, ...]:
        """The keys that a table may have."""

    @abstractmethod
    def has(self, slot: Slot) -> bool:
        """Does a table say a key that has a default?"""

    @abstractmethod
    def meets(self, need: str, kind: str, where: str) -> None:
        """Refuse a kind where the problem is not what it needs."""

    # -- whole tables --------------------------------------------------------------------------

    def one_of(self, kinds: Mapping[str, type[T]], table: Any, where: str, key: str = "kind") -> T:
        """A table of one of several kinds, which it says under a key."""
        own = kinds[self.choice(Slot(table, key, where), tuple(kinds))]
        return self.typed(own, {("kind" if x == key else x): v for x, v in table.items()}, where)

    def typed(self, own: type[T], table: Any, where: str) -> T:
        """A table and no key that has no meaning in it."""
        if not isinstance(table, dict):
            raise self.fail(f"{where}: expected a table of {', '.join(self.names(own))}")
        self.known(table, {*self.names(own), *(["kind"] if own.kind else [])}, where)
        return own.read(table, where, self)

    def known(self, table: Mapping[str, Any], keys: Collection[str], where: str) -> None:
        """Refuse a key that has no meaning, with the nearest that has one."""
        for key in table:
            if key not in keys:
                told = f"{hint(key, keys, table)} (known: {', '.join(sorted(keys))})"
                raise self.fail(f"{where}: unknown key {key[:40]!r}{told}")

    def parameter(self, name: str, about: Any) -> Parameter:
        """A parameter, by a name that means nothing else."""
        where = f"parameter {name[:40]!r}"
        self.identifier(name, where)
        self.not_taken(name, where)
        return self.typed(Parameter, about, where)

    def not_taken(self, name: str, where: str) -> None:
        """Refuse a name that means something else in an expression."""
        if what := taken(name):
            raise self.fail(f"{where}: this is {what} in an expression; choose another name")

    def distinct(self, inputs: Sequence[Input], parameters: Collection[str]) -> None:
        """No two inputs of one name, and none with the name of a parameter, nor its numbers."""
        names = [x.name for x in inputs]
        for k, name in enumerate(names, 1):
            if name in names[: k - 1]:
                raise self.fail(f"input {k}: a second input {name!r}; give each its own name")
            if name in parameters:
                raise self.fail(f"input {k}: {name!r} is a parameter as well; choose another name")
            if name in numbers_of_input(inputs[k - 1].plain(), 2):
                self.not_taken(name, f"input {k}, {name!r}")
            if clash := next((x for x in parameters if _numbers_of(x, name)), None):
                told = f"{clash!r} is one of its numbers, and a parameter as well"
                raise self.fail(f"input {k}, {name!r}: {told}; choose another name")

    def distinct_outputs(
        self,
        outputs: Sequence[Output],
        inputs: Sequence[Input],
        parameters: Collection[str],
        forces: Sequence[Acting],
    ) -> None:
        """No output, and no force of the state, has the name of another, of a parameter or an
        input, nor of a number of these."""
        known = dict.fromkeys(COLUMNS, "a column of runs")
        known |= dict.fromkeys(parameters, "a parameter")
        known |= {x.name: "an input" for x in inputs}
        listed = [(f"force {k}", x.name, "a force") for k, x in enumerate(forces, 1) if x.name]
        listed += [(f"output {k}", x.name, "another output") for k, x in enumerate(outputs, 1)]
        for where, name, role in listed:
            self.not_taken(name, f"{where}, {name!r}")
            for other, what in known.items():
                if name == other or _numbers_of(name, other) or _numbers_of(other, name):
                    raise self.fail(
                        f"{where}, {name!r}: {other!r} is {what} as well; choose another name"
                    )
            known[name] = role

    def table(self, slot: Slot) -> Any:
        """Another table."""
        return self.typed(slot.about.own, self.value(slot), slot.path)

    def tables(self, slot: Slot) -> tuple[Any, ...]:
        """Others, each called by its number."""
        listed = enumerate(self.value(slot, list), 1)
        return tuple(self.typed(slot.about.own, x, f"{slot.key[:-1]} {k}") for k, x in listed)

    # -- what is in them -----------------------------------------------------------------------

    def fail(self, message: str) -> Exception:
        """The error of a file, or of a record."""
        return self.error(message)

    def value(self, slot: Slot, kind: type = object) -> Any:
        """What stands under a key, which must be there, and of a type."""
        if not isinstance(slot.table, dict):
            raise self.fail(f"{slot.where}: expected a table")
        if slot.key not in slot.table:
            raise self.fail(f"{slot.where}: key {slot.key!r} is missing")
        value = slot.table[slot.key]
        if not isinstance(value, kind):
            known = {str: "a string", list: "a list", dict: "a table", bool: "true or false"}
            raise self.fail(f"{slot.where}: key {slot.key!r} must be {known[kind]}")
        return value

    def text(self, slot: Slot) -> str:
        """A string that is not too long."""
        value = str(self.value(slot, str))
        if len(value) > TEXT:
            raise self.fail(f"{slot.where}: key {slot.key!r} is longer than {TEXT} letters")
        return value

    def choice(self, slot: Slot, allowed: tuple[str, ...]) -> str:
        """One of a few strings."""
        if isinstance(slot.table, dict) and slot.key not in slot.table:
            told = f"key {slot.key!r} is missing; it is one of {', '.join(allowed)}"
            raise self.fail(f"{slot.where}: {told}")
        value = self.value(slot)
        if value not in allowed:
            near = hint(self.text(slot), allowed) if isinstance(value, str) else ""
            told = f"{', '.join(allowed)}{near}"
            raise self.fail(f"{slot.where}: key {slot.key!r} must be one of {told}")
        return str(value)

    def word(self, slot: Slot) -> str:
        """One of those that the key may have."""
        return self.choice(slot, slot.about.words)

    def flag(self, slot: Slot) -> bool:
        """True or false."""
        return bool(self.value(slot, bool))

    def unit(self, slot: Slot) -> str:
        """A unit, which may stand at the head of a column."""
        found = self.text(slot)
        if not UNIT.fullmatch(found):
            raise self.fail(
                f"{slot.path}: letters, digits and ^ * / . - only, as m/s^2; at most 30"
            )
        return found

    def name(self, slot: Slot) -> str:
        """A name that every emitted language can take."""
        return self.identifier(self.text(slot), slot.path)

    def identifier(self, name: str, where: str) -> str:
        """The same of a name itself."""
        if not NAME.fullmatch(name):
            raise self.fail(
                f"{where}: letters, digits and _ only, starting with a letter, at most 64"
            )
        if name in WORDS:
            raise self.fail(f"{where}: {name!r} is {WORDS[name]}; call it {name + '_'!r}, say")
        return name

    def input_names(self, slot: Slot) -> tuple[str, ...]:
        """Names of numbers, each its own."""
        listed = self.value(slot, list)
        if not 1 <= len(listed) <= LONGEST:
            raise self.fail(f"{slot.path}: expected a list of 1 to {LONGEST} names")
        found = [self.name(Slot({slot.key: x}, slot.key, slot.where)) for x in listed]
        for k, name in enumerate(found):
            known = "another input" if name in found[:k] else ""
            if what := known or self.meaning_of(name):
                raise self.fail(f"{slot.path}: {name!r} is {what} as well; choose another name")
        return tuple(found)

    @abstractmethod
    def meaning_of(self, name: str) -> str:
        """What a name is already in expressions of the state, in words; "" if nothing."""

    @abstractmethod
    def rate(self, slot: Slot) -> Rows:
        """A matrix of the size of the group, of expressions in its entries and the inputs."""

    def densities(self, slot: Slot) -> tuple[Tree, ...]:
        """An expression for each input."""
        return self.listed(self.value(slot), len(slot.found["inputs"]), slot.path)

    def number(self, slot: Slot) -> float | None:
        """A number that a double holds, or none."""
        value = self.value(slot)
        if value is None:
            return None
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.fail(f"{slot.where}: key {slot.key!r} must be a number")
        if not abs(value) <= MAGNITUDE:
            raise self.fail(
                f"{slot.where}: key {slot.key!r} must be a finite number, at most 1e300"
            )
        return float(value)

    def integer(self, value: Any, least: int, most: int, where: str) -> int:
        """An integer in a range."""
        if type(value) is not int or not least <= value <= most:
            raise self.fail(f"{where}: expected an integer from {least} to {most}")
        return value

    def odd(self, slot: Slot) -> int:
        """An odd number, the N of the torus."""
        found = self.integer(self.value(slot), 3, TORUS, slot.path)
        if found % 2 == 0:
            raise self.fail(f"{slot.path}: {found} is even; the basis of the torus has an odd N")
        return found

    def order(self, slot: Slot) -> int:
        """The power of a Laplacian."""
        return self.integer(self.value(slot), 0, HYPERVISCOSITY, slot.path)

    def block(self, slot: Slot) -> int:
        """The factor of a product, counted from 1; without a product there is one."""
        return self.integer(self.value(slot), 1, self.blocks, slot.path)

    turning = block

    def point(self, value: Any, where: str) -> int:
        """A point by its number."""
        if not self.last:
            raise self.fail(f"{where}: there are no {self.numbered} to number")
        return self.integer(value, 1, self.last, where)

    def pair(self, slot: Slot) -> tuple[int, int]:
        """Two points, in spaces of one dimension."""
        ends = self.value(slot)
        if not isinstance(ends, list) or len(ends) != 2:
            raise self.fail(f"{slot.where}: key {slot.key!r} must be two points")
        i, j = (self.point(x, slot.path) for x in ends)
        if i == j:
            raise self.fail(f"{slot.where}: key {slot.key!r} names one point twice")
        return i, j

    # -- expressions ---------------------------------------------------------------------------

    @abstractmethod
    def expression(self, value: Any, where: str) -> Tree:
        """An expression of the parameters; in a table that is ``timed`` of the time as well."""

    @abstractmethod
    def in_time(self, value: Any, where: str) -> Tree:
        """The same, of the time as well."""

    @abstractmethod
    def layered(self, slot: Slot) -> Tree:
        """A density."""

    def turned(self, value: Any, n: int, where: str) -> Rows:
        """A rotation of Rⁿ."""
        return self.rows(value, n, n, where)

    def scalar(self, slot: Slot) -> Tree:
        """An expression."""
        return self.expression(self.value(slot), slot.path)

    def listed(
        self,
        value: Any,
        n: int | None,
        where: str,
        one: Callable[[Any, str], Tree] | None = None,
    ) -> tuple[Tree, ...]:
        """A list of n expressions, or of a few."""
        if not isinstance(value, list) or not (n or 1) <= len(value) <= (n or LONGEST):
            example = "" if n else ', as ["T_3"]'
            raise self.fail(f"{where}: expected a list of {n or 'a few'} expressions{example}")
        return tuple((one or self.expression)(x, where) for x in value)

    def rows(
        self,
        value: Any,
        count: int,
        n: int,
        where: str,
        what: str = "rows",
        one: Callable[[Any, str], Tree] | None = None,
    ) -> Rows:
        """A list of lists."""
        if not isinstance(value, list) or len(value) != count:
            raise self.fail(f"{where}: expected a list of {count} {what}")
        return tuple(
            self.listed(row, n, f"{where}, {what[:-1]} {k}", one) for k, row in enumerate(value, 1)
        )

    @abstractmethod
    def space(self, slot: Slot) -> int:
        """The dimension of the space."""

    @abstractmethod
    def dimension(self, slot: Slot) -> int | None:
        """Of the space in which the vector under a key is; none where that is not known."""

    def quadric(self, slot: Slot) -> Rows:
        """A matrix of the size of the space."""
        n = self.space(slot)
        return self.rows(self.value(slot), n, n, slot.path)

    def vector(self, slot: Slot) -> tuple[Tree, ...]:
        """A vector of the space of the points."""
        return self.listed(self.value(slot), self.dimension(slot), slot.path)

    place = direction = couple = vector

    @abstractmethod
    def stated(self, slot: Slot) -> tuple[Tree, ...]:
        """A vector that is a function of the state."""

    @abstractmethod
    def observed(self, slot: Slot) -> tuple[Tree, ...]:
        """Expressions that are functions of the state."""

    def other_end(self, slot: Slot) -> int:
        """A point that is not the one whose distance it is."""
        name = "to" if "to" in slot.table else slot.key
        other = self.point(slot.table[name], f"{slot.where}, to")
        if other == slot.found["on"]:
            raise self.fail(f"{slot.where}, to: a point is at distance 0 from itself")
        return other

    def anchor(self, slot: Slot) -> tuple[Tree, ...]:
        """A point of the space in which another moves."""
        name = "to" if "to" in slot.table else slot.key
        return self.listed(slot.table[name], self.dimension(slot), f"{slot.where}, to")

    @abstractmethod
    def is_spring(self, k: int) -> bool:
        """Is this potential, from 1, a spring?"""

    def spring(self, slot: Slot) -> int:
        """A spring by the number of its potential."""
        k = self.value(slot)
        if type(k) is not int or not self.is_spring(k):
            raise self.fail(f"{slot.path}: expected the number of a [[potential]] that is a spring")
        return k

    @abstractmethod
    def acting_names(self) -> Collection[str]:
        """The names of what acts from outside; those of what has none."""

    def acting_name(self, slot: Slot) -> str | None:
        """What acts, by its name; nothing for all of it."""
        known, name = self.acting_names(), slot.table.get(slot.key)
        if name is not None and name not in known:
            near = nearest(str(name), known) or f"; what acts: {', '.join(known) or 'nothing'}"
            raise self.fail(f"{slot.path}: nothing acts by the name {name!r}{near}")
        return name

    @abstractmethod
    def stated_couple(self, slot: Slot) -> tuple[Tree, ...]:
        """A moment that is one."""

    @abstractmethod
    def stated_covector(self, slot: Slot) -> tuple[Tree, ...]:
        """A covector that is one."""

    def samples(self, slot: Slot) -> tuple[Tree, ...]:
        """As many expressions as there are, under the key of a file."""
        (key,) = slot.about.keys
        slot = slot._replace(key=key)
        listed = self.value(slot, list)
        if len(listed) > SAMPLES:
            raise self.fail(f"{slot.path}: more than {SAMPLES}; give them as a table, .csv")
        return self.listed(listed, len(listed) or None, slot.path)

    def charges(self, slot: Slot) -> tuple[Tree, ...]:
        """A number for each point."""
        if not self.count:
            raise self.fail(
                f"{slot.where}: key {slot.key!r} is for [[point]] tables, and there are none"
            )
        return self.listed(self.value(slot), self.count, slot.path)

    def rotation(self, slot: Slot) -> Rows:
        """One of the space of the points."""
        return self.turned(self.value(slot), self.space(slot), slot.path)

    def shift(self, slot: Slot) -> tuple[Tree, ...] | None:
        """A vector of R³, or none."""
        value = self.value(slot)
        return None if value is None else self.listed(value, 3, slot.path)

    def turn(self, slot: Slot) -> Rows | None:
        """A rotation of R³, or none."""
        value = self.value(slot)
        return None if value is None else self.turned(value, 3, slot.path)

    def length(self, slot: Slot) -> Tree:
        """An expression of what is positive."""
        return self.positive(self.scalar(slot), slot)

    def lengths(self, slot: Slot) -> tuple[Tree, ...]:
        """Three of these."""
        return tuple(self.positive(x, slot) for x in self.listed(self.value(slot), 3, slot.path))

    def positive(self, size: Tree, slot: Slot) -> Tree:
        """The same size, where it may be one."""
        del slot
        return size

    def corners(self, slot: Slot) -> Rows:
        """Those of a tetrahedron."""
        return self.rows(self.value(slot), 4, 3, slot.path, "points")


def _numbers_of(name: str, other: str) -> bool:
    """Is a name that of a number of another name, as F_2 of F?"""
    return bool(re.fullmatch(rf"{re.escape(other)}_[1-9][0-9]*", name))
