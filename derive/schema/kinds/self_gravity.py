"""The gravity of a homogeneous ellipsoid on itself, U = −(3/10) G m² ∫₀^∞ du / √det(S + u)."""

from ..kind import Potential
from ..table import Positive


class SelfGravity(Potential):
    """``G``: the constant of gravitation.  The ellipsoid {⟨r, K⁻¹r⟩ ≤ 1} of the body is carried to
    {⟨x, S⁻¹x⟩ ≤ 1}, S = AKĀ.

    Ψ and Ψ_k, of I_1, I_2 and I_3, are integrals with P(u) = u³ + I₁u² + I₂u + I₃ = det(S + u).
    """

    kind, phrase, alone = "self_gravity", "its own gravity", True
    linear = True  # in the place, inside a homogeneous ellipsoid (Newton, Maclaurin)
    legend = "The gravity of the body on itself is not drawn."
    needs = ("deformations of R^3", "one ellipsoid")
    unturned = "the gravity of a body on itself"
    G: Positive
