"""Instances and methods, measured: nobody imports this package."""
