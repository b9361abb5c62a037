"""This package judges the path of a run: against its programmed contours, their stock, and what a shop asks for.

`judged_runs` takes a run apart with `contours_and_leads` and judges each stretch; `judged_findings` says what it found.
The others find one thing each.
"""
