"""Endpoints that a call makes beside the one it names: a camera has `camera_info` in the namespace of its image."""

from __future__ import annotations

import msgspec
from ecm_checker.contract import Interface

from ecm_extract.link.forms import Form


def companion(interface: Interface, form: Form) -> Interface:
    """Return the second endpoint of a row with `beside`."""
    name = beside(interface.name, form.beside)
    changes = {"name": name, "raw_name": beside(interface.raw_name, form.beside), "type": form.beside_type}
    return msgspec.structs.replace(interface, **changes, confidence="pattern" if "{" in name else interface.confidence)


def beside(name: str, leaf: str) -> str:
    """Return a name in the namespace of another; a hole at the end of that one may hold any namespace."""
    head, slash, last = name.rpartition("/")
    if "{" in last or "}" in last:
        return f"/{{{leaf}}}" if name.startswith("/") else f"{{{leaf}}}"
    private = "~" if not slash and last.startswith("~") else ""
    return f"{head}{slash}{private}{leaf}"
