"""Impacts: restitution, head-on and oblique, and a chain of disks."""
