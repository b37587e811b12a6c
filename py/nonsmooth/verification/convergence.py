"""Strength, failure and runout against time step and tolerance."""
