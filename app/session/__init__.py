"""The session holds everything that the screens show."""
