"""The order of the stages: from what was typed to what the cutter does.

`fields_stage` needs no numpy and is enough for a first screen; `derive` runs every stage; its
`look_ahead_table` judges each look-ahead value; `jobs` makes of a derived program what is posted.
"""
