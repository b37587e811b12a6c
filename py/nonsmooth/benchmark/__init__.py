"""How fast steps and sweeps are on this machine: ``scripts/benchmark.py`` runs these measurements and writes ``benchmark.json``.

* :mod:`states`: the slope at rest and on the move, made once and kept;
* :mod:`steps`: whole time steps, by stage;
* :mod:`soft_step`: steps of YADE's own soft contacts on the same disks;
* :mod:`sweeps`: sweeps alone, by the path that the solver takes, and the bound that memory sets;
* :mod:`cold_start`: sweeps that a problem needs from zero impulses;
* :mod:`scale`: the same for slopes of very different size;
* :mod:`machine`: what the numbers were measured on;
* :mod:`statistics`: medians and quartiles;
* :mod:`suite`, :mod:`report`: all of it, and what it says together.
"""
