"""This package runs NC programs as each control reads and compensates them.

`registry` runs a program on any control by name; `judging` judges its path against the programmed contour;
`compared_controls` compares all controls on one program, `compared_contours` two programs of any language.

Word-address controls share the reader, the modal machine and the macros of `iso` and the joints of `compensation`;
`makers` holds what each control does differently and says how to add one.  `klartext` reads its own language.  All of
them return the moves, findings and stretches of `control_run`.  `write` writes a compensated contour as a control's own
program.

Where a maker's manual says nothing, cutcomp makes a choice and reports it in a finding, or it is listed here:

* positions before the first motion are machine zero, and so are work offsets and reference points that are not set;
* the height of a machine point is unknown: no rapid is compared with a contour until an absolute word gives the
  height;
* a corner arc, a generated block and a miter belong to the line of the element after the corner and have its feed;
* the 9/Series makes generated blocks of any length, looks across 10 blocks without motion, and has no least feed
  inside arcs: the machine builder sets all three; backwards moves are R8 for lines and R10 for arcs;
* threeblock takes corners under 0.05 degrees as tangent, and T with tool data as a call of that tool;
* inside an arc that is not larger than the tool, threeblock runs about the same center beyond it: a gouge, reported;
* Fanuc and Haas: the findings FN-PARAM, FN-G1, FN-G2 and FN-N2-ARC say which rules are stated and which are assumed;
  loops are given up after 100,000 rows without movement, 20,000 without progress of their conditions, or 1,000,000 rows
  run again;
* compensation left on at the end of a threeblock program is reported as an error and stops nothing;
* the orientation of a lathe tool shifts moves on LinuxCNC; on RosettaCNC they stay those of the nose's center;
* on the 9/Series G80 ends a cycle and keeps the motion mode before it; on threeblock it leaves no motion mode;
* Klartext arcs outside the working plane count their angles from the plane's first axis: Z in Z/X, Y in Y/Z;
* Klartext cycles are skipped to their known end, or to the next absolute words;
* expressions and parameters of 9/Series and threeblock programs are not evaluated: the run ends there and says so;
* the radii of an arc may differ by 0.0005 in (0.0127 mm) or a thousandth: LinuxCNC and Klartext have their own limits.
"""
