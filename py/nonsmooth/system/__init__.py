"""The machine below: whole files, folders of output, keys, where YADE is, what a function may be given. Needs no YADE.

* ``checks``: what a function asks of the values that it is given; ``parameters``: the same for a script;
* ``whole_files``, ``output_folder``: files that are whole or not there, folders that belong to one run;
* ``keys``, ``cache``: what a result that is kept was made of, and where it lies;
* ``installation``, ``requirements``, ``plugin``, ``machine``: which YADE, which packages, what it runs on.
"""
