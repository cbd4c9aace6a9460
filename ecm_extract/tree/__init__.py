"""Trees: the files of a folder or of a git ref, read the same way and never executed."""

from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, FileDiagnostic, Tree, blob_id, printable
from ecm_extract.tree.checkout import left_out
from ecm_extract.tree.open import open_ref, open_repo, open_tree
from ecm_extract.tree.refs import ReleaseTag, merge_base, newest_release, release_tags, resolve_commit

__all__ = [
    "MAX_FILE_BYTES",
    "Entry",
    "FileDiagnostic",
    "ReleaseTag",
    "Tree",
    "blob_id",
    "left_out",
    "merge_base",
    "newest_release",
    "open_ref",
    "open_repo",
    "open_tree",
    "printable",
    "release_tags",
    "resolve_commit",
]
