"""The gravity of a homogeneous ellipsoid on itself, U = −(3/10) G m² ∫₀^∞ du / √det(S + u)."""

from ..kind import Own, Potential
from ..table import Scalar

_OF_INVARIANTS = {
    "Ψ": ("∫₀^∞ du / √P(u)", r"\Psi"),
    "Ψ_0": ("∫₀^∞ du / P(u)^(3/2)", r"\Psi_0"),
    "Ψ_1": ("∫₀^∞ u du / P(u)^(3/2)", r"\Psi_1"),
    "Ψ_2": ("∫₀^∞ u² du / P(u)^(3/2)", r"\Psi_2"),
}
_P = "P(u) = u³ + I₁u² + I₂u + I₃"


class SelfGravity(Potential):
    """``G``: the constant of gravitation.  The ellipsoid {⟨r, K⁻¹r⟩ ≤ 1} of the body is carried to
    {⟨x, S⁻¹x⟩ ≤ 1}, S = AKĀ."""

    kind, phrase, alone = "self_gravity", "its own gravity", True
    legend = "The gravity of the body on itself is not drawn."
    needs = ("deformations of R^3", "one ellipsoid")
    unturned = "the gravity of a body on itself"
    letters = (
        Own(
            "K_G",
            "matrix",
            "matrix of the ellipsoid {⟨r, K_G⁻¹r⟩ ≤ 1} that the body fills",
            "matrice de l’ellipsoïde {⟨r, K_G⁻¹r⟩ ≤ 1} que remplit le corps",
            "K_G",
        ),
        Own("A_a", "matrix", "adjugate of A", "matrice adjointe de A", "A_a"),
        Own("C_a", "matrix", "adjugate of ĀA", "matrice adjointe de ĀA", "C_a"),
        Own("K_a", "matrix", "adjugate of K_G", "matrice adjointe de K_G", "K_a"),
        *(
            Own(
                f"I_{k}",
                "scalar",
                f"coefficient of u^{3 - k} in det(AK_GĀ + u)",
                f"coefficient de u^{3 - k} dans det(AK_GĀ + u)",
                f"I_{k}",
            )
            for k in (1, 2, 3)
        ),
        *(
            Own(x, "of invariants", f"{text}, with {_P}", f"{text}, où {_P}", latex)
            for x, (text, latex) in _OF_INVARIANTS.items()
        ),
        Own("U_G", "scalar", "energy of self-gravity", "énergie d’autogravitation", "U_G"),
        Own(
            "B_G",
            "matrix",
            "twice the derivative of U_G with respect to ĀA",
            "deux fois la dérivée de U_G par rapport à ĀA",
            "B_G",
        ),
    )
    G: Scalar
