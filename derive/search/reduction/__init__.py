"""Routh reduction by symmetries that commute: the locked inertia, the effective potential."""
