"""The part of cutcomp that knows geometry, programs and controls, and nothing of screens."""
