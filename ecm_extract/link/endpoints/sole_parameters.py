"""Names of parameters that stand for one parameter: one handle of one class, or of one file, reads or declares them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import NamedTuple

from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.declaring.match import handle_argument
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.naming.handles import Handles


class _Reader(NamedTuple):
    handle: Handle
    owner: Cls | File


class SoleParameters:
    """Tells them; what is asked of `mode` of the left arm says nothing of that of the right one."""

    def __init__(self, sites: Sites, handles: Handles) -> None:
        self._sites = sites
        self._handles = handles
        self._by_package: dict[str, list[Site]] = defaultdict(list)
        self._known: dict[tuple[str, str], bool] = {}

    def note(self, sites: Iterable[Site]) -> None:
        """Take the places that read or declare parameters."""
        for site in sites:
            self._by_package[site.root.file.package].append(site)

    def is_sole(self, name: str, package: str) -> bool:
        """Tell whether a name is that of one parameter in a package."""
        key = (name, package)
        if key not in self._known:
            self._known[key] = len({self._reader(site) for site in self._of(name, package)}) == 1
        return self._known[key]

    def _of(self, name: str, package: str) -> Iterable[Site]:
        told = ((site, self._sites.names.of(site)) for site in self._by_package.get(package, ()))
        return (site for site, values in told if any(value.text == name for value in values))

    def _reader(self, site: Site) -> _Reader:
        return _Reader(self._handles.of(handle_argument(site.form, site.call), site.env), site.owner or site.root.file)
