"""The steps of the note for any group: orbit, Lagrangian, pull-back, Cartan form, dϖ, kernel."""
