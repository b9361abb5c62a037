"""This package writes contours as compensated programs for a control and reads them back through its rules."""
