"""Nothing of the machine may show in a picture: colours, themes and options of the environment are cleared."""

from __future__ import annotations

import os

for name in [name for name in os.environ if name.startswith("TEXTUAL_") or name in ("NO_COLOR", "FORCE_COLOR")]:
    del os.environ[name]
os.environ["COLUMNS"], os.environ["LINES"] = "80", "24"
