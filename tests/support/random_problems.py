"""Random problem files that are valid, as plain data: group, body, forces, by hypothesis."""

from hypothesis import strategies as st

FAMILIES = {
    **dict.fromkeys(("SO(2)", "SE(2)", "SL(2)", "SAff(2)", "GL(2)", "Aff(2)", "Sp(2)"), 2),
    **dict.fromkeys(("Sim(2)", "UT(2)", "U(1)"), 2),
    **dict.fromkeys(("SO(3)", "SE(3)", "SL(3)", "SAff(3)", "GL(3)", "Aff(3)", "Sim(3)"), 3),
    **{"UT(3)": 3, "SU(2)": 4},
}
"""And the dimension of the space that each moves points of."""
PRODUCTS = ("SO(2) x SO(2)", "SE(2) x SO(2)", "SO(3) x SE(3)", "SL(2) x GL(2)", "SE(2) x SE(3)")
PARAMETERS = {"a": 1.25, "b": 0.5, "k": 2.0, "mu": 0.75, "w": 1.5}

TURNING = ("SO(2)", "SE(2)", "SO(3)", "SE(3)")
MOVING = ("SE(3)", "SAff(3)", "Aff(3)", "Sim(3)")
"""Those whose linear parts are rotations, and those with all translations of R³."""

eighths = st.integers(-16, 16).map(lambda k: k / 8)
positive = st.integers(4, 16).map(lambda k: k / 8)
coefficient = st.one_of(
    positive, st.sampled_from(["k", "mu", "k*mu", "k + 1/3", "sqrt(2)*k", "mu^2/w"])
)
length = st.one_of(positive, st.sampled_from(["a", "b", "a*b", "a + b/2"]))
coordinate = st.one_of(
    eighths, eighths, st.sampled_from(["a", "-b", "a + 1/2", "b*a", "2 - a", "a^2"])
)
timed = st.sampled_from(["sin(w*t)", "a*t", "b*cos(2*t) + 1"])
driven = st.one_of(coefficient, coefficient, st.sampled_from(["k*(2 + sin(w*t))", "mu + t^2"]))


def vectors(n):
    """n expressions."""
    return st.lists(coordinate, min_size=n, max_size=n)


def moving(n):
    """n expressions, some of the time."""
    return st.lists(st.one_of(coordinate, coordinate, timed), min_size=n, max_size=n)


@st.composite
def points(draw, sizes):
    """Points, some more than the dimension, in every block."""
    found = []
    for block, n in enumerate(sizes, 1):
        for i in range(n + draw(st.integers(1, 2))):
            at = draw(vectors(n))
            if i < n:  # seldom all on one plane
                at[i] = draw(st.sampled_from([3, "3 + a", 2.5, "4*a"]))
            own = {"block": block} if len(sizes) > 1 else {}
            found.append({"mass": draw(length), "at": at, **own})
    return found


@st.composite
def energies(draw, count, sizes):
    """An expression of places, smooth everywhere."""
    places = [
        f"r{i}_{k}"
        for i, n in zip(range(1, count + 1), sizes, strict=True)
        for k in range(1, n + 1)
    ]
    place, named = st.sampled_from(places), st.sampled_from(["sin", "cos", "atan", "tanh"])

    def grown(inside):
        return st.one_of(
            st.tuples(inside, inside).map(lambda x: f"({x[0]} + {x[1]})"),
            st.tuples(inside, inside).map(lambda x: f"{x[0]}*{x[1]}"),
            st.tuples(inside, inside).map(lambda x: f"({x[0]} - k*{x[1]})"),
            st.tuples(inside, st.integers(2, 3)).map(lambda x: f"({x[0]})^{x[1]}"),
            st.tuples(named, inside).map(lambda x: f"{x[0]}({x[1]})"),
            inside.map(lambda x: f"sqrt(2 + ({x})^2)"),
            inside.map(lambda x: f"exp(-({x})^2/9)"),
            inside.map(lambda x: f"log(3 + ({x})^2)"),
            st.tuples(inside, inside).map(lambda x: f"{x[0]}/(3 + ({x[1]})^2)"),
        )

    leaf = st.one_of(place, place, place, st.sampled_from(["a", "2", "sin(w*t)", "0.5"]))
    return f"{draw(place)} * ({draw(st.recursive(leaf, grown, max_leaves=6))})/7"


def rotations(n):
    """A rotation of Rⁿ, as a file has it."""
    if n == 2:
        return st.sampled_from([[[0.6, -0.8], [0.8, 0.6]], [[0, 1], [-1, 0]]])
    axis = st.lists(st.integers(-2, 2), min_size=3, max_size=3).filter(any)
    angle = st.sampled_from(["pi/3", "pi/2", "a", "0.3", "-pi", "w/2"])
    turned = st.fixed_dictionaries({"axis": axis, "angle": angle})
    return st.one_of(turned, st.just([[0, 0, 1], [0.6, 0.8, 0], [-0.8, 0.6, 0]]))


@st.composite
def of_the_whole(draw, group, n, count):
    """Potentials of A and T, and one of charges on all points."""
    found = []
    if group in TURNING and draw(st.booleans()):
        rest = {"rest": draw(rotations(n))} if draw(st.booleans()) else {}
        found.append({"kind": "torsion", "stiffness": draw(driven), **rest})
    if group in MOVING and draw(st.booleans()):
        centre = [draw(st.sampled_from([9, "-8 - a"])), *draw(moving(3))[1:]]
        found.append({"kind": "far_centre", "strength": draw(driven), "centre": centre})
    if count and draw(st.booleans()):
        field = draw(moving(n))
        charges = draw(st.lists(coordinate, min_size=count, max_size=count))
        found.append({"kind": "field", "E": field, "charges": charges})
    return found


@st.composite
def forces(draw, data, sizes):
    """Potentials, damping and inputs on the points, or on places where there are none."""
    listed = data.get("point", [])
    blocks = [x.get("block", 1) for x in listed]
    potentials, inputs = [], []
    turning = {*data["group"].split(" x ")} <= {*TURNING}
    if len({*sizes}) == 1 and draw(st.booleans()):
        potentials.append({"kind": "gravity", "g": draw(moving(sizes[0]))})

    if len({*sizes}) == 1:
        potentials += draw(of_the_whole(data["group"], sizes[0], len(listed)))

    def end():
        if listed and draw(st.booleans()):
            i = draw(st.integers(1, len(listed)))
            return {"on": i}, sizes[blocks[i - 1] - 1]
        block = draw(st.integers(1, len(sizes)))
        own = {"block": block} if len(sizes) > 1 else {}
        return {"at": draw(vectors(sizes[block - 1])), **own}, sizes[block - 1]

    for _ in range(draw(st.integers(0, 2))):
        on, n = end()
        anchor = [*draw(moving(n))]
        anchor[0] = draw(st.sampled_from([7, "7 + a", -9]))
        spring = {"kind": "spring", **on, "anchor": anchor, "stiffness": draw(driven)}
        potentials.append(spring | ({"length": draw(length)} if draw(st.booleans()) else {}))
    if len(listed) > 1 and draw(st.booleans()):
        i, j = draw(st.lists(st.integers(1, len(listed)), min_size=2, max_size=2, unique=True))
        if sizes[blocks[i - 1] - 1] == sizes[blocks[j - 1] - 1]:
            quadratic = draw(st.booleans())
            more = {} if quadratic else {"length": draw(length)}
            potentials.append(
                {"kind": "spring", "between": [i, j], "stiffness": draw(driven), **more}
            )
    alone = listed and "solid" not in data
    if alone and len({*sizes}) == 1 and draw(st.integers(0, 3)) == 0:
        centre = [9, *draw(moving(sizes[0]))[1:]]
        potentials.append({"kind": "attraction", "strength": draw(driven), "centre": centre})
    if listed and draw(st.booleans()):
        U = draw(energies(len(listed), [sizes[b - 1] for b in blocks]))
        potentials.append({"kind": "expression", "U": U})
    if listed and draw(st.booleans()):
        on = draw(st.lists(st.integers(1, len(listed)), min_size=1, max_size=3, unique=True))
        data["damping"] = [{"coefficient": draw(coefficient), "on": on}]
    for k in range(draw(st.integers(0, 2))):
        frame = draw(st.sampled_from(["space", "body"]))
        at, n = end()
        along = {"direction": [1, *draw(vectors(n))[1:]]} if draw(st.booleans()) else {}
        turns = {"moment": [*draw(vectors(3 if n == 3 else 1))]} if along and turning else {}
        inputs.append({"name": f"F{k}", "kind": "force", "frame": frame, **at, **along, **turns})
    if turning and draw(st.booleans()):
        frame = draw(st.sampled_from(["space", "body"]))
        inputs.append({"name": "tau", "kind": "torque", "frame": frame})
    if draw(st.booleans()):
        inputs.insert(draw(st.integers(0, len(inputs))), {"name": "u", "kind": "covector"})
    return data | {"potential": potentials, "input": inputs}


@st.composite
def of_points(draw):
    """A problem of points, in one group or a product."""
    name = draw(st.sampled_from([*FAMILIES, *PRODUCTS]))
    sizes = [FAMILIES[x] for x in name.split(" x ")]
    data = {
        "name": "test",
        "group": name,
        "parameters": dict(PARAMETERS),
        "point": draw(points(sizes)),
    }
    return used(draw(forces(data, sizes)))


@st.composite
def of_solids(draw):
    """A problem of one or two solids in R³."""
    name = draw(st.sampled_from([x for x, n in FAMILIES.items() if n == 3]))
    solids = draw(st.lists(solid(), min_size=1, max_size=2))
    data = {"name": "test", "group": name, "parameters": dict(PARAMETERS), "solid": solids}
    return used(draw(forces(data, [3])))


@st.composite
def of_both(draw):
    """A problem of one or two solids in R³ and up to three points beside them."""
    data = draw(of_solids())
    listed = st.fixed_dictionaries({"mass": length, "at": vectors(3)})
    found = {"point": draw(st.lists(listed, min_size=1, max_size=3))}
    found |= {k: x for k, x in data.items() if k not in ("potential", "input")}
    return used(draw(forces(found | {"parameters": dict(PARAMETERS)}, [3])))


@st.composite
def solid(draw):
    """One of the kinds, turned and shifted."""
    kind = draw(st.sampled_from(["ball", "box", "ellipsoid", "cylinder", "cone", "hollow_ball"]))
    sizes = {
        "ball": lambda: {"radius": draw(length)},
        "box": lambda: {"sides": [draw(length) for _ in range(3)]},
        "ellipsoid": lambda: {"semi_axes": [draw(length) for _ in range(3)]},
        "cylinder": lambda: {"radius": draw(length), "height": draw(length)},
        "cone": lambda: {"radius": draw(length), "height": draw(length)},
        "hollow_ball": lambda: {"outer": draw(st.sampled_from([3, "3*a"])), "inner": draw(length)},
    }[kind]()
    placed = {"rotation": draw(rotations(3))} if draw(st.booleans()) else {}
    placed |= {"shift": draw(vectors(3))} if draw(st.booleans()) else {}
    return {"kind": kind, "density": draw(coefficient), **sizes, **placed}


def used(data):
    """Without the parameters that do not occur, and without empty tables."""
    words = repr({k: x for k, x in data.items() if k != "parameters"})
    letters = "".join(c if c.isalnum() or c == "_" else " " for c in words).split()
    kept = {k: x for k, x in data["parameters"].items() if k in letters}
    return {k: x for k, x in (data | {"parameters": kept}).items() if x != []}
