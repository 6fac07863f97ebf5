"""Training the network: the only room that loads torch."""
