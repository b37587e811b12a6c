"""The same experiment with rigid and with soft contacts, side by side: scripts/compare_hard_soft.py.

* :mod:`options`: what the command takes, and what of it applies to which experiment;
* :mod:`cases`: one run of an experiment, and which runs a comparison needs;
* :mod:`losses`: bonds of the soft runs, and what their model does not have;
* :mod:`course`: a comparison from its plan to its report;
* :mod:`runs`: runs in processes of their own, side by side, kept for a resume;
* :mod:`slopes`, :mod:`biaxials`, :mod:`collapses`, :mod:`spheres`: the experiments, and what is read from their records;
* :mod:`outcomes`: what every experiment hands to the comparison;
* :mod:`deposits`: areas of deposits and of their overlap;
* :mod:`precision`: errors against a reference, scatter, work and precision, rates of convergence;
* :mod:`cost`: wall time at the paper's scale, on several threads;
* :mod:`summary`, :mod:`answers`, :mod:`figures`, :mod:`report`: what comes out;
* :mod:`common`: sections of the report that several experiments have; :mod:`slope_report`, :mod:`biaxial_report`,
  :mod:`collapse_report`, :mod:`triaxial_report`, :mod:`cost_report`: those of one or two.
"""
