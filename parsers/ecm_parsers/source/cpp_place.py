"""Where a declaration of C++ stands."""

from __future__ import annotations


class Place:
    """Where a declaration stands: scope, access, anonymous namespace, and the template parameters as written.

    `written` is None outside of templates, and empty for an explicit specialization; `defaults` are those of the
    parameters that have one, and `variadic` tells whether one is a pack.
    """

    __slots__ = ("access", "anonymous", "defaults", "scope", "variadic", "written")

    def __init__(
        self,
        scope: str = "",
        access: str = "",
        anonymous: bool = False,
        written: tuple[str, ...] | None = None,
        defaults: tuple[tuple[str, str], ...] = (),
        variadic: bool = False,
    ) -> None:
        self.scope = scope
        self.access = access
        self.anonymous = anonymous
        self.written = written
        self.defaults = defaults
        self.variadic = variadic

    @property
    def template(self) -> tuple[str, ...]:
        """The template parameters, none of what is no template."""
        return self.written or ()

    def inside(self, name: str, access: str = "") -> Place:
        """Return the place within a namespace of that name."""
        scope = f"{self.scope}::{name}" if self.scope and name else self.scope or name
        return Place(scope, access, self.anonymous or not name)

    def traits(self) -> tuple[str, ...]:
        """Return what the place makes of its declarations: hidden, anonymous, of a template that has a pack."""
        hidden = (self.access,) if self.access in {"private", "protected"} else ()
        packed = ("variadic",) if self.variadic else ()
        return (*hidden, "anonymous", *packed) if self.anonymous else (*hidden, *packed)
