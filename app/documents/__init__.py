"""Documents on disk: program files, the lock of who has one open, and the journal of edits that a crash cannot lose."""
