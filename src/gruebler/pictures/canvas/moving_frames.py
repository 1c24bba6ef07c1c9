"""Moving pictures of whole frames, for what cannot be shown by bodies that shift and turn in the plane."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from gruebler.pictures.canvas.figure import MARGIN, Figure, svg_document
from gruebler.pictures.canvas.moving_picture import Clock
from gruebler.pictures.canvas.shapes import Point, Shape, bounds, moved_shape
from gruebler.pictures.canvas.svg import svg_element


@dataclass(frozen=True, slots=True, kw_only=True)
class FramePicture:
    """Frames that are shown one after the other, each as long as the others."""

    frames: tuple[tuple[Shape, ...], ...]
    clock: Clock
    page: Figure
    """Without shapes: size, title and description."""

    def figure_at(self, time: float) -> Figure:
        """The frame after a part of the time (0 to 1)."""
        frame = self.frames[int(time * len(self.frames)) % len(self.frames)]
        page = self.page
        return Figure(frame, width=page.width, height=page.height, title=page.title, description=page.description)

    def svg(self, *, styled: bool = True) -> str:
        """The frames as animated SVG (SMIL), repeated without end, without script; with the rules of its styles."""
        used = [shape.style for frame in self.frames for shape in frame]
        return svg_document(self.page, used if styled else None, self._groups())

    def _groups(self) -> Iterator[str]:
        count = len(self.frames)
        for k, frame in enumerate(self.frames):
            ends = [(k / count, "visible"), ((k + 1) / count, "hidden")][: 2 if k + 1 < count else 1]
            keys = [*([(0.0, "hidden")] if k else []), *ends]
            times, values = (";".join(column) for column in zip(*((f"{t:.4g}", v) for t, v in keys), strict=True))
            moves = (
                f'<animate attributeName="visibility" calcMode="discrete" dur="{self.clock.seconds:g}s" '
                f'repeatCount="indefinite" keyTimes="{times}" values="{values}"/>'
            )
            visibility = "hidden" if k else "visible"
            yield f'<g visibility="{visibility}">{moves if count > 1 else ""}{"".join(map(svg_element, frame))}</g>'


def frame_picture(frames: Sequence[Sequence[Shape]], clock: Clock, title: str, description: str) -> FramePicture:
    """The smallest moving picture around all its frames."""
    corner, size = bounds((shape for frame in frames for shape in frame), MARGIN)
    shift = Point(-corner.x, -corner.y)
    return FramePicture(
        frames=tuple(tuple(moved_shape(shape, shift) for shape in frame) for frame in frames),
        clock=clock,
        page=Figure((), width=size.x, height=size.y, title=title, description=description),
    )
