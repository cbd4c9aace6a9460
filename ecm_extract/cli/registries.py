"""`--registry URL`, and the registry behind it; what is not installed is told with the line that installs it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import wraps
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import click

from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_checker.hub.package import Package
    from ecm_checker.profiles import Profiles
    from sqlalchemy.orm import Session

    from ecm_extract.outside import Outside
    from ecm_extract.registry.fit import Fit
    from ecm_extract.registry.scope import Scope
    from ecm_extract.registry.store import Registry


class ProfileFiles(NamedTuple):
    """Files of profiles as the user named them."""

    embodiment: str | None
    policy: str | None
    runtime: str | None


class KnownFrom(NamedTuple):
    """Where `lint` and `check` ask what is outside of the tree: a registry, and which of its releases are there."""

    registry: str | None
    environment: str | None
    distribution: str | None

    @property
    def is_asked(self) -> bool:
        """Whether a registry is named, on the command line or by the environment."""
        return any(each is not None for each in self) or bool(os.environ.get("ECM_REGISTRY"))


_NEEDED: Final = frozenset({"sqlalchemy", "alembic", "zstandard", "resolvelib", "mako"})

registry_option: Final[Callable[..., Any]] = click.option(
    "--registry",
    "url",
    metavar="URL|FILE",
    help="The registry: a SQLite file or a PostgreSQL URL.  [default: ECM_REGISTRY, else the user's own]",
)


def scope_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that say who is asked."""
    environment = click.option("--environment", metavar="NAME", help="Ask what this environment runs.")
    distribution = click.option("--distribution", metavar="FILE", help="Ask what a distribution.yaml or .repos lists.")
    return environment(distribution(function))


def known_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options that make known what is outside of the tree; the function gets them as `known`."""

    @wraps(function)
    def with_known(registry: str | None, environment: str | None, distribution: str | None, **rest: Any) -> Any:
        return function(known=KnownFrom(registry, environment, distribution), **rest)

    option = click.option(
        "--registry",
        is_flag=False,
        flag_value="",
        metavar="[URL|FILE]",
        help="Ask this registry what packages outside of the tree provide.  [default: ECM_REGISTRY, else none]",
    )
    return option(scope_options(with_known))


def outside_packages(known: KnownFrom, inside: Sequence[Package]) -> Outside:
    """Return what the registry knows outside of packages.

    Raises:
        InputError: there is no registry, or no such set of releases.
    """
    with open_registry(known.registry or None) as registry, registry.reading() as session:
        from ecm_extract.registry.outside import outside_of

        return outside_of(session, inside, scope_of(session, known.environment, known.distribution))


def scope_of(session: Session, environment: str | None, distribution: str | None) -> Scope:
    """Return the releases that options name.

    Raises:
        InputError: there is no such environment, or the file cannot be read.
    """
    from ecm_extract.registry.scope import EVERYTHING, distribution_scope, environment_scope

    if environment and distribution:
        message = "--environment and --distribution name two different sets of releases; give one"
        raise InputError(message)
    if environment:
        return environment_scope(session, environment)
    return distribution_scope(session, distribution) if distribution else EVERYTHING


def profile_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of profiles, which the function gets as `profiles`."""

    @wraps(function)
    def with_profiles(embodiment: str | None, policy: str | None, runtime: str | None, **rest: Any) -> Any:
        return function(profiles=ProfileFiles(embodiment, policy, runtime), **rest)

    given: Callable[..., Any] = with_profiles
    given = click.option("--runtime", metavar="FILE", help="What is installed beside the registry's packages.")(given)
    given = click.option("--policy", metavar="FILE", help="What governance allows.")(given)
    return click.option("--embodiment", metavar="FILE", help="What the robot has.")(given)


def read_profiles(files: ProfileFiles) -> Profiles:
    """Return the profiles of files.

    Raises:
        InputError: one of them cannot be read or does not fit its schema.
    """
    from ecm_checker.profiles import Embodiment, Policy, Profiles, Runtime

    from ecm_extract.check_inputs import profile

    return Profiles(
        profile(files.embodiment, Embodiment), profile(files.policy, Policy), profile(files.runtime, Runtime)
    )


def fit_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of an answer."""
    form = click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)
    level = click.option(
        "--fail-on",
        type=click.Choice(["reject", "review", "never"]),
        default="review",
        show_default=True,
        help="Exit with 1 when it may not; also when something about it is not known.",
    )
    return form(level(function))


def say_fit(found: Fit, form: str, fail_on: str) -> int:
    """Print whether releases fit, and return the exit status."""
    from ecm_extract.registry.texts import as_json, fit_text

    click.echo(as_json(found) if form == "json" else fit_text(found), nl=False)
    failing = {"reject": {"reject"}, "review": {"reject", "review"}, "never": set[str]()}[fail_on]
    return int(found.outcome in failing)


def open_registry(url: str | None) -> Registry:
    """Open a registry that is there.

    Raises:
        InputError: there is none, or the extra that it needs is not installed.
    """
    require_extra()
    from ecm_extract.registry.store import Registry

    return Registry(url)


def require_extra() -> None:
    """Make sure that what a registry needs is installed.

    Raises:
        InputError: it is not.
    """
    from importlib.util import find_spec

    absent = sorted(name for name in _NEEDED if find_spec(name) is None)
    if absent:
        message = f"a registry needs {', '.join(absent)}, which is not installed"
        raise InputError(message, "pip install 'ecm-extract[registry]'")
