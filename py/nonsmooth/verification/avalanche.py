"""A whole avalanche: energy, residuals, bonds."""
