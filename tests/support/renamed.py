"""A record whose parameters have other names."""

from dataclasses import replace

NAMES = """
    a b c d e h i j k l m n p q r s t_ x y z A B C E F G H J K M N P Q R S T U V X Y Z ab ba
    xy x1 x_1 x12 x_12 y1 y_1 k12 k_12 Tr det dm dt dT dd mu rho rho1 rho_1 sigma_1 d_11 d11
    d_1 J_3 J_11 c_9 m_1 m1 M_ab E_a r_1 r_i I_c U_Q p_b N_c w_c si cos_1 sn pi_2 lambda
    Lambda phi Omega omega_3 mass s_max a1_2 a12 x_123 zeta zeta_1 alpha delta delta_A Sigma
    in_ os sp An ca
""".split()  # noqa: SIM905
"""Of those that a problem may have, the ones that are hardest to print apart."""


def renamed(d, draw):
    """The record with names drawn for all parameters but its moments."""
    parameters = d.problem["parameters"]
    kept = [*parameters] if d.problem["body"]["kind"] == "moments" else []
    kept = [x for x in kept if x[0] in "mcJ"]
    free = [x for x in NAMES if x not in kept]
    new = dict(
        zip([x for x in parameters if x not in kept], draw.sample(free, len(free)), strict=False)
    )
    problem = {**d.problem, "parameters": {new.get(x, x): y for x, y in parameters.items()}}

    def of(t):
        if isinstance(t, tuple) and t[0] == "par":
            return ("par", new.get(t[1], t[1]))
        return (t[0], *map(of, t[1:])) if isinstance(t, tuple) else t

    steps = tuple(
        replace(s, equations=tuple(replace(e, lhs=of(e.lhs), rhs=of(e.rhs)) for e in s.equations))
        for s in d.steps
    )
    return replace(d, problem=problem, steps=steps)
