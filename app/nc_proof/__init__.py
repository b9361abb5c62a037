"""NC PROOF: an NC program's text under a control's rules."""
