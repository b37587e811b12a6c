"""Bonds: thresholds in each mode and combined, and a bridge of bonded disks."""
