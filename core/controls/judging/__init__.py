"""This package judges the path of a run: against its programmed contours, their stock, and what a shop asks for.

`judged_runs` takes a run apart with `contours_and_leads`, judges each stretch, and `judged_findings` says what it found; the
others find one thing each.
"""
