"""Program files: TOML text read strictly, and written so that there is always one whole file."""
