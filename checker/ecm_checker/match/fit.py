"""Whether a use fits what is provided under its name: one row for each way of the vocabulary."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Final

from ecm_checker.hub.kinds import Breach
from ecm_checker.hub.provision import Form, Provision
from ecm_checker.hub.requirement import Given, Requirement
from ecm_checker.match.class_names import differ, named_in
from ecm_checker.match.qos_fit import qos_fits

_FUTURE: Final = re.compile(r"future", re.IGNORECASE)
_SHARED: Final = re.compile(r"shared", re.IGNORECASE)
Fit = Callable[[Requirement, Provision], Breach | None]


def misfit(requirement: Requirement, provision: Provision) -> Breach | None:
    """Return in which way a use does not fit; None when it fits, or nothing tells."""
    fit = FITS.get(requirement.row.fit)
    return fit(requirement, provision) if fit is not None else None


def is_future(written: str, shared: bool) -> bool:
    """Whether a type is that of a future that is shared, which can be taken again, or of one that is not."""
    return _FUTURE.search(written) is not None and (_SHARED.search(written) is not None) is shared


def _again(requirement: Requirement, provision: Provision) -> Breach | None:
    """A call with one argument that gives a future that is not shared can be taken once."""
    forms = [form for form in provision.forms if form.required <= 1 <= len(form.types)]
    once = bool(forms) and all(is_future(form.returns, False) for form in forms)
    return "signature" if once else None


def left_out(given: Given, provision: Provision) -> tuple[str, ...]:
    """Return the arguments that a function asks for by a warning, and a call of it does not give."""
    places = {name: at for form in provision.forms for at, name in enumerate(form.names)}
    count = given.count or 0
    return tuple(name for name in provision.advised if name not in given.names and places.get(name, -1) >= count)


def _advised(requirement: Requirement, provision: Provision) -> Breach | None:
    given = requirement.given
    return "advice" if given is not None and left_out(given, provision) else None


def _type(requirement: Requirement, provision: Provision) -> Breach | None:
    """Whether what goes over a name is of another type, or less than what is asked for."""
    if _is_other_type(requirement, provision):
        return "type"
    asked = "qos" in requirement.row.breaches and requirement.ros != 1
    return "qos" if asked and not qos_fits(provision.qos, requirement.qos) else None


def _base(requirement: Requirement, provision: Provision) -> Breach | None:
    """Whether the very class that is described is exported for another base."""
    if requirement.type is None or provision.type is None or provision.name not in named_in(requirement.name):
        return None
    return "type" if differ(requirement.type, provision.type) else None


def _is_other_type(requirement: Requirement, provision: Provision) -> bool:
    known = requirement.type, provision.type
    return None not in known and requirement.type not in {provision.type, *provision.others}


def _takes_count(given: Given, form: Form) -> bool:
    at_most = len(form.types) if not any(each.endswith("...") for each in form.types) else given.count
    return given.count is None or form.required <= given.count <= (at_most or 0)


def _takes_names(given: Given, form: Form) -> bool:
    return all(name in form.names for name in given.names) or any(name.startswith("**") for name in form.names)


def _gives(given: Given, form: Form) -> bool:
    return not form.returns or form.returns == given.takes


def _is_overridden(given: Given, form: Form) -> bool:
    same_result = not form.returns or not given.returns or form.returns == given.returns
    return form.types == given.types and same_result


def _of_any_form(fits: Callable[[Given, Form], bool]) -> Fit:
    """A way to fit of what has forms: one of them must do."""

    def fit(requirement: Requirement, provision: Provision) -> Breach | None:
        given = requirement.given
        if given is None or not provision.forms:
            return None
        return None if any(fits(given, form) for form in provision.forms) else "signature"

    return fit


AGAIN: Final = "again"
FORM: Final = "form"
NAMES: Final = "names"
FITS: Final[Mapping[str, Fit]] = {
    "type": _type,
    "base": _base,
    AGAIN: _again,
    "advised": _advised,
    "count": _of_any_form(_takes_count),
    NAMES: _of_any_form(_takes_names),
    "result": _of_any_form(_gives),
    FORM: _of_any_form(_is_overridden),
}
