"""The gravity of a homogeneous ellipsoid on itself, U = −(3/10) G m² ∫₀^∞ du / √det(S + u)."""

from ..kind import Own, Potential
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
    letters = (
        Own(
            "K_G",
            "matrix",
            "matrix of the ellipsoid {⟨r, K_G⁻¹r⟩ ≤ 1} that the body fills",
            "matrice de l’ellipsoïde {⟨r, K_G⁻¹r⟩ ≤ 1} que remplit le corps",
            "K_G",
        ),
        Own("X_G", "matrix", "K_GĀA", "K_GĀA", "X_G"),
        Own("A_a", "matrix", "adjugate matrix of A", "matrice complémentaire de A", "A_a"),
        Own("C_a", "matrix", "adjugate matrix of ĀA", "matrice complémentaire de ĀA", "C_a"),
        Own("K_a", "matrix", "adjugate matrix of K_G", "matrice complémentaire de K_G", "K_a"),
        Own(
            "I_1",
            "scalar",
            "coefficient of u² in det(AK_GĀ + u)",
            "coefficient de u² dans det(AK_GĀ + u)",
            "I_1",
        ),
        Own(
            "I_2",
            "scalar",
            "coefficient of u in det(AK_GĀ + u)",
            "coefficient de u dans det(AK_GĀ + u)",
            "I_2",
        ),
        Own("I_3", "scalar", "det(AK_GĀ)", "det(AK_GĀ)", "I_3"),
        Own(
            "Ψ",
            "of invariants",
            "∫₀^∞ du / √P(u), with P(u) = u³ + I₁u² + I₂u + I₃",
            "∫₀^∞ du / √P(u), où P(u) = u³ + I₁u² + I₂u + I₃",
            r"\Psi",
        ),
        Own(
            "Ψ_0",
            "of invariants",
            "∫₀^∞ du / P(u)^(3/2), with P(u) = u³ + I₁u² + I₂u + I₃",
            "∫₀^∞ du / P(u)^(3/2), où P(u) = u³ + I₁u² + I₂u + I₃",
            r"\Psi_0",
        ),
        Own(
            "Ψ_1",
            "of invariants",
            "∫₀^∞ u du / P(u)^(3/2), with P(u) = u³ + I₁u² + I₂u + I₃",
            "∫₀^∞ u du / P(u)^(3/2), où P(u) = u³ + I₁u² + I₂u + I₃",
            r"\Psi_1",
        ),
        Own(
            "Ψ_2",
            "of invariants",
            "∫₀^∞ u² du / P(u)^(3/2), with P(u) = u³ + I₁u² + I₂u + I₃",
            "∫₀^∞ u² du / P(u)^(3/2), où P(u) = u³ + I₁u² + I₂u + I₃",
            r"\Psi_2",
        ),
        Own("U_G", "scalar", "energy of self-gravity", "énergie d’autogravitation", "U_G"),
        Own(
            "B_G",
            "matrix",
            "matrix with δU_G = ½ Tr B_G δ(ĀA)",
            "matrice telle que δU_G = ½ Tr B_G δ(ĀA)",
            "B_G",
        ),
    )
    G: Positive
