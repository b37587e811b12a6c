"""Changes that compute the same for every input, or what nobody can be asked to test: the generators leave them out.

{(file, what stands there, what takes its place): reason}, both texts as the table of `random_mutants.py` shows them.
"""

SAME = {}
