"""A master between nodes and the real one, which notes every parameter that a node asks for."""

from __future__ import annotations

import threading
import xmlrpc.client
from collections.abc import Iterator
from contextlib import contextmanager
from socketserver import ThreadingMixIn
from typing import Any
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

_KEY_AT = {"getParam": 1, "hasParam": 1, "subscribeParam": 2}


class _Handler(SimpleXMLRPCRequestHandler):
    rpc_paths = ()

    def log_message(self, *_: Any) -> None:
        """Keep quiet."""


class Recording(ThreadingMixIn, SimpleXMLRPCServer):
    """Forwards every call."""

    daemon_threads = True

    def __init__(self, master: str) -> None:
        SimpleXMLRPCServer.__init__(self, ("127.0.0.1", 0), _Handler, logRequests=False, allow_none=True)
        self._master = master
        self.asked: set[tuple[str, str]] = set()

    @property
    def uri(self) -> str:
        return f"http://127.0.0.1:{self.server_address[1]}"

    def _dispatch(self, method: str, params: Any) -> Any:
        if method in _KEY_AT:
            self.asked.add((str(params[0]), str(params[_KEY_AT[method]]).rstrip("/")))
        with xmlrpc.client.ServerProxy(self._master, allow_none=True) as master:
            return getattr(master, method)(*params)


@contextmanager
def recording(master: str) -> Iterator[Recording]:
    server = Recording(master)
    threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True).start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
