"""Nothing of the machine may show in a picture: colours, themes and options of the environment are cleared."""

from __future__ import annotations

import os

KEPT = "TEXTUAL_SNAPSHOT_"
"""The snapshot plugin's own, set before this is read when the tests are named by their top folder."""

for name in list(os.environ):
    if (name.startswith("TEXTUAL_") and not name.startswith(KEPT)) or name in ("NO_COLOR", "FORCE_COLOR"):
        del os.environ[name]
os.environ["COLUMNS"], os.environ["LINES"] = "80", "24"
