"""C that makes a library of the emitted steps in time, for ``motion.native`` to call."""

from __future__ import annotations

import re
from collections.abc import Sequence

DEFINED = re.compile(r"^((?:void|int|size_t|const char \*)[^{;]*\))\n{", re.MULTILINE)
"""The head of a function that others may call: compilers want it declared first."""
INCLUDE = '#include "{name}_steps.h"\n'
HEAD = """\
size_t derive_motion_size(void)
{{
    return sizeof({name}_motion);
}}
void derive_begin({name}_motion *m, double t, const double *x)
{{
    {name}_begin(m, t, x);
}}
void derive_dense(const {name}_motion *m, double t, double *x)
{{
    {name}_dense(m, t, x);
}}
void derive_now(const {name}_motion *m, double *now, double *x)
{{
    now[0] = m->t;
    now[1] = m->t_low;
    now[2] = m->h;
    now[3] = (double)m->evaluations;
    memcpy(x, m->x, sizeof m->x);
}}
"""
DRIVE = """\
typedef void derive_inputs(double t, const double *x, double *u, void *data);
static void derive_line(double t, const double *x, double *u, void *data)
{{
    const double *line = (const double *)data; /* a time, the inputs then, their rates */
    (void)x;
    for (int i = 0; i < {name}_N_INPUTS; ++i) {{
        u[i] = line[1 + i] + (t - line[0])*line[1 + {name}_N_INPUTS + i];
    }}
}}
void derive_drive({name}_motion *m, derive_inputs *function, double *line)
{{
    m->inputs = line ? derive_line : function;
    m->data = line;
}}
"""
EVENT = """\
int derive_event(const {name}_motion *m, int *rising)
{{
    *rising = m->rising;
    return m->event;
}}
"""
CALL = """\
void derive_{step}{more}({name}_motion *m, const double *k, const double *u, {takes}, int *told)
{{{{
    *told = {name}_{called}m, k, u, {given});
}}}}
"""
"""A function that hands on to one of the same name with a motion, and tells the status."""
MOVE, VARY, MOVE_TO_EVENT, WATCH = (
    CALL.format(
        step="{step}",
        name="{name}",
        more=more,
        takes=takes,
        called=called or f"{{step}}{more}(",
        given=", ".join(x.split()[-1].strip("*") for x in takes.split(",")),
    )
    for more, takes, called in (
        ("", "double h, size_t n", ""),
        ("_jacobian", "double h, size_t n, double *phi, double *gamma", ""),
        ("_to", "double t1, double tol", ""),
        ("_watch", "double t1, double h", "watch({name}_{step}, "),
    )
)
MOVE_TO = """\
void derive_{step}_to({name}_motion *m, const double *k, const double *u, double t1, double tol,
    size_t n, int *told)
{{
    int fault = {name}_{step}(m, k, u, 0, 0); /* dense asks for the numbers of a call */
    for (; fault == 0 && n > 0 && t1 - m->t - m->t_low != 0; --n) {{
        fault = {name}_towards({name}_{step}_step, m, k, u, t1, tol);
    }}
    *told = fault;
}}
"""
ENSEMBLE = """\
size_t derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status)
{{
    return {name}_ensemble(n, x, k, k_each, u, u_each, t0, t1, tol, h, status);
}}
"""
ENDED = """\
void derive_ensemble(size_t n, double *x, const double *k, size_t k_each, const double *u,
    size_t u_each, double t0, double t1, double tol, double *h, int *status, double *ended)
{{
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (long long j = 0; j < (long long)n; ++j) {{
        const size_t i = (size_t)j;
        {name}_motion m;
        {name}_begin(&m, t0, x + i*{name}_N_STATE);
        m.h_next = h[i];
        status[i] = {name}_{step}_to(&m, k + i*k_each, u + i*u_each, t1, tol);
        status[i] += status[i] == {name}_EVENT ? m.event : 0;
        memcpy(x + i*{name}_N_STATE, m.x, sizeof m.x);
        h[i] = m.h_next;
        ended[i] = m.t;
    }}
}}
"""
ON_CARD = """\
const char *derive_ensemble_on_card(size_t n, double *x, const double *k, size_t k_each,
    const double *u, size_t u_each, double t0, double t1, double tol, double *h, int *status)
{{
    const int fault = {name}_ensemble_device(n, x, k, k_each, u, u_each, t0, t1, tol, h, status);
    return fault ? cudaGetErrorString((cudaError_t)fault) : 0;
}}
"""
CONSTANTS = """\
void derive_constants(size_t n, const double *p, double *k, int *wrong)
{{
    for (size_t i = 0; i < n; ++i) {{
        wrong[i] = {name}_constants(p + i*{name}_N_PARAMETERS, k + i*{name}_N_CONSTANTS);
    }}
}}
"""


def binding(
    name: str,
    steps: Sequence[str],
    fixed: Sequence[str] = (),
    *,
    ensemble: bool = False,
    events: bool = False,
    driven: bool = False,
    varied: Sequence[str] = (),
) -> str:
    """C that makes functions of a library of the inline functions of a header of steps; those that
    are ``fixed`` have no size of their own, those that are ``varied`` have derivatives; are there
    ``events``, and inputs, which may be ``driven``?"""
    every, to = ((MOVE, WATCH), MOVE_TO_EVENT) if events else ((MOVE,), MOVE_TO)
    moves = [text.format(name=name, step=x) for x in steps for text in every]
    moves += [VARY.format(name=name, step=x) for x in varied]
    moves += [to.format(name=name, step=x) for x in steps if x not in fixed]
    parts = [
        INCLUDE,
        HEAD * bool(steps),
        DRIVE * driven,
        EVENT * events,
        (ENSEMBLE + CONSTANTS) * ensemble,
    ]
    return _declared("\n".join([*(x.format(name=name) for x in parts if x), *moves]))


def binding_to_events(name: str, step: str) -> str:
    """The same of an ensemble whose motions end at their events, by one of those steps."""
    parts = (x.format(name=name, step=step) for x in (INCLUDE, ENDED, CONSTANTS))
    return _declared("\n".join(parts))


def binding_on_card(name: str) -> str:
    """The same of an ensemble on a graphics card, in CUDA."""
    parts = INCLUDE, 'extern "C" {{\n', ON_CARD, CONSTANTS, "}}\n"
    return _declared("".join(x.format(name=name) for x in parts))


def _declared(text: str) -> str:
    """C with each function declared before it is defined."""
    return DEFINED.sub(r"\1;\n\1\n{", text)
