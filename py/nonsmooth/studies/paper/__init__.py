"""The paper's results beside ours: readings of what it leaves open, control runs of its slope, their figures."""
