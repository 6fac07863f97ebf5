"""Forecasters of the wind over the next minutes, behind one interface."""
