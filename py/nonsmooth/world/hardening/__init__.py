"""A scene that a script has built for soft contacts, turned into one of rigid contacts: :func:`harden`."""

from .scene import Hardened, HardenError, harden

__all__ = ["HardenError", "Hardened", "harden"]
