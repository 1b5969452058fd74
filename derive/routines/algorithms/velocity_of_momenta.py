"""Newton's method for the velocity that momenta have, where no formula tells it."""


def velocity_step(
    t: real,
    x: real[N_STATE],
    y: real[N_STATE],
    k: real[N_CONSTANTS],
    next: out[real[N_STATE]],
): ...


def momentum_rates(
    t: real,
    x: real[N_STATE],
    y: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    dy: out[real[N_STATE]],
): ...


def velocity(t: real, y: real[N_STATE], k: real[N_CONSTANTS], out: out[real[N_STATE]]) -> status:
    """out = the state y with its velocity in place of the momenta, by Newton's method from velocity 0: in
    NEWTON_STEPS steps at most, else NOT_CONVERGED is returned."""
    for i in range(N_STATE):
        out[i] = y[i]
    for i in range(FIRST, END):
        out[i] = 0.0
    next: real[N_STATE]
    for step in range(NEWTON_STEPS):
        change: var[real] = 0.0
        size: var[real] = 0.0
        velocity_step(t, out, y, k, next)
        for i in range(FIRST, END):
            change += abs(next[i] - out[i])
            size += abs(next[i])
            out[i] = next[i]
        if change <= SMALL * size and size - size == 0.0:
            return OK
    return NOT_CONVERGED


def momentum_rhs(
    t: real, y: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], dy: out[real[N_STATE]]
) -> status:
    """dy = dy/dt at time t, y the state with momenta.  Returns what velocity does."""
    x: real[N_STATE]
    found: status = velocity(t, y, k, x)
    momentum_rates(t, x, y, k, u, dy)
    return found
