"""The same experiment with rigid disks and with soft contacts, side by side: scripts/compare_hard_soft.py.

* :mod:`cases`: one run of an experiment, and which runs a comparison needs;
* :mod:`runs`: runs in processes of their own, side by side, kept for a resume;
* :mod:`slopes`, :mod:`biaxials`: the experiments, and what is read from their records;
* :mod:`outcomes`: what every experiment hands to the comparison;
* :mod:`deposits`: areas of deposits and of their overlap;
* :mod:`precision`: errors against a reference, scatter, work and precision, rates of convergence;
* :mod:`cost`: wall time at the paper's scale, on several threads;
* :mod:`summary`, :mod:`answers`, :mod:`figures`, :mod:`report`: what comes out.
"""
