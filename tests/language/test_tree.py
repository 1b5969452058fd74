"""Trees are gone through in one way."""

from fractions import Fraction

from derive.language.tree import fold, names, nodes, operands, terms

T = ("add", ("mul", 2, ("par", "k"), ("fun", "sin", "x")), ("pow", ("at", "r", 1), 3), "y")


def test_what_is_a_tree_in_a_tree():
    """Neither the name of a parameter or a function, nor an exponent."""
    assert operands(("par", "k")) == operands("x") == operands(Fraction(1, 2)) == ()
    assert operands(("fun", "sin", "x")) == ("x",)
    assert operands(("pow", "x", 3)) == ("x",)
    assert operands(("div", "x", 3)) == ("x", 3)
    assert terms(T) == T[1:]
    assert terms("x") == ("x",)


def test_a_fold_goes_from_the_leaves_up():
    @fold
    def depth(t, *below):
        return 1 + max(below, default=0)

    @fold
    def size(t, *below):
        return 1 + sum(below)

    assert depth(T) == 4
    assert size(T) == len(nodes(T)) == 11
    assert [*names(T)] == ["x", "r", "y"]
