"""Trees: the files of a folder or of a git ref, read the same way and never executed."""

from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, FileDiagnostic, Tree, blob_id, printable, unread_of
from ecm_extract.tree.checkout import left_out
from ecm_extract.tree.open import open_ref, open_repo, open_tree
from ecm_extract.tree.ref_hints import is_shallow
from ecm_extract.tree.refs import ReleaseTag, merge_base, newest_release, release_tags, resolve_commit
from ecm_extract.tree.unread import Unread, can_declare

__all__ = [
    "MAX_FILE_BYTES",
    "Entry",
    "FileDiagnostic",
    "ReleaseTag",
    "Tree",
    "Unread",
    "blob_id",
    "can_declare",
    "is_shallow",
    "left_out",
    "merge_base",
    "newest_release",
    "open_ref",
    "open_repo",
    "open_tree",
    "printable",
    "release_tags",
    "resolve_commit",
    "unread_of",
]
