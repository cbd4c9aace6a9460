"""Records of what was observed of each module: who saw it, when, on what, with which result."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from importlib.metadata import version

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.view import View
from ecm_checker.wire import (
    EvidenceFinding,
    EvidenceKind,
    EvidenceRecord,
    EvidenceResult,
    EvidenceSubject,
    LookedAt,
    Witness,
)

from ecm_extract.contract_digest import contract_digest
from ecm_extract.observe.expected import graph_keys, is_exact
from ecm_extract.observe.model import Observation
from ecm_extract.observe.watch import Watch

_TOOL = "ecm-extract"


class Run(msgspec.Struct, frozen=True):
    """What a run was: who looked, by name, and what it shows of the release."""

    witness: str
    kind: EvidenceKind = "observation"


class _Count(msgspec.Struct, frozen=True):
    promised: int
    seen: int


def records(watch: Watch, findings: Sequence[Finding], run: Run) -> tuple[EvidenceRecord, ...]:
    """Return a record for each module that can run.

    Args:
        watch: what was seen, beside contracts.
        findings: what `compare` said of it.
        run: what it was.
    """
    looked = LookedAt(watch.seen.source, watch.seen.target, watch.seen.senses, digest(watch.seen))
    by = Witness(run.witness, _TOOL, version(_TOOL))
    found = (_record(watch, module, findings, looked, by) for module in watch.modules)
    return tuple(msgspec.structs.replace(each, kind=run.kind) for each in found)


def document(found: Iterable[EvidenceRecord]) -> str:
    """Records as JSON, one a line."""
    return "".join(f"{msgspec.json.encode(record, order='deterministic').decode()}\n" for record in found)


def digest(seen: Observation) -> str:
    """What the source gives, else SHA-256 over everything that was seen."""
    return seen.digest or _hashed(msgspec.json.encode(seen, order="deterministic"))


def _record(watch: Watch, module: View, findings: Sequence[Finding], looked: LookedAt, by: Witness) -> EvidenceRecord:
    nodes = tuple(each.node for each in watch.running if each.module is module)
    against = [each for each in findings if module.id in each.subjects or not set(nodes).isdisjoint(each.subjects)]
    count = _counted(watch, module, nodes)
    identity = module.contract.ecm
    return EvidenceRecord(
        schema="ecm-extract/evidence/1",
        kind="observation",
        subject=EvidenceSubject(module.package, identity.version, module.id, contract_digest(module.contract)),
        result=_result(watch, module, count, against) if nodes or count.seen else "not_seen",
        by=by,
        begun=watch.seen.begun,
        seconds=watch.seen.seconds,
        on=looked,
        nodes=nodes,
        promised=count.promised,
        seen=count.seen,
        findings=tuple(_finding(each) for each in against),
    )


def _result(watch: Watch, module: View, count: _Count, against: Sequence[Finding]) -> EvidenceResult:
    """Of a module that was seen; a part of what it promises, and what may be another module, confirm nothing."""
    severities = {each.severity for each in against}
    if "error" in severities:
        return "contradicted"
    whole = 0 < count.promised == count.seen and module.id not in watch.rivals
    return "confirmed" if whole and "warning" not in severities and not watch.seen.gaps else "doubtful"


def _counted(watch: Watch, module: View, nodes: Sequence[str]) -> _Count:
    """Endpoints with a fixed name and a role that the source can see, on its nodes, or of nodes that nobody told."""
    promises = [each for each in watch.promises_of(module, nodes) if is_exact(each)]
    keys = [graph_keys(each) for each in promises]
    seen = watch.keys_of(nodes)
    visible = [each for each in keys if any(role in watch.visible_roles for role, _ in each)]
    return _Count(len(visible), sum(any(key in seen for key in each) for each in visible))


def _finding(each: Finding) -> EvidenceFinding:
    return EvidenceFinding(each.rule, each.severity, each.certainty, each.fingerprint, each.message)


def _hashed(data: bytes) -> str:
    return f"sha256:{hashlib.sha256(data).hexdigest()}"
