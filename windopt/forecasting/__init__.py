"""Forecasting the next 40 minutes of wind from the last two hours."""
