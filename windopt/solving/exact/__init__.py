"""Column generation for inspection flights: one idea per module."""
