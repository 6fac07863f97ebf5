"""The only translation: domain objects to arrays, to programs, to plans."""
