"""The discrete road: a Lagrangian of two elements of the group, its one-forms, their motion."""
