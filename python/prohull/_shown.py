"""What meshes, hulls, covers, cages and robots have in common: they can be looked at."""

from typing import TYPE_CHECKING, Optional

from ._types import Progress

if TYPE_CHECKING:
    from ._view import Part, View


class Shown:
    """What view() shows."""

    def show(self, *, progress: Optional[Progress] = None) -> "View":
        """Shows it in three dimensions: in a notebook as the value of a cell, elsewhere in a browser.

        A hull is shown with its levels or around its original, a cover or a cage with the mesh that it is of, a robot
        with sliders for its joints. It is view(self) (docs/guides/view.md).

        progress: called as build() calls it.
        """
        from . import _view  # which imports what is shown

        return _view.open_view(self, progress)

    def _view_parts(self) -> "list[Part]":
        raise NotImplementedError
