"""The session: what the screens are drawn from."""
