"""Advice: what a finding says and what would mend it."""
