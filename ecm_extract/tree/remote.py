"""The public name of a repository: its remote without user, password, token or machine path."""

import re
from urllib.parse import urlsplit

from ecm_extract.errors import GitError
from ecm_extract.tree.base import printable
from ecm_extract.tree.git_repo import GitRepo

_SCP_FORM = re.compile(r"(?:[^@/]*@)?(?P<host>[\w.-]{2,}):(?P<path>[^:]+)")
_PUBLIC_SCHEMES = frozenset({"https", "http", "ssh", "git"})


def repository_name(repo: GitRepo) -> str:
    """URL of the remote `origin` without credentials, else the name of the repository's folder."""
    config = repo.common_dir / "config"
    if not config.is_file():
        return repo.name
    try:
        # --file reads one text file: no program that it names is run, no include followed.
        status, out = repo.run(
            "config",
            "--file",
            str(config),
            "--no-includes",
            "--get",
            "remote.origin.url",
            accept=(0, 1, 3, 128),
        )
    except GitError:
        return repo.name
    url = out.decode("utf-8", "surrogateescape").strip() if status == 0 else ""
    return public_url(url) or repo.name


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
