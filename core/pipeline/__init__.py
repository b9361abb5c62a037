"""Runs the stages in order, from what was typed to what the cutter does.

`derived` needs no numpy and is enough for a first screen; `derive` runs every stage, and its
`look_ahead_table` judges each look-ahead value; `jobs` turns a derived program into what is posted.
"""
