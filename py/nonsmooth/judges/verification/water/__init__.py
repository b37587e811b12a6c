"""Water: how it seeps, what it does to disks, and what a section makes of it."""
