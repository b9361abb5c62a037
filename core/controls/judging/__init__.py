"""This package judges the path of a run: against its programmed contours, their stock, and what a shop asks for.

`judged_runs` judges each stretch with `judged_stretches`, which takes it apart with `contours_and_leads` and measures
the cuts into each contour with `judged_walls`; `judged_findings` says what was found.  The others find one thing each.
"""
