"""Settings of all tests: what is found must not depend on how busy the machine is."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("cutcomp", deadline=None, derandomize=True)
settings.load_profile("cutcomp")
