"""Every form of the emitted code is the same equations: held against the plain one."""

import os
import platform
import subprocess

import numpy as np
import pytest

from derive import derive
from derive.code.languages import LANGUAGES
from derive.code.program import LoweringError
from derive.command.cli import main
from tests.support.emitted import import_python, some_body
from tests.support.needs import need, needs

GROUPS = ("so3", "se3", "sl3", "saff3", "two_tops", "screw", "jelly", "heisenberg", "so4")
TURNING = ("so3", "se3")
ALL = ("state", "inputs", "parameters", "raw")
WITHOUT_INPUTS = ("state", "parameters", "raw")


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """A function (problem, languages, options) → the folder of its files, made once."""
    kept, derived = {}, {}

    def get(name, languages=("python",), **options):
        if options.get("jacobian") == ALL and name not in TURNING:
            options["jacobian"] = WITHOUT_INPUTS
        key = (name, languages, tuple(sorted(options.items())))
        if key not in kept:
            kept[key] = tmp_path_factory.mktemp(name)
            derived.setdefault(name, derive(name)).emit(kept[key], languages, **options)
        return kept[key]

    return get


def module_of(emitted, name, **options):
    return import_python(name, emitted(name, **options))


def drawn(module, seed=1):
    """Parameters, a group element near 1 as names → numbers, ζ (and w), inputs."""
    rng = np.random.default_rng(seed)
    own = some_body(module.PARAMETERS, seed)
    p = np.array(
        [own.get(x, module.DEFAULTS.get(x)) or rng.uniform(0.5, 1.5) for x in module.PARAMETERS]
    )
    x = dict(zip(module.STATE, rng.normal(size=len(module.STATE)), strict=True))
    return p, x, rng.normal(size=len(module.INPUTS)), rng


def element(module, rng):
    """A matrix of the group with the body's matrices: a product of exponentials of the basis."""
    g = np.eye(len(module.BASIS[0]))
    for e in module.BASIS:
        z = rng.normal() / 2 * e
        power, term = np.eye(len(z)), np.eye(len(z))
        for k in range(1, 30):
            term = term @ z / k
            power = power + term
        g = g @ power
    return g


def element_names(module):
    """The names of the group element in the state, with their places in the matrix."""
    size, places = len(module.BASIS[0]), {}
    marks = sorted({x[1:].split("_")[0] for x in module.STATE if x[0] in "AT"})
    offset = 0
    for mark in marks:
        rows = max(int(x[-1]) for x in module.STATE if x.startswith(f"A{mark}_"))
        for name in module.STATE:
            if name.startswith(f"A{mark}_"):
                places[name] = (offset + int(name[-2]) - 1, offset + int(name[-1]) - 1)
            elif name.startswith(f"T{mark}_"):
                places[name] = (offset + int(name[-1]) - 1, offset + rows)
        offset += rows + any(x.startswith(f"T{mark}_") for x in module.STATE)
    assert offset == size
    return places


def state(module, seed=1):
    """p, x, u, the matrix g and the coordinates of Z."""
    p, x, u, rng = drawn(module, seed)
    g = element(module, rng)
    x |= {name: g[place] for name, place in element_names(module).items()}
    zeta = np.array([x[name] for name in module.STATE[-len(module.BASIS) :]])
    return p, np.array([x[name] for name in module.STATE]), u, g, zeta


def hat(module, coordinates):
    return np.einsum("a,aij->ij", coordinates, module.BASIS)


@pytest.mark.parametrize("name", GROUPS)
def test_columns_are_the_rows_in_another_order(name, emitted):
    rows, columns = module_of(emitted, name), module_of(emitted, name, layout="col")
    p, x, u, *_ = state(rows)
    order = [rows.STATE.index(y) for y in columns.STATE]
    assert order != sorted(order)
    there = columns.rhs(0.3, x[order], columns.constants(p), u)
    assert np.allclose(there, rows.rhs(0.3, x, rows.constants(p), u)[order], rtol=1e-13)


@pytest.mark.parametrize("name", GROUPS)
def test_the_tangent_velocity_moves_alike(name, emitted):
    """ġ = gZ and g̈ = g(Ż + Z²), from the plain form."""
    plain, tangent = module_of(emitted, name), module_of(emitted, name, velocity="tangent")
    p, x, u, g, zeta = state(plain)
    dx = plain.rhs(0.3, x, plain.constants(p), u)
    Z, rate = hat(plain, zeta), hat(plain, dx[-len(zeta) :])
    speed, second = g @ Z, g @ (rate + Z @ Z)
    places = element_names(plain)
    count = len(places)
    assert (*plain.STATE[:count], *(y + "_dot" for y in plain.STATE[:count])) == tangent.STATE
    y = np.concatenate([x[:count], [speed[places[z]] for z in plain.STATE[:count]]])
    expected = np.concatenate([y[count:], [second[places[z]] for z in plain.STATE[:count]]])
    found = tangent.rhs(0.3, y, tangent.constants(p), u)
    assert np.allclose(found, expected, rtol=1e-11, atol=1e-11 * np.abs(expected).max())
    energies = (
        plain.energy(0.3, x, plain.constants(p)),
        tangent.energy(0.3, y, tangent.constants(p)),
    )
    assert np.isclose(*energies, rtol=1e-12)


def quaternion_matrix(q):
    """Rodrigues' parameters by the vector product: v + 2s(a×v) + 2a×(a×v)."""
    s, a = q[0], q[1:]
    return np.array(
        [v + 2 * s * np.cross(a, v) + 2 * np.cross(a, np.cross(a, v)) for v in np.eye(3)]
    ).T


@pytest.mark.parametrize("name", TURNING)
def test_the_quaternion_turns_alike(name, emitted):
    plain, other = module_of(emitted, name), module_of(emitted, name, attitude="quaternion")
    p, x, u, *_ = state(plain)
    q = np.random.default_rng(3).normal(size=4)
    q /= np.linalg.norm(q)
    x[:9] = quaternion_matrix(q).ravel()
    y = np.concatenate([q, x[9:]])
    assert ("q_0", "q_1", "q_2", "q_3", *plain.STATE[9:]) == other.STATE
    dx, dy = plain.rhs(0, x, plain.constants(p), u), other.rhs(0, y, other.constants(p), u)
    assert np.allclose(dy[4:], dx[9:], rtol=1e-12, atol=1e-12)
    h = 1e-20j  # the matrix is a polynomial in q, so a complex step is exact
    assert np.allclose(quaternion_matrix(q + h * dy[:4]).imag.ravel() / 1e-20, dx[:9], atol=1e-13)
    assert abs(q @ dy[:4]) < 1e-14


def test_what_does_not_go_together(emitted):
    with pytest.raises(LoweringError, match="not tangent"):
        emitted("se3", attitude="quaternion", velocity="tangent")
    with pytest.raises(LoweringError, match="needs SO"):
        emitted("sl3", attitude="quaternion")
    with pytest.raises(LoweringError, match="no inputs"):
        emitted("sl3", jacobian=("inputs",))


DERIVED = [(name, x) for name in GROUPS for x in ({}, {"velocity": "tangent"})]
DERIVED += [(name, {"attitude": "quaternion"}) for name in TURNING]


@pytest.mark.parametrize(("name", "options"), DERIVED)
def test_the_jacobian_is_the_derivative(name, options, emitted):
    """Against complex steps of rhs along the group; the matrix of ad_Z by the brackets."""
    plain = module_of(emitted, name)
    module = module_of(emitted, name, jacobian=ALL, **options)
    p, x, u, g, zeta = state(plain)
    d, k = len(zeta), module.constants(p)
    if options.get("attitude") == "quaternion":
        q = np.random.default_rng(3).normal(size=4)
        q /= np.linalg.norm(q)
        x[:9], y = quaternion_matrix(q).ravel(), np.concatenate([q, x[9:]])
        g[:3, :3] = quaternion_matrix(q)
    elif options:
        speed = g @ hat(plain, zeta)
        places = element_names(plain)
        y = np.concatenate([x[: len(places)], [speed[places[z]] for z in plain.STATE[:-d]]])
    else:
        y = x
    found, D = module.jacobian(0.3, y, k, u)
    assert np.allclose(found, module.rhs(0.3, y, k, u), rtol=1e-13, atol=1e-13)
    assert D.shape == (2 * d, 2 * d)
    places, h = element_names(plain), 1e-30
    Z, k = hat(plain, zeta), plain.constants(p)
    for a, e in enumerate(plain.BASIS):
        assert np.allclose(hat(plain, D[:d, a]), -(Z @ e - e @ Z), atol=1e-13)
        moved = x.astype(complex)
        change = g @ e
        moved[: len(places)] += 1j * h * np.array([change[places[z]] for z in plain.STATE[:-d]])
        slope = plain.rhs(0.3, moved, k, u).imag[-d:] / h
        assert np.allclose(D[d:, a], slope, rtol=1e-9, atol=1e-9 * np.abs(D).max())
        faster = x.astype(complex)
        faster[len(places) + a] += 1j * h
        slope = plain.rhs(0.3, faster, k, u).imag[-d:] / h
        assert np.allclose(D[d:, d + a], slope, rtol=1e-9, atol=1e-9 * np.abs(D).max())
    assert np.array_equal(D[:d, d:], np.eye(d))


@pytest.mark.parametrize(("name", "options"), DERIVED)
def test_the_raw_jacobian_is_the_derivative_by_the_numbers_of_the_state(name, options, emitted):
    """Against complex steps of rhs, off the group as well."""
    p = state(module_of(emitted, name))[0]
    module = module_of(emitted, name, jacobian=ALL, **options)
    draw, h = np.random.default_rng(5), 1e-30
    x, u = draw.normal(size=len(module.STATE)), draw.normal(size=len(module.INPUTS))
    k = module.constants(p)
    D = module.jacobian_raw(0.3, x, k, u)
    slopes = [module.rhs(0.3, x + 1j * h * e, k, u).imag / h for e in np.eye(len(x))]
    assert np.allclose(D, np.transpose(slopes), rtol=1e-9, atol=1e-9 * np.abs(D).max())


@pytest.mark.parametrize("name", GROUPS)
def test_derivatives_by_inputs_and_parameters(name, emitted):
    module = module_of(emitted, name, jacobian=ALL)
    p, x, u, _, zeta = state(module)
    d, h = len(zeta), 1e-30
    if module.INPUTS:
        D = module.jacobian_inputs(0.3, x, module.constants(p), u)
        for i in range(len(u)):
            slope = module.rhs(0.3, x, module.constants(p), u + 1j * h * np.eye(len(u))[i])
            assert np.allclose(D[d:, i], slope.imag[-d:] / h, rtol=1e-9, atol=1e-12)
            assert not D[:d].any()
    if module.PARAMETERS:
        D = module.jacobian_parameters(0.3, x, p, u)
        for i in range(len(p)):
            step = 1e-6 * max(abs(p[i]), 1)
            ends = [
                module.rhs(0.3, x, module.constants(p + s * step * np.eye(len(p))[i]), u)[-d:]
                for s in (1, -1)
            ]
            slope = (ends[0] - ends[1]) / (2 * step)
            assert np.allclose(D[d:, i], slope, rtol=1e-5, atol=1e-5 * np.abs(D).max())


@needs("objdump")
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_batches_are_vectorised(compiler, emitted, tmp_path):
    """gcc and clang use packed multiplications in the loop over states."""
    need(compiler)
    for name in ("so3", "se3", "sl3"):
        source, out = emitted(name, ("c",)) / f"{name}.c", tmp_path / "batch.o"
        flags = ["-std=c99", "-O3", "-fno-math-errno", "-c", str(source), "-o", str(out)]
        subprocess.run([compiler, *flags], check=True)
        shown = subprocess.run(
            ["objdump", "-d", f"--disassemble={name}_rhs_batch", str(out)],
            check=True, capture_output=True, text=True,
        ).stdout  # fmt: skip
        packed, single = shown.count("mulpd"), shown.count("mulsd")
        if platform.machine() == "x86_64":
            assert packed > 50, (name, packed, single)


@pytest.mark.parametrize("form", ["source", "header"])
def test_the_names_are_those_of_the_files(form, emitted, tmp_path, capsys):
    """In every language; with a prefix no problem is read, without one it has its own."""
    chosen = [x for name in LANGUAGES for x in ("--lang", name)]
    assert main(["emit", "none.toml", *chosen, "--prefix", "so3", "--form", form, "--names"]) == 0
    names = capsys.readouterr().out.splitlines()
    assert sorted(names) == sorted(os.listdir(emitted("so3", tuple(LANGUAGES), form=form)))
    assert main(["emit", "top", "--names"]) == 0
    assert capsys.readouterr().out.splitlines() == ["top.h", "top.c", "top.py"]
