"""The motion up to its next event."""


def events(
    t: real, x: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], to: out[real[N_EVENTS]]
): ...


def passes(e: index, before: real, after: real) -> flag:
    """Does event e happen between two values?  From below alone for 1, from above for -1."""
    direction: table[sign, N_EVENTS] = DIRECTION
    up: flag = before < 0.0 and after >= 0.0 and direction[e] >= 0
    down: flag = before > 0.0 and after <= 0.0 and direction[e] <= 0
    return up or down


def values(
    m: Motion,
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    to: out[real[N_EVENTS]],
):
    """What becomes 0 at each event, at a time and a state of a motion."""
    if INPUT_FUNCTIONS:
        held: real[SIZE_U]
        inputs_at(m, t, x, u, held)
        events(t, x, k, held, to)
    else:
        events(t, x, k, u, to)


def values_within(
    m: Motion, theta: real, k: real[N_CONSTANTS], u: real[N_INPUTS], to: out[real[N_EVENTS]]
):
    """The same at a part theta of the last step."""
    t: real = m.t + (m.t_low - (1.0 - theta) * m.h)
    x: real[N_STATE]
    dense(m, t, x)
    values(m, t, x, k, u, to)


def event_here(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS]) -> flag:
    """Does an event happen where a motion stands, by the values that were last seen?"""
    now: real[N_EVENTS]
    values(m, m.t, m.x, k, u, now)
    if m.seen != m.t:
        m.seen = m.t
        m.values[:] = now
    for e in range(N_EVENTS):
        if passes(e, m.values[e], now[e]):
            m.event = e
            m.rising = m.values[e] < 0.0
            m.values[e] = 0.0
            return True
    return False


def keep_place(m: Motion, place: out[Place]):
    """Where a motion is."""
    place.t = m.t
    place.t_low = m.t_low
    place.x[:] = m.x
    place.low[:] = m.low


def put(m: out[Motion], there: Place):
    """A motion at a place."""
    m.t = there.t
    m.t_low = there.t_low
    m.x[:] = there.x
    m.low[:] = there.low


def mark(m: out[Motion]):
    """Keep where a motion is, as the end of a step."""
    m.end.t = m.t
    m.end.t_low = m.t_low
    m.end.x[:] = m.x
    m.end.low[:] = m.low


def resume(m: out[Motion]):
    """A motion at the end that was kept."""
    m.t = m.end.t
    m.t_low = m.end.t_low
    m.x[:] = m.end.x
    m.low[:] = m.end.low


def back(m: out[Motion], past: Place):
    """A motion back where a step began."""
    put(m, past)
    m.start[:] = past.x
    m.h = 0.0
    if METHODS:
        m.method = 0


def clipped(part: real) -> real:
    """A part of a step."""
    return 0.0 if part < 0.0 else part if part < 1.0 else 1.0


def locate_event(
    steps: Steps,
    past: Place,
    m: out[Motion],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    e: index,
    theta: real,
    slope: real,
) -> status:
    """EVENT, and m stands at event e, which is near a part theta of the step from past: Newton's method
    makes it that of steps which end there, as the polynomial has a larger error."""
    h: real = m.h
    if ADAPTIVE:
        planned: real = m.h_next
    part: var[real] = theta
    gradient: var[real] = slope
    now: real[N_EVENTS]
    for n in range(NEWTON):
        back(m, past)
        if part > 0.0:
            failed: status = steps(m, k, u, part * h, 1)
            if failed != OK:
                return failed
        values(m, m.t, m.x, k, u, now)
        change: real = now[e] / gradient if gradient != 0.0 else 0.0
        if abs(change * h) <= EXACT * (abs(m.t) + abs(h)):
            break
        part = clipped(part - change)
        if not abs(part - theta) < WIDTH:  # it only touches 0
            part = theta
            gradient = 0.0
    if ADAPTIVE:
        m.h_next = planned
    m.event = e
    m.seen = m.t
    # others that happen here are told by the next call; those that were just told are not seen again
    for o in range(N_EVENTS):
        just: flag = m.values[o] == 0.0 and part < WIDTH
        if not just and not passes(o, m.values[o], now[o]):
            m.values[o] = now[o]
    m.values[e] = 0.0
    return EVENT


def first_event(
    steps: Steps, past: Place, m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS]
) -> status:
    """OK where no event happens on the step from past to m; EVENT, and m stands at the first one; or why it
    cannot be taken there."""
    seen: real[INTERVALS + 1, N_EVENTS]
    inside: real[N_EVENTS]
    first: var[real] = 2.0
    found: var[index] = 0
    interval: var[index] = 0
    if EXTRA:
        vern9_complete(m)
    # what two steps share is the same for both: nothing is seen twice, or not at all
    seen[0][:] = m.values
    for s in range(1, INTERVALS):
        values_within(m, real(s) * WIDTH, k, u, seen[s])
    values(m, m.t, m.x, k, u, seen[INTERVALS])
    for e in range(N_EVENTS):
        s: var[index] = 0
        while s < INTERVALS and not passes(e, seen[s][e], seen[s + 1][e]):
            s += 1
        if s == INTERVALS:
            continue
        a: var[real] = real(s) * WIDTH
        b: var[real] = real(s + 1) * WIDTH
        for halved in range(HALVINGS):
            middle: real = (a + b) / 2.0
            values_within(m, middle, k, u, inside)
            if passes(e, seen[s][e], inside[e]):
                b = middle
            else:
                a = middle
        if b < first:
            first = b
            found = e
            interval = s
            m.rising = seen[s][e] < 0.0
    if first > 1.0:
        m.seen = m.t
        m.values[:] = seen[INTERVALS]
        return OK
    # what else happens there has changed its sign since that interval began, whatever it was before
    m.values[:] = seen[interval]
    values_within(m, first + 1e-3, k, u, inside)
    above: real = inside[found]
    values_within(m, first - 1e-3, k, u, inside)
    return locate_event(steps, past, m, k, u, found, first, (above - inside[found]) / 2e-3)


def up_to_event(
    step: Step,
    steps: Steps,
    m: out[Motion],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    t1: real,
    tol: real,
) -> status:
    """Steps of their own size up to the time t1 or an event."""
    past: Place
    if event_here(m, k, u):
        return EVENT
    while t1 - m.t - m.t_low != 0.0:
        keep_place(m, past)
        code: var[status] = towards(step, m, k, u, t1, tol)
        if code == OK:
            code = first_event(steps, past, m, k, u)
        if code != OK:
            return code
    return OK


def watch(
    steps: Steps, m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], t1: real, h: real
) -> status:
    """Steps of size h, the last one shorter where that is left, up to the time t1 or an event.  From an event
    the same call goes first to where the step that it is in ends without it: what is watched is the same
    motion."""
    size: real = abs(h)
    most: var[real] = size  # of a part of a step that is made in parts
    past: Place
    if not (0.0 * (t1 - m.t) == 0.0 and size > 0.0 and 0.0 * size == 0.0):  # they are finite
        return NOT_FINITE
    code: var[status] = EVENT if event_here(m, k, u) else OK
    while code == OK:
        keep_place(m, past)
        inside: flag = m.halted == m.t
        left: real = m.end.t - m.t + (m.end.t_low - m.t_low) if inside else t1 - m.t - m.t_low
        if abs(left) <= SLIVER * size:
            if not inside:
                break
            resume(m)
            m.seen = m.t
            m.halted = INFINITY
            most = size
            continue
        part: real = left if abs(left) < most * (1.0 - SLIVER) else -most if left < 0.0 else most
        code = steps(m, k, u, part, 1)
        if code != OK:
            break
        if not inside:
            mark(m)
        if abs(m.h) < abs(part) * (1.0 - SLIVER):  # it was made in parts: each is watched
            back(m, past)
            most = abs(part) / 2.0
            m.halted = m.t
            continue
        code = first_event(steps, past, m, k, u)
        if inside or code == EVENT:
            m.halted = m.t
    return code
