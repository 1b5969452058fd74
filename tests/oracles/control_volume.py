"""The balances of momentum of a body from which mass flows, as those of a control volume."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Leaking:
    """Points at places of a body along its axes in R³, and what leaves at its exits: functions of
    the time, the masses of the former and their rates, the rates and the velocities of the latter
    relative to the body; ``g``: the acceleration of gravity in space; ``steady``: has the momentum
    of what flows inside, relative to the body, no rate?"""

    places: np.ndarray
    exits: np.ndarray
    masses: Callable
    mass_rates: Callable
    rates: Callable
    velocities: Callable
    g: tuple = (0, 0, -9.81)
    steady: bool = False

    def unbalanced(self, t, A, spin, speed, d_spin, d_speed):
        """What is left of the balances of angular and linear momentum, along the axes of a body in
        R³ and about its origin, of all that is in the body, what flows there with it; and their
        size.  A of the plane turns that of the last two axes about the first."""
        places, exits = np.array(self.places, float), np.array(self.exits, float)
        if np.shape(A) == (2, 2):
            places[:, 0], exits[:, 0] = 0, 0
            A = np.block([[np.eye(1), np.zeros((1, 2))], [np.zeros((2, 1)), A]])

        def momenta(s):
            w, v, m = spin + (s - t) * d_spin, speed + (s - t) * d_speed, self.masses(s)
            at = t if self.steady else s
            flowing = self.mass_rates(at) @ places - self.rates(at) @ exits
            turning = sum(x * np.cross(r, np.cross(w, r)) for x, r in zip(m, places, strict=True))
            linear = m.sum() * v + np.cross(w, m @ places) + flowing
            return np.concatenate([turning + np.cross(m @ places, v), linear])

        now, change = momenta(t), np.imag(momenta(t + 1e-30j)) / 1e-30
        H, P = now[:3], now[3:]
        u = self.velocities(t) * ([0, 1, 1] if not places[:, 0].any() else 1)
        leaving = speed + np.cross(spin, exits) + u
        g, m, rates = A.T @ self.g, self.masses(t), self.rates(t)
        terms = [
            change,
            np.concatenate([np.cross(spin, H) + np.cross(speed, P), np.cross(spin, P)]),
            -np.concatenate([np.cross(m @ places, g), m.sum() * g]),
            -np.concatenate([rates @ np.cross(exits, leaving), rates @ leaving]),
        ]
        return sum(terms), max(np.abs(x).max() for x in terms)

    def unbalanced_of(self, t, A, velocity, found):
        """The same for the velocity of a state on SE(n), SO(n), n = 2, 3, and its rate: of a body
        about a fixed point, whose reaction is not known, the moments alone."""
        n, turns = len(A), 3 if len(A) == 3 else 1
        moves = len(velocity) > turns

        def embedded(v):
            shift = v[turns:] if moves else np.zeros(n)
            if n == 3:
                return v[:3], shift
            return np.array([v[0], 0, 0]), np.array([0, *shift])

        left, size = self.unbalanced(t, A, *embedded(velocity), *embedded(found))
        kept = left if moves else left[:3]
        return kept if n == 3 else kept[[0, 4, 5]] if moves else kept[:1], size
