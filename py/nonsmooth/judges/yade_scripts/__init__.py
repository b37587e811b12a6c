"""YADE's own scripts, run with rigid contacts: which run, what they show, and which are refused with what message.

A script "runs", or "differs" where it runs but its spheres are not where those of the soft run are, or its own check
finds springs missing; it "overlaps" where bodies are more than 1 % of a radius in each other at its end, is "refused"
by a message of ours, "lacks" what this YADE or this machine has not (it ends in the same way as it is), is "stopped"
after too long, or "fails".
"""
