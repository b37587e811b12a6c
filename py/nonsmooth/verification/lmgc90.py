"""A packing at rest by LMGC90."""
