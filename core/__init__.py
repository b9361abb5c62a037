"""The part of cutcomp that knows geometry, programs and controls; it does not depend on screens."""
