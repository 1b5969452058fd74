"""A motion under way, and what every step does with it; on a DEVICE nothing of its last step is kept."""

if EVENTS:

    class Place:
        """A time and a state, each with what rounding leaves of it."""

        t: real
        t_low: real
        x: real[N_STATE]
        low: real[N_STATE]


class Motion:
    """A motion under way.  x + low is the state at time t + t_low: what rounding leaves is kept."""

    t: real
    t_low: real
    x: real[N_STATE]
    low: real[N_STATE]
    h: real  # the last step, 0 before the first
    evaluations: count  # of the rates, at the stages of steps
    if not DEVICE:
        start: real[N_STATE]  # the state where the last step began
    if ADAPTIVE:
        h_next: real  # the next step for a tolerance
        size: real[N_PARTS]  # how large each part of the state ever was
    if GAUSS:
        L: eight[N_STATE]  # what each stage of the last step adds
        sweeps: index  # the iterations that the last step took
        ratio: real  # of the last step and this one, which ahead continues
        ahead: eight[8]
    if MODES:
        coarse: real  # steps from this size on are solved by Newton's method
        lu: real[4, N_STATE, N_STATE, 2]  # which it works with
        pivots: index[4, N_STATE]
    if METHODS:
        method: index  # that of the last step, METHODS_SAID
    if EXPLICIT:
        f: real[MOST_ROWS, N_STATE]  # the rates at the stages of that step
    if EXTRA:
        dense_known: flag  # are the stages of dense output among them?
    if HELD:
        k: real[SIZE_K]  # those of the last call
        u: real[SIZE_U]
    if EVENTS:
        event: label  # that at which it stands, if that was told
        rising: flag  # is it reached from below?
        seen: real  # when the events were last looked at
        values: real[N_EVENTS]  # what became 0 at each then
        halted: real  # where it stands within a step of watch
        end: Place  # the end of that step


def rhs(
    t: real, x: real[N_STATE], k: real[N_CONSTANTS], u: real[N_INPUTS], f: out[real[N_STATE]]
): ...


def jacobian_raw(
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    J: out[real[N_STATE * N_STATE]],
): ...


def projected(x: real[N_STATE], on: out[real[N_STATE]]): ...


def inputs_at(m: Motion, t: real, x: real[N_STATE], u: real[N_INPUTS], to: out[real[SIZE_U]]): ...


def hold_inputs(m: out[Motion], u: real[N_INPUTS]): ...


def part(p: index) -> index:
    """Where a part of the state begins, whose errors are measured together, and where the last one ends."""
    begins: table[index, N_PARTS + 1] = PARTS
    return begins[p]


def sizes(m: Motion, x: real[N_STATE], size: out[real[N_PARTS]]):
    """The size of each part at the state x, as large as it ever was; a part that is zero but for
    rounding has that of the others in small."""
    largest: var[real] = 0.0
    for i in range(N_STATE):
        largest = abs(x[i]) if abs(x[i]) > largest else largest
    least: real = 1e-8 * largest + 1e-300
    for p in range(N_PARTS):
        size[p] = least if least > m.size[p] else m.size[p]
        for i in range(part(p), part(p + 1)):
            size[p] = abs(x[i]) if abs(x[i]) > size[p] else size[p]


def begin(m: out[Motion], t: real, x: real[N_STATE]):
    """The motion that is in state x at time t."""
    m.t = t
    m.t_low = 0.0
    m.h = 0.0
    m.evaluations = 0
    if GAUSS:
        m.sweeps = 0
        m.ratio = 0.0
    if MODES:
        m.coarse = INFINITY
    if METHODS:
        m.method = 0
    if EVENTS:
        m.event = NO_EVENT
        m.rising = False
        m.seen = INFINITY  # never
        m.halted = INFINITY
    for i in range(N_STATE):
        m.x[i] = x[i]
        if not DEVICE:
            m.start[i] = x[i]
        m.low[i] = 0.0
    if ADAPTIVE:
        size: real[N_PARTS]
        m.h_next = 0.0
        for p in range(N_PARTS):
            m.size[p] = 0.0
        sizes(m, x, size)
        m.size[:] = size
    if INPUT_FUNCTIONS:
        no_inputs(m)


def rate(
    m: Motion,
    t: real,
    x: real[N_STATE],
    k: real[N_CONSTANTS],
    u: real[N_INPUTS],
    f: out[real[N_STATE]],
):
    """f = f(t, x): the rates at a state."""
    if INPUT_FUNCTIONS:
        held: real[SIZE_U]
        inputs_at(m, t, x, u, held)
        rhs(t, x, k, held, f)
    else:
        rhs(t, x, k, u, f)


if HELD:

    def hold(m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS]):
        """Keep what dense output needs of a call."""
        for i in range(N_CONSTANTS):
            m.k[i] = k[i]
        if INPUT_FUNCTIONS:
            hold_inputs(m, u)
        elif INPUTS:
            m.u[:] = u


def moved(m: out[Motion], h: real, sum: real[N_STATE]) -> flag:
    """The step h, which adds sum to x + low, taken to the group; and the time.  Not made where that is
    not finite."""
    low: real[N_STATE]
    fault: var[real] = 0.0
    if PROJECTS:
        near: real[N_STATE]
        on: real[N_STATE]
        for i in range(N_STATE):
            low[i] = m.low[i] + sum[i]
            near[i] = m.x[i] + low[i]
        projected(near, on)
        for i in range(N_STATE):
            low[i] += on[i] - near[i]
            fault += low[i] - low[i]
    else:
        for i in range(N_STATE):
            low[i] = m.low[i] + sum[i]
            fault += low[i] - low[i]
    if not fault == 0.0:
        return False
    # a sum as a number and what its rounding leaves, for x larger than low or so
    for i in range(N_STATE):
        x: real = m.x[i] + low[i]
        if not DEVICE:
            m.start[i] = m.x[i]
        m.low[i] = low[i] - (x - m.x[i])
        m.x[i] = x
    rest: real = m.t_low + h
    t: real = m.t + rest
    m.t_low = rest - (t - m.t)
    m.t = t
    m.h = h
    if EVENTS:
        m.halted = INFINITY
    if ADAPTIVE:
        size: real[N_PARTS]
        sizes(m, m.x, size)
        m.size[:] = size
    return True


def fault_of(x: real[N_STATE], dx: real[N_STATE]) -> status:
    """Why there is no next state: the equations have no value there, or else no step is short enough."""
    sum: var[real] = 0.0
    for i in range(N_STATE):
        sum += x[i] - x[i] + (dx[i] - dx[i])
    if sum == 0.0:
        return NOT_CONVERGED
    return NOT_FINITE


def first_of(x: real[N_STATE], dx: real[N_STATE]) -> real:
    """A first step for a tolerance: a small turn of the state; any where that is 0 or does not move."""
    speed: var[real] = 0.0
    size: var[real] = 0.0
    for i in range(N_STATE):
        speed = abs(dx[i]) if abs(dx[i]) > speed else speed
        size = abs(x[i]) if abs(x[i]) > size else size
    return 0.1 * size / speed if speed > 0.0 and size > 0.0 else 1.0


def fault_here(m: Motion, k: real[N_CONSTANTS], u: real[N_INPUTS]) -> status:
    """Why no step of a motion is found."""
    dx: real[N_STATE]
    rate(m, m.t, m.x, k, u, dx)
    return fault_of(m.x, dx)


def first_step(m: Motion, k: real[N_CONSTANTS], u: real[N_INPUTS]) -> real:
    """A first step of a motion for a tolerance."""
    dx: real[N_STATE]
    rate(m, m.t, m.x, k, u, dx)
    return first_of(m.x, dx)


def towards(
    step: Step, m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], t1: real, tol: real
) -> status:
    """One step of its own size, or a smaller one where that is not made, towards the time t1."""
    left: real = t1 - m.t - m.t_low
    if not abs(left) < INFINITY:
        return NOT_FINITE
    size: real = abs(m.h_next) if abs(m.h_next) > 0.0 else first_step(m, k, u)
    h: var[real] = -size if left < 0.0 else size
    if abs(h) > abs(left) / 2.0:  # no sliver is left
        h = left if abs(h) > abs(left) * (1.0 - 1e-9) else left / 2.0
    while not step(m, k, u, h, tol if tol > 1e-15 else 1e-15):
        h = m.h_next
        if not abs(h) > LEAST * (abs(left) + abs(m.t)):
            return fault_here(m, k, u)
    if h == left:
        m.t = t1
        m.t_low = 0.0
    return OK


def up_to(
    step: Step, m: out[Motion], k: real[N_CONSTANTS], u: real[N_INPUTS], t1: real, tol: real
) -> status:
    """Such steps up to the time t1."""
    if DEVICE:
        # made or not, each is one turn of one loop: threads beside do not wait for one another
        if not abs(m.h_next) > 0.0:
            m.h_next = first_step(m, k, u)
        left: var[real] = t1 - m.t - m.t_low
        while left != 0.0:
            if not abs(left) < INFINITY:
                return NOT_FINITE
            h: var[real] = -abs(m.h_next) if left < 0.0 else abs(m.h_next)
            if abs(h) > abs(left) / 2.0:
                h = left if abs(h) > abs(left) * (1.0 - 1e-9) else left / 2.0
            if step(m, k, u, h, tol if tol > 1e-15 else 1e-15):
                if h == left:
                    m.t = t1
                    m.t_low = 0.0
            elif not abs(m.h_next) > LEAST * (abs(left) + abs(m.t)):
                return fault_here(m, k, u)
            left = t1 - m.t - m.t_low
    else:
        while t1 - m.t - m.t_low != 0.0:
            code: status = towards(step, m, k, u, t1, tol)
            if code != OK:
                return code
    return OK


def collocated(m: Motion, t: real, to: out[real[N_STATE]]): ...


def rk4_within(m: Motion, theta: real, to: out[real[N_STATE]]): ...


def vern9_within(m: Motion, theta: real, to: out[real[N_STATE]]): ...


def discrete_within(m: Motion, theta: real, to: out[real[N_STATE]]): ...


def dense(m: Motion, t: real, to: out[real[N_STATE]]):
    """The state at a time within the last step, by the polynomial that it is of."""
    if METHODS:
        theta: real = 1.0 + (t - m.t - m.t_low) / m.h if m.method != 0 else 0.0
        if RK4:
            if m.method == RK4:
                rk4_within(m, theta, to)
                return
        if VERN9:
            if m.method == VERN9:
                vern9_within(m, theta, to)
                return
        if DISCRETE:
            if m.method == DISCRETE:
                discrete_within(m, theta, to)
                return
    if GAUSS:
        collocated(m, t, to)
    else:
        to[:] = m.x
