"""The public name of a repository: its remote without user, password, token or machine path."""

import re
from urllib.parse import urlsplit

from ecm_extract.errors import EcmError
from ecm_extract.tree.base import printable
from ecm_extract.tree.git_repo import GitRepo, config_text

_SCP_FORM = re.compile(r"(?:[^@/]*@)?(?P<host>[\w.-]{2,}):(?P<path>[^:]+)")
_SHELL_SAFE = re.compile(r"[\w][\w.-]*")
_PUBLIC_SCHEMES = frozenset({"https", "http", "ssh", "git"})


def repository_name(repo: GitRepo) -> str:
    """URL of the remote `origin` without credentials, else the name of the repository's folder."""
    url = _configured(repo, "--get", "remote.origin.url").strip()
    return public_url(url) or repo.name


def remotes(repo: GitRepo) -> list[str]:
    """Names of the remotes, `origin` first."""
    rows = _configured(repo, "--name-only", "--get-regexp", r"^remote\..*\.url$").splitlines()
    names = [row.removeprefix("remote.").removesuffix(".url") for row in rows]
    return sorted(filter(_SHELL_SAFE.fullmatch, names), key=lambda name: (name != "origin", name))


def _configured(repo: GitRepo, *query: str) -> str:
    """What the repository's own configuration says; empty where it says nothing, or git is not installed."""
    config = repo.common_dir / "config"
    if "remote" not in config_text(repo).lower():
        return ""
    try:
        # --file reads one text file: no program that it names is run, no include followed.
        status, out = repo.run("config", "--file", str(config), "--no-includes", *query, accept=(0, 1, 3, 128))
    except EcmError:
        return ""
    return out.decode("utf-8", "surrogateescape") if status == 0 else ""


def public_url(url: str) -> str | None:
    """`url` without user info, query and fragment; None for local paths and helper commands."""
    if "://" in url:
        return _public_scheme_url(url)
    scp = _SCP_FORM.fullmatch(url)
    return printable(f"ssh://{scp['host']}/{scp['path'].lstrip('/')}") if scp else None


def _public_scheme_url(url: str) -> str | None:
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError:
        return None
    if parts.scheme not in _PUBLIC_SCHEMES or not parts.hostname:
        return None
    host = f"{parts.hostname}:{port}" if port else parts.hostname
    return printable(f"{parts.scheme}://{host}{parts.path}")
