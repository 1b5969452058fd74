"""The ready-made problems in every form of the emitted C, for tools that look at all of it; a C
program that calls every function of it on ordinary and on extreme numbers."""

import re

from derive import derive
from derive.code.program import LoweringError
from derive.problem.problem import ProblemError
from tests.support.library import module_of
from tests.support.states import some_body

PROBLEMS = ("so3", "se3", "sl3", "saff3", "comet", "top", "two_tops")
FORMS = {
    "plain": {},
    "quaternion": {"attitude": "quaternion"},
    "tangent": {"velocity": "tangent"},
    "principal": {"frame": "principal"},
    "jacobian": {"jacobian": ("state", "inputs", "parameters")},
}
REFUSED = {("two_tops", "principal")} | {(name, "quaternion") for name in ("sl3", "saff3")}
"""No such form: tests/command/test_emission_errors.py says with what words."""


def emit_forms(folder, problems=PROBLEMS, forms=FORMS, languages=("c",)):
    """Write NAME_FORM.h and .c for every problem and form; return the prefixes with the problem."""
    made = {}
    for name in problems:
        derived = derive(name)
        for form in forms:
            choices = dict(FORMS[form])
            if form == "jacobian" and not derived.problem.inputs:
                choices["jacobian"] = ("state", "parameters")
            try:
                derived.emit(folder, languages, f"{name}_{form}", **choices)
            except (LoweringError, ProblemError):
                assert (name, form) in REFUSED
                continue
            assert (name, form) not in REFUSED
            made[f"{name}_{form}"] = name
    return made


def some_parameters(name):
    """Values of the parameters of a problem for which there is a body, in order."""
    module = module_of(name)
    own = some_body(module.PARAMETERS) or module.DEFAULTS
    return [float(own.get(x, module.DEFAULTS.get(x, 1.25))) for x in module.PARAMETERS]


HEAD = """\
#define _GNU_SOURCE
#include <fenv.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { ORDINARY, EXTREME, MIXED, MODES };

static uint64_t seed = 88172645463325252u;

static uint64_t bits(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    return seed ^= seed << 17;
}

static double ordinary(void)
{
    return (double)(bits() >> 11) / 4503599627370496.0 - 1;
}

static double extreme(void)
{
    const double pool[] = {0.0, 4.9e-324, 2.2e-308, 1e-300, 1e-150, 1.0, 1e150, 1e300, DBL_MAX,
        HUGE_VAL, NAN};
    const double x = pool[bits() % (sizeof pool / sizeof *pool)];
    return bits() & 4096 ? x : -x;
}

static void fill(double *x, int n, const double *like, int mode)
{
    for (int i = 0; i < n; ++i) {
        const int wild = mode == EXTREME || (mode == MIXED && bits() % 8 == 0);
        x[i] = wild ? extreme() : like ? like[i] : ordinary();
    }
}

static int finite_all(const double *x, int n)
{
    int yes = 1;
    for (int i = 0; i < n; ++i) {
        yes = yes && isfinite(x[i]);
    }
    return yes;
}

/* Of just this size, so that a step beyond it is seen; none at all for an empty array. */
static double *room(int n)
{
    return n ? malloc((size_t)n * sizeof(double)) : NULL;
}

static void expect(int holds, const char *name, const char *what)
{
    if (!holds) {
        printf("%s: %s\\n", name, what);
        exit(1);
    }
}
"""

# {0} is the prefix; a body of zeros has no mass unless its masses are numbers of the problem
ONE = """
#include "{0}.h"
static void {0}_exercise(void)
{{
    enum {{ P = {0}_N_PARAMETERS, K = {0}_N_CONSTANTS, U = {0}_N_INPUTS, X = {0}_N_STATE }};
    enum {{ N = {0}_N_ALGEBRA, BATCH = 3 }};
    static const double body[P + 1] = {{ {values} }};
    double *p = room(P), *k = room(K), *x = room(X), *u = room(U), *dx = room(X);
    double *xs = room(BATCH * X), *us = room(BATCH * U), *dxs = room(BATCH * X);
    int seen[3] = {{0}};
    for (int trial = 0; trial < {trials}; ++trial) {{
        const int about = trial % MODES, how = trial / MODES % MODES;
        const double t = how == ORDINARY ? ordinary() : extreme();
        fill(p, P, body, about);
        fill(x, X, NULL, how);
        fill(u, U, NULL, how);
        fill(xs, BATCH * X, NULL, how);
        fill(us, BATCH * U, NULL, how);
        const int calm = about == ORDINARY && how == ORDINARY;
        feclearexcept(FE_ALL_EXCEPT);
        const int status = {0}_constants(p, k);
        expect(status >= 0 && status <= 2, "{0}", "another status");
        seen[status] += 1;
        expect(about != ORDINARY || status == 0, "{0}", "a body is refused");
        expect(status != 0 || finite_all(k, K), "{0}", "accepted, and k is not finite");
        expect(finite_all(p, P) || status == {0}_NOT_FINITE, "{0}", "not finite, and not told so");
        {0}_rhs(t, x, k, u, dx);
        expect(!calm || finite_all(dx, X), "{0}", "rates that are not finite");
        {0}_rhs_batch(BATCH, t, xs, k, us, dxs);
        const double energy = {0}_energy(t, x, k);
        expect(!calm || isfinite(energy), "{0}", "an energy that is not finite");
{more}
        expect(!calm || !fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), "{0}",
            "an exception of the arithmetic from ordinary numbers");
        fill(k, K, NULL, EXTREME); /* whatever the constants are */
        {0}_rhs(t, x, k, u, dx);
        (void){0}_energy(t, x, k);
    }}
    const double scales[] = {{0, 1e200}};
    for (int i = 0; i < 2; ++i) {{
        for (int j = 0; j < P; ++j) {{
            p[j] = scales[i] * body[j];
        }}
        const int wanted = i ? {0}_NOT_FINITE : {0}_SINGULAR, status = {0}_constants(p, k);
        const int held = i && status == 0 && finite_all(k, K); /* by pivots, not by a determinant */
        expect(status == wanted || held || {fixed}, "{0}",
            i ? "too large, and not told so" : "no mass");
    }}
    printf("{0} %d %d %d\\n", seen[0], seen[1], seen[2]);
    free(p), free(k), free(x), free(u), free(dx), free(xs), free(us), free(dxs);
}}
"""
CARRY = """\
        double *out_{what} = room({size});
        {0}_{what}({array}, k, out_{what});
        free(out_{what});"""
DRIFT = """\
        double *there = room(X);
        {0}_project(x, there);
        expect(!calm || finite_all(there, X), "{0}", "a projection that is not finite");
        expect(!calm || isfinite({0}_defect(x)), "{0}", "a defect that is not finite");
        free(there);"""
JACOBIAN = """\
        double *D{what} = room(2 * N * {columns});
        {0}_jacobian{what}(t, x, {given}, u, {rates}D{what});
        free(D{what});"""


def program(headers, bodies, trials, fixed):
    """The program for prefixes with their headers and values; ``fixed``: masses are numbers."""
    text, calls = HEAD, []
    for prefix, header in headers.items():
        values = ", ".join(map(repr, bodies[prefix])) or "0"
        more = "\n".join(optional(prefix, header))
        masses = int(prefix in fixed)
        text += ONE.format(prefix, values=values, trials=trials, more=more, fixed=masses)
        calls.append(f"    {prefix}_exercise();")
    return text + "\nint main(void)\n{\n" + "\n".join(calls) + "\n    return 0;\n}\n"


def optional(prefix, header):
    """Calls of the functions that some headers have."""
    for what in re.findall(rf"void {prefix}_(\w*(?:into|out_of)_frame)\(", header):
        array, size = ("u", "U") if what.startswith("inputs") else ("x", "X")
        yield CARRY.format(prefix, what=what, array=array, size=size)
    if f"void {prefix}_project(" in header:
        yield DRIFT.format(prefix)
    columns = {"": "2 * N", "_inputs": "U", "_parameters": "P"}
    for what in re.findall(rf"void {prefix}_jacobian(\w*)\(", header):
        given, rates = "p" if what == "_parameters" else "k", "" if what else "dx, "
        yield JACOBIAN.format(prefix, what=what, columns=columns[what], given=given, rates=rates)
