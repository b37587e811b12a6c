"""The same problems solved by Siconos."""
