"""Hand-made extractions for the tests of the reports."""

from __future__ import annotations

from ecm_checker.contract import Contract, Evidence, Identity, Interface, Qos, Signature, Source
from ecm_checker.fields import missing_fields

from ecm_extract.extraction_model import Counts, Extraction, LocatedDiagnostic, PackageContracts


def make_module(package: str, module: str, *interfaces: Interface) -> Contract:
    identity = Identity(f"ecm.{package}.{module}", package, "node", "1.2.0", Source(None, None, "."), 2)
    contract = Contract(identity, Signature(interfaces=interfaces))
    return Contract(identity, contract.signature, missing=missing_fields(contract))


def make_package(name: str, *modules: Contract, path: str = ".") -> PackageContracts:
    return PackageContracts(name, "1.2.0", path, 2, modules)


def make_extraction(*packages: PackageContracts, diagnostics: tuple[LocatedDiagnostic, ...] = ()) -> Extraction:
    return Extraction("robot", "0123456789abcdef", packages, diagnostics, 1.25, Counts(12, 34_000))


CMD_VEL = Interface(
    "publisher",
    "/cmd_vel",
    "cmd_vel",
    "geometry_msgs/msg/Twist",
    Qos("reliable", "volatile", "keep_last", 10),
    None,
    "literal",
    (Evidence("src/base.cpp", 41),),
)
COMPUTED = Interface(
    "subscriber", "/{name}/odom", "{name}/odom", None, None, None, "pattern", (Evidence("src/base.cpp", 50),)
)
BAD_MESSAGE = LocatedDiagnostic("error", "msg-bad-field", "base/msg/A.msg", 3, "no such type; check the name")


def demo() -> Extraction:
    base = make_package("base", make_module("base", "driver", CMD_VEL, COMPUTED), path="base")
    return make_extraction(base, make_package("empty", path="empty"), diagnostics=(BAD_MESSAGE,))
