"""Identities and signed documents of DDS security, made by openssl for one run: who may write and read which topics."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

_CURVE = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
_GOVERNANCE = """<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
<domains><id_range><min>0</min><max>230</max></id_range></domains>
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>NONE</discovery_protection_kind>
<liveliness_protection_kind>NONE</liveliness_protection_kind>
<rtps_protection_kind>NONE</rtps_protection_kind>
<topic_access_rules><topic_rule>
<topic_expression>*</topic_expression>
<enable_discovery_protection>false</enable_discovery_protection>
<enable_liveliness_protection>false</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>NONE</metadata_protection_kind>
<data_protection_kind>NONE</data_protection_kind>
</topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
"""
_PERMISSIONS = """<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="{name}">
<subject_name>CN={name}</subject_name>
<validity><not_before>2020-01-01T00:00:00</not_before><not_after>2099-01-01T00:00:00</not_after></validity>
{rules}<default>DENY</default>
</grant></permissions></dds>
"""
_RULE = """<allow_rule><domains><id_range><min>0</min><max>230</max></id_range></domains>
<{way}><topics><topic>{topic}</topic></topics></{way}></allow_rule>
"""
_WAYS = {"write": "publish", "read": "subscribe"}


class Keystore:
    """A folder with an authority, and what it has signed."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._make("req", "-x509", *_CURVE, "-subj", "/CN=authority", "-keyout", "ca.key", "-out", "ca.pem")
        self._sign("governance", _GOVERNANCE)

    def enrol(self, name: str, grants: Iterable[str]) -> dict[str, Path]:
        """Files of an identity that may do what its grants say (`write:/odom`), and nothing else."""
        rules = "".join(_rule(grant) for grant in grants)
        self._sign(name, _PERMISSIONS.format(name=name, rules=rules))
        self._make("req", *_CURVE, "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out", f"{name}.csr")
        signed = ("-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-days", "2")
        self._make("x509", "-req", "-in", f"{name}.csr", *signed, "-out", f"{name}.pem")
        files = {
            "authority": "ca.pem",
            "certificate": f"{name}.pem",
            "key": f"{name}.key",
            "governance": "governance.p7s",
            "permissions": f"{name}.p7s",
        }
        return {what: self._folder / file for what, file in files.items()}

    def _sign(self, name: str, text: str) -> None:
        (self._folder / f"{name}.xml").write_text(text, "utf-8")
        line = ("smime", "-sign", "-text", "-in", f"{name}.xml", "-out", f"{name}.p7s")
        self._make(*line, "-signer", "ca.pem", "-inkey", "ca.key")

    def _make(self, *arguments: str) -> None:
        subprocess.run(["openssl", *arguments], cwd=self._folder, check=True, capture_output=True)


def _rule(grant: str) -> str:
    way, _, topic = grant.partition(":")
    return _RULE.format(way=_WAYS[way], topic=f"rt{topic}")
