"""Whether YADE has loaded the plugin's engines."""
import ctypes
import os

__all__ = ["require"]


def require():
    """Raise RuntimeError, with the reason, unless the engines of this plugin are in YADE."""
    import yade.config

    gate = os.path.join(yade.config.libDir, "libnonsmooth.so")
    if not os.path.exists(gate):
        raise RuntimeError(
            "the engines of yade-nonsmooth are not in this YADE (%s is missing): run the script with "
            "scripts/yade-nonsmooth, or install the plugin with cmake --install" % gate
        )
    refusal = ctypes.CDLL(gate).nonsmooth_refusal
    refusal.restype = ctypes.c_char_p
    reason = refusal().decode()
    if reason:
        raise RuntimeError(reason)
