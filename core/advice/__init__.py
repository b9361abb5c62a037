"""Advice: findings about fields and paths beyond the judge's verdict, and remedies that were cut and judged."""
