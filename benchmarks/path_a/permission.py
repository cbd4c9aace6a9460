"""Permissions: a commander that the policy does not let command, denied by the plugins of DDS security."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from shutil import which

import yaml

from path_a.keystore import Keystore
from path_a.predictions import Predicted, check, manifest, rules
from path_a.qos import LOOPBACK
from path_a.ros1 import PROGRAMS
from path_a.row import FIXTURES, Case, NotMeasured, Observed

SAMPLES = 80
_POLICIES = ("ward", "driver")
_TOPIC = "/cmd_vel"
_DENYING = "PERM005"
_PATIENCE_S = 90
_NEEDS = "needs DDS security, which the wheel of Cyclone DDS lacks: apt-get install libddsc0debian openssl"


@dataclass(frozen=True)
class _Said:
    data: dict[str, int | bool]
    words: str


def measure(repetitions: int) -> Sequence[Case]:
    try:
        library = _library()
    except NotMeasured as reason:
        return [_case(name, (), str(reason)) for name in _POLICIES]
    return [
        _case(name, [_repetition(library, name, denied=bool(_against(name))) for _ in range(repetitions)])
        for name in _POLICIES
    ]


def _library() -> Path:
    """The Cyclone DDS of Debian; its plugins lie in a folder beside it."""
    for plugin in Path("/usr/lib").glob("*/libddsc0debian/libdds_security_ac.so"):
        library = plugin.parents[1] / "libddsc.so.0debian"
        if library.exists() and which("openssl"):
            return library
    raise NotMeasured(_NEEDS)


def _file(policy: str) -> Path:
    return FIXTURES / "policies" / f"{policy}.yaml"


def _against(policy: str) -> tuple[Predicted, ...]:
    """Accesses of the commander that a policy does not grant."""
    found = check("install", manifest("cmd_vel_robot", "teleop"), "--policy", str(_file(policy)))
    return tuple(each for each in found if each.rule == _DENYING)


def _case(policy: str, observed: Sequence[Observed], missing: str = "") -> Case:
    found = _against(policy)
    expected = f"its access to {_TOPIC} is denied" if found else f"all its {SAMPLES} commands arrive"
    return Case(f"commander under the policy {policy}", f"{expected} ({rules(found)})", tuple(observed), missing)


def _repetition(library: Path, policy: str, *, denied: bool) -> Observed:
    """The base is let read commands; the commander is let do what the policy says."""
    grants = yaml.safe_load(_file(policy).read_text("utf-8"))["data"]
    with tempfile.TemporaryDirectory() as folder:
        keys = Keystore(Path(folder))
        reader = _start(library, "read", keys.enrol("base", [f"read:{_TOPIC}"]))
        assert reader.stdout is not None
        reader.stdout.readline()
        writer = _start(library, "write", keys.enrol("teleop", grants))
        wrote, got = _said(writer), int(_said(reader).data["got"])
    what = f"is refused: {wrote.words}" if wrote.data["denied"] else f"sends {wrote.data['sent']}"
    as_predicted = (bool(wrote.data["denied"]) and got == 0) if denied else got == SAMPLES
    return Observed(f"the commander {what}; {got} of {SAMPLES} arrive", as_predicted)


def _start(library: Path, what: str, files: Mapping[str, Path]) -> subprocess.Popen[str]:
    domain = str(100 + os.getpid() % 60)
    program = str(PROGRAMS / "secured_peer.py")
    line = [sys.executable, program, what, str(library), domain, f"rt{_TOPIC}", str(SAMPLES)]
    environment = {**os.environ, "CYCLONEDDS_URI": _configuration(library, files)}
    return subprocess.Popen(line, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def _said(process: subprocess.Popen[str]) -> _Said:
    """What the program says, and what its middleware does, without time and process."""
    text, errors = process.communicate(timeout=_PATIENCE_S)
    if process.returncode:
        message = f"DDS security does not come up: {errors.strip()}"
        raise NotMeasured(message)
    return _Said(json.loads(text.strip().splitlines()[-1]), errors.strip().partition(": ")[2])


def _configuration(library: Path, files: Mapping[str, Path]) -> str:
    """Loopback, and who this is."""
    plugins = library.parent / "libddsc0debian"
    uri = {what: f"file:{path}" for what, path in files.items()}

    def loaded(plugin: str, part: str) -> str:
        path = plugins / f"libdds_security_{plugin}.so"
        return f'<Library path="{path}" initFunction="init_{part}" finalizeFunction="finalize_{part}"/>'

    security = (
        f"<Authentication>{loaded('auth', 'authentication')}<IdentityCertificate>{uri['certificate']}"
        f"</IdentityCertificate><IdentityCA>{uri['authority']}</IdentityCA><PrivateKey>{uri['key']}</PrivateKey>"
        f"</Authentication><Cryptographic>{loaded('crypto', 'crypto')}</Cryptographic>"
        f"<AccessControl>{loaded('ac', 'access_control')}<Governance>{uri['governance']}</Governance>"
        f"<PermissionsCA>{uri['authority']}</PermissionsCA><Permissions>{uri['permissions']}</Permissions>"
        f"</AccessControl>"
    )
    return LOOPBACK.replace("</Discovery>", f"</Discovery><Security>{security}</Security>")
