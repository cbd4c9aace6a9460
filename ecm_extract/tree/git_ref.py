"""A tree read out of a git repository at a commit: no checkout, no file written in the repository."""

from collections.abc import Generator, Iterable, Iterator, Mapping
from contextlib import closing

from ecm_extract.errors import TreeError, TreeReadError
from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, printable
from ecm_extract.tree.git_batch import pipes, read_objects
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.listing import MAX_FILES, ListedTree, Listing, too_large, too_many

_CHUNK = 1 << 20
_MAX_LISTING_BYTES = 256 * _CHUNK
_MAX_LINK_BYTES = 4096
_FETCH_HINT = "Get it with `git fetch --refetch --no-filter origin`."


class GitTree(ListedTree):
    """The files of one tree object; see `Tree` for its members.

    Args:
        repo: the repository.
        tree_id: id of the tree object: of a commit's root, or of a folder in it.
        label: how the user named it.
        commit: id of the commit that the tree belongs to.
        repository: public name of the repository.
    """

    def __init__(self, repo: GitRepo, tree_id: str, *, label: str, commit: str, repository: str | None) -> None:
        super().__init__(label, commit, repository)
        self._repo = repo
        self._tree_id = tree_id
        self._submodules: dict[str, str] = {}

    @property
    def submodules(self) -> Mapping[str, str]:
        """Commit of each submodule that the tree names, by its path; their files are not part of this tree."""
        self.files()
        return self._submodules

    def read(self, path: str) -> bytes:
        """Content of one file; a process each, so prefer `read_many`."""
        blob = self._readable(path)
        for _, data in read_objects(self._repo, [blob]):
            if data is not None:
                return data
        raise _missing(path)

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given, out of one process."""
        wanted = list(self._wanted(paths))
        contents = read_objects(self._repo, [blob for _, blob in wanted])
        for (path, _), (_, data) in zip(wanted, contents, strict=True):
            if data is None:
                self._report_error(_missing(path))
            else:
                yield path, data

    def _wanted(self, paths: Iterable[str]) -> Iterator[tuple[str, str]]:
        for path in paths:
            try:
                yield path, self._readable(path)
            except TreeReadError as error:
                self._report_error(error)

    def _readable(self, path: str) -> str:
        """Blob id of a file that is here and small enough."""
        entry = self._entry(path)
        if entry.identity is None or entry.size is None:
            raise _missing(path)
        if entry.size > MAX_FILE_BYTES:
            raise too_large(path, entry.size)
        return entry.identity

    def _list(self) -> Listing:
        entries: list[Entry] = []
        links: list[Entry] = []
        with closing(self._records()) as records:
            for mode, entry in records:
                if mode == "160000":
                    self._submodules[entry.path] = entry.identity or ""
                elif mode == "120000":
                    links.append(entry)
                else:
                    entries.append(entry)
                if len(entries) + len(links) + len(self._submodules) > MAX_FILES:
                    raise too_many(self.label)
        return Listing(tuple(entries), self._targets(links))

    def _records(self) -> Generator[tuple[str, Entry], None, None]:
        """Mode and entry of each file, streamed: a few small objects can describe billions of files."""
        rest, total = b"", 0
        with self._repo.process("ls-tree", "-r", "-z", "-l", "--full-tree", self._tree_id) as process:
            _, stdout = pipes(process)
            while chunk := stdout.read(_CHUNK):
                total += len(chunk)
                if total > _MAX_LISTING_BYTES:
                    raise too_many(self.label)
                *records, rest = (rest + chunk).split(b"\0")
                yield from map(_record, records)
            if process.wait() != 0:
                message = f"{self.label} cannot be listed: the repository lacks some of its folders."
                raise TreeError(message, _FETCH_HINT)

    def _targets(self, links: list[Entry]) -> dict[str, str]:
        """Text of each link by its path; a text that is missing or too long leads nowhere."""
        short = [link for link in links if link.size is not None and link.size <= _MAX_LINK_BYTES]
        texts = dict(read_objects(self._repo, sorted({link.identity or "" for link in short})))
        found = {link.path: texts.get(link.identity or "") or b"" for link in links}
        return {path: text.decode("utf-8", "surrogateescape") for path, text in found.items()}


def _record(record: bytes) -> tuple[str, Entry]:
    """Read `mode type id size<TAB>path`; the size is `BAD` of a blob that is missing, `-` of a submodule."""
    head, _, path = record.partition(b"\t")
    mode, _, blob, size = head.decode("ascii").split()
    entry = Entry(
        path=path.decode("utf-8", "surrogateescape"),
        size=int(size) if size.isdigit() else None,
        identity=blob,
        executable=mode == "100755",
    )
    return mode, entry


def _missing(path: str) -> TreeReadError:
    shown = printable(path)
    message = f"The content of {shown} is not in the repository (a partial clone, or damaged)."
    return TreeReadError(shown, "missing-blob", message, _FETCH_HINT)
