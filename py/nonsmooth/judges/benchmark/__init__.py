"""How fast steps and sweeps are on this machine: ``scripts/benchmark.py`` runs these measurements and writes ``benchmark.json``.

* :mod:`states`: the slope at rest, on the move, and on soft contacts, made once and kept;
* :mod:`soft_contacts`: YADE's own soft contacts on the same disks;
* :mod:`steps`: whole time steps, by stage;
* :mod:`sweeps`: sweeps alone, by the path that the solver takes, and the bound that memory sets;
* :mod:`cold_start`: sweeps that a problem needs from zero impulses;
* :mod:`scale`: steps, memory and packing for slopes of very different size;
* :mod:`machine`: what the numbers were measured on;
* :mod:`statistics`: medians and quartiles;
* :mod:`course`: functions in processes, one after the other;
* :mod:`suite`, :mod:`report`: all of it, and what it says together.
"""
