"""What people in a wind farm talk about: farms, turbines, wind, fleets and plans."""
