"""A transform mirrors or turns what a program describes about the datum: CYCL DEF 8 and CYCL DEF 10.

Steps are programmed as if there were none, and placed before the tool radius is added.  A mirror image of one axis
makes RL run on the right and turns arcs around; ROT counts from the working plane's first axis.  Sources: HEIDENHAIN
TNC 426/430 user's manual, coordinate transformation cycles and example 10.11 (datum shift, then rotation about it);
TNC 310 Pilot p. 8 (reference axis of ROT); TNC 320 user's manual p. 108 (cycles 7, 8 and 10 in the working plane).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians

from core.controls.compensation.elements import Element
from core.controls.klartext.center_path import ProgrammedStep
from core.controls.moves import Plane
from core.geometry.piece import Point


@dataclass(frozen=True, slots=True)
class Transform:
    """A mirror image and a rotation of the working plane about the datum, a point of the plane in millimeters.

    `mirrored`: True for each of the plane's axes that is reversed.  `angle`: degrees, counterclockwise.
    """

    plane: Plane = Plane.XY
    datum: Point = (0.0, 0.0)
    mirrored: tuple[bool, bool] = (False, False)
    angle: float = 0.0

    @property
    def neutral(self) -> bool:
        """True if it changes nothing."""
        return not any(self.mirrored) and not self.angle

    def placed(self, point: Point) -> Point:
        """Return where a programmed point lies."""
        x, y = self._turned((point[0] - self.datum[0], point[1] - self.datum[1]))
        return self.datum[0] + x, self.datum[1] + y

    def undone(self, point: Point) -> Point:
        """Return the point to program for a place."""
        x, y = rotated((point[0] - self.datum[0], point[1] - self.datum[1]), -self.angle)
        return self.datum[0] + self._signs[0] * x, self.datum[1] + self._signs[1] * y

    def placed_step(self, step: ProgrammedStep) -> ProgrammedStep:
        """Return a step as the control runs it."""
        if self.neutral:
            return step
        flip = self._signs[0] * self._signs[1]
        element = self._placed_element(step.element, -step.element.turn if flip < 0 else step.element.turn)
        return step._replace(element=element, offset=flip * step.offset, hand=int(flip) * step.hand)

    def _placed_element(self, element: Element, turn: int) -> Element:
        start, end, center = (self.placed(point) for point in (element.start, element.end, element.center))
        first, last = self._turned(element.start_direction), self._turned(element.end_direction)
        return element._replace(
            start=start, end=end, center=center, turn=turn, start_direction=first, end_direction=last
        )

    @property
    def _signs(self) -> Point:
        return (-1.0 if self.mirrored[0] else 1.0), (-1.0 if self.mirrored[1] else 1.0)

    def _turned(self, vector: Point) -> Point:
        return rotated((self._signs[0] * vector[0], self._signs[1] * vector[1]), self.angle)


def rotated(vector: Point, angle: float) -> Point:
    """Return a vector turned counterclockwise by an angle in degrees; multiples of 90 degrees are exact."""
    quarter = angle / 90.0
    if quarter.is_integer():
        c, s = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarter) % 4]
    else:
        c, s = cos(radians(angle)), cos(radians(angle - 90.0))
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]
