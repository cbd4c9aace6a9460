"""How the name that is used and the one that is provided compare: one row for each way of the vocabulary."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Final

import msgspec

from ecm_checker.hub.package import folders_of
from ecm_checker.hub.provision import ABOVE, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.class_names import last_of, named_in
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.generated import python_names, section_owners
from ecm_checker.match.hierarchy import Bases
from ecm_checker.match.spelling import (
    graph_name_matches,
    node_matches,
    parameter_name_matches,
    whole_name_matches,
)
from ecm_checker.match.ways import Ways


class Site(msgspec.Struct, frozen=True):
    """A requirement where it stands, and what the providing side knows.

    Attributes:
        folders: packages by what stands first in the includes of their headers.
        bound: dotted names that Python modules offer without declaring them.
        bases: its class hierarchy. ways: to its objects.
    """

    requirement: Requirement
    consumer: Consumer
    folders: Mapping[str, frozenset[str]]
    bound: frozenset[str]
    bases: Bases
    ways: Ways

    @property
    def path(self) -> str:
        """Of the file that requires."""
        return self.requirement.evidence[0].path


class Names(msgspec.Struct, frozen=True):
    """A way to compare names.

    Attributes:
        keys: what provisions are looked up by, of a requirement.
        meant: whether a requirement means one of them.
        whole: whether the name of a requirement has all the text of the name that it means.
    """

    keys: Callable[[Requirement], Iterator[str]]
    meant: Callable[[Site, Provision], bool]
    whole: bool = False


def _whole(requirement: Requirement) -> Iterator[str]:
    yield requirement.name


def _last(requirement: Requirement) -> Iterator[str]:
    yield requirement.name.replace("::", "/").replace(".", "/").rstrip("/").rpartition("/")[2]


def _plugin_name(requirement: Requirement) -> Iterator[str]:
    yield requirement.name.replace("::", "/")


def _launch_keys(requirement: Requirement) -> Iterator[str]:
    yield requirement.name
    yield f"{requirement.name}?"


def _called_keys(requirement: Requirement) -> Iterator[str]:
    for last in _last(requirement):
        yield last
        yield f"{last}()"


def _prefixes(requirement: Requirement) -> Iterator[str]:
    """The name and each name that it begins with: `a::B` of `a::B::c`; constants and messages are found with dots."""
    parts = requirement.name.split("::")
    for count in range(2, len(parts) + 1):
        yield "::".join(parts[:count])
        yield ".".join(parts[:count])


def _dotted_keys(requirement: Requirement) -> Iterator[str]:
    yield requirement.name
    yield from _last(requirement)


def _graph(site: Site, entity: Provision) -> bool:
    return graph_name_matches(entity.name, site.requirement.name)


def _resolved_keys(requirement: Requirement) -> Iterator[str]:
    yield requirement.name
    yield from _last(requirement)


def _resolved(site: Site, entity: Provision) -> bool:
    """Names that are whole: nothing is put before them; a computed part is anything."""
    return _exact(site, entity) or (entity.is_computed and whole_name_matches(entity.name, site.requirement.name))


def _branch_keys(requirement: Requirement) -> Iterator[str]:
    yield requirement.name
    yield from folders_of(requirement.name)


def _branch(site: Site, entity: Provision) -> bool:
    """A name of the owner, one that such names lie below, or one below a name that stands for all below it."""
    wanted = site.requirement
    if wanted.owner != entity.owner:
        return False
    return wanted.name == entity.name or (entity.facet != ABOVE and wanted.name.startswith(f"{entity.name}/"))


def _remap_keys(requirement: Requirement) -> Iterator[str]:
    for name in (requirement.name, requirement.target):
        yield name.rstrip("/").rpartition("/")[2]


def is_of_program(requirement: Requirement, package: str) -> bool:
    """Whether a remap is of a program of a package: then the name before it is that of the package."""
    return requirement.package == package


def _remap(site: Site, entity: Provision) -> bool:
    """A remap of the providing program gives its name another one; that of another program leads to its name."""
    wanted = site.requirement
    if wanted.package is None:
        return False
    name = wanted.name if is_of_program(wanted, entity.package) else wanted.target
    return bool(name) and (name.lstrip("~/") == entity.name.lstrip("~/") or graph_name_matches(entity.name, name))


def _parameter(site: Site, entity: Provision) -> bool:
    wanted = site.requirement
    if wanted.package is not None and wanted.package != entity.package:
        return False
    if entity.ros not in (None, wanted.ros) and wanted.row.same_ros:
        return False
    if not parameter_name_matches(entity.name, wanted.name):
        return False
    if entity.is_computed and _is_of_other_plugin(site, entity):
        return False
    return wanted.ros == 1 or entity.is_computed or node_matches(entity.owner, wanted.owner)


def _is_of_other_plugin(site: Site, entity: Provision) -> bool:
    """Whether a value stands in the block of a plugin that the providing side does not have."""
    home = site.requirement.plugin.replace("::", "/").partition("/")[0]
    return bool(home) and home != entity.package and home not in site.folders


def _exact(site: Site, entity: Provision) -> bool:
    wanted = site.requirement
    same_place = wanted.package in (None, entity.package) and wanted.owner in ("", entity.owner)
    return same_place and wanted.name == entity.name


def _last_part(site: Site, entity: Provision) -> bool:
    """A name of whichever namespace, as what publishes diagnostics is known by."""
    return entity.name.rpartition("/")[2] == site.requirement.name


def _plugin(site: Site, entity: Provision) -> bool:
    return entity.name.replace("::", "/") == site.requirement.name.replace("::", "/")


def _exported_keys(requirement: Requirement) -> Iterator[str]:
    yield from (last_of(name) for name in named_in(requirement.name))


def _exported(site: Site, entity: Provision) -> bool:
    """Its own package may leave namespaces out; the one that builds the library of a description names it in full."""
    names = tuple(named_in(site.requirement.name))
    if entity.package != site.requirement.package:
        return entity.name in names
    return last_of(entity.name) in map(last_of, names)


def _launch(site: Site, entity: Provision) -> bool:
    wanted = site.requirement
    name = entity.owner if entity.row.part else entity.name
    return wanted.package == entity.package and wanted.name == name


def _header(site: Site, entity: Provision) -> bool:
    """A header of that name, or one that is generated of an interface, which the index has found by its headers."""
    return entity.row.generated or (entity.name == site.requirement.name and not entity.is_python)


def _python(site: Site, entity: Provision) -> bool:
    """A dotted name, also one that a module above the declaring one offers as its own."""
    name = site.requirement.name
    if entity.row.generated:
        return name in python_names(entity.name)
    if not entity.is_python:
        return False
    full = f"{entity.owner}.{entity.name}" if entity.row.fixed else entity.name
    if full == name:
        return True
    module, _, last = name.rpartition(".")
    return name in site.bound and full.startswith(f"{module}.") and full.rpartition(".")[2] == last


def called_names(entity: Provision, bases: Bases) -> Iterator[str]:
    """Yield the dotted names that a Python function or constructor is called by."""
    if not entity.row.part:
        yield entity.name
    elif entity.name == "__init__":
        yield entity.owner
        yield from bases.handing_on(entity)


def _called(site: Site, entity: Provision) -> bool:
    """A package may offer a name above the module that has it, so the module has only to begin that of the name."""
    name = site.requirement.name
    module, _, last = name.rpartition(".")
    if not entity.is_python or not module:
        return False
    targets = called_names(entity, site.bases)
    return any(each == name or (each.startswith(f"{module}.") and each.rpartition(".")[2] == last) for each in targets)


def _result(site: Site, entity: Provision) -> bool:
    """Functions go by their dotted name; methods by their own, in files that import from the same package."""
    if not entity.is_python:
        return False
    top = (entity.owner or entity.name).partition(".")[0]
    return entity.name == site.requirement.name and top in site.consumer.modules_of(site.path)


def _method(site: Site, entity: Provision) -> bool:
    return entity.name == site.requirement.name and not entity.is_python


def _cpp(site: Site, entity: Provision) -> bool:
    """A name of a package of which the file includes a header; of a message the type that is generated of it."""
    if entity.row.generated:
        return _is_type(entity, site.requirement.name)
    # of a large library nearly all names differ, and whose header is included takes longer to tell
    return not entity.is_python and _is_written(entity, site.requirement.name) and _reaches(site, entity.package)


def _is_written(entity: Provision, name: str) -> bool:
    if entity.row.fixed:
        return _is_section(entity, name.rpartition("::")[0])
    return name == entity.name or name.startswith(f"{entity.name}::")


def _is_type(message: Provision, written: str) -> bool:
    """Whether `a_msgs::State` or `a_msgs::msg::State` is written; names below it are those of its constants."""
    return written.replace("::", ".") in section_owners(message.name, "")


def _reaches(site: Site, package: str) -> bool:
    included = site.consumer.headers_of(site.path)
    return any(package in site.folders.get(header.partition("/")[0], ()) for header in included)


def _is_section(entity: Provision, owner: str) -> bool:
    """Whether a type as written is the one whose section has a field or constant."""
    if "/" not in entity.owner:
        return False
    return owner.replace("::", ".") in section_owners(entity.owner, entity.facet)


def _override(site: Site, entity: Provision) -> bool:
    wanted = site.requirement
    if entity.name != wanted.name or entity.is_python or not any(form.virtual for form in entity.forms):
        return False
    base = site.bases.meant(wanted.owner, wanted.scope)
    return base is not None and entity.owner in site.bases.ancestry(base) and _is_seen(site, base, entity)


def _is_seen(site: Site, base: str, entity: Provision) -> bool:
    """Whether a base that is written without its namespace comes by a header of the package that has it."""
    return site.bases.resolve(site.requirement.owner, site.requirement.scope) == base or _reaches(site, entity.package)


def _member(site: Site, entity: Provision) -> bool:
    wanted = site.requirement
    if _is_section(entity, wanted.owner) or _is_section(entity, site.ways.end(wanted.owner, wanted.scope)):
        return entity.own_name == wanted.name
    if entity.name != wanted.name or entity.is_python:
        return False
    return entity.owner in site.bases.ancestry(site.ways.end(wanted.owner, wanted.scope))


def _field(site: Site, entity: Provision) -> bool:
    return entity.own_name == site.requirement.name and _is_section(entity, site.requirement.owner)


NAMES: Final[Mapping[str, Names]] = {
    "exact": Names(_whole, _exact),
    "last": Names(_whole, _last_part),
    "graph": Names(_last, _graph, whole=True),
    "resolved": Names(_resolved_keys, _resolved, whole=True),
    "branch": Names(_branch_keys, _branch),
    "remap": Names(_remap_keys, _remap),
    "parameter": Names(_last, _parameter, whole=True),
    "plugin": Names(_plugin_name, _plugin),
    "exported": Names(_exported_keys, _exported),
    "launch": Names(_launch_keys, _launch),
    "header": Names(_whole, _header),
    "python": Names(_dotted_keys, _python),
    "called": Names(_called_keys, _called),
    "result": Names(_dotted_keys, _result),
    "method": Names(_whole, _method),
    "cpp": Names(_prefixes, _cpp),
    "override": Names(_whole, _override),
    "member": Names(_whole, _member),
    "field": Names(_whole, _field),
}
