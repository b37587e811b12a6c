"""The servers that YADE's main program opens, and how to shut them.

The launcher and the programs of the build folder start YADE without them. Plain ``yade`` opens two, to all interfaces:
a Python prompt (ports from 9000) that anyone who finds its cookie of six letters can use, and an XMLRPC server (ports
from 21000) whose ``stop()`` asks for no cookie.
"""

from __future__ import annotations

import gc
import socketserver

__all__ = ["close"]


def close():
    """Shuts the servers that YADE has opened in this process, and returns their ports. Where there are none it does
    nothing.
    """
    from yade import remote

    ports = []
    # YADE keeps no name for them; by type(), since a dead weak reference cannot be asked for its class
    for server in [
        o for o in gc.get_objects() if issubclass(type(o), socketserver.TCPServer) and o.socket.fileno() >= 0
    ]:
        if (
            isinstance(getattr(server, "instance", None), remote.InfoProvider)
            or server.RequestHandlerClass is remote.PythonConsoleSocketEmulator
        ):
            ports.append(server.server_address[1])
            server.shutdown()  # ends its thread, which may be about to accept
            server.server_close()
    return sorted(ports)
