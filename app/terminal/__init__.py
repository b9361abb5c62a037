"""The terminal's side: bytes, keys and character sets."""
