"""What turbines do to each other's wind: the exact model that judges every yaw set-point."""
