"""Program files: TOML text read strictly, line and key named, and written."""
