"""Reports as one HTML page with its pictures in it: the frame of a page, its tables and its figures stand here; what it
says, with who reports.
"""

from .page import write

__all__ = ["write"]
