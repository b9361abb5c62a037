"""NC PROOF runs an NC program's text under a control's rules."""
