"""Sweeps that the solver needs, and its stopping tests."""
