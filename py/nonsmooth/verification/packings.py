"""Packings: macroscopic friction without friction, and the statistics of forces."""
