"""Tolerances that several packages share, each named by the question it answers; in millimeters unless said.

A tolerance that one module alone needs stands at its head."""

from __future__ import annotations

from typing import Final

JOINED: Final = 1e-7
"""Are two points one point?  Offset ends this near are tangent: nothing is put between them."""

ROUNDING: Final = 1e-7
"""How much more than a limit may a difference of typed numbers be?  0.0001 in is the last digit of a form."""

CLOSED: Final = 0.00254 + ROUNDING
"""Is a programmed contour closed?  Its last end is this near to START (0.0001 in)."""

ARC_RADII: Final = 0.00254 + ROUNDING
"""May an arc's radii at its start and its end differ so much (0.0001 in)?  Beyond it the arc is refused."""

GRAZE: Final = 1e-7
"""Do a line and a circle that cross in two points touch in one?  They do when they overlap by no more than this."""

ON_PATH: Final = 1e-9
"""Does a computed point lie on a piece?  Slack at a piece's two ends, and for a touch between pieces."""

GOUGE: Final = 1e-6
"""Does the cutter enter the surface?  A path nearer than the radius by more than this gouges."""

UNCUT: Final = 1e-9
"""Does the cutter reach a point of the surface?  It does when the path is within the radius and this."""

AGREES: Final = 2e-5
"""Do two angles agree?  Radians, a little over the 0.001 degree to which the form shows them."""

STOCK: Final = 1e-4
"""Is what the cutter leaves on the surface worth a word?  A stretch left thinner than this everywhere is cut: no
machine is as exact, and curves drawn by many lines leave that much at every joint."""

SHOWN: Final = 0.00127
"""Is a length more than 0.0000 on a form in inches?  Half of its last digit."""

LARGEST: Final = 1e7
"""Is a coordinate one a machine could have?  Ten kilometers; beyond it doubles lose the last digit."""

LAST_PASS: Final = 1e-3
"""Is the rest of a depth a pass of its own?  A thinner one is cut together with the pass before it."""

CLEAR: Final = 1e-8
"""May the cutter stand at a place of the best path?  It is no nearer to the surface than the radius less this."""

CROWDED: Final = 1e-5
"""Are two meetings on one piece apart?  Nearer ones may be one place where three pieces meet."""

WHISKER: Final = 1e-3
"""Is a loose end of the best path rounding at a near-tangent joint?  A longer one is reported."""
