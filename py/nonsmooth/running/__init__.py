"""Runs as processes: begun, watched, stopped, kept, side by side. Needs no YADE in the process that plans."""
