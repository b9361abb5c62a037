"""Tolerances that several packages share, each with the question that it answers; in millimeters unless noted.

A tolerance that only one module needs is defined at the top of that module."""

from __future__ import annotations

from typing import Final

JOINED: Final = 1e-7
"""Are two points the same?  Offset ends within this distance are tangent: nothing goes between them."""

ROUNDING: Final = 1e-7
"""By how much may a difference of typed numbers exceed a limit?  0.0001 in is the last digit of a form."""

CLOSED: Final = 0.00254 + ROUNDING
"""Is a programmed contour closed?  It is if its last end is within this distance of START (0.0001 in)."""

ARC_RADII: Final = 0.00254 + ROUNDING
"""May an arc's radii at its start and its end differ by this much (0.0001 in)?  An arc beyond it is refused."""

GRAZE: Final = 1e-7
"""Do a line and a circle that cross in two points touch in one?  They do if they overlap by no more than this."""

ON_PATH: Final = 1e-9
"""Is a calculated point on a piece?  Slack at a piece's two ends, and for a touch between pieces."""

GOUGE: Final = 1e-6
"""Does the cutter enter the surface?  A path nearer than the radius by more than this gouges."""

UNCUT: Final = 1.5e-7
"""Does the cutter reach a point of the surface?  It does if the path is within the radius plus this.  A best path may
lie JOINED away from where its contour is typed."""

MIN_INDEPENDENT_SINE: Final = 1e-3
"""Do two conditions on a point determine it?  If the sine of the angle between them is smaller, the last digits of
typed numbers decide where it is."""

AGREES: Final = 2e-5
"""Do two angles agree?  Radians, a little more than the 0.001 degree that the form displays."""

STOCK: Final = 1e-4
"""Is the stock left on the surface worth reporting?  A stretch that is thinner everywhere counts as cut: no
machine is that exact, and curves drawn as many lines leave that much at every joint."""

SMALLEST_SHOWN_LENGTH: Final = 0.00127
"""Is a length more than 0.0000 on a form in inches?  Half of its last digit."""

LARGEST_COORDINATE: Final = 1e7
"""Is a coordinate one that a machine could have?  Ten kilometers; beyond it doubles lose the last digit."""

LAST_PASS: Final = 1e-3
"""Is the rest of a depth a pass of its own?  A thinner rest is cut together with the pass before it."""

CLEAR: Final = 1e-8
"""May a place be on the best path?  It may if it is no nearer to the surface than the radius less this."""

CROWDED: Final = 1e-5
"""Are two meetings on one piece separate?  Closer ones may be a single place where three pieces meet."""

WHISKER: Final = 1e-3
"""Is a loose end of the best path only rounding at a near-tangent joint?  A longer one is reported."""
