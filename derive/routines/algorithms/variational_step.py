"""The step of the discrete motion: what a momentum tells, by Newton's method on what is lowered."""


class Node:
    """What a motion has at a node, between two steps."""

    momentum: real[N_MOMENTA]
    force: real[N_MOMENTA]  # what is added to it in a unit of time
    if TURNS:
        found: real[N_SUBSTEPS, 5, N_TURNS]  # what the last steps were found by, the last first
        known: index  # how many of them


def step_momentum(x: real[N_STATE], k: real[N_CONSTANTS], to: out[real[N_MOMENTA]]): ...


def step_force(
    t: real, x: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], to: out[real[N_MOMENTA]]
): ...


def step_guess(
    x: real[N_STATE], k: real[N_CONSTANTS], q: real[N_LOADED], s: out[real[N_TURNS]]
): ...


def step_begin(
    x: real[N_STATE], k: real[N_CONSTANTS], q: real[N_LOADED], b: out[real[N_BEGUN]]
): ...


def step_newton(
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    b: real[N_BEGUN],
    q: real[N_LOADED],
    v: real[N_UNKNOWNS],
    change: out[real[N_CORRECTED]],
): ...


def step_turn(v: real[N_UNKNOWNS], s: real[N_TURNS], to: out[real[N_UNKNOWNS]]): ...


def step_turn_little(v: real[N_UNKNOWNS], s: real[N_TURNS], to: out[real[N_UNKNOWNS]]): ...


def step_end(
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    q: real[N_LOADED],
    v: real[N_UNKNOWNS],
    to: out[real[N_MOVED]],
): ...


def step_velocity(
    x: real[N_STATE], k: real[N_CONSTANTS], q: real[N_LOADED], to: out[real[N_VELOCITY]]
): ...


def force_at(
    m: Motion,
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    to: out[real[N_MOMENTA]],
):
    """What the forces add to the momentum in a unit of time."""
    if INPUT_FUNCTIONS:
        held: real[SIZE_U]
        inputs_at(m, t, x, u, held)
        step_force(t, x, k, held, to)
    else:
        step_force(t, x, k, u, to)


def at_node(
    m: Motion,
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    node: out[Node],
):
    """The node at a state, with no step before it."""
    step_momentum(x, k, node.momentum)
    force_at(m, t, x, k, u, node.force)
    if TURNS:
        node.known = 0


def turned_by(v: out[real[N_UNKNOWNS]], s: real[N_TURNS]) -> flag:
    """The step v, and a turn by s after it, which is made in parts where it is large; not of what is too
    large, or no number."""
    last: real[N_UNKNOWNS]
    part: real[N_TURNS]
    size: var[real] = 0.0
    for a in range(N_TURNS):
        size += NORM * abs(s[a])
    if not size < 300.0:
        return False
    parts: index = 1 + whole(size / 0.3)
    number: real = real(parts)
    for a in range(N_TURNS):
        part[a] = s[a] / number
    for made in range(parts):
        last[:] = v
        if size < 1e-8:
            step_turn_little(last, part, v)
        else:
            step_turn(last, part, v)
    return True


def by_newton(
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    q: real[N_LOADED],
    near: flag,
    s: out[real[N_TURNS]],
    end: out[real[N_MOVED]],
) -> flag:
    """A step from x: q is h times its momentum, and h; s, about what it is found by, becomes that, if near
    only where it was near; end: what is added to the element, and h times the momentum after it.  Is there
    such a step?"""
    change: real[N_CORRECTED]
    turn: real[N_TURNS]
    if BEGUN:
        b: real[N_BEGUN]
        step_begin(x, k, q, b)
    if BASIS:
        v: real[N_UNKNOWNS]
        sign: var[real] = 0.0
        for i in range(N_UNKNOWNS):
            v[i] = 0.0
        if not turned_by(v, s):
            return False
    for made in range(50):
        fault: var[real] = 0.0
        most: var[real] = 0.0
        size: var[real] = 0.0
        if BEGUN:
            step_newton(x, k, b, q, s, change)
        elif BASIS:
            step_newton(x, k, NOTHING, q, v, change)
        else:
            step_newton(x, k, NOTHING, q, s, change)
        if BASIS:
            if made == 0:
                sign = change[N_TURNS]  # that of the metric, with masses of any sign
            if not sign * change[N_TURNS] > 0.0:
                return False
        else:
            if not change[N_TURNS] > 0.0:
                return False
        for a in range(N_TURNS):
            turn[a] = -change[a]
            s[a] += turn[a]
            size = abs(s[a]) if abs(s[a]) > size else size
            most = abs(turn[a]) if abs(turn[a]) > most else most
            fault += turn[a] - turn[a]
        if VOLUME:
            far: flag = most * change[N_TURNS] > 1e-2
            # the next one would be its square
            found: flag = most * change[N_TURNS] <= 1e-9
        else:
            far: flag = most > 1e-2 * size
            # the next one would be like its square
            found: flag = most * most <= 1e-17 * size
        if not (fault == 0.0 and most < 1e18) or near and made == 0 and far:
            return False
        if BASIS:
            if not turned_by(v, turn):
                return False
        if found:
            if BASIS:
                step_end(x, k, q, v, end)
            else:
                step_end(x, k, q, s, end)
            return True
    return False


def found_step(
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    q: real[N_LOADED],
    substep: index,
    node: out[Node],
    end: out[real[N_MOVED]],
) -> flag:
    """The same, begun where the polynomial of the last steps leads, or anew."""
    continued: table[real, 6, 5] = EXTRAPOLATED
    s: real[N_TURNS]
    there: var[flag] = False
    if node.known > 0:
        for a in range(N_TURNS):
            total: var[real] = 0.0
            for i in range(node.known):
                total += continued[node.known][i] * node.found[substep][i][a]
            s[a] = total
        there = by_newton(x, k, q, True, s, end)
    if not there:
        step_guess(x, k, q, s)
        if not by_newton(x, k, q, False, s, end):
            return False
    for i in reversed(range(4)):
        node.found[substep][i + 1][:] = node.found[substep][i]
    node.found[substep][0][:] = s
    return True


def substep_to(
    m: Motion,
    t: real,
    x: real[N_STATE],
    low: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    h: real,
    substep: index,
    node: out[Node],
    X: out[real[N_STATE]],
    sum: out[real[N_STATE]],
) -> flag:
    """A step h of order 2 from X = x + low + sum to the time t, from a node to the next.  Is there such a step?"""
    q: real[N_LOADED]
    end: real[N_MOVED]
    for i in range(N_MOMENTA):
        q[i] = h * (node.momentum[i] + h / 2.0 * node.force[i])
    q[N_MOMENTA] = h
    if TURNS:
        if not found_step(X, k, q, substep, node, end):
            return False
    else:
        step_end(X, k, q, NOTHING, end)
    for i in range(N_GROUP):
        sum[i] += end[i]
        X[i] = x[i] + (low[i] + sum[i])
    force_at(m, t, X, k, u, node.force)
    for i in range(N_MOMENTA):
        node.momentum[i] = end[N_GROUP + i] / h + h / 2.0 * node.force[i]
    return True


def discrete_sum(
    m: Motion,
    t: real,
    x: real[N_STATE],
    low: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    h: real,
    node: out[Node],
    sum: out[real[N_STATE]],
) -> flag:
    """What a step h adds to the state x + low at time t, from a node to the next.  Is there such a step?"""
    X: real[N_STATE]
    q: real[N_LOADED]
    velocity: real[N_VELOCITY]
    for i in range(N_STATE):
        sum[i] = 0.0
        X[i] = x[i] + low[i]
    if COMPOSED:
        part: table[real, N_SUBSTEPS] = SUBSTEPS
        end: var[real] = t
        for n in range(N_SUBSTEPS):
            end += part[n] * h
            if not substep_to(m, end, x, low, k, u, part[n] * h, n, node, X, sum):
                return False
    else:
        if not substep_to(m, t + h, x, low, k, u, h, 0, node, X, sum):
            return False
    if TURNS:
        node.known += 1 if node.known < 5 else 0
    for i in range(N_MOMENTA):
        q[i] = node.momentum[i]
    q[N_MOMENTA] = h
    step_velocity(X, k, q, velocity)
    for i in range(N_VELOCITY):
        sum[N_GROUP + i] = velocity[i] - x[N_GROUP + i] - low[N_GROUP + i]
    return True


def discrete(
    m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], h: real, n: count = 1
) -> status:
    """The discrete motion of derive walk --discrete, of order ORDER: n steps of size h, which may be negative.
    NO_SOLUTION: there is none of this size; m is as it was."""
    X: real[N_STATE]
    sum: real[N_STATE]
    node: Node
    hold(m, k, u)
    for i in range(N_STATE):
        X[i] = m.x[i] + m.low[i]
    at_node(m, m.t + m.t_low, X, k, u, node)
    made: var[count] = 0
    while made < n:
        if not discrete_sum(m, m.t + m.t_low, m.x, m.low, k, u, h, node, sum):
            return NO_SOLUTION
        if not moved(m, h, sum):
            return NOT_FINITE
        m.method = DISCRETE
        made += 1
    return OK


def discrete_within(m: Motion, theta: real, to: out[real[N_STATE]]):
    """The state at a part theta of the last step: a step of that part; of less than 1e-12 there is none but
    rounding."""
    t: real = m.t + m.t_low - m.h
    none: real[N_STATE]
    sum: real[N_STATE]
    node: Node
    for i in range(N_STATE):
        none[i] = 0.0
    at_node(m, t, m.start, m.k, m.u, node)
    there: flag = abs(theta) > 1e-12 and discrete_sum(
        m, t, m.start, none, m.k, m.u, theta * m.h, node, sum
    )
    for i in range(N_STATE):
        to[i] = m.start[i] + (sum[i] if there else theta * (m.x[i] - m.start[i]))
