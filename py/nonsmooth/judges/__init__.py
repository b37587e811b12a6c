"""What the rest is held against: checks with known answers, and speed. Not installed with the package; ``scripts/verify.py`` and ``scripts/benchmark.py`` find them in the checkout."""
