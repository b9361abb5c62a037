"""This package writes program files as TOML and reads them strictly, with errors that name line and key."""
