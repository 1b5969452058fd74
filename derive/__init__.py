"""derive: equations of motion by the road  L → L̃ on a group → ϖ → dϖ → kernel."""

__version__ = "0.1.0"
